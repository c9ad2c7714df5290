"""A hanging sheet that is cut and swings."""

from analysis.accuracy import motion
from analysis.whole_step import points
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
           "with a consistent mass surely above it, and less than 1.5 times in the mean")
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


@condition("rest_ranks_motion", "the energy norm at rest and the gape in motion have a rank correlation of at least 0.8 at 800 and at 3,200 triangles")
def rest_ranks_motion(published):
    rest, moving = (points.errors(key, published.folder).set_index(["resolution", "method"])["error"] for key in (points.LEADS, "motion"))
    both = rest.to_frame("rest").join(moving.rename("moving"), how="inner").dropna()
    return all(both.loc[size]["rest"].corr(both.loc[size]["moving"], method="spearman") > 0.8 for size in (800, SIZE))
