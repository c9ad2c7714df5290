"""What the rows of experiments/advice/which_method.toml rest on (`rests_on`): a condition for each."""

from analysis import load
from analysis.stability.points import EXPLICIT
from pages.facts import stability, whole_step
from pages.facts.table import condition

KEEPING_LESS = ["conventional split", "delaunay refine", "warp and refine", "snap or split", "adaptive remesh"]


def step(published, name, sweep="single_cuts"):
    """95 % of the median explicit step, of the uncut sheet's."""
    return stability.interval(stability.rows_of(published, name, sweep), 0.5)


def median_step(published, name, sweep="single_cuts"):
    return stability.rows_of(published, name, sweep)[EXPLICIT].median()


def error(published, method):
    """95 % of the error on large sheets."""
    row = whole_step.error(published, method)
    return row["error_low"], row["error_high"]


def time(published, method):
    """95 % of the motion's time after twenty cuts, over that after a plain split."""
    return whole_step.interval(whole_step.ratios(published, method, 20))


def median_time(published, method):
    return load.median(whole_step.ratios(published, method, 20)["ratio"])


def surely_less(one, other):
    return one[1] < other[0]


@condition("choice_diagonal_mass", "the explicit step after cut_polygons is surely longer than after conventional_split, delaunay_refine, "
           "warp_and_refine, snap_or_split and adaptive_remesh, and shorter after four cuts; phantom_node's is surely longer, and its error surely larger")
def choice_diagonal_mass(published):
    polygons, copies = step(published, "cut polygons"), step(published, "phantom node")
    return (all(surely_less(step(published, name), polygons) for name in KEEPING_LESS)
            and median_step(published, "cut polygons", "several_cuts") < median_step(published, "cut polygons")
            and surely_less(polygons, copies) and surely_less(error(published, "cut_polygons"), error(published, "phantom_node")))


@condition("choice_stabilised_mass", "with a stabilised mass the explicit step after a plain split is surely longer than after cut_polygons, after single "
           "cuts and after four")
def choice_stabilised_mass(published):
    return all(surely_less(step(published, "cut polygons", sweep), step(published, "stabilised mass", sweep))
               for sweep in ("single_cuts", "several_cuts"))


@condition("choice_exact_path", "cut_polygons' error is surely below a plain split's, and its motion after twenty cuts surely faster; "
           "delaunay_refine's error is smaller, and its motion surely slower")
def choice_exact_path(published):
    return (surely_less(error(published, "cut_polygons"), error(published, whole_step.SPLIT)) and time(published, "cut_polygons")[1] < 1
            and whole_step.error(published, "delaunay_refine")["error"] < whole_step.error(published, "cut_polygons")["error"]
            and surely_less(time(published, "cut_polygons"), time(published, "delaunay_refine")))


@condition("choice_least_error", "no method's error is surely below adaptive_remesh's, and its motion after twenty cuts is surely faster than after "
           "delaunay_refine, cgal_refine and longest_edge")
def choice_least_error(published):
    least = error(published, "adaptive_remesh")
    return (not any(surely_less(error(published, m), least) for m in whole_step.SHOWN)
            and all(surely_less(time(published, "adaptive_remesh"), time(published, m)) for m in whole_step.REFINING))


@condition("choice_speed", "after twenty cuts the motion after active_node is surely faster than after a plain split, and after no method that errs less "
           "it is faster; edge_release's is surely faster still")
def choice_speed(published):
    mine = whole_step.error(published, "active_node")["error"]
    better = [m for m in whole_step.SHOWN if whole_step.error(published, m)["error"] < mine]
    return (time(published, "active_node")[1] < 1 and surely_less(time(published, "edge_release"), time(published, "active_node"))
            and all(median_time(published, "active_node") <= median_time(published, m) for m in better))
