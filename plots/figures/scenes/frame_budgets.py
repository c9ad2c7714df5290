#!/usr/bin/env python3
"""What a time per frame buys: error over time of linear solves, position-based dynamics and vertex block descent. Reads
DIR/points.csv, which experiments/frame_budgets writes; writes DIR/table.txt and draws DIR/frame_budgets.png."""

import argparse
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis.scenes import frame_budgets
from figures.common import style

LOOKS = [("#1b6ca8", "o"), ("#c8551b", "s"), ("#3b8c3b", "^"), ("#7b4ea3", "D")]


def draw(points, budgets, path):
    resolutions = sorted(points["resolution"].unique())
    figure, axes = plt.subplots(1, len(resolutions), figsize=(style.PAGE, 2.6), sharey=True, squeeze=False)
    for axis, resolution in zip(axes[0], resolutions):
        here = points[points["resolution"] == resolution]
        for way, (colour, marker) in zip(dict.fromkeys(points["way"]), LOOKS):
            mine = here[here["way"] == way].sort_values("median_ms")
            axis.plot(mine["median_ms"], mine["error_percent"], marker, color=colour, markersize=3, alpha=0.35)
            front = mine[mine["error_percent"] <= mine["error_percent"].cummin()]
            axis.plot(front["median_ms"], front["error_percent"], marker=marker, color=colour, markersize=3.5, linewidth=1,
                      label=way)
        for budget in budgets:
            axis.axvline(budget, color="black", linewidth=0.5, linestyle=":")
        axis.set(xscale="log", yscale="log", xlabel="ms a frame, median", title=f"{resolution:,} triangles")
        for side in (axis.xaxis, axis.yaxis):
            side.set_major_formatter(lambda value, _: f"{value:g}")
    axes[0][0].set_ylabel("error, % of the sheet's size")
    figure.legend(*axes[0][0].get_legend_handles_labels(), loc="lower center", ncols=4)
    figure.tight_layout(rect=(0, 0.1, 1, 1))
    style.write_png(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--budgets", default="4,8,16", help="ms a frame")
    options = parser.parse_args()
    points = pd.read_csv(options.folder / "points.csv")
    budgets = [float(ms) for ms in options.budgets.split(",")]
    text = frame_budgets.table(points, budgets)
    (options.folder / "table.txt").write_text(text + "\n", encoding="utf-8")
    print(text)
    draw(points, budgets, options.folder / "frame_budgets.png")


if __name__ == "__main__":
    main()
