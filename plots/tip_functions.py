#!/usr/bin/env python3
"""Functions for the tips of cuts, off and on: the error of the released energy against the number of triangles, by kind of
crack, and a table of the errors, their rates in h, and of K."""

import numpy as np
from matplotlib.lines import Line2D

from common import front, load, style

STEM = "tip_functions"
KINDS = {"straight": ["centre_crack"], "inclined": ["inclined_crack"],
         "arcs": ["arc_crack_30", "arc_crack_45", "arc_crack_60", "arc_crack_45_uniaxial"],
         "from the edge": ["edge_crack_30", "edge_crack_40", "edge_crack_50"]}
MEASURE = "error_released_energy"
MEASURES = ["error_energy_norm", "error_opening", "error_k1", "error_tip_k1"]
ON = {0: "off", 1: "on"}


def means(table, measure):
    """Mean error in percent by resolution, of the members of all problems of a kind."""
    return 100 * table.groupby("resolution")[measure].mean().dropna()


def rate(errors):
    """In h, between the coarsest and the finest sheet: h goes with 1 / sqrt(triangles)."""
    first, last = errors.index[0], errors.index[-1]
    return np.log(errors[first] / errors[last]) / np.log(np.sqrt(last / first))


def rows_of(table):
    rows = []
    for kind, problems in KINDS.items():
        here = table[table["problem"].isin(problems)]
        for (method, on), made in here.groupby(["method", "tip_functions"], sort=False):
            errors = means(made, MEASURE)
            row = [kind, method, ON[int(on)], *errors, rate(errors)]
            for measure in MEASURES:
                of_measure = means(made, measure)
                row += [of_measure.iloc[0], of_measure.iloc[-1]] if len(of_measure) else [np.nan, np.nan]
            rows.append(row)
    return rows


def figure_of(run, table):
    figure, axes = style.panels(1, len(KINDS), 6.2, width=style.PAGE, sharey=True)
    looks = style.looks(set(zip(table["method"], table["parameter"])))
    for ax, (kind, problems) in zip(axes[0], KINDS.items()):
        here = table[table["problem"].isin(problems)]
        for (method, parameter), look in looks.items():
            of_method = here[(here["method"] == method) & (here["parameter"] == parameter)]
            for on, line in ((0, "--"), (1, "-")):
                errors = means(of_method[of_method["tip_functions"] == on], MEASURE)
                ax.plot(errors.index, errors, **(look.drawn() | {"linestyle": line, "linewidth": 1}))
        ax.set_xscale("log"), ax.set_yscale("log")
        ax.set_xticks(sorted(set(here["resolution"])), [str(r) for r in sorted(set(here["resolution"]))])
        ax.minorticks_off()
        ax.set_title(kind, loc="left")
        ax.set_xlabel("triangles, uncut sheet")
    axes[0, 0].set_ylabel("error of the released energy, %")
    style.plain_numbers(axes[0, 0])
    lines = [Line2D([], [], color="#444444", linestyle=line, label=f"tip functions {ON[on]}")
             for on, line in ((0, "--"), (1, "-"))]
    style.finish(figure, looks.values(), " ".join([
        "Error of the energy that a cut gives off, over the exact one: means over the problems of a kind, four sheets and the "
        "members of the ensemble, solved directly. Of each problem:",
        style.provenance(run, table, with_crosses=False, per=("problem", "resolution", "tip_functions"))]), lines)
    return figure


def main():
    folder = load.results_folder(STEM, __doc__)
    columns = [*load.TEXT, "problem", *load.COUNTS, "tip_functions", MEASURE]
    everything = load.read_records(folder / "records.csv", columns, all_columns=True)
    failed = front.failed_rows(everything)
    table = everything[~failed]
    run = load.Run(table, everything[failed], load.read_context(folder / "context.json"))
    style.save(figure_of(run, table), folder, STEM)
    resolutions = sorted(set(table["resolution"]))
    ends = [resolutions[0], resolutions[-1]]
    names = ["kind", "method", "tip functions", *(f"energy, {r}" for r in resolutions), "rate in h",
             *(f"{name}, {r}" for name in ("energy norm", "opening", "K1", "K1 of coefficients") for r in ends)]
    load.print_table("Errors in percent, by the triangles of the uncut sheet: of the released energy, its rate, and by other "
                     "measures", names, rows_of(table))


if __name__ == "__main__":
    main()
