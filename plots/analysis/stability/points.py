"""The points of the stability sweeps: what became of all cases of a point, and where a series of points breaks."""

import numpy as np

from analysis import load, naming, shares

EXPLICIT = "explicit_step_ratio"
WORST_LAST = ["ok", "refused", "solver_stalled", "newton_failed", "inverted", "energy_growth", "not_finite", "failed",
              "wrong", "timed_out", "crashed"]
UNMADE = {"refused", "failed", "wrong", "timed_out", "crashed"}
CUT = ["sweep", "sheet", "resolution", "cut", "place", "case", "repetition"]
ADDED_MASS = ["stabilised", "scaled"]  # values of `mass` that are remedies
SOLVERS = {"cg": "CG", "cg_sliver_blocks": "sliver blocks", "multigrid": "multigrid", "cholmod": "CHOLMOD",
           "constant_factor": "constant factor"}
INTEGRATORS = {"backward_euler": "backward Euler", "midpoint": "midpoint"}


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
    if method.startswith("phantom_node") and parameter:
        return f"phantom, ghost {parameter.partition('=')[2]}"
    return {"ablation:warp+thin:tie": "warp, thin, tie"}.get(method) or naming.words(method)


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


def row_words(column, value):
    """What a row of cells is called."""
    return {"solver": SOLVERS, "integrator": INTEGRATORS}.get(column, {}).get(value, f"{value:g} Newton" if column == "newton" else str(value))


def text(value):
    return "-" if value is None or (isinstance(value, float) and np.isnan(value)) else f"{value:.7g}"
