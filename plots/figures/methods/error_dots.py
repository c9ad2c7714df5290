"""The accuracy figure and table of method_comparison.py: the error of every method's cut sheet beside the cost of the cut,
after a direct solve and after a fixed number of iterations of conjugate gradients."""

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from analysis import families, load, naming, shares
from analysis.accuracy.ranking import ranked_by
from analysis.load import of
from analysis.methods import kinds
from analysis.methods.errors import BUDGET, STEM, counts_of, summary
from figures.common import style
from figures.methods import dots

BESIDE = 0.33  # of a row, below the means
SHOWN = 8  # times the fitted mesh's error: what is larger is written at the edge
KINDS = {kind: dict(marker=marker, markersize=3, markeredgewidth=0.7, markerfacecolor="white")
         for kind, marker in zip(kinds.KINDS, ("s", "^", ">", "o", "v", "D", "<", "P", "p", "h", "X", "*", "d"), strict=False)}


def errors_of(row):
    """{kind: excess in percent} of a row of kinds.table_of()."""
    return {kind: row[f"error, {kind}"] for kind in kinds.KINDS
            if f"error, {kind}" in row and np.isfinite(row[f"error, {kind}"])}


def draw(folder, beside):
    """A row for each method, by families, the least errors on top: the error by kinds of problems and their mean, the error
    after a few iterations where there are any, and the price of the cut. None is drawn of problems of no kind. Returns the table
    of summary()."""
    records, table = summary(beside)
    measure = ranked_by(records)
    by_kind = kinds.table_of(records)
    if by_kind.empty:
        return table
    by_kind = by_kind.merge(table, on=load.VARIANT, how="left")
    stopped, price = f"excess_percent_cg_{BUDGET}", "us_per_crossed_all"
    some_stopped = by_kind[stopped].notna().any()
    order = list(by_kind[load.VARIANT].itertuples(index=False, name=None))
    counts = counts_of(records)
    figure, axes, variants = dots.table_of_dots(order, [2.2, 1, 1][:2 + some_stopped], records.programs, counts)
    of_base = of(by_kind, shares.BASE)
    base = errors_of(of_base.iloc[0]) if len(of_base) else {}
    left, right, numbers = axes[0], axes[-1], [{} for _ in axes]
    left.set_ylim(left.get_ylim()[0] + 0.35, left.get_ylim()[1])  # room for what is written at the edge
    for y, variant in variants:
        row, colour = of(by_kind, variant).iloc[0], families.family(variant[0]).colour
        filled = dots.HOLLOW if counts[variant].is_few else {}
        errors = errors_of(row)
        left.hlines(y, *(1 + kinds.interval(kinds.completed(errors, base)) / 100), color=colour, linewidth=2.6, alpha=0.45, zorder=2)
        for kind, value in errors.items():
            left.plot(1 + value / 100, y + BESIDE, color="#555555", zorder=5, **KINDS[kind])
        beyond = ", ".join(f"{kind} {value:+,.0f} %" for kind, value in errors.items() if 1 + value / 100 > SHOWN)
        if beyond:
            left.annotate(f"{beyond} →", (1, y + 2 * BESIDE), xycoords=left.get_yaxis_transform(), ha="right", va="center",
                          fontsize=7, color="#555555")
        left.plot(1 + row["error, kinds"] / 100, y, color=colour, **dots.MEDIAN | dict(markersize=5) | filled)
        numbers[0][y] = row["error, kinds"]
        if some_stopped:
            axes[1].plot(1 + row[stopped] / 100, y, color=colour, **dots.APART)
            numbers[1][y] = row[stopped]
        right.plot(row[price], y, color=colour, **dots.MEDIAN | filled)
        numbers[-1][y] = row[price]
    left.set_xlabel("error, solved directly, %")
    if some_stopped:
        axes[1].set_xlabel(f"after {BUDGET} iterations, %")
        axes[1].margins(x=0.12)
    for ax in axes[:-1]:
        percent_axis(ax)
    right.set_xlabel("µs per crossed tri.")
    right.set_xscale("log")
    dots.decades(right)
    for ax, places in zip(axes[:-1], numbers):
        dots.write_numbers(ax, places, "{:+,.0f}".format)
    dots.write_numbers(right, numbers[-1])
    grey = dict(linestyle="", color="#666666")
    entries = [Line2D([], [], linestyle="", color="#444444", label="mean", **dots.MEDIAN),
               Line2D([], [], color="#444444", linewidth=2.6, alpha=0.45, label="its 95 % interval")]
    entries += [Line2D([], [], label=kind, **grey, **KINDS[kind]) for kind in kinds.KINDS if f"error, {kind}" in by_kind]
    style.finish(figure, [], records.caption(
        f"Errors over those of a mesh that fits the cut, {measure.short.removeprefix('over a fitted mesh ')}: left of 0 is better. "
        "Mean over kinds of problems; the interval draws the kinds anew. Times: of these cuts, which are others than those of "
        "the table of all methods. "
        f"Error: of each problem's primary measure, over that of {measure.fitted}, minus one; geometric means over sheets, sizes "
        f"and members.{' ' * bool(measure.note)}{measure.note}{naming.PROGRAM_TIME * bool(records.programs)}"
        + f" After {BUDGET} iterations of conjugate gradients (Jacobi preconditioner): all {len(records.problems)} "
        "problems." * bool(some_stopped) + f" {shares.HOLLOW}"), entries)
    style.save(figure, folder, STEM)
    return table


def percent_axis(ax):
    """A logarithmic axis of ratios, labelled by what they are above or below one."""
    ax.set_xscale("log")
    low, high = ax.get_xlim()
    high = min(high, SHOWN)
    ax.set_xlim(low, high)
    ticks = [t for t in (0.25, 0.5, 1, 2, 4, 8, 16, 32) if low <= t <= high]
    ax.xaxis.set_major_locator(FixedLocator(ticks))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{100 * (x - 1):+,.0f}" if x != 1 else "0"))
    ax.axvline(1, color="#111111", linewidth=0.8, zorder=1)
