#!/usr/bin/env python3
"""All methods out of plane (results/out_of_plane): the error of each problem on the finest sheets, beside that of the mesh fitted
to the cut; and a table of all sizes with the excess over that mesh."""

from types import SimpleNamespace

import numpy as np

from common import front, load, style
from common.load import of
from method_parts import dots

STEM = "out_of_plane"
PROBLEMS = {  # the label and the limits of the axis: a cut that failed lies beyond
    "slit_strip": ("slit strip: profile, %", (0.003, 3)),
    "flap": ("flap: profile, %", (0.003, 30)),
    "trouser_tear": ("tear: release rate, %", (0.03, 200))}
REFERENCE = ("body_fitted (reference)", "")


def wide(table):
    """A row per cut with a column of the error in percent for each problem; a cut that failed is infinitely bad. All sheets are one, as in
    the table."""
    errors = (100 * table["error"]).where(~table["failed"], np.inf)
    rows = table[[*load.VARIANT, "failed"]].assign(sheet="all")
    for problem in PROBLEMS:
        rows[problem] = errors.where(table["problem"] == problem)
    return rows


def excess(table):
    """The geometric mean of the error over the fitted mesh's of the same case, minus one, and its 95 % interval (bootstrap over
    the cases), in percent."""
    ratio = np.log1p(table.loc[~table["failed"], "excess_error"].replace(-1, np.nan).dropna())
    if not len(ratio):
        return np.nan, np.nan, np.nan
    return tuple(100 * np.expm1([ratio.mean(), *np.quantile(load.drawn_means(ratio), [0.025, 0.975])]))


def rows_of(table, order):
    rows = []
    for problem in PROBLEMS:
        here = table[table["problem"] == problem]
        for variant in order:
            cuts = of(here, variant)
            made = cuts[~cuts["failed"]]
            mean, low, high = excess(made[made["resolution"] == table["resolution"].max()]) if variant != REFERENCE else 3 * [np.nan]
            rows.append([problem, variant[0], f"{len(made)}/{len(cuts)}",
                         *(100 * made.loc[made["resolution"] == n, "error"].median() for n in sorted(set(table["resolution"]))),
                         mean, f"{low:+.0f} to {high:+.0f}" if np.isfinite(mean) else "-"])
    return rows


def main():
    folder = load.results_folder(STEM, __doc__)
    columns = [*load.TEXT, "problem", *load.COUNTS, "error", "excess_error"]
    table = load.read_records(folder / "records.csv", columns, all_columns=True)
    table = table.assign(failed=front.failed_rows(table))
    refused = table["status"] == "refused"
    mostly = refused.groupby([table[c] for c in (*load.VARIANT, "problem")]).transform("mean") > 0.5
    table = table[~mostly & ~refused]  # what a method is not made for says nothing about it
    run = load.Run(table[~table["failed"]], table[table["failed"]], load.read_context(folder / "context.json"))
    finest = table[table["resolution"] == table["resolution"].max()]
    order = list(finest[~finest["failed"]].groupby(load.VARIANT)["error"].median().sort_values().index)
    cut = [v for v in order if v != REFERENCE]
    measures = [SimpleNamespace(column=p, label=label, worst=np.inf, linear=False, limits=limits, written=dots.two_digits)
                for p, (label, limits) in PROBLEMS.items()]
    rows = wide(finest)
    figure = dots.figure_of(rows[rows["method"] != REFERENCE[0]], cut, measures, [1, 1, 1], ())
    for ax, problem in zip(figure.axes, PROBLEMS):
        ax.axvline(load.median(of(rows, REFERENCE)[problem]), color="#111111", linewidth=0.8, linestyle="--", zorder=1)
    style.finish(figure, [], " ".join([
        f"Errors against exact answers at {finest['resolution'].max():,} triangles, over all four kinds of sheets. Dashed: median of "
        "the mesh fitted to the cut. Methods that refuse a problem, as those that constrain vertices do, are not in it.",
        style.provenance(run, finest, with_crosses=False, per=("problem",))]), dots.legend(rows))
    style.save(figure, folder, STEM)
    load.print_table("Median errors in percent by size, and on the finest sheets the mean excess over the fitted mesh with its 95 %",
                     ["problem", "method", "made", *map(str, sorted(set(table["resolution"]))), "excess, %", "95 %"],
                     rows_of(table, [REFERENCE, *cut]))


if __name__ == "__main__":
    main()
