"""The panels of the stability sweeps: a cell for each point, coloured by its verdict."""

import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.patches import Patch, Rectangle
from matplotlib.patheffects import withStroke

from analysis import shares
from analysis.stability import points

VERDICTS = {  # colour and words of what is not ok
    "refused": ("#c9c9c9", "refused"), "solver_stalled": ("#2c7fb8", "solver stalled"),
    "newton_failed": ("#7b3294", "Newton failed"), "inverted": ("#e78ac3", "triangles turned over"),
    "energy_growth": ("#d7301f", "energy grew"), "not_finite": ("#000000", "not finite"),
    "failed": ("#8c510a", "cut failed"), "wrong": ("#8c510a", "cut wrong"),
    "timed_out": ("#636363", "timed out"), "crashed": ("#3f007d", "crashed"),
}
EXPLICIT_BANDS = [(0.3, "#1a9850", "≥ 0.3"), (0.1, "#91cf60", "≥ 0.1"), (0.01, "#e6f598", "≥ 0.01"),
                  (1e-4, "#fee08b", "≥ 1e-4"), (-np.inf, "#fdae61", "< 1e-4")]
COST_BANDS = [(3, "#006d2c", "≤ 3 ms"), (10, "#41ab5d", "≤ 10"), (30, "#a1d99b", "≤ 30"), (np.inf, "#d5e8a8", "> 30")]
OK, UNKNOWN = "#74c476", "#f7f7f7"
HATCHED = dict(facecolor=UNKNOWN, edgecolor="#888888", linewidth=0, hatch="/" * 7)
MOST_NAMED = 6  # rows of a group that are named
PLAIN = {"rolled", "turned_over", "step_poisson", "vertex_static", "piece_static"}  # panels without bands


def band_colour(row, measure):
    if row.verdict != "ok":
        return VERDICTS[row.verdict][0]
    if measure == "explicit":
        if np.isnan(row.explicit):
            return UNKNOWN
        return next(colour for least, colour, _ in EXPLICIT_BANDS if row.explicit >= least)
    if measure == "cost" and not np.isnan(row.step_us):
        return next(colour for most, colour, _ in COST_BANDS if row.step_us / 1000 <= most)
    return OK


def cells(ax, rows, group, x, inner=(), measure="", ylabels=True, ticks=None, labels=str):
    """A cell for each point: rows of cells for each value of `group`, labelled, and in them one for each combination of the
    columns `inner`, in the order of the records, named in the first group where they are few; in each the values of x from left to right."""
    groups, xs = list(dict.fromkeys(rows[group])), list(dict.fromkeys(rows[x]))
    inner = list(inner)
    combinations = list(dict.fromkeys(zip(*(rows[c] for c in inner)))) if inner else [()]
    colours = ["white"]
    image = np.zeros((len(groups) * len(combinations), len(xs)))
    for row in points.worst(rows, [group, *inner, x]).itertuples():
        colour = band_colour(row, measure)
        if colour not in colours:
            colours.append(colour)
        y = groups.index(getattr(row, group)) * len(combinations) + combinations.index(tuple(getattr(row, c) for c in inner))
        image[y, xs.index(getattr(row, x))] = colours.index(colour)
    ax.imshow(image, cmap=ListedColormap(colours), norm=BoundaryNorm(np.arange(len(colours) + 1) - 0.5, len(colours)),
              aspect="auto", interpolation="none")
    for down, right in np.argwhere(image == (colours.index(UNKNOWN) if UNKNOWN in colours else -1)):
        ax.add_patch(Rectangle((right - 0.5, down - 0.5), 1, 1, **HATCHED))
    for i in range(1, len(xs)):
        ax.axvline(i - 0.5, color="white", linewidth=0.4)
    for i in range(1, len(image)):
        ax.axhline(i - 0.5, color="white", linewidth=0.3 if i % len(combinations) else 1.4 if inner else 0.4)
    if 1 < len(combinations) <= MOST_NAMED:
        for i, combination in enumerate(combinations):
            ax.text(-0.42, i, ", ".join(points.row_words(*pair) for pair in zip(inner, combination)), fontsize=4, va="center",
                    path_effects=[withStroke(linewidth=1, foreground="white")])
    shown = [i for i, value in enumerate(xs) if ticks is None or value in ticks]
    ax.set_xticks(shown, [short(xs[i]) for i in shown])
    middles = (np.arange(len(groups)) + 0.5) * len(combinations) - 0.5
    ax.set_yticks(middles, [labels(g) for g in groups] if ylabels else [])
    ax.grid(False), ax.spines[:].set_visible(False)
    ax.tick_params(length=0, pad=1.5, labelsize=5.5)
    return combinations


def short(value):
    if isinstance(value, str):
        return value
    if value != 0 and (abs(value) < 0.01 or abs(value) >= 1e4):
        return f"$10^{{{round(np.log10(abs(value)))}}}$" if np.isclose(np.log10(abs(value)) % 1, 0) else f"{value:.0e}"
    return f"{value:g}"


def ratio_lines(ax, rows, names, ylabels=True, prices=False):
    """For each method the median of the explicit step over cuts, and from there a line to the 5 % quantile. `prices`: at the
    left the median time of a cut over that of the first method, and the median incision error. Those that made under half of
    their cuts come last, hollow."""
    counts, first = points.shares_of(rows), names[0]
    names = shares.last_if_few(names, counts)
    base = rows[rows["name"] == first]["geometry_us"].median()
    for i, name in enumerate(names):
        few = counts[name].is_few
        values = points.steps_of(rows, name, first, few).dropna()
        if not len(values):
            continue
        low, middle = values.quantile(0.05), values.median()
        if prices:
            mine = rows[rows["name"] == name]
            error = "gap" if (mine["method"] == "element_deletion").all() else f"{mine['incision_error_h'].median():.2g} h"
            ax.text(1e-8, i, f"{mine['geometry_us'].median() / base:.1f} ×,  {error}", fontsize=5, va="center")
        good = middle >= 0.3 and low >= 0.1
        colour = "#1a9850" if good else "#444444"
        ax.plot([max(low, 1e-8), middle], [i, i], color=colour, linewidth=1, marker="|", markersize=4, markevery=[0])
        ax.plot(middle, i, "o", color=colour, markersize=3, markerfacecolor="white" if few else colour)
    for at in (0.3, 0.1):
        ax.axvline(at, color="#d7301f", linewidth=0.6, linestyle="--" if at == 0.3 else ":")
    ax.set(xscale="log", xlim=(0.7e-8, 1.5), ylim=(len(names) - 0.5, -0.5))
    ax.set_yticks(range(len(names)), [name + counts[name].beside() for name in names] if ylabels else [])
    ax.tick_params(axis="y", length=0, labelsize=5.5), ax.tick_params(axis="x", labelsize=5.5)


def share_ok(ax, rows, y, x, ylabels=True):
    """The share of the cases that are ok, from red (none) to green (all)."""
    ys, xs = list(dict.fromkeys(rows[y])), list(dict.fromkeys(rows[x]))
    table = points.worst(rows, [y, x]).pivot(index=y, columns=x, values="ok").loc[ys, xs]
    ax.imshow(table, cmap="RdYlGn", vmin=0, vmax=1, aspect="auto", interpolation="none")
    for i, name in enumerate(ys):
        for j, value in enumerate(xs):
            share = table.loc[name, value]
            ax.text(j, i, f"{100 * share:.0f}", ha="center", va="center", fontsize=4.5,
                    color="white" if share in (0, 1) else "black")
    ax.set_xticks(range(0, len(xs), 2), [f"{v:g}" for v in xs[::2]])
    ax.set_yticks(range(len(ys)), ys if ylabels else [])
    ax.grid(False), ax.spines[:].set_visible(False), ax.tick_params(length=0, labelsize=5.5)


def legends(verdicts, bands=("explicit", "cost")):
    """(what it is about, handles) for each row of a legend: those of the `bands`, and of the verdicts that are not ok. Without bands ok
    has one colour."""
    def patches(of):
        return [Patch(color=colour, label=words) for _, colour, words in of]
    rows = {"explicit": ("ok, explicit step:", [*patches(EXPLICIT_BANDS), Patch(**HATCHED, label="not known")]),
            "cost": ("ok, cost of a step:", patches(COST_BANDS) + [Patch(color=OK, label="not timed")])}
    others = patches((v, *VERDICTS[v]) for v in VERDICTS if v in verdicts)
    if not bands:
        return [("", [Patch(color=OK, label="ok"), *others])]
    return [rows[band] for band in bands] + ([("not ok:", others)] if others else [])


def bands_of(panel):
    """Of legends(): those of a panel."""
    timed = panel.endswith("solvers") or panel in ("iterations", "tolerance", "vertex_mass", "vertex_stress")
    return ["cost"] if timed else [] if panel in PLAIN else ["explicit"]
