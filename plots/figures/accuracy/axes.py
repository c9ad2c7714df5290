"""The axes that the figures of accuracy runs share."""

import numpy as np
from matplotlib.ticker import FuncFormatter, NullFormatter

from figures.common import style


def percent_axis(ax, values):
    """Excess errors in percent: where they are large, linear up to 10 and logarithmic beyond; plain numbers."""
    values = np.asarray(values, float)
    values = values[np.isfinite(values)]
    if len(values) and np.abs(values).max() > 100:
        ax.set_yscale("symlog", linthresh=10, linscale=0.7)
        ax.set_ylim(bottom=min(-12, 1.5 * values.min()))
        ax.yaxis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
        ax.yaxis.set_minor_formatter(NullFormatter())


def log_x_axis(ax):
    """Logarithmic, plain numbers. Call it when all is drawn."""
    ax.set_xscale("log")
    style.plain_numbers(ax, "x", 4)


def zero_line(ax):
    ax.axhline(0, color="#111111", linewidth=0.6, zorder=1)


def label_edges(axes, x, y):
    rows, columns = axes.shape
    for r in range(rows):
        for c in range(columns):
            axes[r, c].set_ylabel("" if c else y)
            below = r + 1 < rows and axes[r + 1, c].get_visible()
            axes[r, c].set_xlabel("" if below else x)
            axes[r, c].tick_params(labelbottom=not below)
