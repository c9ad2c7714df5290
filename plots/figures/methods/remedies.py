#!/usr/bin/env python3
"""Remedies for thin triangles: the largest eigenvalue that each leaves (results/remedies) against the error of its solutions
(results/remedies_accuracy), a table of both, and one of the errors by kind of problem and by measure."""

import sys
from pathlib import Path

import numpy as np
from matplotlib.lines import Line2D

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming, shares
from analysis.accuracy.ranking import at_equal_unknowns
from analysis.accuracy.records import Records
from analysis.methods import kinds
from analysis.methods.remedies import ADDED_MASS, STEM, beside_split, counts_of, errors, in_words, label, rows_of
from figures.common import names, style

KINDS = {  # colour, marker, and the methods whose remedy is of this kind
    "the mesh": ("#0072b2", "s", ["active_node", "warp_and_refine", "delaunay_refine", "adaptive_remesh"]),
    "the path": ("#7b3294", "v", ["snap_or_split", "edge_release"]),
    "the unknowns": ("#d55e00", "o", ["cut_polygons", "split_and_tie", "phantom_node", "phantom_node:consistent_mass", "virtual_node",
                                          "ablation:warp+thin:tie"]),
    "the mass": ("#009e73", "^", []),  # all with an added mass
    "nothing": ("#444444", "D", ["conventional_split"]),
}


def kind_of(row):
    return "the mass" if row[-1] else next(kind for kind, (_, _, methods) in KINDS.items() if row[0] in methods)


def label_of(row, counts):
    """With the share of its cuts."""
    return label(row[0], row[1], row[-1]) + counts[row[0], row[1]].beside()


def figure_of(run, rows, cases, problems):
    counts = counts_of(run)
    figure, axes = style.panels(1, 1, 12.5, width=style.PAGE)
    ax = axes[0, 0]
    ax.set_xscale("log")
    for row in rows:
        colour, marker, _ = KINDS[kind_of(row)]
        ax.plot([row[2], row[3]], [row[9], row[9]], color=colour, linewidth=0.8, alpha=0.6)
        ax.vlines(row[2], *row[10], color=colour, linewidth=0.8, alpha=0.35)
        ax.plot(row[2], row[9], marker=marker, color=colour, markersize=4.5, **style_of(counts[row[0], row[1]], colour))
    ax.axhline(0, color="#888888", linewidth=0.6, linestyle="--")
    ax.set_xlabel("largest eigenvalue / that of the uncut sheet: median, line to 95 %")
    ax.set_ylabel("error over that of a fitted mesh of as many unknowns, - 1 (%)")
    ax.margins(x=0.12, y=0.08)
    marked = [(x, row[9]) for row in rows for x in np.geomspace(row[2], row[3], 40)]
    marked += [(x, 0) for x in np.geomspace(*ax.get_xlim(), 120)]
    legend = [Line2D([], [], color=colour, marker=marker, linestyle="none", markersize=4, label=f"changes {kind}")
              for kind, (colour, marker, _) in KINDS.items()]
    style.finish(figure, [], " ".join([
        "Left and low is good. Of two changes the colour is that of the mass, else of the unknowns. "
        f"Errors: geometric means over {cases} cases of {problems} kinds of plane problems, which weigh alike, solved directly; upright lines: 95 %, kinds drawn anew. "
        f"Eigenvalues: of single and several cuts. {shares.HOLLOW}", naming.provenance(run, run.rows, with_crosses=False, per=())]), legend)
    names.place(ax, [(row[2], row[9], label_of(row, counts), KINDS[kind_of(row)][0]) for row in rows], marked, 6.2)
    return figure


def style_of(share, colour):
    """Of a marker: hollow where few cuts were made."""
    if share.is_few:
        return {"markerfacecolor": "white", "markeredgecolor": colour, "markeredgewidth": 0.9}
    return {"markeredgecolor": "white", "markeredgewidth": 0.3}


def main():
    folder = load.results_folder(STEM, __doc__)
    ratios = [f"{mass}{kind}eigenvalue_ratio" for mass in ("", *(f"{m}_" for m in ADDED_MASS)) for kind in ("", "bending_")]
    run = load.read(folder, [*ratios, "scaled_mass_added", "scaled_bending_mass_added", "geometry_us", "crossed_triangles"])
    accuracy = at_equal_unknowns(Records(folder.with_name("remedies_accuracy"))).ranked()
    excess, *used = errors(accuracy)
    rows, counts, beside = rows_of(run.first_repetition(), excess), counts_of(run), beside_split(run.first_repetition())
    style.save(figure_of(run.first_repetition(), [r for r in rows if r[-1] != "scaled"], *used), folder, STEM)  # no remedy: heavier
    columns = ["method", "eigenvalue, median", "95 %", "worst", "95 %, without several", "worst", "with bending", "95 %",
               "error %, equal unknowns", "its 95 %", "error %, 100 CG", "us", "over split"]
    load.print_table("Remedies: eigenvalues over the uncut sheet's, errors over a fitted mesh's of {} cases of {} kinds of problems with 95 % "
                     "intervals (kinds drawn anew), warm geometry per crossed triangle, "
                     "eigenvalue over a plain split's on the cuts that both made (median)".format(*used), columns, [
                         [label_of(r, counts), *r[2:10], in_words(r[10]), *r[11:-1], np.nan if r[-1] else beside.get((r[0], r[1]), np.nan)]
                         for r in rows])
    added = run.first_repetition().rows
    added = added[added["scaled_mass_added"].notna() & (added["method"] == "conventional_split")]
    load.print_table("Mass that scaling adds to the sheet's after conventional_split, %", ["", "median", "95 %", "worst"],
                     [[words, *(100 * np.quantile(added[column], [0.5, 0.95, 1]))] for words, column in
                      [("membrane", "scaled_mass_added"), ("with bending", "scaled_bending_mass_added")]])
    by_kind = kinds.table_of(accuracy)
    columns = [c for c in by_kind.columns if c not in ("method", "parameter")]
    load.print_table(kinds.WHAT, ["method", *columns], [[label(r["method"], r["parameter"]), *(r[c] for c in columns)]
                                                        for _, r in by_kind.iterrows()])


if __name__ == "__main__":
    main()
