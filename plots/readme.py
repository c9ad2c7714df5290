#!/usr/bin/env python3
"""The figures of README.md: readme_gallery.png, the same cut by every method, made by the program that
experiments/reproduce builds, and from the records in results/reference readme_chart.png, time against the largest
eigenvalue, and readme_atlas.png, where methods stop working. Writes them there."""

import argparse
import io
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke
from PIL import Image

import atlas
import method_gallery
from atlas_parts import panels, points
from common import load, style  # style: the fonts and axes of every figure

STEM = "method_comparison"
WIDTH = 9.0  # inches; at 150 dpi twice the pixels of a page that is not a high-resolution one
DPI = 150
WINDOW = (0.345, 0.765, 0.355, 0.59)  # of the unit sheet: a stretch between vertices, a bend and the tip
BANDS = {3: "#fbdca4", 10: "#f29d4b", 30: "#c8551b"}  # colours of aspect ratios above these
MESH, PATH, INCISION = "#8d8d8d", "#0072b2", "#a50021"
GROUPS = {  # of the methods, by what they promise: colour, marker, words
    "tolerance": ("#0072b2", "o", "incision within 0.1 edge lengths of the path"),
    "moved": ("#d55e00", "s", "incision moved by up to one edge length"),
    "removed": ("#777777", "X", "triangles removed, no incision"),
}
PLACES = {  # of the names in the chart: which side of the name is at the marker, and how many points higher; others: left, 0
    "example": ("right", 5), "conventional_split": ("right", -7), "bowyer_watson": ("right", 0),
    "cgal_refine": ("right", 0), "global_remesh": ("right", 0), "edge_release": ("right", 0),
    "snap_or_split": ("right", 0), "vertex_snap": ("right", -11), "phantom_node": ("left", -5),
}


def group(method):
    if "keeps_area" not in method["promises"]:
        return "removed"
    return "moved" if method["incision_bound"]["longest_edges"] > 0 else "tolerance"


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
    ax.add_collection(PolyCollection(corners, array=method_gallery.aspect_ratio(corners), cmap=colours, norm=norm,
                                     edgecolor=MESH, linewidth=0.5))
    ax.plot(*method_gallery.requested().T, color=PATH, linewidth=5, alpha=0.35, zorder=2, solid_capstyle="butt")
    ax.add_collection(LineCollection(method_gallery.incision(points, triangles), color=INCISION, linewidth=1.5,
                                     capstyle="round", zorder=3))
    ratio = report["ar_max_cut"]
    ax.set_title(method["name"], loc="left", fontsize=9.5, fontweight="bold", pad=3)
    ax.set_title((f"AR {load.number(ratio, 2)}, " if ratio else "") + f"{report['vertices_added']:+d}", loc="right",
                 fontsize=8.5, color="#555555", pad=3)


def gallery(methods):
    results = method_gallery.cut_by_all(methods)
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


# ---- the chart


def statistics(methods):
    """Per method: x, y, the 95 % quantile of y, the name, its group."""
    run = load.read_reference(STEM, ["crossed_triangles", "geometry_us", "eigenvalue_ratio"]).first_repetition()
    rows = run.rows[run.rows["status"] != "noop"]
    points = []
    for method in methods:
        cuts = rows[rows["method"] == method["name"]]
        eigenvalues = cuts["eigenvalue_ratio"].dropna()
        points.append(((cuts["geometry_us"] / cuts["crossed_triangles"]).median(), eigenvalues.median(),
                       eigenvalues.quantile(0.95), method["name"], group(method)))
    return run, rows, points


def write_names(ax, points):
    """Each name beside its marker, where PLACES says, in front of the bars that it crosses."""
    for x, y, _, name, kind in points:
        side, up = PLACES.get(name, ("left", 0))
        ax.annotate(name, (x, y), xytext=(7 if side == "left" else -7, up), textcoords="offset points", ha=side,
                    va="center_baseline", fontsize=9, color=GROUPS[kind][0], zorder=2.5,
                    path_effects=[withStroke(linewidth=2.5, foreground="white")])


def chart(methods):
    run, rows, points = statistics(methods)
    figure, ax = plt.subplots(figsize=(WIDTH, 5.0), dpi=DPI)
    figure.subplots_adjust(left=0.075, right=0.99, top=0.935, bottom=0.175)
    ax.set(xscale="log", yscale="log", xlim=(0.19, 260), ylim=(0.3, 2e8))
    for x, y, top, _, kind in points:
        colour, marker, _ = GROUPS[kind]
        ax.plot([x, x], [y, top], color=colour, linewidth=1.2, alpha=0.55, marker="_", markersize=5, markevery=[1])
        ax.plot(x, y, marker, color=colour, markersize=7, markeredgecolor="white", markeredgewidth=0.6, zorder=3)
    ax.set_xlabel("time of the cut, µs per crossed triangle", fontsize=10)
    ax.set_ylabel("largest eigenvalue, cut over uncut sheet", fontsize=10)
    ax.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
    ax.tick_params(labelsize=9)
    handles = [Line2D([], [], linestyle="", marker=marker, color=colour, markersize=7, label=words)
               for colour, marker, words in GROUPS.values()]
    ax.legend(handles=handles, loc="lower left", bbox_to_anchor=(-0.03, 1), ncol=3, fontsize=9, handletextpad=0.2,
              borderaxespad=0.2, columnspacing=1.2)
    write_names(ax, points)
    sheets = rows.groupby("method")["sheet"].nunique()
    some = "".join(f"{method} cuts {n} of the {sheets.max()} kinds of sheets. " for method, n in sheets.items()
                   if n < sheets.max())
    made = f"{load.count(rows)} cuts, eigenvalues of {rows['eigenvalue_ratio'].count()} of them"
    figure.text(0.075, 0.014, "Lower left is better. Marker: median over the cuts of all sheets, sizes and cut families. "
                f"Bar: up to the 95 % quantile.\n{some}{made}, commit {str(run.context['commit'])[:10]}.",
                fontsize=9, color="#555555", linespacing=1.35)
    return figure


# ---- the atlas in short


def stability():
    """Four panels of the atlas, large enough to be read beside the text."""
    rows = points.on_the_page(points.read(load.REPOSITORY / "results/reference"))
    shown = ["vertex", "border", "strip", "in_a_row"]
    figure, axes = plt.subplots(1, 4, figsize=(WIDTH, 3.6))
    figure.subplots_adjust(left=0.135, right=0.99, top=0.88, bottom=0.29, wspace=0.1)
    axes[-1].set_position([0.85, 0.29, 0.14, 0.59])
    for k, (ax, panel) in enumerate(zip(axes, shown)):
        if k < 3:
            ax.set_position([0.135 + 0.195 * k, 0.29, 0.18, 0.59])
        atlas.draw(ax, rows, panel, ylabels=k in (0, 3))
        ax.set_title(ax.get_title(loc="left"), loc="left", fontsize=9)
        ax.xaxis.label.set_fontsize(8.5)
        ax.tick_params(labelsize=7.5)
    figure.text(0.008, 0.945, "Largest explicit step after a cut, over that of the uncut sheet", fontsize=10, fontweight="bold")
    bands = panels.legends(set())[0][1]
    figure.legend(handles=bands, loc="lower left", ncol=len(bands), bbox_to_anchor=(0.125, 0.1), fontsize=8.5, handlelength=1.2,
                  columnspacing=1.4)
    figure.text(0.008, 0.02, "Columns: from harmless (left) to harmful. A cell: the worst of eight places on four sheets of 800 triangles (cuts in a "
                "row: of one);\nh: mean edge. Stabilised mass: after a conventional split; white: not known. Steps with ties or phantom nodes are predicted.",
                fontsize=9, color="#555555", linespacing=1.35)
    return figure


def save(figure, path):
    picture = io.BytesIO()
    figure.savefig(picture, dpi=DPI)
    plt.close(figure)
    try:  # in 256 colours: a third of the bytes
        Image.open(picture).convert("RGB").quantize(256, kmeans=4, dither=Image.Dither.NONE).save(path, optimize=True)
    except OSError as error:
        load.stop(f"{path} can't be written: {error.strerror}")
    print(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, metavar="DIR", default=load.REPOSITORY / "results/reference",
                        help="receives the figures (default: results/reference)")
    folder = parser.parse_args().out
    methods = method_gallery.all_methods()
    save(gallery(methods), folder / "readme_gallery.png")
    save(chart(methods), folder / "readme_chart.png")
    save(stability(), folder / "readme_atlas.png")


if __name__ == "__main__":
    main()
