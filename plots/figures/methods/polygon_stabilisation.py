#!/usr/bin/env python3
"""The error of cut_polygons over its stabilisation, by measure: the excess over a fitted mesh of as many triangles, solved directly,
with 95 % intervals that draw the kinds of problems anew. The marks are squares with the hourglass energy of other elements
(harness/fem/elements/compound_sheet.h)."""

import sys
from pathlib import Path

import numpy as np
from matplotlib.lines import Line2D

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming, pareto
from analysis.methods import kinds
from figures.common import style

STEM = "polygon_stabilisation"
SWEPT, SPLIT = "cut_polygons:stabilisation", "conventional_split"
MEASURES = {"error": "primary of each problem", "energy_norm": "energy norm", "displacement_l2": "displacement", "opening": "opening",
            "k1": "K1", "rim_stress": "rim stress, a hole"}
SQUARES = {0.333333: "exact in bending", 0.4945: "bilinear", 1.29: "tr(C) / 2", 1.48: "two triangles"}  # at nu = 0.3


def excess(table, measure):
    """In percent with the ends of its interval; geometric mean, kinds of problems weigh alike."""
    column = "excess_error" if measure == "error" else f"excess_{measure}"
    logs = np.log1p(table[column]).replace([np.inf, -np.inf], np.nan).dropna()
    return np.array(kinds.weighed_alike(logs, table.loc[logs.index, "problem"]))


def in_words(numbers):
    middle, low, high = np.round(numbers) + 0.0
    return f"{middle:+.0f} [{low:+.0f}, {high:+.0f}]"


def figure_of(run, table, taus):
    figure, axes = style.panels(1, 1, 7)
    ax = axes[0, 0]
    for number, (measure, words) in enumerate(MEASURES.items()):
        if measure == "rim_stress":  # far above all others
            continue
        swept = np.array([excess(table[table["tau"] == tau], measure) for tau in taus])
        line, = ax.plot(taus, swept[:, 0], marker="osD^v"[number], markersize=3, linewidth=1, label=words)
        ax.fill_between(taus, swept[:, 1], swept[:, 2], color=line.get_color(), alpha=0.12, linewidth=0)
        ax.axhline(excess(table[table["method"] == SPLIT], measure)[0], color=line.get_color(), linestyle=":", linewidth=0.8)
    ax.set_xscale("log")
    ax.set_xticks(taus, ["" if tau in SQUARES else f"{tau:g}" for tau in taus])
    ax.minorticks_off()
    for tau, words in SQUARES.items():
        ax.axvline(tau, color="#999999", linewidth=0.6)
        ax.annotate(words, (tau, 1), xycoords=("data", "axes fraction"), rotation=90, va="top", ha="right", fontsize=5.5, color="#555555")
    ax.set_xlabel("tau: stabilisation over Young's modulus")
    ax.set_ylabel("excess error, %")
    lines = [*ax.get_lines()[0:2 * len(MEASURES) - 2:2], Line2D([], [], color="#444444", linestyle=":", label=SPLIT)]
    style.finish(figure, [], "Excess error of cut_polygons over a fitted mesh of as many triangles; bands: 95 %, kinds of problems drawn anew. Upright: "
                 f"a square is then as stiff in its hourglass mode as what is named. {naming.provenance(run, table)}", lines)
    return figure


def main():
    folder = load.results_folder(STEM, __doc__)
    everything = load.read_records(folder / "records.csv", [*load.TEXT, "problem", *load.COUNTS, "excess_error"], all_columns=True)
    failed = pareto.failed_rows(everything)
    table = everything[~failed]
    table = table.assign(tau=table["parameter"].str.extract(r"^tau=(.*)$")[0].astype(float))
    run = load.Run(table, everything[failed], load.read_context(folder / "context.json"))
    taus = sorted(table["tau"].dropna().unique())
    style.save(figure_of(run, table, taus), folder, STEM)
    rows = [[f"tau = {tau:.3g}", *(in_words(excess(table[table["tau"] == tau], m)) for m in MEASURES)] for tau in taus]
    rows += [[method, *(in_words(excess(table[table["method"] == method], m)) for m in MEASURES)]
             for method in dict.fromkeys(table["method"]) if method != SWEPT and not method.startswith("body_fitted")]
    load.print_table(f"Excess error in percent over a fitted mesh of as many triangles [95 %]. {naming.provenance(run, table)}",
                     ["", *MEASURES.values()], rows)


if __name__ == "__main__":
    main()
