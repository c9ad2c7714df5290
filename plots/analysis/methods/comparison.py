"""All methods on the same cuts: measures, ranks and tables."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pandas as pd

from analysis import load, shares
from analysis.load import of
from analysis.methods import details, distribution, errors, kinds
from analysis.methods.distribution import spread

STEM = "method_comparison"
MEASURES = ["crossed_triangles", "vertices_added", "angle_max_deg_cut", "altitude_min_h_cut", "ar_max_cut", "ar_p99_cut",
            "ar_max_cut_strict", "ar_p99_cut_strict", "ar_max_cut_outside_wedges", "ar_max_cut_away_from_wedges",
            "ar_p99_cut_outside_wedges",
            "wedge_area_rest2", "forced_corners", "eigenvalue_ratio", "bending_eigenvalue_ratio",
            "stabilised_eigenvalue_ratio", "incision_error_h", "area_change", "geometry_us"]
JUMPS = ["membrane_j", "membrane_jump_j", "bending_j", "bending_jump_j", "residual_n", "residual_jump_n", "kinetic_j",
         "kinetic_jump_j", "momentum_jump_kg_m_s"]


@dataclass(frozen=True)
class Measure:
    """A column, its label on the axis, and whether large or small values are bad."""
    column: str
    label: str
    worst: float = np.inf  # what a failed cut counts as
    linear: bool = False
    limits: tuple = ()  # of the axis; empty: what the values need
    written: Callable = distribution.two_digits  # a median as text
    short: str = ""  # of the label, where it is drawn over that of shares.BASE; empty: it is drawn as it is

    @property
    def beside(self):
        """The column of its values over those of shares.BASE, cut by cut; of a linear measure: minus those."""
        return f"{self.column}_{'minus' if self.linear else 'over'}_split"


SHAPES = [Measure("eigenvalue_ratio", "largest eigenvalue / uncut", short="largest eigenvalue"),
          Measure("altitude_min_h_cut", "smallest altitude, h", -np.inf, short="smallest altitude"),
          Measure("angle_max_deg_cut", "largest angle, °", linear=True, limits=(88, 183), written="{:.0f}".format,
                  short="largest angle, °")]
PRICE = [Measure("us_per_crossed", "µs per crossed triangle", short="time"),
         Measure("incision_error_h", "incision error, h", limits=(0.004, 2)),
         Measure("vertices_per_crossed", "vertices added per crossed tri.", linear=True,
                 short="vertices / crossed tri.")]
ROUNDING = 1e-12  # relative jumps below it are rounding errors


def written_jump(value):
    return "none" if value <= ROUNDING else distribution.two_digits(value)


JUMP = [Measure("membrane_jump", "membrane energy", written=written_jump), Measure("bending_jump", "bending energy"),
        Measure("residual_jump", "residual force")]
OURS = "warp_and_refine"  # the project's own method
BY_SHEET, AGAINST, ALTITUDE = f"{STEM}_by_sheet", f"{STEM}_pairs", f"{STEM}_altitude"
TITLES = {  # of the tables that are not medians over all cuts
    errors.STEM: errors.WHAT,
    kinds.STEM: kinds.WHAT,
    BY_SHEET: "cuts with every AR < 3 outside forced wedges, and farther than 0.02 h from them; median largest eigenvalues",
    f"{STEM}_jumps": "jumps at a cut in a moving sheet, over the value before the cut; 1e-12 stands for no jump",
    ALTITUDE: "largest eigenvalue against the square of the smallest altitude (h), of cuts with an eigenvalue over 100, on even sheets",
    AGAINST: f"the cuts of {OURS} and the same cuts by each other method",
    f"{AGAINST}_fine": f"the cuts of {OURS} and the same cuts by each other method, chord tolerance 0.01",
}
DERIVED = {  # groups of the columns that are computed from those of the records
    "vertices_per_crossed": "size", "us_per_crossed": "time", "ar_below_3": "forced", "excess_percent": "accuracy_run",
    "more_unknowns_percent": "accuracy_run", **{f"{name}_jump": "jump" for name in ("membrane", "bending", "residual")},
    **details.GROUPS,
}
SHARE = "made/refused/wrong %"
BLOCKS = [["accuracy_run"], ["stability", "shape"], ["forced"], ["size", "accuracy", "time", "outcome"], ["jump"], ["pairs"]]


def measured(run):
    """Each cut once, with the columns that are computed from others. A failed cut gets the worst value of each measure."""
    rows = run.rows[run.rows["status"] != "noop"].copy()
    rows["vertices_per_crossed"] = rows["vertices_added"] / rows["crossed_triangles"]
    shapes = [c for c in MEASURES if c.startswith(("ar_", "angle_", "altitude_"))]
    rows.loc[rows["ar_max_cut"] == 0, shapes] = np.nan  # edges were released and no triangle was changed
    rows.loc[rows["area_change"].abs() > 1e-6, "incision_error_h"] = np.nan  # removed triangles: no incision
    rows["us_per_crossed"] = rows["geometry_us"] / rows["crossed_triangles"]
    failed = run.failed.copy()
    failed[[c for c in MEASURES if c.startswith("ar_")]] = np.inf
    for m in SHAPES + PRICE:
        failed[m.column] = m.worst
    key = load.cut_columns(rows)  # eigenvalues are computed for some cuts only
    asked = pd.MultiIndex.from_frame(rows.loc[rows["eigenvalue_ratio"].notna(), key])
    failed["eigenvalue_ratio"] = np.where(pd.MultiIndex.from_frame(failed[key]).isin(asked), np.inf, np.nan)
    return pd.concat([rows, failed], ignore_index=True)


def jumped(run):
    rows = run.rows[(run.rows["cache"] == "simulation") & run.rows["membrane_j"].notna()].copy()
    for name, unit in (("membrane", "j"), ("bending", "j"), ("residual", "n")):
        rows[f"{name}_jump"] = (rows[f"{name}_jump_{unit}"].abs() / rows[f"{name}_{unit}"]).clip(lower=ROUNDING)
    return rows


def ranking(table, sheets, counts):
    """The variants, best first: by the sum of their ranks in the three measures of shape, each the mean over the sheets
    of the rank of the median there; those that made under half of their cuts (shares.Share) come last. Also the ranks."""
    variants = sorted(set(zip(table["method"], table["parameter"])))
    ranks = pd.DataFrame(index=variants, columns=[m.column for m in SHAPES], dtype=float)
    for m in SHAPES:
        per_sheet = pd.DataFrame({s: {v: np.sign(m.worst) * spread(of(table, v, s)[m.column], m.worst)[0][2] for v in variants}
                                  for s in sheets})
        per_sheet = per_sheet.rank(na_option="bottom")
        there = pd.DataFrame({s: {v: len(of(table, v, s)) > 0 for v in variants} for s in sheets})
        ranks[m.column] = per_sheet.where(there).mean(axis=1).reindex(ranks.index)
    ranks["sum"] = ranks.sum(axis=1)
    ranks = ranks.sort_values("sum", kind="stable")
    return ranks.loc[shares.last_if_few(ranks.index, counts)]


def summary(table, jumps, order, ranks):
    """The table: a row per method over all sheets, families and resolutions."""
    rows = []
    for variant in order:
        cuts = of(table, variant)
        row = {"method": variant[0], "parameter": variant[1], "cuts": len(cuts), "failed": int(cuts["failed"].sum()),
               "rank": ranks.loc[[variant], "sum"].iloc[0] / len(SHAPES)}
        for m in SHAPES + PRICE:
            quantiles, worst = spread(cuts[m.column], m.worst)
            row |= {f"{m.column}_median": quantiles[2], f"{m.column}_worst": worst}
        for m in (m for m in SHAPES + PRICE if m.beside in cuts):
            row[m.beside] = load.median(cuts[m.beside])
        for kind in ("strict", "outside_wedges"):
            for which in ("max", "p99"):
                row[f"ar_{which}_cut_{kind}_median"] = spread(cuts[f"ar_{which}_cut_{kind}"])[0][2]
            of_cuts = cuts[f"ar_max_cut_{kind}"].notna() | cuts["failed"]  # else no triangle was changed
            below = (cuts[f"ar_max_cut_{kind}"] < 3) & ~cuts["failed"]
            row[f"ar_below_3_{kind}"] = f"{int(below.sum())}/{int(of_cuts.sum())}"
        row["wedge_area_rest2_mean"] = cuts["wedge_area_rest2"].mean()
        if jumps is not None:
            for m in JUMP:
                row[f"{m.column}_median"] = of(jumps, variant)[m.column].median()
        rows.append(row)
    return pd.DataFrame(rows)


def blocks(table):
    """The columns of a table, in blocks that fit beside the method's name: one for each of BLOCKS."""
    groups = {column: load.group(column, DERIVED) for column in table.columns}
    return [found for block in BLOCKS if (found := [c for c, group in groups.items() if group in block])]


def as_text(name, table):
    """The title of the table and its blocks, numbers with three digits."""
    shown = table.copy()
    for column in shown.columns[shown.dtypes == float]:
        shown[column] = [f"{x:.3g}" if np.isfinite(x) else "-" for x in shown[column]]
    of_all = [c for c in ("method", "parameter", "cuts", SHARE, "outside", "rank") if c in shown]
    what = TITLES.get(name, "medians over the cuts of all families, sheets and sizes; the best shapes first")
    if table.attrs.get("note"):
        what += f". {table.attrs['note']}"
    return "\n".join([f"{name}: {what}\n"] + [shown[of_all + block].to_string(index=False) + "\n"
                                               for block in blocks(shown[shown.columns.difference(of_all, sort=False)])])


def with_shares(table, counts):
    """With the share of cuts made beside each method's name, and the number of those outside its domain where there are any."""
    found = [counts.get(variant, shares.Share()) for variant in table[load.VARIANT].itertuples(index=False, name=None)]
    if "parameter" not in table or not found:
        return table
    table = table.copy()
    table.insert(2, SHARE, [share.text() for share in found])
    if any(share.outside for share in found):
        table.insert(3, "outside", [share.outside for share in found])
    return table


def write_tables(folder, stem, tables, counts):
    """A CSV of each table of {name: table}, and one text of all, STEM.txt. \param counts  {name: shares.Share by variant}"""
    tables = {name: with_shares(table, counts[name]) for name, table in tables.items()}
    for name, table in tables.items():
        table.to_csv(folder / f"{name}.csv", index=False, float_format="%.6g")
        print(folder / f"{name}.csv")
    text = "\n".join(as_text(name, table) for name, table in tables.items())
    (folder / f"{stem}.txt").write_text(text, encoding="utf-8")
    print(folder / f"{stem}.txt", text, sep="\n\n")


def read_cuts(folder):
    return cuts_of(load.read(folder, MEASURES))


def cuts_of(run):
    """Each cut of a run once, as measured(), without those outside a method's domain (shares.is_outside), and with
    Measure.beside where shares.BASE is there."""
    run = run.first_repetition()
    table = measured(run)
    table["failed"] = (table["verdict"] != "ok") | table["status"].isin(["failed", "refused"])
    # A kind of sheet that a method is not made for says nothing about it.
    table = table[~shares.is_outside(table, load.programs(run.everything(), run.context))].copy()
    for m in (m for m in SHAPES + PRICE if m.short):
        beside = shares.over_base(table, m.column, m.linear)
        if beside is not None:
            table[m.beside] = beside
    return run, table


def counts_of(run):
    """shares.Share by variant of a run."""
    return shares.of_run(run, load.programs(run.everything(), run.context))
