#!/usr/bin/env python3
"""Figure 10 of the paper: the detail round an incision. Above each picture: the unknowns, and the Hausdorff distance at
rest between the requested curve and the incision. The sheet is 1 m wide."""

import sys
from pathlib import Path

from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import naming
from analysis.paper.fig10_level_of_detail import STEM, label, read_levels
from analysis.scenes import scene_frames
from figures.common import scene_panels, style
from figures.common.render import Camera
from figures.common.scene_panels import Shot

TOLERANCES = {"0.05": ("-", "chord tolerance 0.05 h (default)"), "0.005": ("--", "0.005 h")}


def error_figure(levels, described):
    """Error over unknowns of the same cut at several resolutions, in the first frame after the cut."""
    figure, axes = style.panels(1, 1, 5, layout="constrained")
    ax, looks = axes[0, 0], naming.looks(levels)
    for variant, look in looks.items():
        for tolerance, points in levels[variant].items():
            ax.plot(*zip(*sorted(points)), **{**look.drawn(), "linestyle": TOLERANCES[tolerance][0]})
    ax.set_xscale("log")
    ax.set_yscale("log")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
        axis.set_minor_formatter(NullFormatter())
    ax.set_xlabel("unknowns after the cut")
    ax.set_ylabel("incision error, mm")
    n = sorted({d["triangles_before"] for d in described})
    style.finish(figure, looks.values(), "Figure 10 of the paper, measured. Distance between the requested curve and the incision. It is the "
                 "Hausdorff distance at rest, over the unknowns of the cut sheet, which is 1 m wide. All methods but warp and refine cut "
                 "through the same points, so that resolution and chord tolerance alone determine the error. The methods differ in the "
                 f"unknowns that they need. n = {', '.join(map(str, n))} triangles before the cut, one cut. No seed: "
                 f"the cut is in the scene file; {scene_frames.commits(described)}. Command: experiments/reproduce {STEM}",
                 [Line2D([], [], color="#444444", linestyle=line, label=name) for line, name in TOLERANCES.values()])
    return figure


def main():
    options = scene_panels.main(
        STEM, __doc__, [Shot(STEM, "", 0.7, Camera(centre=(0.5, 0.5, -0.25), azimuth=20, elevation=62),
                             box=(-0.3, 0.3, -0.31, 0.3))], label=label, kinds=("mesh",))
    levels, described = read_levels(options.results)
    if levels:
        style.save(error_figure(levels, described), options.results, f"{STEM}_error")


if __name__ == "__main__":
    main()
