"""The methods at other settings: medians by the settings of a parameter."""

import numpy as np

from analysis import load, naming

BEFORE = ["nothing", "snap", "warp", "thin", "warp+thin"]
AFTER = ["nothing", "flips", "smoothing", "refine", "tie"]


def median_of(rows, column):
    """That of the rows; a failed cut is infinitely bad."""
    return load.median(rows[column].where(~rows["failed"], np.inf))


def below_three(rows):
    return float((~(rows["ar_max_cut_outside_wedges"] >= 3) & ~rows["failed"]).mean())


def settings_by_method(table):
    """{method: [(variant, what is written below it)]}, the settings of a parameter in their order. A variant `method:part` is a
    setting of the method, too."""
    found = {}
    for method, parameter in sorted(set(zip(table["method"], table["parameter"])), key=lambda v: (v[0], naming.natural(v[1]))):
        name, _, part = method.partition(":")
        found.setdefault(name, []).append(((method, parameter), parameter.partition("=")[2] or part.replace("_", "\n") or "default"))
    return found
