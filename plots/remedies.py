#!/usr/bin/env python3
"""Remedies for thin triangles: the largest eigenvalue that each leaves (results/remedies) against the error of its solutions
(results/remedies_accuracy), a table of both, and one of the errors by kind of problem and by measure."""

import numpy as np
from matplotlib.lines import Line2D

from accuracy_parts.ranking import at_equal_unknowns, made_by_all, mean_excess
from accuracy_parts.records import Records
from common import load, names, style
from common.load import of
from method_parts import kinds

STEM = "remedies"
KINDS = {  # colour, marker, and the methods whose remedy is of this kind
    "the mesh": ("#0072b2", "s", ["active_node", "warp_and_refine", "delaunay_refine", "adaptive_remesh"]),
    "the path": ("#7b3294", "v", ["snap_or_split", "edge_release"]),
    "the unknowns": ("#d55e00", "o", ["cut_polygons", "split_and_tie", "phantom_node", "ablation:warp+thin:tie"]),
    "the mass": ("#009e73", "^", ["phantom_node:lumped_mass"]),  # and all with an added mass
    "nothing": ("#444444", "D", ["conventional_split"]),
}
ADDED_MASS = {  # columns of the records, and the methods that are shown with such a mass
    "stabilised": ["conventional_split", "delaunay_refine", "warp_and_refine"],
    "scaled": ["conventional_split"],
}
NAMES = {"ablation:warp+thin:tie": "warp + thin + tie", "phantom_node:lumped_mass": "phantom node, lumped mass"}


def kind_of(row):
    return "the mass" if row[-1] else next(kind for kind, (_, _, methods) in KINDS.items() if row[0] in methods)


def label(method, parameter, mass=""):
    several = method == "phantom_node"
    return NAMES.get(method, method.replace("_", " ")) + (f", {parameter}" if several else "") + (f", {mass} mass" if mass else "")


def errors(folder):
    """Excess error in percent, by (method, parameter): over a fitted mesh of as many unknowns, of the cases that no method
    failed, solved directly, with its 95 % interval; and after 100 iterations over one of as many triangles. Also how many
    cases of how many problems these are."""
    records = at_equal_unknowns(Records(folder)).ranked()
    common = made_by_all(records.table)
    found = {}
    for variant in records.methods:
        made = of(common, variant)
        direct = made[made["direct"] & (made["ratio_equal"] > 0)]
        found[variant] = [mean_excess(direct, "ratio_equal"), interval(direct), mean_excess(made[~made["direct"]], "ratio")]
        used = len(direct), direct["problem"].nunique()
    return found, *used


def interval(direct):
    """The ends of that of the mean excess at equal unknowns in percent, 95 %: problems drawn anew (bootstrap)."""
    if direct.empty:  # one size of sheets alone
        return np.full(2, np.nan)
    return 100 * np.expm1(np.quantile(load.drawn_group_means(np.log(direct["ratio_equal"]), direct["problem"]), [0.025, 0.975]))


def in_words(ends):
    return "-" if np.isnan(ends).any() else kinds.in_words(np.round(ends) + 0.0)  # no -0


def rows_of(run, excess):
    """Of each method, and of some with an added mass: it leaves the errors at rest and the time of the cut as they are."""
    cuts = run.rows[run.rows["eigenvalue_ratio"].notna()]
    rows = []
    for (method, parameter), here in cuts.groupby(["method", "parameter"], sort=False):
        single = here["cut_family"] != "several"
        per_crossed = (here["geometry_us"] / here["crossed_triangles"]).median()
        for mass in ["", *(m for m, methods in ADDED_MASS.items() if method in methods)]:
            prefix = f"{mass}_" if mass else ""
            ratio, bends = here[f"{prefix}eigenvalue_ratio"], here[f"{prefix}bending_eigenvalue_ratio"]
            rows.append([method, parameter, *np.quantile(ratio, [0.5, 0.95, 1]), *np.quantile(ratio[single], [0.95, 1]),
                         bends.median(), bends.quantile(0.95), *excess[method, parameter], per_crossed, mass])
    return sorted(rows, key=lambda r: r[2])


def figure_of(run, rows, cases, problems):
    figure, axes = style.panels(1, 1, 12.5, width=style.PAGE)
    ax = axes[0, 0]
    ax.set_xscale("log")
    for row in rows:
        colour, marker, _ = KINDS[kind_of(row)]
        ax.plot([row[2], row[3]], [row[9], row[9]], color=colour, linewidth=0.8, alpha=0.6)
        ax.vlines(row[2], *row[10], color=colour, linewidth=0.8, alpha=0.35)
        ax.plot(row[2], row[9], marker=marker, color=colour, markersize=4.5, markeredgecolor="white", markeredgewidth=0.3)
    ax.axhline(0, color="#888888", linewidth=0.6, linestyle="--")
    ax.set_xlabel("largest eigenvalue / that of the uncut sheet: median, line to 95 %")
    ax.set_ylabel("error over that of a fitted mesh of as many unknowns, - 1 (%)")
    ax.margins(x=0.12, y=0.08)
    marked = [(x, row[9]) for row in rows for x in np.geomspace(row[2], row[3], 40)]
    marked += [(x, 0) for x in np.geomspace(*ax.get_xlim(), 120)]
    names.place(ax, [(row[2], row[9], label(row[0], row[1], row[-1]), KINDS[kind_of(row)][0]) for row in rows], marked, 6.2)
    legend = [Line2D([], [], color=colour, marker=marker, linestyle="none", markersize=4, label=f"changes {kind}")
              for kind, (colour, marker, _) in KINDS.items()]
    style.finish(figure, [], " ".join([
        "Left and low is good. Of two changes the colour is that of the mass, else of the unknowns. "
        f"Errors: geometric means over {cases} cases of {problems} plane problems, solved directly; upright lines: 95 %, problems drawn anew. "
        "Eigenvalues: of single and several cuts.", style.provenance(run, run.rows, with_crosses=False, per=())]), legend)
    return figure


def main():
    folder = load.results_folder(STEM, __doc__)
    ratios = [f"{mass}{kind}eigenvalue_ratio" for mass in ("", *(f"{m}_" for m in ADDED_MASS)) for kind in ("", "bending_")]
    run = load.read(folder, [*ratios, "scaled_mass_added", "scaled_bending_mass_added", "geometry_us", "crossed_triangles"])
    excess, *used = errors(folder.with_name("remedies_accuracy"))
    rows = rows_of(run.first_repetition(), excess)
    style.save(figure_of(run.first_repetition(), [r for r in rows if r[-1] != "scaled"], *used), folder, STEM)  # no remedy: heavier
    columns = ["method", "eigenvalue, median", "95 %", "worst", "95 %, without several", "worst", "with bending", "95 %",
               "error %, equal unknowns", "its 95 %", "error %, 100 CG", "us"]
    load.print_table("Remedies: eigenvalues over the uncut sheet's, errors over a fitted mesh's of {} cases of {} problems with 95 % "
                     "intervals (problems drawn anew), warm geometry per crossed triangle".format(*used), columns, [[label(r[0], r[1], r[-1]), *r[2:10], in_words(r[10]), *r[11:-1]] for r in rows])
    added = run.first_repetition().rows
    added = added[added["scaled_mass_added"].notna() & (added["method"] == "conventional_split")]
    load.print_table("Mass that scaling adds to the sheet's after conventional_split, %", ["", "median", "95 %", "worst"],
                     [[words, *(100 * np.quantile(added[column], [0.5, 0.95, 1]))] for words, column in
                      [("membrane", "scaled_mass_added"), ("with bending", "scaled_bending_mass_added")]])
    by_kind = kinds.table_of(at_equal_unknowns(Records(folder.with_name("remedies_accuracy"))).ranked())
    columns = [c for c in by_kind.columns if c not in ("method", "parameter")]
    load.print_table(kinds.WHAT, ["method", *columns], [[label(r["method"], r["parameter"]), *(r[c] for c in columns)]
                                                        for _, r in by_kind.iterrows()])


if __name__ == "__main__":
    main()
