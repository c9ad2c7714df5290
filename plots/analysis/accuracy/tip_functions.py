"""Errors with functions for the tips of cuts, off and on."""

import numpy as np

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
