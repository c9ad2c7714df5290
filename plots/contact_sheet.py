#!/usr/bin/env python3
"""An overview of the scenes that have frames: four moments of each, cut by a method that README recommends."""

import argparse
from pathlib import Path

import matplotlib.pyplot as plt

from common import load, render, scene_panels, style

METHOD = "bowyer_watson rounds=1"  # the paper's
SHOWN = ["warp_and_refine", METHOD]  # each scene by the first of these that cut it
ALIKE = {"fig8_edge_quality_cg", "fig8_edge_quality_hinges", "fig8_edge_quality_unconverged"}  # look like fig8_edge_quality_patches
TITLES = {
    "falling_piece": "A disc falls out of a sheet", "picked_cut": "A cut picked in motion",
    "progressive_cut": "A blade that advances", "fig5_single_cuts_curved": "Figure 5: a curved cut",
    "fig5_single_cuts_straight": "Figure 5: a straight cut", "fig6_partial_and_cutout_cutout": "Figure 6: a part cut out",
    "fig6_partial_and_cutout_partial": "Figure 6: a cut from a side", "fig7_recut_and_multiple_multiple": "Figure 7: several cuts",
    "fig7_recut_and_multiple_recut": "Figure 7: a cut across a cut", "fig8_edge_quality_patches": "Figure 8: the cut edge",
    "fig8_edge_quality_cg": "Figure 8, by CG", "fig8_edge_quality_hinges": "Figure 8, hinges",
    "fig8_edge_quality_unconverged": "Figure 8, CG stopped early", "fig10_level_of_detail": "Figure 10: a winding cut",
}
MOMENTS = 4
CAMERA = render.Camera(centre=(0.5, 0.5, -0.25), azimuth=25, elevation=42)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results",
                        help="holds STEM/SCENE/METHOD with frames, receives contact_sheet (default: results)")
    results = parser.parse_args().results
    draw([f for f in folders_of(results) if f.parent.name not in ALIKE], results)


def folders_of(results):
    """Of each scene that one of SHOWN cut, the folder by the first of these."""
    scenes = {}
    for file in results.glob("*/*/*/simulation.json"):
        method = render.read_description(file.parent)["method"]
        rank = next((i for i, m in enumerate(SHOWN) if m in (method, method.partition(" ")[0])), None)
        if rank is not None:
            scenes.setdefault(file.parent.parent, []).append((rank, file.parent))
    if not scenes:
        load.stop(f"{results} has no frames by {' or '.join(SHOWN)}; experiments/reproduce fig5_single_cuts makes some")
    return sorted((min(found)[1] for found in scenes.values()), key=scene_number)


def title(scene):
    return TITLES.get(scene, scene.replace("_", " "))


def scene_number(folder):
    """Figures first, fig5 before fig10."""
    return [(not folder.parent.name.startswith("fig"), "")] + [(int(part) if part.isdigit() else 0, part)
            for part in folder.parent.name.replace("fig", "").split("_")]


def draw(folders, results):
    height = 0.6
    width = style.WIDTH / MOMENTS  # of a picture; two columns of scenes, half as many rows
    rows = -(-len(folders) // 2)
    descriptions = [render.read_description(d) for d in folders]
    n = sorted({d["triangles_before"] for d in descriptions})
    by = " or ".join(sorted({d["method"] for d in descriptions}))
    figure = plt.figure(figsize=(style.PAGE, 1))
    lines = style.two_lines(figure, f"Every scene, cut by {by}, from just before the first cut to the end. Red: lips. n = "
                            f"{', '.join(map(str, n))} triangles before the cuts. Figure 8 with other solvers or bending looks alike. No "
                            f"seed: the cuts are in experiments/scenes; {scene_panels.commits(descriptions)}. Command: "
                            "plots/contact_sheet.py", style.PAGE - 0.1)
    below, row = 0.125 * len(lines) + 0.08, height + 0.17
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
