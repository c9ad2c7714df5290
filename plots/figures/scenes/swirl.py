#!/usr/bin/env python3
"""Does the edge of a cut swirl? How far the lips turn away from those on a fine sheet, by method, over several cuts and
materials (experiments/swirl); and what the conventional split turns beside each other method."""

import contextlib
import io
import sys
from pathlib import Path

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import families, load
from analysis.scenes import scene_frames
from analysis.scenes.swirl import COARSER, FINE, STEM, measured, ratios
from figures.common import style

MATERIALS = {"skin": "o", "stiff_in_bending": "^", "soft_in_plane": "s"}


def draw(rows, described):
    methods = list(rows[rows["method"] != str(COARSER)].groupby("method")["degrees"].median().sort_values().index)
    figure, axes = style.panels(1, 1, 4.2, width=style.PAGE * 0.7)
    ax = axes[0, 0]
    for i, method in enumerate(methods):
        here = rows[rows["method"] == method]
        colour = families.family(method).colour
        for material, marker in MATERIALS.items():
            some = here[here["material"] == material]
            ax.plot(some["degrees"], np.full(len(some), i), marker, color=colour, markersize=4, markerfacecolor="none")
        ax.plot(here["degrees"].median(), i, "|", color=colour, markersize=16, markeredgewidth=2)
    worth = rows.loc[rows["method"] == str(COARSER), "degrees"].median()
    ax.axvline(worth, color="black", linewidth=0.8, linestyle=":")
    ax.set_xscale("log")
    ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.set_xlabel("lips turned by, degrees")
    ax.set_yticks(range(len(methods)), [families.name(m) for m in methods])
    ax.set_ylim(len(methods) - 0.5, -0.5)
    n = scene_frames.same((d["triangles_before"] for d in described if d["triangles_before"] not in (FINE, COARSER)),
                          "the number of triangles")
    cuts = rows["cut"].nunique()
    grey = dict(linestyle="", color="#444444")
    style.finish(figure, [], (
        f"Lips against those on a fine sheet, {cuts} cuts and {len(MATERIALS)} materials. Root mean square of the "
        f"angle along both lips, edge by edge, against the same scene on {FINE} triangles. n = {n} triangles before the cut; direct "
        f"solver. Dotted: median difference of a sheet of {COARSER} triangles. {scene_frames.commits(described)}. Command: "
        f"experiments/swirl --cuts {cuts}"),
        [Line2D([], [], marker=marker, markersize=4, markerfacecolor="none", label=material.replace("_", " "), **grey)
         for material, marker in MATERIALS.items()]
        + [Line2D([], [], marker="|", markersize=9, markeredgewidth=2, label="median", **grey),
           Line2D([], [], color="black", linewidth=0.8, linestyle=":", label=f"sheet of {COARSER}")])
    return figure


def main():
    results = load.results_folder(STEM, __doc__)
    rows, described = measured(results)
    style.save(draw(rows, described), results, STEM)
    text = io.StringIO()
    with contextlib.redirect_stdout(text):
        load.print_table("Angle of the lips by the conventional split over that by: geometric mean over materials and cuts, and its range by cut", ["method", "ratio", "lowest cut", "highest cut", "cuts"],
                         [[*row[:-1], str(row[-1])] for row in ratios(rows)])
        load.print_table(f"Lips against those of a sheet of {FINE} triangles; {scene_frames.commits(described)}", list(rows.columns),
                         [[str(r.cut), r.material, r.method, r.mm, r.degrees, r.verdict] for r in rows.itertuples()])
    load.write_beside(results / f"{STEM}.txt", text.getvalue())


if __name__ == "__main__":
    main()
