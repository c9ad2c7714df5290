"""What a method costs in a scene that is cut again and again, and what the cut sheets' solutions err."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pandas as pd

from analysis import load, pareto
from analysis.accuracy.ranking import made_by_all
from analysis.accuracy.records import CASE, REFERENCE
from analysis.methods.kinds import kind_of

SETTING = ["place", "step_s", "stiffness_n_m"]  # cuts in the sheet, step, stiffness
BETWEEN_S = 0.25  # from one cut to the next
TIMES = ["cut_update_us", "first_step_us", "step_us"]
NO_ANSWER = 0.9  # an error that is on no front: that of a sheet that does not move is 1
TO_THE_END = {"ok", "energy_growth", "inverted"}  # verdicts of motions that made all their steps


class Measure(NamedTuple):
    title: str
    of: str  # what it is an error of, in the words of a caption
    stem: str  # of the published records
    column: str
    kind: Callable  # of a table of records, for each row: what the mean is taken over; none: the row does not count

    def files(self, folder):
        """Its published records and their context, in published_in() of the folder."""
        folder = published_in(folder)
        return folder / f"{self.stem}.records.csv.xz", folder / f"{self.stem.removesuffix('.direct')}.context.json"


def _by_kind(table):
    return table["problem"].map(kind_of)


def _out_of_plane(table):
    return table["problem"].where(table["problem"] != "trouser_tear")  # it ranks nothing: docs/notebook/which_method_cuts_best.md


def _in_motion(table):
    return table["sheet"].where(table["problem"] == "hanging_sheet_backward_euler")


LEADS = "energy_norm"  # has no sign: nothing cancels in it
MEASURES = {
    LEADS: Measure("energy norm", "kinds of problems at rest", "method_comparison_accuracy.direct", "error_energy_norm",
                   _by_kind),
    "released_energy": Measure("primary measure of each problem", "kinds of problems at rest",
                               "method_comparison_accuracy.direct", "error", _by_kind),
    "out_of_plane": Measure("out of plane", "problems out of plane at rest", "out_of_plane", "error", _out_of_plane),
    "motion": Measure("gape in motion", "sheets, hanging sheet, backward Euler", "motion", "error_gape_motion", _in_motion)}


def steps_between(step_s):
    return np.round(BETWEEN_S / step_s)


def motions(rows):
    """The rows of the sheets that the method does not refuse, with ms for one cut and the 0.25 s after it: infinitely many
    where the motion ended early."""
    made = rows["verdict"].isin(TO_THE_END)
    total = (rows["cut_update_us"] / rows["place"] + rows["first_step_us"]
             + (steps_between(rows["step_s"]) - 1) * rows["step_us"]) / 1000
    rows = rows.assign(ms=total.where(made, np.inf), made=made, cut_ms=rows["cut_update_us"] / rows["place"] / 1000)
    refused = (rows["verdict"] == "refused").groupby([rows["method"], rows["sheet"]]).transform("all")
    return rows[~refused]


def costs(rows):
    """A row per setting, method, size and solver: the median and the quartiles of the ms of motions(). `grew`: share of the
    cases in which energy came from nowhere."""
    found = []
    for key, here in motions(rows).groupby([*SETTING, "method", "resolution", "solver"], sort=False):
        low, middle, high = load.quantiles(here["ms"], [0.25, 0.5, 0.75])
        found.append(dict(zip([*SETTING, "method", "resolution", "solver"], key)) | {
            "ms": middle, "ms_low": low, "ms_high": high, "cut_ms": load.median(here["cut_ms"]), "n": len(here),
            "failed": int((~here["made"]).sum()), "grew": (here["verdict"] == "energy_growth").mean(),
            "sheets": here["sheet"].nunique()})
    return pd.DataFrame(found)


def best_of(table):
    """Of each setting, method and size the solver that is the fastest in the median."""
    return table.loc[table.groupby([*SETTING, "method", "resolution"], sort=False)["ms"].idxmin()]


def published_in(folder):
    """The folder, or its part reference/, where that holds the published rows of all MEASURES, else results/reference."""
    for place in (folder, folder / "reference"):
        if all((place / f"{measure.stem}.records.csv.xz").is_file() for measure in MEASURES.values()):
            return place
    return load.REPOSITORY / "results/reference"


def errors(measure, folder):
    """errors_of() the published rows."""
    return errors_of(published(measure, folder))


def published(measure, folder):
    """The published rows, of published_in() the folder, of direct solves of the cases that all methods made, but for methods that miss over half of that kind
    and sheet, which have no row there, with `kind` and `size`, the absolute relative error. \\param measure  a key of MEASURES"""
    measure = MEASURES[measure]
    table = load.read_records(measure.files(folder)[0], load.TEXT + ["problem", "solver", "primary", "budget", "error"] + load.COUNTS,
                              all_columns=True)
    table = table.assign(kind=measure.kind(table), failed=pareto.failed_rows(table), size=table[measure.column].abs())
    table = table[(table["budget"] == 0) & table["kind"].notna()]
    key = [table[c] for c in ("method", "parameter", "sheet", "kind")]
    table = made_by_all(table[table["failed"].groupby(key).transform("mean") <= 0.5])
    return table[table["size"] > 0]


def with_fitted(table):
    """Rows of published() with `log`, the logarithm of the ratio of `size` to that of the fitted mesh in the same case."""
    fitted = table.loc[table["method"] == REFERENCE[0], CASE + ["size"]]
    pairs = table.merge(fitted, on=CASE, suffixes=("", "_fitted"))
    return pairs.assign(log=np.log(pairs["size"] / pairs["size_fitted"]))


def by_kind(pairs):
    """Of rows of with_fitted(), two tables of logarithms with a column per kind of problem: by size, the fitted mesh's geometric mean
    of `size`; by (method, size), the ratio to it in the cases that the method made. NaN: it made none."""
    fitted = pairs[pairs["method"] == REFERENCE[0]]
    levels = np.log(fitted["size"]).groupby([fitted["resolution"], fitted["kind"]]).mean().unstack()
    return levels, pairs.groupby(["method", "resolution", "kind"])["log"].mean().unstack().reindex(columns=levels.columns)


def errors_of(table, pooled=False):
    """Of rows of published(), by (method, size) or, `pooled`, by method with size 0: the geometric mean of `size` over kinds of
    problems. It is the fitted mesh's, times the ratio to it in the cases that the method made, so that a method that
    refuses a sheet is not better for it. Its interval: how the ratio changes as kinds are drawn anew (bootstrap, 95 %)."""
    pairs = with_fitted(table)
    if pooled:
        pairs = pairs.assign(resolution=0)
    levels, ratios = by_kind(pairs)
    cases, found = pairs.groupby(["method", "resolution"]).size(), []
    for (method, resolution), here in ratios.iterrows():
        here, middle = here.dropna(), np.exp(levels.loc[resolution].mean())
        low, high = middle * np.exp(np.quantile(load.drawn_means(here), [0.025, 0.975]))
        found.append({"method": method, "resolution": resolution, "error": middle * np.exp(here.mean()), "error_low": low,
                      "error_high": high, "cases": cases[method, resolution], "kinds": len(here)})
    return pd.DataFrame(found)


def joined(cost, error):
    """Both, of the methods and sizes that have both, with the layer of the front in each setting. A row with energy from
    nowhere in more than half of its motions is on none, nor is one with an error of NO_ANSWER: what went wrong has no price."""
    table = cost.merge(error, on=["method", "resolution"])
    sound = table["ms"].where((table["grew"] <= 0.5) & (table["error"] < NO_ANSWER), np.inf)
    table["layer"] = 0
    for index in table.groupby(SETTING).groups.values():
        table.loc[index, "layer"] = load.front_layers(sound[index], table.loc[index, "error"])
    return table
