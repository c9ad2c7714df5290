"""Draws points of two measures, and the Pareto front: the points that no other beats in both (analysis/pareto.py)."""

import numpy as np
from matplotlib.lines import Line2D

from analysis import naming

FRONT_LINE = dict(color="#111111", linewidth=0.7, linestyle=(0, (1, 1)), zorder=2.5)
BEHIND = 0.28  # opacity


def draw(ax, points, look, size=1.0):
    """One curve of a panel, its points in order; those behind the front pale, but not those of a program, which has its
    name beside the first of the panel. Bars: quartiles."""
    made = points[points["layer"] > 0]
    behind = 1.0 if look.program else BEHIND
    name = look.label.removesuffix(naming.PROGRAM)
    if look.program and len(made) and name not in {text.get_text() for text in ax.texts}:
        ax.annotate(name, (made["x"].iloc[0], made["y"].iloc[0]), xytext=(-3, 3),
                    textcoords="offset points", ha="right", fontsize=7, color=look.colour, zorder=5)
    ax.plot(made["x"], made["y"], color=look.colour, linestyle=look.line, linewidth=0.5 * look.width,
            alpha=1 if (made["layer"] == 1).all() else behind, zorder=2)
    for _, p in made.iterrows():
        alpha = 1.0 if p["layer"] == 1 else behind
        bars = dict(color=look.colour, linewidth=0.7, alpha=0.5 * alpha, zorder=1.5)
        ax.hlines(p["y"], *_finite(p["x_q1"], p["x_q3"], p["x"]), **bars)
        ax.vlines(p["x"], *_finite(p["y_q1"], p["y_q3"], p["y"]), **bars)
        ax.plot(p["x"], p["y"], color=look.colour, marker=look.marker, linestyle="", alpha=alpha, zorder=3,
                markerfacecolor="white" if look.few else look.colour,
                markersize=size * (3.2 + (p["layer"] == 1)),
                markeredgecolor="#111111" if p["layer"] == 1 else "white",
                markeredgewidth=0.5 if p["layer"] == 1 else 0.3)


def _finite(low, high, middle):
    """A bar that would go on without end stops at the median."""
    return (low if np.isfinite(low) else middle, high if np.isfinite(high) else middle)


def draw_front(ax, points):
    """The front itself, as the stairs below which nothing was measured."""
    best = points[points["layer"] == 1].sort_values("x")
    if len(best) > 1:
        ax.plot(best["x"], best["y"], **FRONT_LINE)


def draw_failures(ax, points, looks):
    """At the top edge of a panel: a cross where a group with failures is, if any of it was made, and on the right, per
    method, how many failed of how many."""
    for number, ((method, parameter), look) in enumerate(
            (v, look) for v, look in looks.items() if _of(points, v)["failed"].any()):
        here = _of(points, (method, parameter))
        for x in here.loc[(here["failed"] > 0) & np.isfinite(here["x_made"]), "x_made"]:
            ax.annotate("×", (x, 1), xycoords=ax.get_xaxis_transform(), va="center", ha="center", fontsize=6,
                        color=look.colour, annotation_clip=False)
        ax.annotate(f"× {here['failed'].sum()}/{here['n'].sum()}", (1, 1), xycoords="axes fraction",
                    xytext=(0, 2 + 5 * number), textcoords="offset points", va="bottom", ha="right", fontsize=4.6,
                    color=look.colour, annotation_clip=False)


def _of(points, variant):
    return points[(points["method"] == variant[0]) & (points["parameter"] == variant[1])]


def legend_entries(looks):
    others = "other points: pale, but for programs" if any(look.program for look in looks) else "other points: pale"
    return [Line2D([], [], label=f"Pareto front ({others})", **FRONT_LINE)]


def scale(axis, values):
    """Logarithmic where values of one sign span more than a factor 5, linear near zero and logarithmic beyond where
    they have both signs and span much, else linear. `axis`: "x" or "y" of set_xscale, as a function."""
    values = np.asarray(values, float)
    values = values[np.isfinite(values)]
    if not len(values):
        return
    if (values > 0).all():
        if values.max() > 5 * values.min():
            axis("log")
        return
    sizes = np.abs(values[values != 0])
    if len(sizes) and sizes.max() > 10 * np.median(sizes):
        axis("symlog", linthresh=float(np.median(sizes)))
