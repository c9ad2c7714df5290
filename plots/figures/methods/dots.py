"""A table of dots: a row for each method, by families, a panel for each measure, and beside each panel the medians in numbers."""

import numpy as np
import pandas as pd
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, LogFormatterMathtext, NullLocator

from analysis import families
from analysis.load import of
from analysis.methods.distribution import spread, two_digits
from figures.common import style

ROW = 0.335  # cm
UNEVEN = "graded"  # its sheets stand apart: most cuts don't meet their fine corner
MEDIAN, APART = dict(marker="o", markersize=4, zorder=4), dict(marker="D", markersize=3.2, zorder=3, markerfacecolor="white")


def rows_of(order):
    """[(y, variant)] and [(y, family)] of the headings, from above, by families; and the number of rows."""
    variants, headings, y = [], [], 0
    for family, methods in families.grouped(dict.fromkeys(method for method, _ in order)):
        headings.append((y, family))
        for variant in (v for m in methods for v in order if v[0] == m):
            y += 1
            variants.append((y, variant))
        y += 1.25
    return variants, headings, y - 0.25


def table_of_dots(order, widths, programs=()):
    """A figure with a panel for each of `widths`, relative to each other, and the names at the left. Returns the figure, its
    axes and the variants with their places, rows_of()."""
    variants, headings, height = rows_of(order)
    figure, axes = style.panels(1, len(widths), ROW * height + 1.3, width=style.PAGE, sharey=True, width_ratios=widths)
    several = pd.Series([method for method, _ in order]).value_counts()
    left = axes[0, 0]
    left.set_yticks([y for y, _ in variants], [
        families.name(m, programs) + (f", {parameter}" if several[m] > 1 else "") for _, (m, parameter) in variants])
    left.set_ylim(height - 0.3, -0.6)
    for y, family in headings:
        left.annotate(family.name, (0, y), xycoords=left.get_yaxis_transform(), xytext=(-4, 0), ha="right", va="center",
                      textcoords="offset points", fontsize=7, fontweight="bold", color=family.colour)
    for ax in axes[0]:
        ax.grid(axis="y", visible=False)
        ax.tick_params(axis="y", length=0)
        for y, _ in variants:
            ax.axhline(y, color="#ececec", linewidth=0.6, zorder=0)
    return figure, axes[0], variants


def decades(ax):
    """Ticks of a logarithmic axis: plain numbers, powers where they are many."""
    low, high = np.log10(ax.get_xlim())
    step = max(1, int(np.ceil((high - low) / 5)))
    ticks = 10.0 ** (step * np.arange(np.ceil(low / step), np.floor(high / step) + 1))
    ax.xaxis.set_major_locator(FixedLocator(ticks))
    ax.xaxis.set_minor_locator(NullLocator())
    plain = FuncFormatter(lambda x, _: f"{x:g}")
    ax.xaxis.set_major_formatter(plain if len(ticks) and ticks[0] >= 1e-3 and ticks[-1] <= 1e3 else LogFormatterMathtext())


def write_numbers(ax, places, written=two_digits):
    """Beside the panel, {y: number}. \\param written  makes the text of a number"""
    for y, value in places.items():
        if np.isfinite(value):
            ax.annotate(written(value), (1, y), xycoords=ax.get_yaxis_transform(), xytext=(24, 0), textcoords="offset points",
                        ha="right", va="center", fontsize=7, annotation_clip=False)


def figure_of(table, order, measures, widths, programs):
    """A dot at the median over the even sheets, bars from quartile to quartile and from 5 to 95 %, a tick at the worst; a
    hollow diamond at the median over the graded sheets."""
    figure, axes, variants = table_of_dots(order, widths, programs)
    for ax, m in zip(axes, measures):
        numbers = {}
        for y, variant in variants:
            colour = families.family(variant[0]).colour
            here = of(table, variant)
            apart = here["sheet"] == UNEVEN
            values = here.loc[~apart, m.column] if (~apart).any() else here[m.column]
            quantiles, worst = spread(values, m.worst)
            if not np.isfinite(quantiles[2]):
                continue
            numbers[y] = quantiles[2]
            ends = np.clip(quantiles, -1e30, 1e30)
            ax.hlines(y, ends[0], ends[4], color=colour, linewidth=0.7, zorder=2)
            ax.hlines(y, ends[1], ends[3], color=colour, linewidth=2.6, alpha=0.45, zorder=2)
            ax.plot(worst, y, "x" if np.isinf(values).any() else "|", color=colour, markersize=4, markeredgewidth=0.8)
            if apart.any() and (~apart).any():
                ax.plot(spread(here.loc[apart, m.column], m.worst)[0][2], y, color=colour, **APART)
            ax.plot(quantiles[2], y, color=colour, **MEDIAN)
        ax.set_xlabel(m.label)
        if m.limits:
            ax.set_xlim(m.limits)
        if not m.linear:
            ax.set_xscale("log")
            decades(ax)
        write_numbers(ax, numbers, m.written)
    return figure


def legend(table):
    grey = "#444444"
    entries = [Line2D([], [], linestyle="", color=grey, label="median (in numbers at the right)", **MEDIAN),
               Line2D([], [], color=grey, linewidth=2.6, alpha=0.45, label="quartiles"),
               Line2D([], [], color=grey, linewidth=0.7, label="5 to 95 %"),
               Line2D([], [], linestyle="", marker="|", color=grey, markersize=5, label="worst")]
    if table["failed"].any():
        entries.append(Line2D([], [], linestyle="", marker="x", color=grey, markersize=4, label="worst that did not fail"))
    if (table["sheet"] == UNEVEN).any() and (table["sheet"] != UNEVEN).any():
        entries.append(Line2D([], [], linestyle="", color=grey, label="median, graded sheet", **APART))
    return entries
