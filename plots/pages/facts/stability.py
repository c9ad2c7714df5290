"""Explicit steps after single cuts and after four."""

import numpy as np

from analysis.stability.points import EXPLICIT
from pages.facts.table import bracket, drawn_whole, number, plain, table

NAMES = {"`conventional_split`": "conventional split", "the same, stabilised mass": "stabilised mass", "`cut_polygons`": "cut polygons",
         "`active_node`": "active node", "`edge_release`": "edge release", "`warp_and_refine`": "warp and refine",
         "`snap_or_split`": "snap or split", "`adaptive_remesh`": "adaptive remesh", "`delaunay_refine`": "Delaunay refine"}


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
