#!/usr/bin/env python3
"""How accurate a cut sheet is, and what the accuracy costs: the error of each problem's primary measure against time and
unknowns, for the direct solve and for fixed numbers of iterations of conjugate gradients.
Also: whether the error depends on the shape of the triangles, and which share of all cases is solved within a given time."""

import contextlib
import io
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming
from analysis.accuracy.intervals import print_intervals
from analysis.accuracy.ranking import at_equal_unknowns, print_ranking
from analysis.accuracy.records import Records, cells_of
from analysis.accuracy.shape import print_shapes, print_statements
from analysis.load import of
from figures.accuracy.axes import label_edges, log_x_axis
from figures.accuracy.budgets import budgets_figure
from figures.accuracy.errors import error_figure
from figures.accuracy.profiles import profile_figure
from figures.accuracy.shape import shape_figure
from figures.common import front, style

STEM = "accuracy"


def problems_figure(records):
    """A panel for each problem: its error against time, over all sheets."""
    direct = records.rows(direct=True)
    cells = cells_of(direct, "ms", "error", ["problem", "method", "parameter", "resolution"], ["problem"])
    columns = min(4, len(records.problems))
    figure, axes = style.panels(-(-len(records.problems) // columns), columns, 3.9, sharex=True, width=style.PAGE)
    for i, ax in enumerate(axes.flat):
        ax.set_visible(i < len(records.problems))
    for problem, ax in zip(records.problems, axes.flat):
        here = cells[cells["problem"] == problem]
        for variant, look in records.looks.items():
            front.draw(ax, of(here, variant).sort_values("resolution"), look)
        front.draw_front(ax, here)
        front.draw_failures(ax, here, records.looks)
        log_x_axis(ax)
        if (here["y"] > 0).any():
            ax.set_yscale("log")
            style.plain_numbers(ax)
        primary = records.rows(problem=problem)["primary"].iloc[0]
        ax.set_title(f"{problem}:\n{primary}".replace("_", " "), loc="left", fontsize=6.3)
    label_edges(axes, "total time, ms", "relative error")
    style.finish(figure, records.looks.values(), records.caption(
        "Error of each problem's primary measure against the total time (cut, assembly, direct solve). Marker: median "
        "over all sheets and the ensemble at one resolution; bars: quartiles. The time of the body-fitted mesh includes "
        "the meshing of the whole sheet. ×: failed/tried."), front.legend_entries(records.looks.values()))
    return figure


def write_text(folder, records):
    """Prints the tables and writes them beside the figures."""
    text = io.StringIO()
    with contextlib.redirect_stdout(text):
        print_ranking(records.in_plane(), "in plane")
        print_intervals(records.in_plane())
        print_ranking(records.out_of_plane(), "out of plane")
        print_shapes(records)
        print_statements(records)
        print(f"\n{naming.provenance(records.run, records.run.rows, with_machine=True, with_crosses=False)}")
    load.write_beside(folder / f"{STEM}.txt", text.getvalue())


def main():
    folder = load.results_folder(STEM, __doc__)
    records = at_equal_unknowns(Records(folder))
    figures = {STEM: error_figure(records, "ms", "total time, ms"), f"{STEM}_unknowns": error_figure(records, "unknowns", "unknowns"),
               f"{STEM}_problems": problems_figure(records), f"{STEM}_budgets": budgets_figure(records),
               f"{STEM}_shape": shape_figure(records), f"{STEM}_profile": profile_figure(records)}
    for stem, figure in figures.items():
        if figure:
            style.save(figure, folder, stem)
    write_text(folder, records)


if __name__ == "__main__":
    main()
