#!/usr/bin/env python3
"""Figure 8 of the paper. Above: largest aspect ratio; distance and angle of the lips from those on a fine sheet. Distance (mm)
and angle (degrees) are root mean squares, of the same scene. The paper calls this edge of a cut "swirling" for the conventional
split."""

import sys
from pathlib import Path

from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import frame_files, naming
from analysis.paper.fig8_edge_quality import (
    COARSER, FINE, Reference, SCENES, STEM, TIMES, answer, measured, print_numbers)
from analysis.scenes import scene_frames
from figures.common import scene_panels, style
from figures.common.render import Camera
from figures.common.scene_panels import Shot

FROM_ABOVE = Camera(centre=(0.5, 0.5, -0.2), azimuth=25, elevation=42)
BOX = (-0.45, 0.42, -0.36, 0.3)


def lips_figure(rows, worth, described):
    """Left: how far the lips are off; right: how far they turn away. Above: soon after the cut; below: in the end."""
    figure, axes = style.panels(len(TIMES), 2, 3.4, sharex="col", sharey=True, layout="constrained")
    looks = naming.looks({method for _, _, method, *_ in rows})
    names = list(SCENES)
    for r, time in enumerate(TIMES):
        for c, unit in enumerate(("lips off by, mm", "lips turned by, degrees")):
            ax = axes[r, c]
            for scene, at, method, *values, _ in rows:
                if at == time:
                    shift = 0.16 * (list(looks).index(method) - (len(looks) - 1) / 2)
                    ax.plot(values[c], names.index(scene) + shift, **{**looks[method].drawn(), "linestyle": ""})
            for i, scene in enumerate(names):
                ax.vlines(worth[scene, time][c], i - 0.45, i + 0.45, color="black", linewidth=0.7, linestyle=":")
            ax.set_xscale("log")
            ax.set_yticks(range(len(names)), SCENES.values(), fontsize=5.6)
            ax.set_ylim(len(names) - 0.5, -0.5)
            ax.set_title(f"{time:g} s", loc="left")
            ax.tick_params(labelbottom=True)
            ax.set_xlabel(unit)
            ax.xaxis.set_major_locator(LogLocator(subs=(1, 3)))
            ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
            ax.xaxis.set_minor_formatter(NullFormatter())
    n = scene_frames.same((d["triangles_before"] for d in described), "the number of triangles")
    style.finish(figure, looks.values(), " ".join([
        f"Figure 8 of the paper, measured. Lips against those on a sheet of {FINE} triangles.", answer(rows),
        "Root mean square differences along both lips (same scene, bending element, integrator and step; direct solver). "
        f"n = {n} triangles before the cut at 0.5 s; one cut. No seed: the "
        f"cut is in the scene files; {scene_frames.commits(described)}. Command: experiments/reproduce {STEM}"]),
        [Line2D([], [], color="black", linewidth=0.7, linestyle=":", label=f"difference of a sheet of {COARSER} triangles")])
    return figure


def main():
    def label(description, frame):
        offset, turn = Reference(options.results).difference(description, frame)
        return f"max AR {frame.cell['aspect_ratio'].max():.0f}, {offset:.1f} mm, {turn:.1f}°"
    options = scene_panels.arguments(STEM, __doc__)
    scene_panels.main(STEM, __doc__, [Shot(f"{STEM}_patches", "direct solver", TIMES[0], FROM_ABOVE, box=BOX),
                                      Shot(f"{STEM}_unconverged", "CG stopped at 0.3", TIMES[0], FROM_ABOVE, box=BOX)],
                      label=label)
    rows, worth = measured(options.results)
    described = [frame_files.read_description(f.parent) for f in sorted(options.results.glob(f"{STEM}_*/*/simulation.json"))]
    style.save(lips_figure(rows, worth, described), options.results, f"{STEM}_lips")
    print_numbers(rows, worth)


if __name__ == "__main__":
    main()
