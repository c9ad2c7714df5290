"""Errors of the motion of two sheets that are cut and swing."""

import numpy as np

from analysis import load, naming, shares

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


def of_problem(table, problem, integrator="midpoint"):
    """Its rows, with the drawn error as the column "error"."""
    here = table[table["problem"] == f"{problem}_{integrator}"]
    return here.assign(error=100 * here[f"error_{next(iter(PROBLEMS[problem][1]))}"])


CASE = ["sheet", "resolution", "case"]


def counts_of(everything, failed):
    """{method: shares.Share}"""
    return {method: shares.counted(rows, failed[rows.index]) for method, rows in everything.groupby("method", sort=False)}


def errors_of(here, method, few):
    """Of each cut of of_problem(), those of a method that made few by shares.fair_values()."""
    return shares.fair_values(here[here["method"] == method], here[here["method"] == PLAIN], "error", CASE, few)


def names_of(everything, failed):
    """The methods, the largest mean error last, and those after all others that made few of their cuts; each with its share."""
    made, counts = everything[~failed & (everything["method"] != REFERENCE)], counts_of(everything, failed)

    def error(method):
        return sum(np.log(errors_of(of_problem(made, problem), method, counts[method].is_few).mean()) for problem in PROBLEMS)
    order = sorted(dict.fromkeys(made["method"]), key=lambda method: (counts[method].is_few, error(method), method))
    return {method: naming.words(method) + counts[method].beside() for method in order}


def interval(errors):
    """95 %, of the mean, by drawing the cuts anew (bootstrap)."""
    return np.quantile(load.drawn_means(errors), [0.025, 0.975])


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
