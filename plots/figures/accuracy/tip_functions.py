#!/usr/bin/env python3
"""Functions for the tips of cuts, off and on: the error of the released energy against the number of triangles, by kind of
crack, and a table of the errors, their rates in h, and of K."""

import sys
from pathlib import Path

from matplotlib.lines import Line2D

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming, pareto
from analysis.accuracy.tip_functions import KINDS, MEASURE, ON, STEM, means, rows_of
from figures.common import style


def figure_of(run, table):
    figure, axes = style.panels(1, len(KINDS), 6.2, width=style.PAGE, sharey=True)
    looks = naming.looks(set(zip(table["method"], table["parameter"])))
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
        naming.provenance(run, table, with_crosses=False, per=("problem", "resolution", "tip_functions"))]), lines)
    return figure


def main():
    folder = load.results_folder(STEM, __doc__)
    columns = [*load.TEXT, "problem", *load.COUNTS, "tip_functions", MEASURE]
    everything = load.read_records(folder / "records.csv", columns, all_columns=True)
    failed = pareto.failed_rows(everything)
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
