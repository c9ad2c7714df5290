#!/usr/bin/env python3
"""Figure 9 of the paper: the maximum aspect ratio after a cut over the resolution of the sheet, and, in a second
figure, the mean and the 99th percentile over the sheet, because the paper's text speaks of the average."""

import sys
from pathlib import Path

from matplotlib.lines import Line2D

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming
from analysis.paper.fig9_aspect_ratio import (
    LIMIT, MEASURES, STEM, average_sentence, claim_sentence, print_numbers, print_rounds)
from figures.common import style

LIMIT_LINE = dict(color="#c00000", linewidth=0.9, linestyle=(0, (4, 2)), zorder=2, label="limit 3: the paper's claim")


def draw_panel(ax, run, column, looks):
    """One sheet: a curve per method, the limit, the failures."""
    for (method, parameter), look in looks.items():
        table = load.quartiles(run.select(method=method, parameter=parameter).rows, "resolution", column)
        style.curve(ax, look, table)
    ax.axhline(LIMIT, **LIMIT_LINE)


def maximum_figure(run):
    sheets = naming.sheet_order(run.everything()["sheet"])
    looks = naming.looks_of(run, run.variants("ar_max_cut"))
    figure, axes = style.sheet_panels(sheets, run.everything()["resolution"], "sqrt", "maximum aspect ratio")
    for sheet, ax in zip(sheets, axes):
        draw_panel(ax, run.select(sheet=sheet), "ar_max_cut", looks)
    axes[0].set_ylim(bottom=1)
    style.plain_numbers(axes[0])
    style.failures(axes, [run.select(sheet=s) for s in sheets], looks)
    style.finish(figure, looks.values(), " ".join([
        "Largest aspect ratio of the triangles that a cut made or changed. Line: median of the cuts; band: quartiles.",
        claim_sentence(run), naming.AR_DEFINITION, naming.provenance(run, run.rows)]), [Line2D([], [], **LIMIT_LINE)])
    return figure


def average_figure(run):
    """A row per sheet: mean on the left, 99th percentile on the right."""
    sheets = naming.sheet_order(run.everything()["sheet"])
    looks = naming.looks_of(run, run.variants("ar_mean_all"))
    figure, axes = style.panels(len(sheets), 2, 3.4, sharey="col", subplot_kw={"yscale": "log"})
    resolutions = run.everything()["resolution"]
    for sheet, row in zip(sheets, axes):
        for ax, column, label in zip(row, ("ar_mean_all", "ar_p99_all"), ("mean AR", "p99 of AR")):
            draw_panel(ax, run.select(sheet=sheet), column, looks)
            ax.set_ylabel(label)
            ax.set_title(naming.sheet_title(sheet))
            style.resolution_axis(ax, resolutions, labelled=sheet == sheets[-1])
    for ax in axes[0]:
        ax.set_ylim(bottom=1)
        style.plain_numbers(ax)
    for ax_column in axes.T:
        style.failures(list(ax_column), [run.select(sheet=s) for s in sheets], looks)
    style.finish(figure, looks.values(), " ".join([
        "Mean and 99th percentile (p99) of the aspect ratios of the whole sheet after a cut. Line: median of the cuts; "
        "band: quartiles.",
        average_sentence(run), naming.AR_DEFINITION, naming.provenance(run, run.rows)]), [Line2D([], [], **LIMIT_LINE)])
    return figure


def main():
    folder = load.results_folder(STEM, __doc__)
    run = load.read(folder, MEASURES).first_repetition()
    style.save(maximum_figure(run), folder, STEM)
    style.save(average_figure(run), folder, f"{STEM}_mean")
    print_numbers(run)
    print_rounds(run)


if __name__ == "__main__":
    main()
