#!/usr/bin/env python3
"""What a step costs by solver: over the size of the sheet, and over the number of its cuts. Reads DIR/rows.csv, which
experiments/solvers writes; draws DIR/solver_table.png."""

import argparse
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming
from figures.common import style

DASHES = {"cg": "-", "multigrid": "-", "constant_factor": "-", "cholmod": "-", "eigen_cg": ":", "eigen_ldlt": ":"}


def read(folder):
    try:
        return pd.read_csv(folder / "rows.csv").replace({"solver": load.OLD_SOLVERS})
    except (OSError, ValueError) as error:
        load.stop(f"{folder / 'rows.csv'} can't be read: {error}; experiments/solvers makes it")


def draw_lines(axis, rows, x, colours):
    for solver, of_solver in rows.groupby("solver", sort=False):
        of_solver = of_solver.dropna(subset=["step_ms"]).sort_values(x)
        axis.plot(of_solver[x], of_solver["step_ms"], DASHES.get(solver, "--"), color=colours[solver], marker="o",
                  markersize=2, linewidth=1.6 if solver == "multigrid" else 0.9, label=solver)
    axis.set(xscale="log", yscale="log")


def draw(rows, path):
    solvers = list(dict.fromkeys(rows["solver"]))
    colours = dict(zip(solvers, plt.get_cmap("tab10").colors))
    size = rows[rows["sweep"] == "size"]
    # The uncut sheet is one for all methods; it stands where half a cut would.
    cuts = rows[(rows["sweep"] == "cuts") & (rows["method"] == "conventional_split") | (rows["sweep"] == "uncut")].copy()
    cuts["cuts"] = cuts["cuts"].astype(float).replace(0, 0.5)
    figure, axes = plt.subplots(1, 3, figsize=(style.PAGE, 2.9), sharey=True)
    for axis, method in zip(axes, ("warp_and_refine", "conventional_split")):
        draw_lines(axis, size[size["method"] == method], "resolution", colours)
        axis.set(xlabel="triangles", title=f"{naming.words(method)}, 4 cuts")
        axis.axhline(16.7, color="black", linewidth=0.7, linestyle="--")
    draw_lines(axes[2], cuts, "cuts", colours)
    axes[2].set_xticks([0.5, 1, 4, 20], ["none", "1", "4", "20"])
    axes[2].minorticks_off()
    axes[2].axhline(16.7, color="black", linewidth=0.7, linestyle="--")
    axes[2].set(xlabel="cuts", title="conventional split, 3,200 triangles")
    axes[0].set_ylabel("ms a step, median")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="lower center", ncols=5)
    figure.suptitle("A step of 1/240 s by solver; iterative ones stop at a residual of 1e-2. Dashed: 16.7 ms.", fontsize=7)
    figure.tight_layout(rect=(0, 0.13, 1, 1))
    style.write_png(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, metavar="DIR")
    options = parser.parse_args()
    draw(read(options.folder), options.folder / "solver_table.png")


main()
