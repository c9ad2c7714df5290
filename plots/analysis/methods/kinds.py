"""The error of every method by kind of problem and by measure: what a mean over all problems hides."""

import numpy as np
import pandas as pd

from analysis import shares
from analysis.accuracy.ranking import fair_excess, made_by_all, mean_excess, ranked_by
from analysis.accuracy.records import CASE, REFERENCE
from analysis.load import drawn_means, of
from analysis.methods.errors import last_if_few

STEM = "method_comparison_accuracy_kinds"
KINDS = {"crack": ("centre_crack", "inclined_crack"), "arc": ("arc_crack",), "edge crack": ("edge_crack",),
         "hole": ("kirsch_hole",), "tip field": ("williams",), "row of cracks": ("collinear_cracks",),
         "loaded lips": ("loaded_lips",), "crossing": ("crossed_cracks",), "corner": ("corner",),
         "ellipse": ("elliptic_hole",), "bent plate": ("bent_plate",), "frequency": ("free_strip",)}  # by the beginnings of their names
TWICE = "two_cuts_one_geometry"  # has the exact answer of centre_crack
MEASURES = ["energy_norm", "displacement_l2", "opening", "k1"]
WHAT = ("error over that of a body-fitted mesh with as many unknowns, minus one, %: mean over kinds of problems (geometric), its 95 % "
        "interval by drawing the kinds anew, and by kind; then errors by measure, over those of a mesh with as many triangles as "
        "the uncut sheet")


def kind_of(problem):
    return next((kind for kind, names in KINDS.items() if problem.startswith(names)), None)


def completed(kinds, base):
    """\\param kinds  {kind: excess in percent}. With the kinds that `base` has alone, as those of a method that refuses them: the value of
    `base`, times the mean ratio to it in the others. To leave them out would flatter it where they are hard for all."""
    shared = [kind for kind in kinds if kind in base]
    if not shared or not set(base) > set(kinds):
        return kinds
    ratio = np.mean([np.log1p(kinds[kind] / 100) - np.log1p(base[kind] / 100) for kind in shared])
    return {kind: kinds[kind] if kind in kinds else 100 * np.expm1(np.log1p(base[kind] / 100) + ratio) for kind in base}


def mean_over(kinds):
    """\\param kinds  {kind: excess in percent}. The geometric mean of the ratios, in percent."""
    return 100 * (np.exp(np.log1p(np.array(list(kinds.values())) / 100).mean()) - 1)


def interval(kinds):
    """The ends of that of mean_over(), 95 %, of all draws of kinds with replacement (bootstrap)."""
    means = drawn_means(np.log1p(np.array(list(kinds.values())) / 100))
    return 100 * (np.exp(np.quantile(means, [0.025, 0.975])) - 1)


def weighed_alike(logs, problems):
    """\\param logs  of ratios, a row per case. The geometric mean of kinds and the ends of its interval, 95 %, kinds drawn anew: each
    minus one, in percent. A problem of no kind (TWICE) is left out."""
    by_kind = dict(100 * np.expm1(logs.groupby(problems.map(kind_of)).mean()))
    return (mean_over(by_kind), *interval(by_kind)) if by_kind else (np.nan,) * 3


def in_words(ends):
    return " to ".join(f"{end:+.0f}" for end in ends) if np.isfinite(ends).all() else "-"


def by_measure(direct, fitted, measure):
    """The absolute error of one measure over the fitted mesh's of the same case: geometric mean minus one, %."""
    column = f"error_{measure}"
    pairs = direct.merge(fitted[CASE + [column]], on=CASE, suffixes=("", "_fitted"))
    ratio = pairs[column].abs() / pairs[f"{column}_fitted"].abs()
    return mean_excess(pairs.assign(ratio=ratio), "ratio")


def kinds_of(common, variant, measure):
    """{kind: excess in percent} of the kinds that a method made."""
    made = set(of(common, variant)["kind"])
    return {kind: fair_excess(common[common["kind"] == kind], variant, measure.column) for kind in KINDS if kind in made}


def table_of(records):
    """A row per method, most accurate first, by ranked_by(). \\param records  ranked, at_equal_unknowns()"""
    measure = ranked_by(records)
    table = records.table[records.table["direct"] & (records.table["problem"] != TWICE)]
    table = table.assign(kind=table["problem"].map(kind_of))
    table = table[table["kind"].notna()]
    fitted = of(table, REFERENCE)
    refuses = table.groupby([table[c] for c in ("method", "parameter", "sheet", "kind")])["failed"].transform("all")
    common = made_by_all(table[~refuses])
    base = kinds_of(common, shares.BASE, measure)
    rows = []
    for variant in records.methods:
        made, kinds = of(common, variant), kinds_of(common, variant, measure)
        if not kinds:
            continue
        whole = completed(kinds, base)
        rows.append({"method": variant[0], "parameter": variant[1], "error, kinds": mean_over(whole),
                     "error, its 95 %": in_words(interval(whole)),
                     **{f"error, {kind}": value for kind, value in kinds.items()},
                     **{f"error, by {m}": by_measure(made, fitted, m) for m in MEASURES
                        if f"error_{m}" in made}})
    if not rows:
        return pd.DataFrame(columns=["method", "parameter", "error, kinds"])
    result = last_if_few(pd.DataFrame(rows).sort_values("error, kinds", kind="stable"), records)
    result.attrs["note"] = measure.note and f"{measure.note} All here are over {measure.fitted}."
    return result
