#!/usr/bin/env python3
"""Two sheets that are cut and swing: a stretched strip, cut across, and a hanging sheet, cut from the side. The error of the
motion by method and size of the sheet, beside that of the mesh fitted to the cut, by integrator; and a table of all measures."""

import sys
from pathlib import Path

import numpy as np
from matplotlib.lines import Line2D

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming, pareto, shares
from analysis.accuracy.motion import (
    INTEGRATORS, PROBLEMS, REFERENCE, STEM, counts_of, errors_of, interval, names_of, of_problem, print_ratios, rows_of)
from figures.common import style

COLOURS = ["#56b4e9", "#0072b2", "#111111"]
MARKERS = ["o", "s", "D"]


def draw(ax, here, names, few):
    """\param few  the methods that made few of their cuts"""
    for size, colour, marker in zip(sorted(set(here["resolution"])), COLOURS, MARKERS):
        of_size = here[here["resolution"] == size]
        errors = {name: errors_of(of_size, name, name in few) for name in [REFERENCE, *names]}
        ax.hlines(range(len(names)), *np.transpose([interval(errors[name]) for name in names]), color=colour, linewidth=0.8, alpha=0.5)
        ax.axvline(errors[REFERENCE].mean(), color=colour, linewidth=0.8, linestyle="--", zorder=1)
        for y, name in enumerate(names):
            faces = {"markerfacecolor": "white", "markeredgecolor": colour} if name in few else {"markeredgecolor": "white"}
            ax.plot(errors[name].mean(), y, color=colour, marker=marker, linestyle="", markersize=3.4,
                    markeredgewidth=0.9 if name in few else 0.3, **faces)
    ax.set_xscale("log")
    style.plain_numbers(ax, "x", 7)
    ax.minorticks_off()


def figure_of(run, table, names, few=()):
    figure, axes = style.panels(len(PROBLEMS), len(INTEGRATORS), 8.6, width=style.PAGE, sharey=True)
    for row, (problem, (title, measures)) in zip(axes, PROBLEMS.items()):
        for ax, (integrator, rule) in zip(row, INTEGRATORS.items()):
            draw(ax, of_problem(table, problem, integrator), names, few)
            ax.set_title(f"{title}, {rule}", loc="left")
            ax.set_xlabel(f"error of the {next(iter(measures.values()))}, %")
        row[0].set_yticks(range(len(names)), list(names.values()))
    axes[0, 0].invert_yaxis()
    lines = [Line2D([], [], color=colour, marker=marker, linestyle="--", linewidth=0.8, markersize=3.4,
                    label=f"{size} triangles (line: mesh fitted to the cut)")
             for size, colour, marker in zip(sorted(set(table["resolution"])), COLOURS, MARKERS)]
    style.finish(figure, [], " ".join([
        "Root mean square over all steps: strip, against a released bar; sheet, against fine fitted meshes. Means over the cuts, two on "
        "each of four sheets; bars: 95 %, cuts drawn anew. The step lets a wave pass one square of the sheet. "
        f"{shares.HOLLOW} Of each problem:",
        naming.provenance(run, table, with_crosses=False, per=("problem", "resolution"))]), lines)
    return figure


def main():
    folder = load.results_folder(STEM, __doc__)
    measures = [f"error_{m}" for _, of_one in PROBLEMS.values() for m in of_one]
    excesses = [f"excess_{next(iter(of_one))}" for _, of_one in PROBLEMS.values()]
    columns = [*load.TEXT, "problem", *load.COUNTS, *measures, *excesses]
    everything = load.read_records(folder / "records.csv", columns, all_columns=True)
    failed = pareto.failed_rows(everything)
    table = everything[~failed]
    run = load.Run(table, everything[failed], load.read_context(folder / "context.json"))
    names = names_of(everything, failed)
    few = {method for method, share in counts_of(everything, failed).items() if share.is_few}
    style.save(figure_of(run, table, names, few), folder, STEM)
    sizes = sorted(set(table["resolution"]))
    for problem, (title, measures) in PROBLEMS.items():
        first, *others = measures.values()
        load.print_table(f"{title.capitalize()}: errors in percent, means over sheets and members: {first} by size, its excess over "
                         f"the fitted mesh, and at {sizes[-1]} triangles the other measures",
                         ["integrator", "method", *(f"{s}" for s in sizes), *(f"excess, {s}" for s in sizes), *others],
                         rows_of(table, names, problem))
    for size in sizes[1:]:
        print_ratios(table, size)


if __name__ == "__main__":
    main()
