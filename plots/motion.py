#!/usr/bin/env python3
"""Two sheets that are cut and swing: a stretched strip, cut across, and a hanging sheet, cut from the side. The error of the
motion by method and size of the sheet, beside that of the mesh fitted to the cut, by integrator; and a table of all measures."""

import numpy as np
from matplotlib.lines import Line2D

from common import front, load, style

STEM = "motion"
INTEGRATORS = {"midpoint": "midpoint rule", "backward_euler": "backward Euler"}
REFERENCE = "body_fitted (reference)"
PLAIN = "conventional_split"
# Of each problem its panel's title, and its measures, the first drawn.
PROBLEMS = {
    "severed_strip": ("strip cut across", {"lip_motion": "lips' motion", "lip_speed": "lip speed", "arrival": "arrival",
                                           "energy_kept": "energy"}),
    "hanging_sheet": ("hanging sheet", {"flap_motion": "flap's motion", "gape_motion": "gape",
                                        "strain_energy_motion": "strain energy", "energy_lost": "energy lost"}),
}
COLOURS = ["#56b4e9", "#0072b2", "#111111"]
MARKERS = ["o", "s", "D"]


def of_problem(table, problem, integrator="midpoint"):
    """Its rows, with the drawn error as the column "error"."""
    here = table[table["problem"] == f"{problem}_{integrator}"]
    return here.assign(error=100 * here[f"error_{next(iter(PROBLEMS[problem][1]))}"])


def names_of(everything, failed):
    """The methods, the largest mean error last, each with what it refused."""
    made = everything[~failed & (everything["method"] != REFERENCE)]
    errors = sum(np.log(of_problem(made, problem).groupby("method")["error"].mean()) for problem in PROBLEMS)
    names = {}
    for method in errors.sort_values().index:
        rows = everything["method"] == method
        lost = int((rows & failed).sum())
        how = "refused" if (everything.loc[rows & failed, "status"] == "refused").all() else "refused or failed"
        names[method] = method.replace("_", " ") + (f" ({lost} of {int(rows.sum())} {how})" if lost else "")
    return names


def interval(errors):
    """95 %, of the mean, by drawing the cuts anew (bootstrap)."""
    return np.quantile(load.drawn_means(errors), [0.025, 0.975])


def draw(ax, here, names):
    for size, colour, marker in zip(sorted(set(here["resolution"])), COLOURS, MARKERS):
        by_method = here[here["resolution"] == size].groupby("method")["error"]
        errors, ends = by_method.mean(), {method: interval(cuts) for method, cuts in by_method}
        ax.hlines(range(len(names)), *np.transpose([ends[name] for name in names]), color=colour, linewidth=0.8, alpha=0.5)
        ax.axvline(errors[REFERENCE], color=colour, linewidth=0.8, linestyle="--", zorder=1)
        ax.plot(errors.reindex(list(names)), range(len(names)), color=colour, marker=marker, linestyle="",
                markersize=3.4, markeredgewidth=0.3, markeredgecolor="white")
    ax.set_xscale("log")
    style.plain_numbers(ax, "x", 7)
    ax.minorticks_off()


def figure_of(run, table, names):
    figure, axes = style.panels(len(PROBLEMS), len(INTEGRATORS), 8.6, width=style.PAGE, sharey=True)
    for row, (problem, (title, measures)) in zip(axes, PROBLEMS.items()):
        for ax, (integrator, rule) in zip(row, INTEGRATORS.items()):
            draw(ax, of_problem(table, problem, integrator), names)
            ax.set_title(f"{title}, {rule}", loc="left")
            ax.set_xlabel(f"error of the {next(iter(measures.values()))}, %")
        row[0].set_yticks(range(len(names)), list(names.values()))
    axes[0, 0].invert_yaxis()
    lines = [Line2D([], [], color=colour, marker=marker, linestyle="--", linewidth=0.8, markersize=3.4,
                    label=f"{size} triangles (line: mesh fitted to the cut)")
             for size, colour, marker in zip(sorted(set(table["resolution"])), COLOURS, MARKERS)]
    style.finish(figure, [], " ".join([
        "Root mean square over all steps: strip, against a released bar; sheet, against fine fitted meshes. Means over the cuts, two on "
        "each of four sheets; bars: 95 %, cuts drawn anew. The step lets a wave pass one square of the sheet. Of each problem:",
        style.provenance(run, table, with_crosses=False, per=("problem", "resolution"))]), lines)
    return figure


def rows_of(table, names, problem):
    measures = list(PROBLEMS[problem][1])
    rows = []
    for integrator, rule in INTEGRATORS.items():
        here = of_problem(table, problem, integrator)
        for method in [REFERENCE, *names]:
            by_size = here[here["method"] == method].groupby("resolution")
            excess = 100 * by_size[f"excess_{measures[0]}"].mean()
            rows.append([rule, method, *by_size["error"].mean(), *(np.nan if method == REFERENCE else e for e in excess),
                         *(100 * by_size[f"error_{m}"].mean().iloc[-1] for m in measures[1:])])
    return rows


def ratios(table, size):
    """How the flap's motion compares with that after a plain split, a row a method: geometric mean over cuts and integrators, its
    95 %, of each integrator."""
    here = table[table["problem"].str.startswith("hanging_sheet") & (table["resolution"] == size)]
    errors = here.pivot_table(index=["problem", "sheet", "case"], columns="method", values="error_flap_motion")
    rows = []
    for method in errors:
        logs = np.log(errors[method] / errors[PLAIN]).dropna().groupby(level=["sheet", "case"]).mean()
        each = [np.log(here[method] / here[PLAIN]).mean() for _, here in errors.groupby(level="problem", sort=False)]
        rows.append([method, *np.exp([logs.mean(), *np.quantile(load.drawn_means(logs), [0.025, 0.975]), *each])])
    return sorted(rows, key=lambda row: row[1])


def print_ratios(table, size):
    load.print_table(f"Hanging sheet, {size} triangles: error of the flap's motion over that after {PLAIN}; geometric mean over eight "
                     "cuts and both integrators, 95 % by drawing the cuts anew, and of each integrator",
                     ["method", "ratio", "from", "to", *(rule for rule in sorted(INTEGRATORS))], ratios(table, size))


def main():
    folder = load.results_folder(STEM, __doc__)
    measures = [f"error_{m}" for _, of_one in PROBLEMS.values() for m in of_one]
    excesses = [f"excess_{next(iter(of_one))}" for _, of_one in PROBLEMS.values()]
    columns = [*load.TEXT, "problem", *load.COUNTS, *measures, *excesses]
    everything = load.read_records(folder / "records.csv", columns, all_columns=True)
    failed = front.failed_rows(everything)
    table = everything[~failed]
    run = load.Run(table, everything[failed], load.read_context(folder / "context.json"))
    names = names_of(everything, failed)
    style.save(figure_of(run, table, names), folder, STEM)
    sizes = sorted(set(table["resolution"]))
    for problem, (title, measures) in PROBLEMS.items():
        first, *others = measures.values()
        load.print_table(f"{title.capitalize()}: errors in percent, means over sheets and members: {first} by size, its excess over "
                         f"the fitted mesh, and at {sizes[-1]} triangles the other measures",
                         ["integrator", "method", *(f"{s}" for s in sizes), *(f"excess, {s}" for s in sizes), *others],
                         rows_of(table, names, problem))
    for size in sizes[1:]:
        print_ratios(table, size)


if __name__ == "__main__":
    main()
