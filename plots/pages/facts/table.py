"""The one table of what pages quote: functions of Published records by name, and how numbers are written."""

import numpy as np

from analysis import load
from analysis.methods.distribution import two_digits

NUMBERS, TABLES, CONDITIONS, WORDS = {}, {}, {}, {}


def _named(where, name, function):
    if name in where:
        raise ValueError(f"two functions are named {name}")
    where[name] = function
    return function


def number(name):
    """Of Published: the text between <!--=name--> and <!--/-->."""
    return lambda function: _named(NUMBERS, name, function)


def table(name):
    """Of Published: the head and the rows, lists of cells, between <!--table name--> and <!--/table-->."""
    return lambda function: _named(TABLES, name, function)


def condition(name, words):
    """Of Published: whether the sentence before <!--if name--> holds. \\param words  what it rests on"""
    WORDS[name] = words
    return lambda function: _named(CONDITIONS, name, function)


# ---- how numbers are written


def plain(value):
    """Two digits, without exponent up to a million; a dash where there is none."""
    if np.isnan(value):
        return "-"
    return two_digits(value) if abs(value) < 1e6 else f"{value:.1e}".replace("e+", "e").replace("e0", "e")


def percent(value):
    """A share that is given in percent."""
    return f"{value:.0f}" if value >= 10 or value == 0 else f"{value:.1f}"


def signed(value):
    return f"{value:+,.0f}"


def bracket(value, ends, written=plain):
    """A number with its 95 % interval."""
    return f"{written(value)} [{', '.join(written(end) for end in ends)}]"


def interval_of(values, statistic, draws=5000):
    """95 %, the values drawn anew (bootstrap). \\param statistic  of the rows of an array"""
    drawn = np.random.default_rng(1).choice(np.asarray(values, float), (draws, len(values)))
    return np.quantile(statistic(drawn), [0.025, 0.975])


def medians(rows):
    return np.median(rows, axis=1)


def drawn_whole(rows, groups, column, draws=5000):
    """A column in draws of whole groups of rows, all of one size: by draw and row."""
    values = np.array([here[column].to_numpy() for _, here in rows.groupby(groups)])
    return values[np.random.default_rng(1).integers(0, len(values), (draws, len(values)))].reshape(draws, -1)


def code(*names):
    return ", ".join(f"`{name}`" for name in names)


def stop(text):
    load.stop(text)
