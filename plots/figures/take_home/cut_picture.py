#!/usr/bin/env python3
"""Draws a cut: the sheet before and after in rest space, triangles by their aspect ratios, and the worst triangle of the cut.
`cutbench cut --picture` calls it. Needs numpy and matplotlib alone."""

import argparse
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from figures.common import cut_sheet

WIDTH, HEADER, FOOTER, GAP, SIDE = 10.0, 0.25, 0.3, 0.08, 0.06  # inches
INSET = 3.2  # of its side, times the longest edge of the worst triangle


def window_of(points):
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.02 * (high - low).max()
    return low[0] - margin, high[0] + margin, low[1] - margin, high[1] + margin


def axes_at(figure, left, width, height):
    total = figure.get_size_inches()
    return figure.add_axes([left / total[0], FOOTER / total[1], width / total[0], height / total[1]])


def changed(old, new):
    """Which of the new triangles, (triangles, 3, 2), are no old ones."""
    known = {c.tobytes() for corners in (old, np.roll(old, 1, axis=1), np.roll(old, 2, axis=1)) for c in np.ascontiguousarray(corners)}
    return np.array([c.tobytes() not in known for c in np.ascontiguousarray(new)])


def worst_window(corners, made):
    """A square round the worst triangle that the cut made, that triangle, and its aspect ratio; None where it made none."""
    if not made.any():
        return None, None, None
    ratios = np.where(made, cut_sheet.aspect_ratio(corners), 0)
    worst = corners[ratios.argmax()]
    centre, reach = worst.mean(axis=0), INSET / 2 * np.linalg.norm(worst - np.roll(worst, 1, axis=0), axis=1).max()
    return (centre[0] - reach, centre[0] + reach, centre[1] - reach, centre[1] + reach), worst, ratios.max()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("before", "after", "path", "parents", "out"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    parser.add_argument("--title", default="")
    options = parser.parse_args()
    old, old_triangles = cut_sheet.read_obj(options.before)
    new, new_triangles = cut_sheet.read_obj(options.after)
    details = cut_sheet.Details(options.parents)
    curves = [cut_sheet.curve_points(cut) for cut in json.loads(options.path.read_text(encoding="utf-8"))["cuts"]]

    whole = window_of(np.vstack([old, new]))
    close, worst, ratio = worst_window(new[new_triangles], changed(old[old_triangles], new[new_triangles]))
    aspect = (whole[3] - whole[2]) / (whole[1] - whole[0])
    panels = 3 if close else 2
    # Two panels of the sheet and a square one, all of one height.
    height = (WIDTH - 2 * SIDE - (panels - 1) * GAP) / (2 / aspect + (panels - 2))
    height = min(height, 5.0)
    wide = height / aspect
    figure = plt.figure(figsize=(2 * SIDE + 2 * wide + (panels - 1) * GAP + (panels - 2) * height, HEADER + height + FOOTER))
    scale = float(np.clip(wide / 3.3 * np.sqrt(800 / len(old_triangles)), 0.25, 1))

    def panel(number, title, text, window, width):
        ax = axes_at(figure, SIDE + number * (wide + GAP), width, height)
        cut_sheet.frame(ax, window)
        ax.set_title(title, loc="left", fontsize=9, fontweight="bold", pad=3)
        ax.set_title(text, loc="right", fontsize=8, color="#555555", pad=3)
        return ax

    ax = panel(0, "before", f"{len(old_triangles):,} triangles", whole, wide)
    cut_sheet.draw(ax, old, old_triangles, curves, scale=scale)
    ax = panel(1, options.title or "after", f"{len(new_triangles):,} triangles", whole, wide)
    cut_sheet.draw(ax, new, new_triangles, details=details, scale=scale)
    cut_sheet.draw_copies(ax, old, details, scale)
    if close:
        ax.add_patch(plt.Rectangle((close[0], close[2]), close[1] - close[0], close[3] - close[2], fill=False, edgecolor="black",
                                   linewidth=1.2, zorder=6))
        ax = panel(2, f"its worst triangle: AR {ratio:.3g}", f"{close[1] - close[0]:.3g} wide", close, height)
        cut_sheet.draw(ax, new, new_triangles, details=details)
        cut_sheet.draw_copies(ax, old, details)
        ax.add_patch(plt.Polygon(worst, fill=False, edgecolor="black", linewidth=1, joinstyle="round", zorder=7))
    figure.legend(handles=cut_sheet.legend_entries(details=[details]), loc="lower left", ncol=8, fontsize=8, borderaxespad=0.3, handlelength=1.6,
                  columnspacing=1.2, frameon=False)
    figure.savefig(options.out, dpi=160)


if __name__ == "__main__":
    main()
