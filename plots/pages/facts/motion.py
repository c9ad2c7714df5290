"""A hanging sheet that is cut and swings."""

from analysis.accuracy import motion
from pages.facts.table import bracket, condition, table

SHOWN = ["adaptive_remesh", "longest_edge", "cut_polygons", "cgal_refine", "global_remesh", "delaunay_refine", "bowyer_watson",
         "warp_and_refine", "active_node", "split_and_tie", "phantom_node", "virtual_node"]
SIZE = 3200


def ratios(published):
    """{method: error of the flap's motion over that after a plain split, and its interval}"""
    return {row[0]: row[1:4] for row in motion.ratios(published.flap, SIZE)}


@table("motion")
def of_flap(published):
    found = ratios(published)
    shown = sorted(SHOWN, key=lambda method: found[method][0])
    return ["method", "error over a plain split's [95 %]"], [
        [f"`{m}`", bracket(found[m][0], found[m][1:])] for m in shown]


@condition("motion_depends_on_method", "the flap's error by adaptive_remesh is surely below half that by conventional_split, that by phantom_node "
           "surely above it, and less than 1.5 times in the mean")
def motion_depends_on_method(published):
    found = ratios(published)
    return found["adaptive_remesh"][2] < 0.5 and found["phantom_node"][1] > 1 and found["phantom_node"][0] < 1.5


def strip(published, integrator):
    """Mean errors of the strip's lips by method, but for those that cut elsewhere."""
    rows = motion.of_problem(published.flap, "severed_strip", integrator)
    return rows[rows["resolution"] == SIZE].groupby("method")["error"].mean().drop([motion.REFERENCE, "edge_release", "element_deletion"])


@condition("strip_by_integrator", "errors of the strip that is cut right across differ by less than 10 % from method to method, and are more than "
           "three times as large by backward Euler as by the midpoint rule")
def strip_by_integrator(published):
    midpoint, euler = strip(published, "midpoint"), strip(published, "backward_euler")
    return midpoint.max() / midpoint.min() < 1.1 and euler.max() / euler.min() < 1.1 and euler.min() > 3 * midpoint.max()
