#!/usr/bin/env python3
"""All methods out of plane (results/out_of_plane): the error of each problem on the finest sheets, beside that of the mesh fitted
to the cut; and a table of all sizes with the excess over that mesh."""

import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming, pareto, shares
from analysis.accuracy.out_of_plane import PROBLEMS, REFERENCE, rows_of, wide
from analysis.load import of
from analysis.methods import distribution
from figures.common import style
from figures.methods import dots

STEM = "out_of_plane"


def main():
    folder = load.results_folder(STEM, __doc__)
    columns = [*load.TEXT, "problem", *load.COUNTS, "error", "excess_error"]
    table = load.read_records(folder / "records.csv", columns, all_columns=True)
    table = table.assign(failed=pareto.failed_rows(table))
    refused = table["status"] == "refused"
    mostly = refused.groupby([table[c] for c in (*load.VARIANT, "problem")]).transform("mean") > 0.5
    table = table[~mostly & ~refused]  # what a method is not made for says nothing about it
    run = load.Run(table[~table["failed"]], table[table["failed"]], load.read_context(folder / "context.json"))
    finest = table[table["resolution"] == table["resolution"].max()]
    order = list(finest[~finest["failed"]].groupby(load.VARIANT)["error"].median().sort_values().index)
    cut = [v for v in order if v != REFERENCE]
    measures = [SimpleNamespace(column=p, beside=None, label=label, worst=np.inf, linear=False, limits=limits, written=distribution.two_digits)
                for p, (label, limits) in PROBLEMS.items()]
    rows = wide(finest)
    counts = {variant: shares.counted(here, here["failed"]) for variant, here in finest.groupby(load.VARIANT)}
    figure = dots.figure_of(rows[rows["method"] != REFERENCE[0]], cut, measures, [1, 1, 1], (), counts)
    for ax, problem in zip(figure.axes, PROBLEMS):
        ax.axvline(load.median(of(rows, REFERENCE)[problem]), color="#111111", linewidth=0.8, linestyle="--", zorder=1)
    style.finish(figure, [], " ".join([
        f"Errors against exact answers at {finest['resolution'].max():,} triangles, over all four kinds of sheets. Dashed: median of "
        "the mesh fitted to the cut. Methods that refuse a problem, as those that constrain vertices do, are not in it.",
        naming.provenance(run, finest, with_crosses=False, per=("problem",))]), dots.legend(rows))
    style.save(figure, folder, STEM)
    load.print_table("Median errors in percent by size, and on the finest sheets the mean excess over the fitted mesh with its 95 %",
                     ["problem", "method", "made", *map(str, sorted(set(table["resolution"]))), "excess, %", "95 %"],
                     rows_of(table, [REFERENCE, *cut]))


if __name__ == "__main__":
    main()
