"""Explicit steps after single cuts and after four."""

import numpy as np

from analysis.stability.points import EXPLICIT
from pages.facts.table import bracket, condition, drawn_whole, number, plain, table

NAMES = {"`conventional_split`": "conventional split", "the same, stabilised mass": "stabilised mass", "`cut_polygons`": "cut polygons",
         "`phantom_node`": "phantom node", "`virtual_node`": "virtual node", "`active_node`": "active node",
         "`edge_release`": "edge release", "`warp_and_refine`": "warp and refine",
         "`snap_or_split`": "snap or split", "`adaptive_remesh`": "adaptive remesh", "`delaunay_refine`": "delaunay refine"}


def rows_of(published, name, sweep="single_cuts"):
    rows = published.stability
    return rows[(rows["sweep"] == sweep) & (rows["name"] == name)]


def interval(rows, share):
    """Each cut is on several sheets; the cuts are drawn anew, each with all of its sheets."""
    return np.quantile(np.quantile(drawn_whole(rows, ["cut", "case"], EXPLICIT), share, axis=1), [0.025, 0.975])


def quantile(published, name, share, sweep="single_cuts"):
    rows = rows_of(published, name, sweep)
    return bracket(rows[EXPLICIT].quantile(share), interval(rows, share))


@table("explicit")
def explicit(published):
    head = ["method", "median [95 %]", "95 % of the cuts have at least", "median after four cuts"]
    return head, [[label, *(quantile(published, name, share) for share in (0.5, 0.05)), quantile(published, name, 0.5, "several_cuts")]
                  for label, name in NAMES.items()]


@number("stability.step.conventional_split")
def split(published):
    return plain(rows_of(published, "conventional split")[EXPLICIT].median())


@number("stability.step.stabilised_mass")
def stabilised(published):
    return plain(rows_of(published, "stabilised mass")[EXPLICIT].median())


@number("stability.step.stabilised_mass.interval")
def stabilised_interval(published):
    return quantile(published, "stabilised mass", 0.5)


@number("stability.step.cut_polygons")
def polygons(published):
    return plain(rows_of(published, "cut polygons")[EXPLICIT].median())


@number("stability.step.cut_polygons.interval")
def polygons_interval(published):
    return quantile(published, "cut polygons", 0.5)


BY_DISTANCE = [f"{sweep}_solvers" for sweep in ("vertex", "edge", "border", "tip", "angle", "strip", "in_a_row")]


@condition("polygons_ok_in_implicit_steps", "all points of cut_polygons in the sweeps of solvers over distances, angles and numbers of cuts are ok")
def polygons_ok_in_implicit_steps(published):
    rows = published.stability
    rows = rows[rows["sweep"].isin(BY_DISTANCE) & (rows["name"] == "cut polygons")]
    return len(rows) > 0 and bool((rows["rank"] == 0).all())


@condition("no_solver_past_a_vertex", "after conventional_split past a vertex each solver has a distance at which its point is not ok")
def no_solver_past_a_vertex(published):
    rows = rows_of(published, "conventional split", "vertex_solvers")
    return bool((rows.groupby("solver")["rank"].max() > 0).all())


@condition("split_breaks_in_explicit_steps", "the median explicit step after conventional_split, and after delaunay_refine, is surely below a "
           "twentieth of the uncut sheet's")
def split_breaks_in_explicit_steps(published):
    return all(interval(rows_of(published, name), 0.5)[1] < 0.05 for name in ("conventional split", "delaunay refine"))


LONG = ["stabilised mass", "phantom node", "virtual node"]


@condition("everything_for_single_cuts", "cut_polygons: the median explicit step is at least 0.3 of the uncut sheet's, 95 % have at least 0.1, "
           "after four cuts not; with a stabilised mass, by phantom_node and by virtual_node both after single and after four cuts")
def everything_for_single_cuts(published):
    def long(name, sweep):
        steps = rows_of(published, name, sweep)[EXPLICIT]
        return steps.median() >= 0.3 and steps.quantile(0.05) >= 0.1
    return (long("cut polygons", "single_cuts") and not long("cut polygons", "several_cuts")
            and all(long(name, sweep) for name in LONG for sweep in ("single_cuts", "several_cuts")))


def share_not_ok(rows):
    """By solver."""
    return (rows["rank"] > 0).groupby(rows["solver"]).mean()


@condition("strips_are_harder", "by each solver more points of strip_solvers are not ok than of vertex_solvers")
def strips_are_harder(published):
    rows = published.stability
    strips, vertices = (share_not_ok(rows[rows["sweep"] == f"{sweep}_solvers"]) for sweep in ("strip", "vertex"))
    return bool((strips > vertices).all())


@condition("ten_iterations", "with 10 iterations allowed no point is ok by cg and cg_sliver_blocks, all are by multigrid")
def ten_iterations(published):
    rows = published.stability
    bad = share_not_ok(rows[(rows["sweep"] == "iterations") & (rows["max_iterations"] == 10)])
    return bool(bad["cg"] == 1 and bad["cg_sliver_blocks"] == 1 and bad["multigrid"] == 0)
