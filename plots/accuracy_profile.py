"""Which share of all cases is solved to an error within a time."""

import numpy as np

import style
from accuracy_records import label_edges, log_x_axis

TOLERANCES = (0.2, 0.1, 0.05, 0.02)


def solved_times(records, variant, tolerance):
    """Per case of the ensemble the least time, by whatever resolution, solver and budget, to an error within the
    tolerance; infinity where none gives it. A case: problem, sheet, member that every resolution has."""
    members = records.rows().groupby("resolution")["case"].nunique().min()
    table = records.rows(variant)
    table = table[table["case"] < members]
    good = table["ms"].where((table["error"] <= tolerance) & ~table["failed"], np.inf)
    return good.groupby([table[c] for c in ("scene", "sheet", "case")]).min().to_numpy()


def profile_figure(records):
    """Share of all cases solved to a tolerance within a time."""
    figure, axes = style.panels(2, 2, 4.0, sharex=True, sharey=True)
    for tolerance, ax in zip(TOLERANCES, axes.flat):
        for variant, look in records.looks.items():
            times = np.sort(solved_times(records, variant, tolerance))
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
    style.finish(figure, records.looks.values(), records.caption(
        f"Performance profile over all {len(records.problems)} problems and {len(records.sheets)} sheets: share of the "
        "cases (problem, sheet, member) whose primary measure is within the tolerance after so much time for cut, "
        "assembly and solve, by the best resolution, solver and number of iterations for each. Failed cases, and those "
        "that no resolution solves, are never reached."))
    return figure
