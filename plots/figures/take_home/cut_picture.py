#!/usr/bin/env python3
"""Draws a cut: the sheet before and after in rest space, triangles by their aspect ratios, and the worst triangle of the cut.
`cutbench cut --picture` calls it. Needs numpy, matplotlib and Pillow alone."""

import argparse
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.fonttype"] = "none"
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import cut_result
from figures.common import cut_sheet

WIDTH, HIGHEST, HEADER, FOOTER, GAP, SIDE = 10.0, 5.0, 0.25, 0.3, 0.08, 0.06  # inches
INSET = 3.2  # of its side, times the longest edge of the worst triangle


def window_of(points):
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.02 * (high - low).max()
    return low[0] - margin, high[0] + margin, low[1] - margin, high[1] + margin


def layout(aspect, has_inset):
    """(left, bottom, width, height) of the sheet before, after and of a square inset, and the size of the figure, inches: side by
    side; of a wide sheet one below the other, the inset beside both. \param aspect  height of the sheet over its width"""
    width = WIDTH - 2 * SIDE - has_inset * GAP
    if aspect < 0.6:
        height = (width - has_inset * HEADER) / (1 / aspect + 2 * has_inset)
        wide, side = height / aspect, 2 * height + HEADER
        before, after = (SIDE, FOOTER + height + HEADER, wide, height), (SIDE, FOOTER, wide, height)
        return before, after, (SIDE + wide + GAP, FOOTER, side, side), (WIDTH, FOOTER + side + HEADER)
    height = min((width - GAP) / (2 / aspect + has_inset), HIGHEST)
    wide = height / aspect
    places = [(SIDE + k * (wide + GAP), FOOTER, wide, height) for k in range(2)]
    inset = (SIDE + 2 * (wide + GAP), FOOTER, height, height)
    return *places, inset, (2 * SIDE + 2 * wide + GAP + has_inset * (GAP + height), FOOTER + height + HEADER)


def changed(old, new):
    """Which of the new triangles, (triangles, 3, 2), are no old ones."""
    known = {c.tobytes() for corners in (old, np.roll(old, 1, axis=1), np.roll(old, 2, axis=1)) for c in np.ascontiguousarray(corners)}
    return np.array([c.tobytes() not in known for c in np.ascontiguousarray(new)])


def worst_window(corners, made):
    """A square round the worst triangle that the cut made, that triangle, and its aspect ratio; None where it made none."""
    if not made.any():
        return None, None, None
    ratios = np.where(made, cut_result.aspect_ratio(corners), 0)
    worst = corners[ratios.argmax()]
    centre, reach = worst.mean(axis=0), INSET / 2 * np.linalg.norm(worst - np.roll(worst, 1, axis=0), axis=1).max()
    return (centre[0] - reach, centre[0] + reach, centre[1] - reach, centre[1] + reach), worst, ratios.max()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("before", "after", "path", "parents", "out"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    parser.add_argument("--title", default="")
    options = parser.parse_args()
    old, old_triangles = cut_result.read_obj(options.before)
    new, new_triangles = cut_result.read_obj(options.after)
    details = cut_result.Details(options.parents)
    curves = [cut_result.curve_points(cut) for cut in json.loads(options.path.read_text(encoding="utf-8"))["cuts"]]

    whole = window_of(np.vstack([old, new]))
    close, worst, ratio = worst_window(new[new_triangles], changed(old[old_triangles], new[new_triangles]))
    before, after, inset, size = layout((whole[3] - whole[2]) / (whole[1] - whole[0]), bool(close))
    figure = plt.figure(figsize=size)
    scale = float(np.clip(before[2] / 3.3 * np.sqrt(800 / len(old_triangles)), 0.25, 1))

    def panel(place, title, text, window):
        ax = figure.add_axes([place[0] / size[0], place[1] / size[1], place[2] / size[0], place[3] / size[1]])
        cut_sheet.frame(ax, window)
        ax.set_title(title, loc="left", fontsize=9, fontweight="bold", pad=3)
        if place[2] > 2.8:
            ax.set_title(text, loc="right", fontsize=8, color="#555555", pad=3)
        return ax

    ax = panel(before, "before", f"{len(old_triangles):,} triangles", whole)
    cut_sheet.draw(ax, old, old_triangles, curves, scale=scale)
    ax = panel(after, options.title or "after", f"{len(new_triangles):,} triangles", whole)
    cut_sheet.draw(ax, new, new_triangles, details=details, scale=scale)
    cut_sheet.draw_copies(ax, old, details, scale)
    if close:
        ax.add_patch(plt.Rectangle((close[0], close[2]), close[1] - close[0], close[3] - close[2], fill=False, edgecolor="black",
                                   linewidth=1.2, zorder=6))
        ax = panel(inset, f"its worst triangle: AR {ratio:.3g}", f"{close[1] - close[0]:.3g} wide", close)
        cut_sheet.draw(ax, new, new_triangles, details=details)
        cut_sheet.draw_copies(ax, old, details)
        ax.add_patch(plt.Polygon(worst, fill=False, edgecolor="black", linewidth=1, joinstyle="round", zorder=7))
    figure.legend(handles=cut_sheet.legend_entries(details=[details]), loc="lower left", ncol=8, fontsize=8, borderaxespad=0.3, handlelength=1.6,
                  columnspacing=1.2, frameon=False)
    figure.text(1 - SIDE / figure.get_figwidth(), 0.12 / figure.get_figheight(), "AR: longest edge over the height on it", ha="right", va="center",
                fontsize=8, color="#555555")
    figure.savefig(options.out, dpi=160)
    if options.out.suffix == ".png":  # a third of the bytes
        Image.open(options.out).convert("RGB").quantize(64, Image.Quantize.MAXCOVERAGE, kmeans=2, dither=Image.Dither.NONE).save(options.out, optimize=True)


if __name__ == "__main__":
    main()
