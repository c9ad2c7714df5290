"""Numbers that the pages quote, a line each, for plots/pages/quoted_*.py."""

import numpy as np

from analysis import load


def say(words, *values):
    print(f"  {words}: {', '.join(value if isinstance(value, str) else load.number(float(value)) for value in values)}")


def span(values, digits=3):
    values = [float(value) for value in values]
    return f"{load.number(min(values), digits)} to {load.number(max(values), digits)}"


def drawn_whole(rows, groups, columns, draws=5000):
    """The columns in draws with replacement of whole groups of rows, all of one size: by draw, row and column."""
    values = np.array([here[columns].to_numpy() for _, here in rows.groupby(groups)])
    drawn = values[np.random.default_rng(1).integers(0, len(values), (draws, len(values)))]
    return drawn.reshape(draws, -1, len(columns))
