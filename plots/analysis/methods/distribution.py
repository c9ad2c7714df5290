"""Quantiles of values of which some count as infinitely bad, and how a median is written."""

import numpy as np

from analysis import load


def spread(values, worst=np.inf):
    """The 5, 25, 50, 75 and 95 % quantiles, in which a failed cut is infinitely bad, and the worst of the cuts that did not
    fail. `worst`: what a failed cut counts as."""
    values = np.asarray(values.dropna(), float)
    if not len(values):
        return np.full(5, np.nan), np.nan
    sign = 1 if worst > 0 else -1
    quantiles = sign * load.quantiles(sign * values, [0.05, 0.25, 0.5, 0.75, 0.95])
    return quantiles, sign * max(sign * values[np.isfinite(values)], default=-np.inf)


def two_digits(value):
    if 0 < abs(value) < 1e-3:
        return f"{value:.1e}".replace("e-0", "e-")
    return f"{float(f'{value:.2g}'):,.0f}" if value >= 100 else load.number(value, 2)
