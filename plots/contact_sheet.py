#!/usr/bin/env python3
"""An overview of all scenes that have frames: four moments of each, cut by the paper's method."""

import argparse
from pathlib import Path

import matplotlib.pyplot as plt

from common import load, render, scene_panels, style

METHOD = "bowyer_watson rounds=1"
MOMENTS = 4
CAMERA = render.Camera(centre=(0.5, 0.5, -0.25), azimuth=25, elevation=42)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results",
                        help="holds STEM/SCENE/METHOD with frames, receives contact_sheet (default: results)")
    results = parser.parse_args().results
    draw(folders_of(results), results)


def folders_of(results):
    """Of the scenes that METHOD cut."""
    folders = sorted((d.parent for d in results.glob("*/*/*/simulation.json")
                      if render.read_description(d.parent)["method"] == METHOD), key=scene_number)
    if not folders:
        load.stop(f"{results} has no frames by {METHOD}; experiments/reproduce fig5_single_cuts makes some")
    return folders


def scene_number(folder):
    """fig5 before fig10."""
    return [(int(part) if part.isdigit() else 0, part)
            for part in folder.parent.name.replace("fig", "").split("_")]


def draw(folders, results):
    height = 0.56
    width = style.WIDTH / MOMENTS  # of a picture; two columns of scenes, half as many rows
    rows = -(-len(folders) // 2)
    descriptions = [render.read_description(d) for d in folders]
    n = sorted({d["triangles_before"] for d in descriptions})
    figure = plt.figure(figsize=(style.PAGE, 1))
    lines = style.wrapped(figure, f"Every scene, cut by {METHOD}, from just before the first cut to the end. n = "
                          f"{', '.join(map(str, n))} triangles before the cuts. Red: lips. No seed: the cuts are in "
                          f"experiments/scenes; {scene_panels.commits(descriptions)}. Command: plots/contact_sheet.py", style.PAGE - 0.1)
    below, row = 0.115 * len(lines) + 0.08, height + 0.24
    total = below + row * rows
    figure.set_size_inches(style.PAGE, total)
    figure.text(0.05 / style.PAGE, 0.04 / total, "\n".join(lines), fontsize=style.CAPTION_SIZE, va="bottom",
                linespacing=1.2, parse_math=False)
    for r, (folder, description) in enumerate(zip(folders, descriptions)):
        times = [t for t, _ in render.read_series(folder)]
        first = description["cuts"][0]["time_s"]
        frames = [render.read_frame(folder, first + (times[-1] - first) * i / (MOMENTS - 1)) for i in range(MOMENTS)]
        box = render.extent(frames, CAMERA)
        bottom, left = below + row * (rows - 1 - r % rows), (style.PAGE - style.WIDTH) * (r // rows)
        figure.text((left + 0.05) / style.PAGE, (bottom + height + 0.03) / total,
                    folder.parent.name.replace("_", " ") + "\n" + description["effect"], fontsize=4.9, va="bottom",
                    linespacing=1.1)
        for c, frame in enumerate(frames):
            ax = figure.add_axes([(left + c * width) / style.PAGE, bottom / total, width / style.PAGE, height / total])
            render.draw(ax, frame, CAMERA)
            render.blank(ax, box)
            ax.text(0.97, 1, f"{frame.time:.2f} s", transform=ax.transAxes, fontsize=5, va="top", ha="right")
    style.save(figure, results, "contact_sheet")


if __name__ == "__main__":
    main()
