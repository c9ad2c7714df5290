"""The points of the stability sweeps: what became of all cases of a point, and where a series of points breaks."""

import numpy as np

from analysis import load, shares

EXPLICIT = "explicit_step_ratio"
WORST_LAST = ["ok", "refused", "solver_stalled", "newton_failed", "inverted", "energy_growth", "not_finite", "failed",
              "wrong", "timed_out", "crashed"]
UNMADE = {"refused", "failed", "wrong", "timed_out", "crashed"}
CUT = ["sweep", "sheet", "resolution", "cut", "place", "case", "repetition"]
NAMES = {"conventional_split": "conventional split", "bowyer_watson": "Bowyer-Watson", "cgal_cdt": "CGAL CDT",
         "delaunay_refine": "Delaunay refine", "cgal_refine": "CGAL refine", "longest_edge": "longest edge",
         "global_remesh": "global remesh", "warp_and_refine": "warp and refine", "vertex_snap": "vertex snap", "active_node": "active node",
         "snap_or_split": "snap or split", "edge_release": "edge release", "split_and_tie": "split and tie", "cut_polygons": "cut polygons",
         "ablation:warp+thin:tie": "warp, thin, tie", "element_deletion": "element deletion"}
ADDED_MASS = ["stabilised", "scaled"]  # values of `mass` that are remedies
SOLVERS = {"cg": "CG", "cg_sliver_blocks": "sliver blocks", "multigrid": "multigrid", "cholmod": "CHOLMOD",
           "constant_factor": "constant factor"}


def read(folder):
    """The rows, with columns `name` (of the method, for figures), `share` (of `place` and its like) and `worse`."""
    path = folder / "records.csv"
    table = load.read_records(path if path.is_file() else folder / "stability.records.csv.xz", ["sweep", "place", EXPLICIT],
                              all_columns=True)
    table["name"] = [name_of(*row) for row in zip(table["method"], table["parameter"], table["mass"])]
    table["sweep"] = table["sweep"].str.removesuffix("_added_mass")
    known = set(WORST_LAST)
    table["verdict"] = [v if v in known else "wrong" for v in table["verdict"]]  # of the oracle: what, is in the reason
    table["rank"] = table["verdict"].map(WORST_LAST.index)
    return table


def name_of(method, parameter, mass):
    if mass in ADDED_MASS:  # after a conventional split
        return f"{mass} mass"
    return f"phantom, ghost {parameter.partition('=')[2]}" if method.startswith("phantom_node") and parameter else NAMES.get(method, method.replace("_", " "))


def on_the_page(rows):
    """Without the scaled mass, which has long steps because it makes the sheet many times heavier: no remedy to be shown beside others."""
    return rows[rows["mass"] != "scaled"]


def shares_of(rows):
    """{name: shares.Share} of cuts: motions that end badly are made, too."""
    unmade = rows["verdict"].isin(UNMADE)
    return {name: shares.counted(here, unmade[here.index]) for name, here in rows.groupby("name", sort=False)}


def steps_of(rows, name, base, few):
    """Explicit steps after the cuts of one that may have made `few`: shares.fair_values() beside those of `base`."""
    of_name = [rows[rows["name"] == n] for n in (name, base)]
    return shares.fair_values(*of_name, EXPLICIT, CUT, few)


def worst(rows, by):
    """A row for each value of `by`, in the order of the records: the worst verdict of its cases, and the worst measures."""
    groups = rows.groupby(by, sort=False)
    table = groups.agg(rank=("rank", "max"), cases=("rank", "size"), ok=("rank", lambda r: (r == 0).mean()),
                       explicit=(EXPLICIT, lambda step: step.min(skipna=False)), least_known=(EXPLICIT, "min"),
                       unknown=(EXPLICIT, lambda step: step.isna().sum()), step_us=("step_us", "max"), iterations=("iterations", "max"),
                       geometry_us=("geometry_us", "median"), energy_gain=("energy_gain", "max"), drift=("drift_h", "max"))
    table["verdict"] = [WORST_LAST[r] for r in table["rank"]]
    return table.reset_index()


def breaking_point(values, good):
    """(the last value that was good before the first that was not, the first that was not); None where there is none. The
    values are in the order from harmless to harmful."""
    last = None
    for value, is_good in zip(values, good):
        if not is_good:
            return last, value
        last = value
    return last, None


def text(value):
    return "-" if value is None or (isinstance(value, float) and np.isnan(value)) else f"{value:.7g}"
