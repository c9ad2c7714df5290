#!/usr/bin/env python3
"""What one kind of change does against thin triangles, alone and with others: the mesh, the unknowns, the mass and the solver
on the same cuts (results/one_change), the functions on the same cracks (results/one_change_accuracy). A figure and a table,
one row per change."""

import sys
from pathlib import Path

import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, shares
from analysis.methods.one_change import CUT, ERROR, MADE, PATH, STEM, in_words, rows_of
from figures.common import style

KINDS = {"nothing": "#444444", "mesh": "#0072b2", "unknowns": "#d55e00", "functions": "#7b3294", "mass": "#009e73",
         "solver": "#b8860b", "together": "#111111"}


def figure_of(rows, size, caption):
    figure, axes = style.panels(1, 4, 7.6, width=style.PAGE, sharey=True)
    panels = [("largest eigenvalue /\nuncut: median,\nline to worst", "eigenvalue"), ("error of the\nreleased energy,\n%", f"error %, {size}"),
              ("iterations of a\nstep (hollow: of\nmultigrid)", f"iterations, {size}"), ("time of a step /\nthat of the first\nrow", f"a step, {size}")]
    y = -np.arange(len(rows))
    for ax, (title, column) in zip(axes[0], panels):
        ax.set_xscale("log"), ax.set_xlabel(title, fontsize=6.5)
        ax.axvline(np.ravel(rows[0][1][column])[0], color="#999999", linewidth=0.6, linestyle="--", zorder=0)
        for at, (change, row) in zip(y, rows):
            colour = KINDS[change.kind]
            value, *ends = (row[column], row[column], row["worst"]) if column == "eigenvalue" else np.ravel(row[column])
            if ends:
                ax.plot(ends, [at, at], color=colour, linewidth=0.8, alpha=0.6)
            hollow = row[MADE].is_few or column.startswith("iterations") and change.solver != "cg"
            ax.plot(value, at, "o", color="white" if hollow else colour, markeredgecolor=colour, markersize=4)
        ax.axhline(0.5 - sum(change.kind != "together" for change, _ in rows), color="#999999", linewidth=0.5)
        if column != "eigenvalue":
            ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            ax.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
            ax.xaxis.set_minor_formatter(NullFormatter())
    axes[0, 0].set_yticks(y, [change.short() + row[MADE].beside() for change, row in rows], fontsize=6)
    style.finish(figure, [], caption)
    return figure


def main():
    folder = load.results_folder(STEM, __doc__)
    numbers = ["eigenvalue_ratio", "iterations", "step_us", "first_step_us", "cut_update_us"]
    cuts = load.read_records(folder / "records.csv", load.TEXT + ["cut", "mass", "solver"] + load.COUNTS + numbers)
    errors = load.read_records(folder.with_name("one_change_accuracy") / "records.csv",
                               load.TEXT + ["problem", "tip_functions", ERROR] + load.COUNTS)
    rows, sizes = rows_of(cuts, errors)
    context = load.read_context(folder / "context.json")
    made = cuts[CUT].drop_duplicates()
    drawn = made[made["resolution"] == sizes[-1]]
    style.save(figure_of(rows, sizes[-1], (
        f"Left is good. Above the line one change of conventional split, lumped mass and CG; below it several together. Lines at errors and times: 95 % intervals ({errors['problem'].nunique()} problems, or paths, drawn anew). Tips: tip functions; mass: stabilised. {sizes[-1]} triangles, "
        f"{len(drawn)} cuts of {len(drawn[PATH].drop_duplicates())} paths (eigenvalues: {len(made)}, also of {sizes[0]} triangles). Errors: {errors['problem'].nunique()} cracks at rest, where mass "
        f"and solver change nothing; steps are without tip functions. {shares.HOLLOW} "
        f"Commit {str(context.get('commit'))[:10]}, seed {context.get('seed')}.")), folder, STEM)
    load.print_table("Each change alone, and together: largest eigenvalue over the uncut sheet's (median, 95 %, worst), mean error of the released "
                     "energy at cracks with its 95 % interval (problems drawn anew), iterations of a step (median); medians of times over those of the first "
                     "row on the same cuts with 95 % intervals (paths drawn anew); share of motions in which energy grew", ["change", "by", *rows[0][1]],
                     [[change.kind, change.label(), *(in_words(*v) if isinstance(v, tuple) else v.text() if isinstance(v, shares.Share) else v
                                                      for v in row.values())]
                      for change, row in rows])


if __name__ == "__main__":
    main()
