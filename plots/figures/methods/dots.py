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
HOLLOW = dict(markerfacecolor="white")  # the median of a method that made under half of its cuts


FEW = families.Family("under half of the cuts made", "#777777", "P")


def rows_of(order, counts):
    """[(y, variant)] and [(y, family)] of the headings, from above, by families, those that made few of their cuts last; and
    the number of rows."""
    few = [v for v in order if is_few(counts, v)]
    most = [v for v in order if v not in few]
    groups = [(family, [v for m in methods for v in most if v[0] == m])
              for family, methods in families.grouped(dict.fromkeys(method for method, _ in most))]
    variants, headings, y = [], [], 0
    for family, members in groups + [(FEW, few)] * bool(few):
        headings.append((y, family))
        for variant in members:
            y += 1
            variants.append((y, variant))
        y += 1.25
    return variants, headings, y - 0.25


def is_few(counts, variant):
    return variant in counts and counts[variant].is_few


def share_of(counts, variant):
    return counts[variant].beside() if variant in counts else ""


def table_of_dots(order, widths, programs, counts):
    """A figure with a panel for each of `widths`, relative to each other, and the names at the left with their shares. Returns
    the figure, its axes and the variants with their places, rows_of(). \param counts  {variant: shares.Share}"""
    variants, headings, height = rows_of(order, counts)
    figure, axes = style.panels(1, len(widths), ROW * height + 1.3, width=style.PAGE, sharey=True, width_ratios=widths)
    several = pd.Series([method for method, _ in order]).value_counts()
    left = axes[0, 0]
    left.set_yticks([y for y, _ in variants], [
        families.name(m, programs) + (f", {parameter}" if several[m] > 1 else "") + share_of(counts, (m, parameter))
        for _, (m, parameter) in variants])
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


def beside_split(table, measures):
    """The sentence for captions where figure_of() draws cuts beside those of conventional_split."""
    if not any(m.beside in table for m in measures):
        return ""
    return ("Where an axis says split's: each cut beside the same cut by conventional_split, of the cuts that both made, ratios or "
            "differences. ")


def drawn(table, m):
    """The column, the label, the limits of the axis, and how numbers are written: cut by cut beside conventional_split where
    that is in the table."""
    if m.beside not in table:
        return m.column, m.label, m.limits, m.written
    if m.linear:
        return m.beside, f"{m.short} − split's", (), "{:+.2g}".format
    return m.beside, f"{m.short} / split's", (), m.written


def figure_of(table, order, measures, widths, programs, counts):
    """A dot at the median over the even sheets, bars from quartile to quartile and from 5 to 95 %, a tick at the worst; a
    hollow diamond at the median over the graded sheets. The dot is hollow where under half of the cuts were made."""
    figure, axes, variants = table_of_dots(order, widths, programs, counts)
    for ax, m in zip(axes, measures):
        column, label, limits, written = drawn(table, m)
        numbers = {}
        for y, variant in variants:
            colour = families.family(variant[0]).colour
            here = of(table, variant)
            apart = here["sheet"] == UNEVEN
            values = here.loc[~apart, column] if (~apart).any() else here[column]
            quantiles, worst = spread(values, m.worst)
            if not np.isfinite(quantiles[2]):
                continue
            numbers[y] = quantiles[2]
            ends = np.clip(quantiles, -1e30, 1e30)
            ax.hlines(y, ends[0], ends[4], color=colour, linewidth=0.7, zorder=2)
            ax.hlines(y, ends[1], ends[3], color=colour, linewidth=2.6, alpha=0.45, zorder=2)
            ax.plot(worst, y, "x" if here["failed"].any() else "|", color=colour, markersize=4, markeredgewidth=0.8)
            if apart.any() and (~apart).any():
                ax.plot(spread(here.loc[apart, column], m.worst)[0][2], y, color=colour, **APART)
            ax.plot(quantiles[2], y, color=colour, **MEDIAN | (HOLLOW if is_few(counts, variant) else {}))
        ax.set_xlabel(label)
        if limits:
            ax.set_xlim(limits)
        if not m.linear:
            ax.set_xscale("log")
            decades(ax)
        write_numbers(ax, numbers, written)
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
