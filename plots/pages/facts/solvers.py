"""What a step costs by each solver."""

from pages.facts.table import condition, number, plain, table

SWEEP, SPLIT, WARP = "two cuts in motion", "conventional_split", "warp_and_refine"
METHODS = [WARP, "snap_or_split", "cgal_cdt", SPLIT, "delaunay_refine", "bowyer_watson"]
SHOWN = ["cg", "multigrid", "constant_factor", "cholmod"]


def ms(published, method):
    """{solver: milliseconds a step}"""
    rows = published.solvers[(published.solvers["sweep"] == SWEEP) & (published.solvers["method"] == method)]
    return rows.set_index("solver")["step_ms"]


def over_warp(published, solver):
    return ms(published, SPLIT)[solver] / ms(published, WARP)[solver]


@table("solvers")
def solvers(published):
    there = [solver for solver in SHOWN if solver in ms(published, SPLIT)]
    return ["method", *(f"`{solver}`" for solver in there)], [
        [f"`{method}`", *(plain(ms(published, method)[solver]) for solver in there)] for method in METHODS]


@number("solvers.multigrid_split_over_warp")
def by_multigrid(published):
    return plain(over_warp(published, "multigrid"))


@number("solvers.cg_split_over_warp")
def by_cg(published):
    return plain(over_warp(published, "cg"))


@condition("multigrid_hides_slivers", "by multigrid a step after conventional_split takes less than 1.5 times as long as after warp_and_refine, "
           "by cg more than 3 times")
def multigrid_hides_slivers(published):
    return over_warp(published, "multigrid") < 1.5 and over_warp(published, "cg") > 3
