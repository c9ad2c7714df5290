"""The points of the Pareto chart: those of whole_step.py, for each measure of the error, way to choose the solver, and setting."""

import numpy as np

from analysis import families
from analysis.whole_step import points, runs
from figures.methods import whole_step
from pages.report.comparison import files_of, origin

SHAPES = {"o": "circle", "s": "square", "D": "diamond", "^": "up", "v": "down", "X": "cross", "P": "plus"}
NUMBERS = ["ms", "ms_low", "ms_high", "cut_ms", "error", "error_low", "error_high", "grew"]
COUNTS = ["resolution", "n", "failed", "cases", "kinds", "layer"]
WAYS = {"best": "each by its fastest solver", "same": f"all by {runs.SAME}"}


def rounded(value):
    return float(f"{value:.6g}") if np.isfinite(value) else None


def point(row):
    return {"method": row["method"], "solver": row["solver"], **{c: rounded(row[c]) for c in NUMBERS},
            **{c: int(row[c]) for c in COUNTS}}


def as_json(results):
    """None without records. `points`: {"measure|way|cuts|step|stiffness": [point]}; layer 1 is the front."""
    files = files_of(results, runs.STEM)
    if not files:
        return None
    rows, _ = runs.read(files[0].parent)
    cost, found, absent = points.costs(rows), {}, {}
    methods = list(dict.fromkeys(rows["method"]))
    for measure in points.MEASURES:
        error = points.errors(measure, results)
        for way, some in runs.ways(cost).items():
            table = points.joined(some, error)
            for setting in {tuple(s) for s in table[points.SETTING].itertuples(index=False, name=None)}:
                key = "|".join([measure, way, *(f"{x:.6g}" for x in setting)])
                drawn = whole_step.near(runs.at(table, setting))
                found[key] = [point(row) for _, row in drawn.sort_values(["method", "resolution"]).iterrows()]
                absent[key] = whole_step.absent(drawn, methods)
    settings = cost[points.SETTING].drop_duplicates()

    def values(column, words):
        return [{"value": f"{x:.6g}", "label": words(x)} for x in sorted(settings[column].unique())]

    return {
        "points": found, "absent": absent, "real_time_ms": whole_step.REAL_TIME_MS,
        "origins": [origin(files), *(origin(files) for files in dict.fromkeys(m.files(results) for m in points.MEASURES.values()))],
        "groups": [{"name": f.name, "colour": f.colour, "shape": SHAPES[f.marker], "methods": f.methods}
                   for f in [*families.FAMILIES, families.OTHER]],
        "choices": [
            {"name": "cuts", "label": "cuts in the sheet", "options": values("place", lambda x: f"{x:g}")},
            {"name": "step", "label": "step", "options": values("step_s", lambda x: f"1/{1 / x:.0f} s")},
            {"name": "stiffness", "label": "stiffness E t", "options": values("stiffness_n_m", lambda x: f"{x:g} N/m")},
            {"name": "solver", "label": "solver", "options": [{"value": k, "label": v} for k, v in WAYS.items()]},
            {"name": "measure", "label": "error in", "options": [{"value": k, "label": m.title} for k, m in points.MEASURES.items()]}],
        "chosen": dict(zip(["cuts", "step", "stiffness"], (f"{x:.6g}" for x in runs.summarised(rows))))}
