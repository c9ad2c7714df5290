"""Fronts, costs and ranks in numbers."""

import contextlib
import io

import numpy as np
import pandas as pd

from analysis import load
from analysis.whole_step import points
from analysis.whole_step.points import SETTING
from analysis.whole_step.runs import SAME, SOLVERS, setting_name, setting_of, spoken


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


def tables(rows, charted, cost, fronts, folder):
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
        print_ranks(folder)
    return text.getvalue()


def print_ranks(folder):
    """Whether one error ranks the methods as another does: Spearman's rank correlation, by the sizes that all have."""
    errors = {m.title: points.errors(key, folder).set_index(["resolution", "method"])["error"] for key, m in points.MEASURES.items()}
    table = pd.DataFrame(errors).dropna()
    for size in sorted(set(table.index.get_level_values("resolution"))):
        ranks = table.loc[size].corr(method="spearman")
        load.print_table(f"Rank correlation of the errors of {len(table.loc[size])} methods, the fitted mesh among them, at {size} triangles",
                         ["error", *ranks.columns], [[name, *row] for name, row in zip(ranks.index, ranks.to_numpy())])
