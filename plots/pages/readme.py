#!/usr/bin/env python3
"""The figures of README.md: readme_gallery.png, the same cut by every method, made by the program that
experiments/reproduce builds, and from the published records readme_chart.png, the time of a cut and of the
motion after it against the error, and readme_stability.png, where methods stop working. Writes them there."""

import argparse
import sys
from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from analysis import load
from analysis.methods import same_cut
from analysis.stability import points as stability_points
from figures.common import style
from figures.methods import whole_step
from figures.stability import panels, stability as stability_page

WIDTH = 9.0  # inches: twice the pixels of a page that is not a high-resolution one
WINDOW = (0.345, 0.765, 0.355, 0.59)  # of the unit sheet: a stretch between vertices, a bend and the tip
BANDS = {3: "#fbdca4", 10: "#f29d4b"}  # colours of aspect ratios above these; triangles of more than 30 are lines here
MESH, PATH, INCISION = "#8d8d8d", "#0072b2", "#a50021"


# ---- the gallery


def draw_panel(ax, method, result):
    points, triangles, report = result
    corners = points[triangles]
    colours = ListedColormap(["white", *BANDS.values()])
    norm = BoundaryNorm([1, *BANDS, 1e9], colours.N)
    ax.set_xlim(WINDOW[:2]), ax.set_ylim(WINDOW[2:])
    ax.set(aspect="equal", xticks=[], yticks=[])
    ax.set_facecolor("#dddddd")  # seen where triangles are gone
    ax.spines[:].set_visible(True)
    ax.spines[:].set_color("#555555")
    ax.grid(False)
    ax.add_collection(PolyCollection(corners, array=same_cut.aspect_ratio(corners), cmap=colours, norm=norm,
                                     edgecolor=MESH, linewidth=0.5))
    ax.plot(*same_cut.requested().T, color=PATH, linewidth=5, alpha=0.35, zorder=2, solid_capstyle="butt")
    ax.add_collection(LineCollection(same_cut.incision(points, triangles), color=INCISION, linewidth=1.5,
                                     capstyle="round", zorder=3))
    ratio = report["ar_max_cut"]
    ax.set_title(method["name"], loc="left", fontsize=9.5, fontweight="bold", pad=3)
    ax.set_title((f"AR {load.number(ratio, 2)}, " if ratio else "") + f"{report['vertices_added']:+d}", loc="right",
                 fontsize=8.5, color="#555555", pad=3)


def gallery(methods):
    results = same_cut.cut_by_all(methods)
    rows = -(-len(methods) // 4)
    aspect = (WINDOW[3] - WINDOW[2]) / (WINDOW[1] - WINDOW[0])
    panel = WIDTH / 4 - 0.12
    height = rows * (panel * aspect + 0.28) + 0.3
    figure, axes = plt.subplots(rows, 4, figsize=(WIDTH, height), squeeze=False)
    figure.subplots_adjust(left=0.006, right=0.994, top=1 - 0.22 / height, bottom=0.33 / height, wspace=0.05,
                           hspace=0.28 / (panel * aspect))
    for ax in axes.flat[len(methods):]:
        ax.set_visible(False)
    for ax, method, result in zip(axes.flat, methods, results):
        draw_panel(ax, method, result)
    limits = [*BANDS, None]
    entries = [Line2D([], [], color=PATH, alpha=0.35, linewidth=5, label="requested path"),
               Line2D([], [], color=INCISION, linewidth=1.5, label="incision")]
    entries += [Patch(facecolor=colour, edgecolor=MESH, linewidth=0.5,
                      label=f"AR {low} to {high}" if high else f"AR > {low}")
                for (low, colour), high in zip(BANDS.items(), limits[1:])]
    figure.legend(handles=entries, loc="lower left", ncol=5, fontsize=8.5, borderaxespad=0.1, handlelength=1.6,
                  columnspacing=1.4)
    figure.text(0.994, 0.1 / height, "beside each name: largest aspect ratio AR, vertices added", ha="right", fontsize=8.5,
                color="#555555")
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
    bands = [*panels.legends(set())[0][1], *panels.legends(verdicts)[2][1]]
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
