#!/usr/bin/env python3
"""Animated WebP of every scene that has frames, cut by the paper's method: results/<stem>/<scene>.webp. Camera and limits
stay the same throughout a scene; the animation runs at the speed of the simulated time."""

import argparse
import io
import sys
from pathlib import Path

import matplotlib.pyplot as plt
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import frame_files, load
from analysis.scenes import overview
from figures.common import render
from figures.scenes import contact_sheet

WIDTH, HEADER, DPI = 3.2, 0.24, 200  # inches
LAST = 1000  # ms that the end is held


def picture(frame, camera, box, caption):
    below = WIDTH * (box[3] - box[2]) / (box[1] - box[0])
    figure = plt.figure(figsize=(WIDTH, below + HEADER))
    ax = figure.add_axes([0, 0, 1, below / (below + HEADER)])
    render.draw(ax, frame, camera)
    render.blank(ax, box)
    figure.text(0.02, 0.98, caption, fontsize=6, va="top")
    figure.text(0.98, 0.98, f"{frame.time:.2f} s", fontsize=6, va="top", ha="right")
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=DPI, format="png")
    plt.close(figure)
    return Image.open(buffer).convert("RGB")


def animate(folder, path):
    description = frame_files.read_description(folder)
    frames = frame_files.read_all(folder)
    camera = contact_sheet.CAMERA
    box = render.extent(frames, camera)
    caption = f"{folder.parent.name.replace('_', ' ')}\n{description['method']}, {description['triangles_before']} triangles"
    pictures = [picture(frame, camera, box, caption) for frame in frames]
    times = [f.time for f in frames]
    durations = [round(1000 * (b - a)) for a, b in zip(times, times[1:])] + [LAST]
    try:
        pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=durations, loop=0, quality=70, method=4)
    except OSError as error:
        load.stop(f"{path} can't be written: {error.strerror or error}")
    print(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("stems", nargs="*", metavar="STEM", help="folders of results (default: all that have frames)")
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results",
                        help="holds STEM/SCENE/METHOD with frames, receives STEM/SCENE.webp (default: results)")
    options = parser.parse_args()
    for folder in overview.folders_of(options.results):
        if not options.stems or folder.parent.parent.name in options.stems:
            animate(folder, folder.parent.with_suffix(".webp"))


if __name__ == "__main__":
    main()
