"""Of the same cuts by all methods: shapes, steps, errors, prices."""

import numpy as np

from pages.facts.table import bracket, condition, interval_of, medians, number, percent, plain, signed, table

SPLIT, REFINED = "conventional_split", "delaunay_refine"
# Method: how it works, whether its path is exact, whether vertices stay. `cutbench methods` has the promises.
IDEAS = {"warp_and_refine": ("moves vertices", "no", "no"), "active_node": ("takes vertices out", "no", "no"),
         "vertex_snap": ("moves vertices", "no", "no"), "cisamr": ("moves vertices; structured grids only; not all of CISAMR", "no", "no"),
         "snap_or_split": ("moves the path", "no", "yes"), "edge_release": ("moves the path", "no", "yes"),
         "cut_polygons": ("merges", "yes", "yes"), "split_and_tie": ("constrains", "yes", "yes"), "phantom_node": ("copies", "yes", "yes"),
         "virtual_node": ("copies", "yes", "yes"),
         "adaptive_remesh": ("remeshes", "no", "no"), "global_remesh": ("remeshes", "no", "no"),
         "delaunay_refine": ("refines", "yes", "yes"), "cgal_refine": ("refines", "yes", "yes"), "longest_edge": ("refines", "yes", "yes"),
         "conventional_split": ("splits", "yes", "yes"), "cgal_cdt": ("splits", "yes", "yes"), "bowyer_watson": ("splits", "yes", "yes"),
         "example": ("splits", "yes", "yes"), "element_deletion": ("deletes triangles", "no", "no")}
CRACKS = ["crack", "arc", "edge crack", "tip field", "row of cracks", "loaded lips", "crossing"]
SHOWN = [SPLIT, REFINED, "cgal_refine", "global_remesh", "warp_and_refine", "active_node", "cut_polygons"]


def plain_signed(value):
    return "-" if np.isnan(value) else signed(value)


def of(published, method):
    return published.cuts[published.cuts["method"] == method]


def even(rows):
    """Without the graded sheet, whose largest eigenvalue is mostly elsewhere."""
    return rows[rows["sheet"] != "graded"]


def below_three(rows, column="ar_max_cut_strict"):
    """% of the cuts that changed triangles and left none with an aspect ratio of 3 or more, but at forced corners."""
    return 100 * (rows[column] < 3).sum() / max(1, rows["ar_max_cut_strict"].notna().sum())


def steps(published, method, column="eigenvalue_ratio"):
    """Largest stable steps of the membrane over that of the uncut sheet, even sheets."""
    return even(of(published, method))[column].dropna().to_numpy() ** -0.5


def step_in_words(values):
    return bracket(np.median(values), interval_of(values, medians))


@table("shapes_and_steps")
def shapes_and_steps(published):
    head = ["method", "all aspect ratios below 3, % of the cuts", "explicit step over the uncut sheet's [95 %]"]
    rows = [[f"`{m}`", percent(below_three(of(published, m))), step_in_words(steps(published, m))] for m in SHOWN]
    rows.insert(1, [f"`{SPLIT}`, stabilised mass", rows[0][1], step_in_words(steps(published, SPLIT, "stabilised_eigenvalue_ratio"))])
    return head, rows


@number("comparison.cuts")
def cuts(published):
    return f"{len(of(published, SPLIT)):,}"


@number("comparison.shorter.delaunay_refine")
def shorter(published):
    return plain(1 / np.median(steps(published, REFINED)))


@condition("shapes_force_short_steps", "delaunay_refine: aspect ratios below 3 in over half of its cuts, and its median step surely below "
           "a tenth of the uncut sheet's")
def shapes_force_short_steps(published):
    values = steps(published, REFINED)
    return below_three(of(published, REFINED)) > 50 and interval_of(values, medians)[1] < 0.1


@table("methods")
def methods(published):
    head = ["method", "how", "exact path", "vertices stay", "eigenvalue, even sheets: median", "95 %", "AR < 3, % of the cuts",
            "excess error, % [95 %]", "excess error in bent plates, %", "vertices added per crossed triangle", "us per crossed triangle"]
    rows = []
    for method, idea in IDEAS.items():
        here, errors = of(published, method), published.error_kinds.loc[method]
        eigenvalues, changed = even(here)["eigenvalue_ratio"], here["ar_max_cut_strict"].notna().any()
        low, high = errors["error, its 95 %"].split(" to ")
        rows.append([f"`{method}`", *idea, plain(eigenvalues.median()), plain(eigenvalues.quantile(0.95)),
                     percent(below_three(here)) if changed else "none changed",
                     f"{signed(errors['error, kinds'])} [{low}, {high}]", plain_signed(errors["error, bent plate"]),
                     plain(here["vertices_per_crossed"].median()), plain(here["us_per_crossed"].median())])
    return head, rows


@condition("refining_keeps_the_eigenvalue", "the median eigenvalue after delaunay_refine and cgal_refine is at least half of that after "
           "conventional_split")
def refining_keeps_the_eigenvalue(published):
    plain_split = even(of(published, SPLIT))["eigenvalue_ratio"].median()
    return all(even(of(published, m))["eigenvalue_ratio"].median() > plain_split / 2 for m in (REFINED, "cgal_refine"))


@condition("polygons_poor_in_bending", "cut_polygons errs less than a fitted mesh at all kinds of cracks in the plane, and more than twice as "
           "much in bent plates")
def polygons_poor_in_bending(published):
    errors = published.error_kinds.loc["cut_polygons"]
    return all(errors[f"error, {kind}"] < 0 for kind in CRACKS) and errors["error, bent plate"] > 100


@condition("path_movers_poor_in_bending", "snap_or_split and edge_release err more than 1.5 times as much as conventional_split in bent plates")
def path_movers_poor_in_bending(published):
    errors = 1 + published.error_kinds["error, bent plate"] / 100
    return all(errors[m] > 1.5 * errors[SPLIT] for m in ("snap_or_split", "edge_release"))
