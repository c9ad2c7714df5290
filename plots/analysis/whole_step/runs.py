"""The runs of whole steps, their settings, and the points of the chart of one setting."""

import numpy as np

from analysis import load
from analysis.whole_step import draws, points
from analysis.whole_step.points import SETTING

STEM = "whole_step"
SAME = "multigrid"
SOLVERS = {"cg_sliver_blocks": "CG", "multigrid": "MG", "cholmod": "direct"}
SUMMARY = (4, 1 / 240, 1000)  # the setting of readme_chart.png
CHART = "whole_step_chart"  # the run of this setting on more cuts


def setting_name(setting):
    cuts, step, stiffness = setting
    return f"{cuts:g} cut{'' if cuts == 1 else 's'}, step 1/{1 / step:.0f} s, E t {stiffness:g} N/m"


def at(table, setting):
    return table[np.isclose(table[SETTING].to_numpy(float), setting).all(axis=1)]


def setting_of(table):
    """Of a table of one setting."""
    return tuple(table[SETTING].iloc[0])


def spoken(counts):
    return " to ".join(dict.fromkeys(map(str, (counts.min(), counts.max()))))


def summarised(table):
    """SUMMARY, or the first setting of records that lack it."""
    return SUMMARY if len(at(table, SUMMARY)) else tuple(table[SETTING].iloc[0])


def read(folder, stem=STEM):
    """The rows and the context of a run, or those that are published in the folder."""
    published = not (folder / "records.csv").is_file() and (folder / f"{stem}.records.csv.xz").is_file()
    rows = load.read_records(folder / (f"{stem}.records.csv.xz" if published else "records.csv"),
                             [*SETTING, *points.TIMES, "solver"], all_columns=True)
    return rows, load.read_context(folder / (f"{stem}.context.json" if published else "context.json"))


def ways(cost):
    """How the solver of each method is chosen."""
    return {"best": points.best_of(cost), "same": cost[cost["solver"] == SAME]}


def read_chart(folder):
    """The rows of one setting and the context of the run of its own, which has more cuts of it, where that is there."""
    own = folder.resolve().with_name(CHART)
    if (folder / f"{CHART}.records.csv.xz").is_file():
        rows, context = read(folder, CHART)
    else:
        rows, context = read(own if (own / "records.csv").is_file() else folder)
    return at(rows, summarised(rows)), context


def chart(here, folder):
    """Of read_chart() the points of readme_chart.png, with the share of draws in which each is on the front."""
    table = points.joined(points.best_of(points.costs(here)), points.errors(points.LEADS, folder))
    share = draws.shares(points.motions(here), points.LEADS, folder).rename("share").reset_index()
    return table.merge(share, how="left", on=["method", "resolution"])
