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


@condition("residual_hides_errors", "after conventional_split cg errs by more than 10 mm at a residual of 1e-2 and by 4 to 6 mm at 1e-4; multigrid by "
           "1.5 to 2.5 mm at 1e-2, and at 1e-4 by within one percent of a direct solve")
def residual_hides_errors(published):
    rough, fine = (errors_mm(published, SPLIT, tolerance) for tolerance in (1e-2, 1e-4))
    return (rough["cg"] > 10 and 4 < fine["cg"] < 6 and 1.5 < rough["multigrid"] < 2.5
            and abs(fine["multigrid"] / fine["cholmod"] - 1) < 0.01)


def real_time_rows(published):
    """Of realtime.txt, as words: method, triangles, verdict, frames, ms a frame: median, 99 %, worst, median of those with a cut, ..."""
    return [words for words in map(str.split, published.text("realtime.txt").splitlines()) if len(words) == 14 and words[1].isdigit()]


@table("real_time")
def real_time(published):
    """Of realtime.txt: seconds, with a cut each quarter of one, until 99 % of the frames no longer take 16.7 ms or less."""
    until = {(words[0], words[1]): words[-1] for words in real_time_rows(published)}
    sizes = sorted({size for _, size in until}, key=int)
    methods = dict.fromkeys(method for method, _ in until)
    return ["method", *(f"{int(size):,} triangles" for size in sizes)], [
        [f"`{method}`", *(until[method, size] for size in sizes)] for method in methods]


KEEP_UP = {"`edge_release`", "`element_deletion`", "`active_node`"}


@condition("largest_sheet_is_late", "at 3,200 triangles edge_release, element_deletion and active_node, and no others, keep up for all 20 s, and they do at "
           "800; at 12,800 no method for 5 s")
def largest_sheet_is_late(published):
    rows = real_time(published)[1]
    all_along = [{row[0] for row in rows if float(row[size]) == 20} for size in (1, 2)]
    return KEEP_UP <= all_along[0] and all_along[1] == KEEP_UP and all(float(row[-1]) < 5 for row in rows)


@condition("cut_is_not_the_reason", "at 12,800 triangles the median frame with a cut takes less than 2 times the median of all, by every method")
def cut_is_not_the_reason(published):
    return max(float(words[7]) / float(words[4]) for words in real_time_rows(published) if words[1] == "12800") < 2
