#!/usr/bin/env python3
"""The same cut by every method, a detail near its tip. Runs the program that experiments/reproduce builds."""

import sys
from pathlib import Path

from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LogNorm

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming
from analysis.cut_result import aspect_ratio
from analysis.methods.same_cut import SQUARES, all_methods, cut_by_all, requested, sheet_points, title
from figures.common import cut_sheet, style

STEM = "method_comparison"
WINDOW = (0.36, 0.76, 0.32, 0.58)
COLOURS = "YlOrBr"


def draw_method(ax, title, result, norm):
    ax.set_xlim(WINDOW[:2])
    ax.set_ylim(WINDOW[2:])
    ax.set_aspect("equal")
    ax.set_xticks([])
    ax.set_yticks([])
    ax.grid(False)
    ax.spines[:].set_visible(True)
    ax.set_title(title, pad=2, fontsize=6.2)
    if result is None:
        ax.text(0.5, 0.5, "failed", transform=ax.transAxes, ha="center")
        return None
    points, triangles, report, details = result
    faces = PolyCollection(points[triangles], array=aspect_ratio(points[triangles]), cmap=COLOURS, norm=norm, edgecolor="#555555",
                           linewidth=0.25)
    ax.add_collection(faces)
    ax.plot(*requested().T, color=cut_sheet.PATH, linewidth=2.2, alpha=0.45, zorder=2, solid_capstyle="butt")
    cut_sheet.draw_unknowns(ax, points, triangles, details, 0.5)
    cut_sheet.draw_copies(ax, sheet_points(), details, 0.5)
    ax.add_collection(LineCollection(points[details.incision], color=cut_sheet.INCISION, linewidth=0.7, zorder=3))
    ratio = report["ar_max_cut"]
    shapes = f"AR ≤ {load.number(ratio, 2)}" if ratio else "none changed"
    ax.set_xlabel(f"{shapes}, {report['vertices_added']:+d} vertices", fontsize=5.6, labelpad=2)
    return faces


def draw(folder, only=None):
    """Writes folder/method_gallery.png and .pdf. \\param only  names, those of other methods are left out; None: all"""
    methods = [m for m in all_methods() if only is None or m["name"] in only]
    if not methods:
        return
    left_out = sorted(set(only or ()) - {m["name"] for m in methods})
    results = cut_by_all(methods)
    columns = 3
    figure, axes = style.panels(-(-len(methods) // columns), columns, 2.75)
    norm = LogNorm(1.2, 60)
    faces = None
    for i, ax in enumerate(axes.flat):
        ax.set_visible(i < len(methods))
        if i < len(methods):
            faces = draw_method(ax, title(methods[i]), results[i], norm) or faces
    if faces is not None:
        bar = figure.colorbar(faces, ax=list(axes.flat), orientation="horizontal", aspect=50, pad=0.02, extend="max")
        bar.set_label("aspect ratio")
        bar.set_ticks([2, 3, 5, 10, 20, 50], labels=["2", "3", "5", "10", "20", "50"])
        bar.ax.minorticks_off()
    which = "every method" if only is None else "every method of the run"
    missing = f"Not drawn, as `cutbench methods` does not have them: {', '.join(left_out)}. " if left_out else ""
    style.finish(figure, [], f"The same cut by {which}, at rest, near the tip of the cut. Each parameter (the number beside "
                 f"the name) has its default. The sheet is the paper's grid of {2 * SQUARES ** 2} triangles; the chord "
                 "tolerance is 0.05 h. Blue: requested path. Red: incision. AR: largest aspect ratio of the triangles that "
                 f"the cut made or changed. {missing}Green: polygons, and vertices that go "
                 f"along with others (dots) or are there several times (squares). {naming.AR_DEFINITION} "
                 "Command: plots/figures/methods/method_gallery.py")
    style.save(figure, folder, "method_gallery")


if __name__ == "__main__":
    target = load.results_folder(STEM, __doc__)
    target.mkdir(parents=True, exist_ok=True)
    draw(target)
