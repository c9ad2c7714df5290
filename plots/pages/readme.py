#!/usr/bin/env python3
"""The figures of README.md: readme_gallery.png, the same cut by every method, made by the program that
experiments/reproduce builds, and from the published records readme_chart.png, the time of a cut and of the
motion after it against the error, and readme_stability.png, where methods stop working. Writes them there."""

import argparse
import sys
from pathlib import Path

import matplotlib.pyplot as plt

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from analysis import load
from analysis.methods import same_cut
from analysis.stability import points as stability_points
from figures.common import cut_sheet, style
from figures.methods import whole_step
from figures.stability import panels, stability as stability_page

WIDTH = 9.0  # inches: twice the pixels of a page that is not a high-resolution one
WINDOW = (0.345, 0.765, 0.355, 0.59)  # of the unit sheet: a stretch between vertices, a bend and the tip


# ---- the gallery


def draw_panel(ax, method, result):
    points, triangles, report, details = result
    cut_sheet.frame(ax, WINDOW)
    cut_sheet.draw(ax, points, triangles, [same_cut.requested()], details)
    cut_sheet.draw_copies(ax, same_cut.sheet_points(), details)
    ratio = report["ar_max_cut"]
    ax.set_title(method["name"], loc="left", fontsize=9.5, fontweight="bold", pad=3)
    ax.set_title((f"AR {load.number(ratio, 2)}, " if ratio else "") + f"{report['vertices_added']:+d}", loc="right",
                 fontsize=8.5, color="#555555", pad=3)


def gallery(methods):
    results = same_cut.cut_by_all(methods)
    rows = -(-len(methods) // 4)
    aspect = (WINDOW[3] - WINDOW[2]) / (WINDOW[1] - WINDOW[0])
    panel = WIDTH / 4 - 0.12
    height = rows * (panel * aspect + 0.28) + 0.46
    figure, axes = plt.subplots(rows, 4, figsize=(WIDTH, height), squeeze=False)
    figure.subplots_adjust(left=0.006, right=0.994, top=1 - 0.22 / height, bottom=0.49 / height, wspace=0.05,
                           hspace=0.28 / (panel * aspect))
    for ax in axes.flat[len(methods):]:
        ax.set_visible(False)
    for ax, method, result in zip(axes.flat, methods, results):
        draw_panel(ax, method, result)
    figure.legend(handles=cut_sheet.legend_entries([r[3] for r in results]), loc="lower left", ncol=8, fontsize=8.5, borderaxespad=0.1,
                  bbox_to_anchor=(0, 0.19 / height), handlelength=1.5, columnspacing=1.1)
    figure.text(0.006, 0.07 / height, "Beside each name: the largest aspect ratio AR of the triangles that the cut changed, and how many vertices it added",
                fontsize=8.5, color="#555555")
    return figure


# ---- the stability sweeps in short


def stability(folder):
    """Of the records in the folder: four panels of the stability sweeps, large enough to be read beside the text."""
    rows = stability_points.on_the_page(stability_points.read(folder))
    shown = ["vertex", "border", "strip", "in_a_row"]
    figure, axes = plt.subplots(1, 4, figsize=(WIDTH, 3.8))
    figure.subplots_adjust(left=0.135, right=0.99, top=0.88, bottom=0.33, wspace=0.1)
    axes[-1].set_position([0.85, 0.33, 0.14, 0.55])
    for k, (ax, panel) in enumerate(zip(axes, shown)):
        if k < 3:
            ax.set_position([0.135 + 0.195 * k, 0.33, 0.18, 0.55])
        stability_page.draw(ax, rows, panel, ylabels=k in (0, 3))
        ax.set_title(ax.get_title(loc="left"), loc="left", fontsize=9)
        ax.xaxis.label.set_fontsize(8.5)
        ax.tick_params(labelsize=7.5)
    figure.text(0.008, 0.945, "Largest explicit step after a cut, over that of the uncut sheet", fontsize=10, fontweight="bold")
    verdicts = set(rows.loc[rows["sweep"].isin(shown), "verdict"])
    bands = [handle for _, handles in panels.legends(verdicts, ["explicit"]) for handle in handles]
    figure.legend(handles=bands, loc="lower left", ncol=len(bands), bbox_to_anchor=(0.125, 0.155), fontsize=8.5, handlelength=1.2,
                  columnspacing=1.4)
    figure.text(0.008, 0.02, "To the right the cut comes nearer; at $10^{-12}$ h, below the snap distance, it goes through the vertex or along the border. "
                "h: mean edge.\nA cell: the worst of eight places on four sheets of 800 triangles (cuts in a row: of one). Stabilised mass: "
                "after a conventional split.\nWarp, thin, tie: three parts together. Steps with ties or phantom nodes are predicted.",
                fontsize=8.5, color="#555555", linespacing=1.3)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results/reference",
                        help="holds the published records, receives the figures (default: results/reference)")
    folder = parser.parse_args().results
    methods = same_cut.all_methods()
    style.write_png(gallery(methods), folder / "readme_gallery.png")
    style.write_png(whole_step.readme_chart(folder)[0], folder / "readme_chart.png")
    style.write_png(stability(folder), folder / "readme_stability.png")


if __name__ == "__main__":
    main()
