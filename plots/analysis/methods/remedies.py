"""Remedies for thin triangles: the largest eigenvalue that each leaves, and the error of its solutions."""

import numpy as np

from analysis import load, naming, shares
from analysis.accuracy.ranking import made_by_all
from analysis.load import of
from analysis.methods import kinds

STEM = "remedies"
ADDED_MASS = {  # columns of the records, and the methods that are shown with such a mass
    "stabilised": ["conventional_split", "delaunay_refine", "warp_and_refine"],
    "scaled": ["conventional_split"],
}
NAMES = {"ablation:warp+thin:tie": "warp + thin + tie",
         "phantom_node:consistent_mass": "phantom node, consistent mass"}


def label(method, parameter, mass=""):
    several = method.startswith("phantom_node") and parameter
    return NAMES.get(method, naming.words(method)) + (f", {parameter}" if several else "") + (f", {mass} mass" if mass else "")


def errors(records):
    """Of records ranked, at_equal_unknowns(). Excess error in percent, by (method, parameter): over a fitted mesh of as many
    unknowns, of the cases that no method failed, solved directly, with its 95 % interval, kinds of problems drawn anew; and after
    100 iterations over one of as many triangles. Kinds weigh alike. Also how many cases of how many kinds these are."""
    common = made_by_all(records.table)
    found = {}
    for variant in records.methods:
        made = of(common, variant)
        direct = made[made["direct"] & (made["ratio_equal"] > 0)]
        short = made[~made["direct"] & (made["ratio"] > 0)]
        mean, *ends = kinds.weighed_alike(np.log(direct["ratio_equal"]), direct["problem"])
        found[variant] = [mean, np.array(ends), kinds.weighed_alike(np.log(short["ratio"]), short["problem"])[0]]
        used = len(direct), direct["problem"].map(kinds.kind_of).nunique()
    return found, *used


def in_words(ends):
    return "-" if np.isnan(ends).any() else kinds.in_words(np.round(ends) + 0.0)  # no -0


def counts_of(run):
    """shares.Share by variant."""
    return shares.of_run(run, load.programs(run.everything(), run.context))


def beside_split(run):
    """{variant: median of its eigenvalue over that of shares.BASE on the same cut, of the cuts that both made}"""
    cuts = run.rows[run.rows["eigenvalue_ratio"].notna()].assign(failed=False)
    ratios = shares.over_base(cuts, "eigenvalue_ratio")
    if ratios is None:
        return {}
    return ratios.groupby([cuts["method"], cuts["parameter"]]).median().to_dict()


def rows_of(run, excess):
    """Of each method, and of some with an added mass: it leaves the errors at rest and the time of the cut as they are. Those
    that made few of their cuts come last, with eigenvalues by shares.fair_values()."""
    cuts, counts = run.rows[run.rows["eigenvalue_ratio"].notna()], counts_of(run)
    base, key = of(cuts, shares.BASE), load.cut_columns(cuts)
    rows = []
    for (method, parameter), here in cuts.groupby(["method", "parameter"], sort=False):
        few = counts[method, parameter].is_few
        single = here["cut_family"] != "several"
        per_crossed = (here["geometry_us"] / here["crossed_triangles"]).median()
        for mass in ["", *(m for m, methods in ADDED_MASS.items() if method in methods and f"{m}_eigenvalue_ratio" in here)]:
            prefix = f"{mass}_" if mass else ""
            ratio, bends = (shares.fair_values(here, base, f"{prefix}{kind}eigenvalue_ratio", key, few) for kind in ("", "bending_"))
            of_single = shares.fair_values(here[single], base[base["cut_family"] != "several"], f"{prefix}eigenvalue_ratio", key, few)
            rows.append([method, parameter, *np.quantile(ratio, [0.5, 0.95, 1]), *np.quantile(of_single, [0.95, 1]),
                         bends.median(), bends.quantile(0.95), *excess[method, parameter], per_crossed, mass])
    return sorted(rows, key=lambda r: (counts[r[0], r[1]].is_few, r[2]))
