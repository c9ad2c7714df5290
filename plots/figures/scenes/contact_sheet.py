#!/usr/bin/env python3
"""An overview of the scenes that have frames: four moments of each, cut by a method that README recommends."""

import argparse
import sys
from pathlib import Path

import matplotlib.pyplot as plt

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import frame_files, load
from analysis.scenes import scene_frames
from analysis.scenes.overview import ALIKE, folders_of, title
from figures.common import render, style

MOMENTS = 4
CAMERA = render.Camera(centre=(0.5, 0.5, -0.25), azimuth=25, elevation=42)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results",
                        help="holds STEM/SCENE/METHOD with frames, receives contact_sheet (default: results)")
    results = parser.parse_args().results
    draw([f for f in folders_of(results) if f.parent.name not in ALIKE], results)


def draw(folders, results):
    height = 0.6
    width = style.WIDTH / MOMENTS  # of a picture; two columns of scenes, half as many rows
    rows = -(-len(folders) // 2)
    descriptions = [frame_files.read_description(d) for d in folders]
    n = sorted({d["triangles_before"] for d in descriptions})
    by = " or ".join(sorted({d["method"] for d in descriptions}))
    figure = plt.figure(figsize=(style.PAGE, 1))
    lines = style.two_lines(figure, f"Every scene, cut by {by}, from just before the first cut to the end. Red: lips. n = "
                            f"{', '.join(map(str, n))} triangles before the cuts. Figure 8 with other solvers or bending looks alike. No "
                            f"seed: the cuts are in experiments/scenes; {scene_frames.commits(descriptions)}. Command: "
                            "plots/figures/scenes/contact_sheet.py", style.PAGE - 0.1)
    below, row = 0.125 * len(lines) + 0.08, height + 0.17
    total = below + row * rows
    figure.set_size_inches(style.PAGE, total)
    figure.text(0.05 / style.PAGE, 0.04 / total, "\n".join(lines), fontsize=style.CAPTION_SIZE, va="bottom",
                linespacing=1.2, parse_math=False)
    for r, (folder, description) in enumerate(zip(folders, descriptions)):
        times = [t for t, _ in frame_files.read_series(folder)]
        first = description["cuts"][0]["time_s"]
        frames = [frame_files.read_frame(folder, first + (times[-1] - first) * i / (MOMENTS - 1)) for i in range(MOMENTS)]
        box = render.extent(frames, CAMERA)
        bottom, left = below + row * (rows - 1 - r % rows), (style.PAGE - style.WIDTH) * (r // rows)
        figure.text((left + 0.05) / style.PAGE, (bottom + height + 0.02) / total, title(folder.parent.name), fontsize=7.5,
                    fontweight="bold", va="bottom")
        for c, frame in enumerate(frames):
            ax = figure.add_axes([(left + c * width) / style.PAGE, bottom / total, width / style.PAGE, height / total])
            render.draw(ax, frame, CAMERA)
            render.blank(ax, box)
            ax.text(0.97, 1, f"{frame.time:.2f} s", transform=ax.transAxes, fontsize=7, va="top", ha="right")
    style.save(figure, results, "contact_sheet")


if __name__ == "__main__":
    main()
