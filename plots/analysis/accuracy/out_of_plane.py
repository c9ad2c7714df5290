"""Errors out of plane."""

import numpy as np

from analysis import load
from analysis.load import of

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
