#!/usr/bin/env python3
"""What each frame of a sheet cost that was cut while it swung: the distribution by method and resolution, and its growth
over the run. Reads DIR/frames.csv, which experiments/realtime writes; draws DIR/frame_times.png and writes DIR/table.txt.
With DIR/animation and DIR/animation.csv: also DIR/realtime.webp, the sheet with the frame times under it."""

import argparse
import io
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import frame_files, naming
from analysis.families import family
from analysis.scenes.frame_times import KEYS, read, row_of, write_table
from figures.common import render, style
from figures.scenes import contact_sheet


def looks_of(methods):
    """The colour of the family; the second of a family is dashed, the third has dots and dashes."""
    looks, seen = {}, []
    for method in methods:
        colour = family(method).colour
        looks[method] = {"color": colour, "linestyle": ("-", "--", "-.")[seen.count(colour)], "linewidth": 1}
        seen.append(colour)
    return looks


def draw(frames, limits, path):
    resolutions = sorted(frames["resolution"].unique())
    methods = list(dict.fromkeys(frames["method"]))
    looks = looks_of(methods)
    figure, axes = plt.subplots(2, len(resolutions), figsize=(style.PAGE, 4.6), sharey="row", squeeze=False)
    for column, resolution in enumerate(resolutions):
        share, run = axes[:, column]
        for method in methods:
            mine = frames[(frames["resolution"] == resolution) & (frames["method"] == method)].iloc[1:]
            if mine.empty:
                continue
            ordered = np.sort(mine["total_ms"])
            share.step(ordered, 100 * (1 - np.arange(len(ordered)) / len(ordered)), where="post", **looks[method],
                       label=naming.words(method))
            second = mine.groupby(np.floor(mine["time_s"] - 1e-9))["total_ms"].median()
            run.plot(second.index + 0.5, second, **looks[method])
        for axis in (share, run):
            (axis.axvline if axis is share else axis.axhline)(limits[0], color="black", linewidth=0.7, linestyle="--")
            if len(limits) > 1:
                (axis.axvline if axis is share else axis.axhline)(limits[1], color="black", linewidth=0.5, linestyle=":")
        share.set(xscale="log", yscale="log", ylim=(0.08, 100), xlabel="ms a frame",
                  title=f"{resolution:,} triangles at first")
        run.set(yscale="log", xlabel="time in the scene, s")
        for axis in (share.xaxis, share.yaxis, run.yaxis):
            axis.set_major_formatter(lambda value, _: f"{value:g}")
    axes[0][0].set_ylabel("frames that take longer, %")
    axes[1][0].set_ylabel("ms a frame, median of each second")
    figure.legend(*axes[0][0].get_legend_handles_labels(), loc="lower center", ncols=min(5, len(methods)))
    names = " and ".join(f"{limit:g} ms ({'dashed' if k == 0 else 'dotted'})" for k, limit in enumerate(limits[:2]))
    figure.suptitle(f"A swinging sheet, cut every quarter of a second. Lines: {names}.", fontsize=7)
    figure.tight_layout(rect=(0, 0.05 + 0.035 * -(-len(methods) // 5), 1, 1))
    style.write_png(figure, path)


def animate(folder, limit):
    frames, costs = frame_files.read_all(folder / "animation"), pd.read_csv(folder / "animation.csv")
    frames = frames[(len(frames) - 1) % 2::2]  # every other one, and the last: half the bytes
    description = frame_files.read_description(folder / "animation")
    camera = contact_sheet.CAMERA
    low, high, bottom, top = render.extent(frames, camera)
    box = (low, high, max(bottom, top - 1.1 * (high - low)), top)  # pieces that are cut free fall out of the picture
    pictures = [frame_picture(frame, camera, box, description, costs, limit) for frame in frames]
    times = [frame.time for frame in frames]
    durations = [round(1000 * (b - a)) for a, b in zip(times, times[1:])] + [1000]
    path = folder / "realtime.webp"
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=durations, loop=0, quality=30, method=6)
    print(path)


def frame_picture(frame, camera, box, description, costs, limit):
    width = 3.2
    height = width * (box[3] - box[2]) / (box[1] - box[0])
    figure = plt.figure(figsize=(width, height + 0.9))
    whole = height + 0.9
    ax = figure.add_axes([0, 0.75 / whole, 1, height / whole])
    render.draw(ax, frame, camera)
    render.blank(ax, box)
    strip = figure.add_axes([0.13, 0.3 / whole, 0.84, 0.42 / whole])
    past = costs[costs["time_s"] <= frame.time + 1e-9]
    strip.plot(past["time_s"], past["total_ms"], color="#0072b2", linewidth=0.6)
    cuts = past[past["has_cut"] == 1]
    strip.plot(cuts["time_s"], cuts["total_ms"], "o", color="#b0001e", markersize=1.6)
    strip.axhline(limit, color="black", linewidth=0.5, linestyle="--")
    strip.set(xlim=(0, costs["time_s"].max()), ylim=(0, max(1.2 * limit, costs["total_ms"].iloc[1:].max())))
    strip.tick_params(labelsize=4.5)
    strip.set_xlabel("s", fontsize=4.5, labelpad=0)
    strip.set_ylabel("ms a frame", fontsize=4.5, labelpad=1)
    name = naming.words(description["method"].split(" ")[0])
    figure.text(0.02, 0.99, f"{name}, {description['triangles_before']} triangles at first; red: frames with a cut",
                fontsize=5, va="top")
    last = past["total_ms"].iloc[-1] if len(past) else 0
    figure.text(0.98, 0.99, f"{frame.time:.2f} s, {last:.1f} ms", fontsize=5, va="top", ha="right")
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=style.DPI, format="png")
    plt.close(figure)
    return Image.open(buffer).convert("RGB")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, metavar="DIR")
    parser.add_argument("--limits", default="16.7,8.3", help="ms, of a frame (default: 16.7,8.3)")
    options = parser.parse_args()
    limits = [float(limit) for limit in options.limits.split(",")]
    frames = read(options.folder)
    table = frames.groupby(KEYS, sort=False).apply(lambda group: row_of(group, limits))
    write_table(table, options.folder / "table.txt", limits[0])
    draw(frames, limits, options.folder / "frame_times.png")
    if (options.folder / "animation" / "frames.pvd").exists():
        animate(options.folder, limits[0])


if __name__ == "__main__":
    main()
