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


def errors_mm(published, method, tolerance=1e-2):
    """{solver: error after sixty steps} of the skin in steps of 1/240 s."""
    rows = published.solvers[(published.solvers["sweep"] == "settings") & (published.solvers["method"] == method)]
    rows = rows[(rows["material"] == "skin") & (rows["step"].round(6) == round(1 / 240, 6)) & (rows["tolerance"] == tolerance)]
    return 1000 * rows.set_index("solver")["error"]


@condition("residual_hides_errors", "at a residual of 1e-2 after conventional_split cg errs by more than 5 mm, multigrid and constant_factor by less "
           "than 1 mm; at 1e-4 cg errs by less than at 1e-2")
def residual_hides_errors(published):
    errors = errors_mm(published, SPLIT)
    return (errors["cg"] > 5 and max(errors["multigrid"], errors["constant_factor"]) < 1
            and errors_mm(published, SPLIT, 1e-4)["cg"] < errors["cg"])


@table("real_time")
def real_time(published):
    """Of realtime.txt: seconds, with a cut each quarter of one, until 99 % of the frames no longer take 16.7 ms or less."""
    until = {(words[0], words[1]): words[-1] for words in map(str.split, published.text("realtime.txt").splitlines())
             if len(words) == 14 and words[1].isdigit()}
    sizes = sorted({size for _, size in until}, key=int)
    methods = dict.fromkeys(method for method, _ in until)
    return ["method", *(f"{int(size):,} triangles" for size in sizes)], [
        [f"`{method}`", *(until[method, size] for size in sizes)] for method in methods]


@condition("largest_sheet_is_late", "at 12,800 triangles no method keeps up for more than half of the 20 s, at 800 all for more than half")
def largest_sheet_is_late(published):
    seconds = [list(map(float, row[1:])) for row in real_time(published)[1]]
    return all(row[-1] < 10 < row[0] for row in seconds)
