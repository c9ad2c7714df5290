"""A cut and the motion after it: time over that after a plain split, errors, fronts."""

import numpy as np

from analysis import load
from analysis.whole_step import runs
from analysis.whole_step.points import SETTING
from pages.facts.table import bracket, condition, number, plain, table

SPLIT, SIZE = "conventional_split", 12800
CASE = ["sheet", "resolution", "case", *SETTING]
SHOWN = ["edge_release", "active_node", "cut_polygons", "split_and_tie", "snap_or_split", "phantom_node", "virtual_node", SPLIT,
         "warp_and_refine", "adaptive_remesh", "delaunay_refine", "cgal_refine", "longest_edge"]
REFINING = ["delaunay_refine", "cgal_refine", "longest_edge"]
SHORT = ["active_node", "edge_release", "phantom_node", "virtual_node"]


def ratios(published, method, cuts):
    """Times over that of the same case after a plain split, both by the same solver, after so many cuts."""
    motions = published.motions[(published.motions["solver"] == runs.SAME) & (published.motions["place"] == cuts)]
    pairs = motions[motions["method"] == method].merge(motions.loc[motions["method"] == SPLIT, [*CASE, "ms"]], on=CASE, suffixes=("", "_other"))
    with np.errstate(invalid="ignore"):  # both ended early
        return pairs.assign(ratio=pairs["ms"] / pairs["ms_other"])


def interval(rows, draws=1000):
    """95 % of the median: the cuts are drawn anew, each with all of its settings."""
    cuts = [here["ratio"].to_numpy() for _, here in rows.groupby(["sheet", "resolution", "case"])]
    which = np.random.default_rng(1).integers(0, len(cuts), (draws, len(cuts)))
    return load.quantiles([load.median(np.concatenate([cuts[i] for i in drawn])) for drawn in which], [0.025, 0.975])


def in_words(published, method, cuts):
    rows = ratios(published, method, cuts)
    return bracket(load.median(rows["ratio"]), interval(rows))


def error(published, method, size=SIZE):
    """Row of the energy norm's error, as a share."""
    errors = published.energy_errors
    return errors[(errors["method"] == method) & (errors["resolution"] == size)].iloc[0]


def error_in_words(published, method):
    row = error(published, method)
    return bracket(100 * row["error"], (100 * row["error_low"], 100 * row["error_high"]))


@table("cut_and_motion")
def cut_and_motion(published):
    head = ["method", "motion after one cut [95 %]", "motion after twenty", "error, %"]
    return head, [[f"`{m}`", *("1" if m == SPLIT else in_words(published, m, cuts) for cuts in (1, 20)), plain(100 * error(published, m)["error"])]
                  for m in SHOWN]


@number("whole_step.cut_share")
def cut_share(published):
    front = published.fronts.query("layer == 1")
    return plain(load.median(100 * front["cut_ms"] / front["ms"]))


@condition("cut_is_small_part", "on the fronts cut and update take less than 2 % of the time in the median, less than 15 % everywhere, and the "
           "method with the fastest cut, example, is not the one with the fastest motion")
def cut_is_small_part(published):
    front = published.fronts.query("layer == 1")
    share = front["cut_ms"] / front["ms"]
    return load.median(share) < 0.02 and share.max() < 0.15 and load.median(ratios(published, "example", 1)["ratio"]) > 0.9


@condition("refining_is_dear", "after twenty cuts the medians of delaunay_refine, cgal_refine and longest_edge surely lie above "
           "3 times a plain split's time, those of active_node, edge_release, phantom_node and virtual_node surely below 0.67 "
           "times")
def refining_is_dear(published):
    return (all(interval(ratios(published, m, 20))[0] > 3 for m in REFINING)
            and all(interval(ratios(published, m, 20))[1] < 0.67 for m in SHORT))


@condition("polygons_gain_energy", "in the motions of the whole step by multigrid, at 1/60 s and 10,000 N/m, energy grows in over 40 % after "
           "every method, and after none more often than after cut_polygons")
def polygons_gain_energy(published):
    motions = published.motions[(published.motions["solver"] == runs.SAME) & (published.motions["step_s"] > 0.01)
                                & (published.motions["stiffness_n_m"] == 10000)]
    grew = (motions["verdict"] == "energy_growth").groupby(motions["method"]).mean()
    return grew.min() > 0.4 and grew.idxmax() == "cut_polygons"


@number("whole_step.error.conventional_split")
def error_of_split(published):
    return plain(100 * error(published, SPLIT)["error"])


@number("whole_step.error.cut_polygons")
def error_of_polygons(published):
    return plain(100 * error(published, "cut_polygons")["error"])


@number("whole_step.error.cut_polygons.interval")
def error_of_polygons_interval(published):
    return error_in_words(published, "cut_polygons")


@number("whole_step.error.adaptive_remesh")
def error_of_remesh(published):
    return plain(100 * error(published, "adaptive_remesh")["error"])


@number("whole_step.error.adaptive_remesh.interval")
def error_of_remesh_interval(published):
    return error_in_words(published, "adaptive_remesh")


@number("whole_step.twenty.active_node")
def twenty(published):
    return plain(load.median(ratios(published, "active_node", 20)["ratio"]))


@number("whole_step.twenty.active_node.interval")
def twenty_interval(published):
    return in_words(published, "active_node", 20)
