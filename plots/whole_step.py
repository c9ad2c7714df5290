#!/usr/bin/env python3
"""Speed against accuracy: the time of a cut and of the 0.25 s of motion after it, by every method (results/whole_step), against
published errors of the cut sheets: in plane at rest (method_comparison_accuracy), out of plane, and in motion. A Pareto chart per
setting and error, each method by its fastest solver and all by the same one; readme_chart.png, one setting; and whole_step.txt,
the fronts in numbers."""

import contextlib
import io

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

from common import front, load, names, style
from common.families import FAMILIES, family
from whole_step_parts import draws, points
from whole_step_parts.points import SETTING

STEM = "whole_step"
SAME = "multigrid"
REAL_TIME_MS = 1000 * points.BETWEEN_S
SOLVERS = {"cg_sliver_blocks": "CG", "multigrid": "MG", "cholmod": "direct"}
FAR = 4  # times the median error: such a method is not drawn, unless it is on the front
PALE = 0.3
SUMMARY = (4, 1 / 240, 1000)  # the setting of readme_chart.png
CHART = "whole_step_chart"  # the run of this setting on more cuts


def setting_name(setting):
    cuts, step, stiffness = setting
    return f"{cuts:g} cut{'' if cuts == 1 else 's'}, step 1/{1 / step:.0f} s, E t {stiffness:g} N/m"


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
    return p["method"].replace("_", " ") + (f" ({SOLVERS.get(p['solver'], p['solver'])})" if with_solver and p["solver"] != SAME else "")


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
    strengths = {"behind the front": 0} if "share" not in table else {"on the front in all draws": 1, "in half of them": 0.5, "in none": 0}
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


def pages(table, column, context, by_solver):
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
    errors_commit = str(load.read_context(points.MEASURES[column].files()[1]).get("commit"))
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
    figure.subplots_adjust(left=0.07, right=0.995, top=0.9, bottom=0.17)
    drawn = draw(ax, table, 1.9)
    ax.set_xlim(drawn["ms"].min() / 1.5, drawn["ms"].max() * 1.8)
    ax.set_xlabel("ms for a cut and the 0.25 s of motion after it", fontsize=9.5)
    ax.set_ylabel(f"error of the cut sheet's solution, {points.MEASURES[points.LEADS].title}", fontsize=9.5)
    ax.tick_params(labelsize=9)
    write_names(ax, drawn[(drawn["layer"] == 1) | (drawn["resolution"] == drawn["resolution"].max())], drawn, 8, False)
    handles = entries(drawn, 1.6)
    figure.legend(handles=handles, loc="upper left", ncol=-(-len(handles) // 2), fontsize=9, borderaxespad=0.2, handletextpad=0.3,
                  columnspacing=1.2)
    figure.text(0.02, 0.012, f"Lower left is better. {setting_name(setting_of(table)).replace('E t', 'stiffness')}; medians of {spoken(table['n'])} such sheets. "
                f"{sizes_of(table)}, by size of marker. "
                f"Commit {str(context.get('commit'))[:7]}.\nEach method by its fastest solver. A draw: other cuts and kinds of problems. Bars: quartiles of the time; "
                f"95 % of the error. Named: the front and the largest sheets.\n{absent(drawn, methods)}", fontsize=7.5, color="#555555")
    return figure


def absent(drawn, methods):
    """Which methods are in no panel, in words."""
    lost = [m.replace("_", " ") for m in methods if m not in set(drawn["method"])]
    return f"Not shown (refuses the scene, ended early, no published error, or an error over {FAR} times the median): {', '.join(lost)}." if lost else ""


def at(table, setting):
    return table[np.isclose(table[SETTING].to_numpy(float), setting).all(axis=1)]


def setting_of(table):
    """Of a table of one setting."""
    return tuple(table[SETTING].iloc[0])


def spoken(counts):
    return " to ".join(dict.fromkeys(map(str, (counts.min(), counts.max()))))


def summarised(table):
    """SUMMARY, or the first setting of records that lack it."""
    return SUMMARY if len(at(table, SUMMARY)) else tuple(table[SETTING].iloc[0])


def print_fronts(table, title):
    rows = []
    for setting, here in table.groupby(SETTING):
        for _, p in here[here["layer"] == 1].sort_values("ms").iterrows():
            rows.append([setting_name(setting), p["method"], str(p["resolution"]), p["solver"], p["ms"], p["ms_low"], p["ms_high"],
                         p["cut_ms"], 100 * p["error"], 100 * p["error_low"], 100 * p["error_high"], f"{p['failed']}/{p['n']}",
                         f"{100 * p['grew']:.0f}"])
    load.print_table(title, ["setting", "method", "triangles", "solver", "ms", "q1", "q3", "cut, ms", "error %", "from", "to",
                             "ended early", "energy grew %"], rows)


def print_costs(cost):
    """All methods, also at sizes whose error is not known."""
    rows = []
    for (setting, method), here in best_groups(cost):
        cells = {p["resolution"]: p for _, p in here.iterrows()}
        rows.append([setting_name(setting), method, *(
            f"{load.number(cells[n]['ms'])} {SOLVERS.get(cells[n]['solver'], cells[n]['solver'])}" if n in cells else "-"
            for n in sorted(set(cost["resolution"])))])
    load.print_table("ms for a cut and the 0.25 s after it, by the fastest solver (inf: half of the motions ended early or were refused)",
                     ["setting", "method", *(str(n) for n in sorted(set(cost["resolution"])))], rows)


def best_groups(cost):
    best = points.best_of(cost)
    return [((key[:3], key[3]), here) for key, here in best.groupby([*SETTING, "method"])]


def print_counts(fronts):
    """In how many settings a method is on the front, by each error."""
    counts = pd.DataFrame({points.MEASURES[column].title: table[table["layer"] == 1].drop_duplicates([*SETTING, "method"])["method"].value_counts()
                           .reindex(table["method"].unique(), fill_value=0)
                           for (column, way), table in fronts.items() if way == "best"})
    counts = counts.sort_values(list(counts.columns), ascending=False)
    settings = len(next(iter(fronts.values()))[SETTING].drop_duplicates())
    load.print_table(f"On the front in how many of the {settings} settings, each by its fastest solver, by the error",
                     ["method", *counts.columns], [[method, *("-" if np.isnan(n) else f"{n:.0f}" for n in row)]
                                                   for method, row in zip(counts.index, counts.to_numpy())])


def print_chart(table):
    """readme_chart.png in numbers."""
    rows = [[str(p["resolution"]), p["method"], p["solver"], p["ms"], p["ms_low"], p["ms_high"], 100 * p["error"], 100 * p["error_low"],
             100 * p["error_high"], f"{100 * p['share']:.0f}"] for _, p in table.sort_values(["resolution", "ms"]).iterrows()]
    load.print_table(f"{setting_name(setting_of(table))}, medians of {spoken(table['n'])} sheets with their cuts: time against error "
                     f"({points.MEASURES[points.LEADS].title}), each by its fastest solver; on the front in how many % of 1000 draws of "
                     "cuts and kinds of problems",
                     ["triangles", "method", "solver", "ms", "q1", "q3", "error %", "from", "to", "on the front"], rows)


def print_iterations(rows):
    """How hard the meshes are for SAME; a cut that is refused makes none."""
    rows = rows[(rows["solver"] == SAME) & (rows["verdict"] != "refused")]
    cuts, sizes = sorted(set(rows["place"])), sorted(set(rows["resolution"]))
    median = rows.groupby(["method", "place", "resolution"])["iterations"].agg(load.median)
    load.print_table(f"Iterations of a step by {SAME}, medians over sheets, cases, steps and stiffnesses, by cuts / triangles",
                     ["method", *(f"{c:g} / {n}" for c in cuts for n in sizes)],
                     [[m, *(median.get((m, c, n), np.nan) for c in cuts for n in sizes)] for m in sorted(set(rows["method"]))])


def tables(rows, charted, cost, fronts):
    text = io.StringIO()
    with contextlib.redirect_stdout(text):
        print_counts(fronts)
        print_chart(charted)
        print_iterations(rows)
        for (column, kind), table in fronts.items():
            solver = "each by its fastest solver" if kind == "best" else f"all by {SAME}"
            print_fronts(table, f"Fronts: time against error ({points.MEASURES[column].title}; {table['kinds'].max()} "
                                f"{points.MEASURES[column].of}), {solver}")
        print_costs(cost)
        print_ranks()
    return text.getvalue()


def print_ranks():
    """Whether one error ranks the methods as another does: Spearman's rank correlation, by the sizes that all have."""
    errors = {m.title: points.errors(key).set_index(["resolution", "method"])["error"] for key, m in points.MEASURES.items()}
    table = pd.DataFrame(errors).dropna()
    for size in sorted(set(table.index.get_level_values("resolution"))):
        ranks = table.loc[size].corr(method="spearman")
        load.print_table(f"Rank correlation of the errors of {len(table.loc[size])} methods, the fitted mesh among them, at {size} triangles",
                         ["error", *ranks.columns], [[name, *row] for name, row in zip(ranks.index, ranks.to_numpy())])


def read(folder, stem=STEM):
    """The rows and the context of a run, or those that are published in the folder."""
    published = not (folder / "records.csv").is_file() and (folder / f"{stem}.records.csv.gz").is_file()
    rows = load.read_records(folder / (f"{stem}.records.csv.gz" if published else "records.csv"),
                             [*SETTING, *points.TIMES, "solver"], all_columns=True)
    return rows, load.read_context(folder / (f"{stem}.context.json" if published else "context.json"))


def ways(cost):
    """How the solver of each method is chosen."""
    return {"best": points.best_of(cost), "same": cost[cost["solver"] == SAME]}


def read_chart(folder):
    """The rows of one setting and the context of the run of its own, which has more cuts of it, where that is there."""
    own = folder.resolve().with_name(CHART)
    if (folder / f"{CHART}.records.csv.gz").is_file():
        rows, context = read(folder, CHART)
    else:
        rows, context = read(own if (own / "records.csv").is_file() else folder)
    return at(rows, summarised(rows)), context


def chart(here):
    """Of read_chart() the points of readme_chart.png, with the share of draws in which each is on the front."""
    table = points.joined(points.best_of(points.costs(here)), points.errors(points.LEADS))
    share = draws.shares(points.motions(here), points.LEADS).rename("share").reset_index()
    return table.merge(share, how="left", on=["method", "resolution"])


def readme_chart(folder):
    """The figure, and its points."""
    here, context = read_chart(folder)
    table = chart(here)
    return summary(table, here["method"].unique(), context), table


def main():
    folder = load.results_folder(STEM, __doc__)
    rows, context = read(folder)
    cost = points.costs(rows)
    fronts = {(column, way): points.joined(some, points.errors(column))
              for column in points.MEASURES for way, some in ways(cost).items()}
    for (column, way), table in fronts.items():
        style.save(pages(table, column, context, way == "best"), folder,
                   STEM + "_same_solver" * (way == "same") + f"_{column}" * (column != points.LEADS))
    figure, charted = readme_chart(folder)
    figure.savefig(folder / "readme_chart.png", dpi=150)
    plt.close(figure)
    load.write_beside(folder / f"{STEM}.txt", tables(rows, charted, cost, fronts))


if __name__ == "__main__":
    main()
