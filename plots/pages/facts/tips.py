"""Functions for the tips of cuts against more triangles."""

import numpy as np

from analysis import load
from pages.facts.table import condition, number, plain, table

METHODS = ["conventional_split", "snap_or_split", "warp_and_refine"]
POLYGONS = "cut_polygons"


def cases(published, method):
    """Errors by problem, sheet and member: columns (tip functions, triangles)."""
    here = published.tips[published.tips["method"] == method]
    return here.pivot(index=["problem", "sheet", "case"], columns=["tip_functions", "resolution"], values="error")


def surely_better(published, method):
    """Of the problems: in how many 3,200 triangles with tip functions surely err less than 12,800 without, the cases drawn anew."""
    by_problem = cases(published, method).groupby("problem")
    return sum(load.ratio(here[1, 3200], here[0, 12800])[2] < 1 for _, here in by_problem), by_problem.ngroups


@table("tips")
def tips(published):
    head = ["method", "800", "3,200", "12,800 triangles", "800, with tip functions", "3,200, with", "12,800, with"]
    rows = []
    for method in [*METHODS, POLYGONS]:
        errors = published.tips[published.tips["method"] == method].groupby(["tip_functions", "problem", "resolution"])["error"].mean()
        means = 100 * errors.groupby(["tip_functions", "resolution"]).mean()
        rows.append([f"`{method}`", *(plain(means[on, size]) for on in (0, 1) for size in (800, 3200, 12800))])
    return head, rows


@condition("tips_beat_triangles", "3,200 triangles with tip functions surely err less than 12,800 without, in all nine problems, by "
           "conventional_split, snap_or_split and warp_and_refine")
def tips_beat_triangles(published):
    return all(surely_better(published, method) == (9, 9) for method in METHODS)


@number("tips.polygons_surely")
def polygons_surely(published):
    names = ["none", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"]
    return names[surely_better(published, POLYGONS)[0]]


@condition("tips_polygons_in_some", "by cut_polygons the same in fewer problems than by the others")
def tips_polygons_in_some(published):
    return surely_better(published, POLYGONS)[0] < 9 and bool(np.isfinite(cases(published, POLYGONS).to_numpy()).all())
