#!/usr/bin/env python3
"""A stretched strip, cut across and in motion: the error of the lips' displacement over a period by method and size of the
sheet, beside that of the mesh fitted to the cut, by integrator; and a table of all measures."""

import numpy as np
from matplotlib.lines import Line2D

from common import front, load, style

STEM = "motion"
PROBLEMS = {"severed_strip_midpoint": "midpoint rule", "severed_strip_backward_euler": "backward Euler"}
REFERENCE = "body_fitted (reference)"
MEASURE = "error_lip_motion"
MEASURES = [MEASURE, "error_lip_speed", "error_arrival", "error_energy_kept"]
COLOURS = ["#56b4e9", "#0072b2", "#111111"]
MARKERS = ["o", "s", "D"]


def names_of(everything, failed):
    """The methods, the largest mean error last, each with what it refused."""
    made = everything[~failed & (everything["method"] != REFERENCE)]
    names = {}
    for method in made.groupby("method")[MEASURE].mean().sort_values().index:
        rows = everything["method"] == method
        lost = int((rows & failed).sum())
        names[method] = method.replace("_", " ") + (f" ({lost} of {int(rows.sum())} refused or failed)" if lost else "")
    return names


def figure_of(run, table, names):
    figure, axes = style.panels(1, len(PROBLEMS), 8.6, width=style.PAGE, sharey=True)
    sizes = sorted(set(table["resolution"]))
    for ax, (problem, title) in zip(axes[0], PROBLEMS.items()):
        here = table[table["problem"] == problem]
        for size, colour, marker in zip(sizes, COLOURS, MARKERS):
            errors = 100 * here[here["resolution"] == size].groupby("method")[MEASURE].mean()
            ax.axvline(errors[REFERENCE], color=colour, linewidth=0.8, linestyle="--", zorder=1)
            ax.plot(errors.reindex(list(names)), range(len(names)), color=colour, marker=marker, linestyle="",
                    markersize=3.4, markeredgewidth=0.3, markeredgecolor="white")
        ax.set_xscale("log")
        ticks = [t for t in (1, 1.5, 2, 3, 4, 5, 7, 10, 15, 20, 30, 40, 50) if ax.get_xlim()[0] <= t <= ax.get_xlim()[1]]
        ax.set_xticks(ticks, [f"{t:g}" for t in ticks])
        ax.minorticks_off()
        ax.set_title(title, loc="left")
        ax.set_xlabel("error of the lips' motion, %")
    axes[0, 0].set_yticks(range(len(names)), list(names.values()))
    axes[0, 0].invert_yaxis()
    lines = [Line2D([], [], color=colour, marker=marker, linestyle="--", linewidth=0.8, markersize=3.4,
                    label=f"{size} triangles (line: mesh fitted to the cut)")
             for size, colour, marker in zip(sizes, COLOURS, MARKERS)]
    style.finish(figure, [], " ".join([
        "Root mean square over one period of the lips' displacement against a released bar, over its amplitude; means over "
        "four sheets (cisamr: the two it takes) and the members. Step: a wave passes one square. Of each problem:",
        style.provenance(run, table, with_crosses=False, per=("problem", "resolution"))]), lines)
    return figure


def rows_of(table, names):
    rows = []
    for problem, title in PROBLEMS.items():
        for method in [REFERENCE, *names]:
            here = table[(table["problem"] == problem) & (table["method"] == method)]
            errors = 100 * here.groupby("resolution")[MEASURES].mean()
            excess = 100 * here.groupby("resolution")["excess_lip_motion"].mean()
            rows.append([title, method, *errors[MEASURE], *(np.nan if method == REFERENCE else e for e in excess),
                         *errors.iloc[-1][MEASURES[1:]]])
    return rows


def main():
    folder = load.results_folder(STEM, __doc__)
    columns = [*load.TEXT, "problem", *load.COUNTS, *MEASURES, "excess_lip_motion"]
    everything = load.read_records(folder / "records.csv", columns, all_columns=True)
    failed = front.failed_rows(everything)
    table = everything[~failed]
    run = load.Run(table, everything[failed], load.read_context(folder / "context.json"))
    names = names_of(everything, failed)
    style.save(figure_of(run, table, names), folder, STEM)
    sizes = sorted(set(table["resolution"]))
    load.print_table("Errors in percent, means over sheets and members: lips' motion by size, its excess over the fitted mesh, "
                     f"and at {sizes[-1]} triangles the other measures",
                     ["integrator", "method", *(f"{s}" for s in sizes), *(f"excess, {s}" for s in sizes),
                      "lip speed", "arrival", "energy"], rows_of(table, names))


if __name__ == "__main__":
    main()
