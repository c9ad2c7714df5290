"""The share of all cases that are solved to a tolerance within a time."""

import numpy as np

from analysis.accuracy.profiles import TOLERANCES, members_throughout, solved_times
from figures.accuracy.axes import label_edges, log_x_axis
from figures.common import style


def profile_figure(records):
    """Share of all cases solved to a tolerance within a time."""
    figure, axes = style.panels(2, 2, 4.0, sharex=True, sharey=True)
    for tolerance, ax in zip(TOLERANCES, axes.flat):
        for variant, look in records.looks.items():
            times = np.sort(solved_times(records, variant, tolerance).to_numpy())
            reached = times[np.isfinite(times)]
            if len(reached):
                share = 100 * np.arange(1, len(reached) + 1) / len(times)
                ax.step(reached, share, where="post", color=look.colour, linestyle=look.line,
                        linewidth=0.5 + 0.4 * look.width)
                ax.plot(reached[-1], share[-1], marker=look.marker, markersize=3.2, color=look.colour,
                        markeredgecolor="white", markeredgewidth=0.3)
        ax.set_title(f"error ≤ {100 * tolerance:g} %", loc="left")
        log_x_axis(ax)
        ax.set_ylim(0, 102)
    label_edges(axes, "total time, ms", "cases solved, %")
    drawn = members_throughout(records)
    style.finish(figure, records.looks.values(), drawn.caption(
        f"Share of {len(solved_times(records, next(iter(records.looks)), 1))} cases whose error is within the tolerance, against "
        f"the time of cut, assembly and solve. A case is a problem ({len(drawn.problems)}), sheet ({len(records.sheets)}) and member; "
        "its error is that of the primary measure. Each case is solved by the resolution, solver and number of iterations "
        "that need the least time. Cases that failed, or that no resolution solves to the tolerance, count as unsolved."))
    return figure
