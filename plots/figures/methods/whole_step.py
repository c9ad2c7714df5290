#!/usr/bin/env python3
"""Speed against accuracy: the time of a cut and of the 0.25 s of motion after it, by every method (results/whole_step), against
published errors of the cut sheets: at rest (method_comparison_accuracy), out of plane, and in motion. A Pareto chart per
setting and error, each method by its fastest solver and all by the same one; readme_chart.png, one setting; and whole_step.txt,
the fronts in numbers."""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming
from analysis.families import FAMILIES, family
from analysis.whole_step import points
from analysis.whole_step.points import SETTING
from analysis.whole_step.runs import (
    SAME, SOLVERS, STEM, at, chart, read, read_chart, setting_name, setting_of, spoken, ways)
from analysis.whole_step.tables import tables
from figures.common import front, names, style

REAL_TIME_MS = 1000 * points.BETWEEN_S
FAR = 4  # times the median error: such a method is not drawn, unless it is on the front
PALE = 0.3


def near(table):
    """The rows of a setting that are drawn: the motions ended, and the error is not FAR off, or on the front."""
    shown = (table["error"] < FAR * table["error"].median()) | (table["layer"] == 1)
    return table[np.isfinite(table["ms"]) & shown]


def draw(ax, table, scale=1.0):
    """The methods of a setting, the larger the sheet the larger the marker; the paler, the smaller their `share`: on the front or,
    where the table has it, how often. Returns the rows that are drawn."""
    sizes = sorted(set(table["resolution"]))
    table = made = near(table)
    share = table["share"] if "share" in table else (table["layer"] == 1).astype(float)
    for method, here in table.groupby("method", sort=False):
        here = here.sort_values("resolution")
        colour, marker = family(method).colour, family(method).marker
        for i, p in here.iterrows():
            strength = PALE + (1 - PALE) * share[i]
            bars = dict(color=colour, linewidth=0.6 * scale, alpha=0.55 if p["layer"] == 1 else 0.15, zorder=1.5)
            ax.hlines(p["error"], p["ms_low"], p["ms_high"] if np.isfinite(p["ms_high"]) else p["ms"], **bars)
            ax.vlines(p["ms"], p["error_low"], p["error_high"], **bars)
            ax.plot(p["ms"], p["error"], marker, color=colour if p["grew"] <= 0.5 else "white", markeredgecolor=colour,
                    markersize=scale * (2.6 + 1.6 * sizes.index(p["resolution"])), alpha=strength,
                    markeredgewidth=0.7 * scale, zorder=2 + share[i])
    best = table[table["layer"] == 1].sort_values("ms")
    ax.plot(best["ms"], best["error"], **front.FRONT_LINE)
    ax.set(xscale="log", yscale="log")
    ax.set_xlim(made["ms"].min() / 1.7, made["ms"].max() * 2.2)
    ax.set_ylim(made["error"].min() / 1.25, made["error"].max() * 1.25)
    ax.axvline(REAL_TIME_MS, color="#999999", linewidth=0.7, linestyle="--", zorder=0)
    span = made["ms"].max() / made["ms"].min()
    ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5) if span < 15 else (1, 3) if span < 100 * scale**2 else (1,)))
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
    ax.yaxis.set_major_locator(plt.FixedLocator([0.0002, 0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1]))
    ax.yaxis.set_minor_locator(plt.NullLocator())
    ax.yaxis.set_major_formatter(lambda y, _: f"{100 * y:g} %")
    return made


def name_of(p, with_solver):
    """`with_solver`: also the solver, unless it is SAME."""
    return naming.words(p["method"]) + (f" ({SOLVERS.get(p['solver'], p['solver'])})" if with_solver and p["solver"] != SAME else "")


def along(best):
    """Points along the line of a front."""
    ends = np.log(best.sort_values("ms")[["ms", "error"]].to_numpy())
    return np.exp(np.concatenate([np.linspace(a, b, 12) for a, b in zip(ends, ends[1:])])) if len(ends) > 1 else np.exp(ends)


def write_names(ax, named, everything, size, with_solver):
    """Each name near its marker, and on neither markers nor the front; the best first. Without solvers all methods are named: a crowd."""
    covered = np.concatenate([everything[["ms", "error"]].to_numpy(), along(everything[everything["layer"] == 1])])
    names.place(ax, [(p["ms"], p["error"], name_of(p, with_solver), family(p["method"]).colour)
                     for _, p in named.sort_values("error").iterrows()], covered, size, clear_lines=with_solver)


def entries(table, scale=1.0):
    there = set(table["method"])
    handles = [Line2D([], [], linestyle="", marker=f.marker, color=f.colour, markersize=4 * scale, label=f.name)
               for f in FAMILIES if there & set(f.methods)]
    grey = dict(linestyle="", marker="o", markeredgecolor="#444444", markersize=4 * scale)
    strengths = {"behind the front": 0} if "share" not in table else {"on the front in all draws": 1, "on it in half of the draws": 0.5, "in none": 0}
    handles += [Line2D([], [], color="#444444", alpha=PALE + (1 - PALE) * share, label=words, **grey)
                for words, share in strengths.items()]
    if (table["grew"] > 0.5).any():
        handles += [Line2D([], [], color="white", label="energy grew in over half of the motions", **grey)]
    return handles + [Line2D([], [], label="front", **front.FRONT_LINE),
                      Line2D([], [], color="#999999", linewidth=0.7, linestyle="--", label="real time")]


def sizes_of(table):
    *smaller, largest = (f"{n:,}" for n in sorted(set(table["resolution"])))
    return f"{', '.join(smaller)}{' and ' * bool(smaller)}{largest} triangles"


def source(context):
    return f"commit {str(context.get('commit'))[:10]}, seed {context.get('seed')}"


def pages(table, column, context, by_solver, errors_commit):
    settings = sorted(set(table[SETTING].itertuples(index=False, name=None)), key=lambda s: (s[2], -s[1], s[0]))
    columns = min(3, len(settings))
    rows = -(-len(settings) // columns)
    figure, axes = style.panels(rows, columns, 6.6, width=style.PAGE)
    for ax in axes.flat[len(settings):]:
        ax.set_visible(False)
    drawn = []
    for i, (ax, setting) in enumerate(zip(axes.flat, settings)):
        here = at(table, setting)
        drawn.append((ax, draw(ax, here)))
        ax.set_title(setting_name(setting), fontsize=6.5, loc="left")
        ax.set_xlabel("ms for a cut and the 0.25 s after it" if i + columns >= len(settings) else "")
        ax.set_ylabel("" if i % columns else f"error, {points.MEASURES[column].title}")
    solver = f"All by {SAME}."
    if by_solver:
        solver = (f"Each by its fastest solver: {SAME}, unless CG (conjugate gradients with sliver blocks) or direct (CHOLMOD) stands "
                  "beside the name.")
    style.finish(figure, [], (
        f"Lower left is better; the larger the marker, the larger the sheet. {solver} {sizes_of(table)}. Hollow markers and errors of "
        f"{100 * points.NO_ANSWER:.0f} % and more are on no front. E t: stiffness of the sheet. "
        "Time: median over sheets and cuts, bars quartiles. Error: |relative error|, geometric mean "
        f"over {points.MEASURES[column].of}; bars: 95 %, how the ratio to a fitted mesh changes as these are drawn anew. Not drawn: errors "
        f"of over {FAR} times the median behind the front. {source(context).capitalize()}; errors: commit {errors_commit[:10]}."),
        entries(pd.concat([made for _, made in drawn])))
    for ax, made in drawn:
        best = made[made["layer"] == 1].sort_values("error").drop_duplicates("method")  # each method once: its least error
        write_names(ax, best, made, 5.8, by_solver)
    return figure


def summary(table, methods, context):
    """readme_chart.png: one setting, each method by its fastest solver. \\param table  with the share of draws on the front"""
    figure, ax = plt.subplots(figsize=(9, 6))
    figure.subplots_adjust(left=0.07, right=0.995, top=0.87, bottom=0.17)
    drawn = draw(ax, table, 1.9)
    ax.set_xlim(drawn["ms"].min() / 1.5, drawn["ms"].max() * 1.8)
    ax.yaxis.set_major_locator(plt.FixedLocator([0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.5]))
    ax.set_xlabel("ms for a cut and the 0.25 s of motion after it", fontsize=9.5)
    ax.set_ylabel(f"error of the cut sheet's solution, {points.MEASURES[points.LEADS].title}", fontsize=9.5)
    ax.tick_params(labelsize=9)
    write_names(ax, drawn[(drawn["layer"] == 1) | (drawn["resolution"] == drawn["resolution"].max())], drawn, 8, False)
    handles = entries(drawn, 1.6)
    figure.legend(handles=handles, loc="upper left", ncol=-(-len(handles) // 3), fontsize=9, borderaxespad=0.2, handletextpad=0.3,
                  columnspacing=1.2)
    figure.text(0.02, 0.012, f"Lower left is better. {setting_name(setting_of(table)).replace('E t', 'stiffness')}; medians of {spoken(table['n'])} such sheets. "
                f"{sizes_of(table)}, by size of marker. "
                f"Commit {str(context.get('commit'))[:7]}.\nEach method by its fastest solver. A draw: other cuts and kinds of problems. Bars: quartiles of the time; "
                f"95 % of the error. Named: the front and the largest sheets.\n{absent(drawn, methods)}", fontsize=7.5, color="#555555")
    return figure


def absent(drawn, methods):
    """Which methods are in no panel, in words."""
    lost = [naming.words(m) for m in methods if m not in set(drawn["method"])]
    return f"Not shown (refuses the scene, ended early, no published error, or an error over {FAR} times the median): {', '.join(lost)}." if lost else ""


def readme_chart(folder):
    """The figure, and its points."""
    here, context = read_chart(folder)
    table = chart(here, folder)
    return summary(table, here["method"].unique(), context), table


def main():
    folder = load.results_folder(STEM, __doc__)
    rows, context = read(folder)
    cost = points.costs(rows)
    fronts = {(column, way): points.joined(some, points.errors(column, folder))
              for column in points.MEASURES for way, some in ways(cost).items()}
    for (column, way), table in fronts.items():
        of_errors = load.read_context(points.MEASURES[column].files(folder)[1])
        style.save(pages(table, column, context, way == "best", str(of_errors.get("commit"))), folder,
                   STEM + "_same_solver" * (way == "same") + f"_{column}" * (column != points.LEADS))
    figure, charted = readme_chart(folder)
    style.write_png(figure, folder / "readme_chart.png")
    load.write_beside(folder / f"{STEM}.txt", tables(rows, charted, cost, fronts, folder))


if __name__ == "__main__":
    main()
