"""Two more figures of method_comparison.py: shapes against cost for each setting of each method's knob
(method_comparison_knobs), and the effect of each part of warp_and_refine (method_comparison_ablation)."""

import numpy as np
from matplotlib.colors import LogNorm, Normalize

from common import style

BEFORE = ["nothing", "snap", "warp", "thin", "warp+thin"]
AFTER = ["nothing", "flips", "smoothing", "refine", "tie"]
OFF_AT_ZERO = {"cgal_refine", "delaunay_refine"}  # bound=0 sets no bound


def median(rows, column):
    """The median, in which a failed cut is infinitely bad; NaN if nothing was measured."""
    values = np.where(rows["failed"], np.inf, rows[column].to_numpy(float))
    values = values[~np.isnan(values)]
    return float(np.quantile(values, 0.5, method="inverted_cdf")) if len(values) else np.nan


def below_three(rows):
    return float((~(rows["ar_max_cut_outside_wedges"] >= 3) & ~rows["failed"]).mean())


def draw_knobs(folder, table, caption, defaults):
    """A panel for each sheet and measure of shape; in it a curve for each method through the settings of its knob, with a
    large marker at the default. The setting bound=0 is not joined to the others."""
    sheets = style.sheet_order(table["sheet"])
    measures = [("eigenvalue_ratio", "largest eigenvalue / uncut"), ("ar_max_cut_outside_wedges", "largest AR")]
    figure, axes = style.panels(len(measures), len(sheets), 4.6, sharex=True, sharey="row")
    variants = sorted(set(zip(table["method"], table["knob"])), key=lambda v: (v[0], style.natural(v[1])))
    names = list(dict.fromkeys(name for name, _ in variants))
    looks = style.many_looks(names)
    for row, (column, label) in zip(axes, measures):
        for ax, sheet in zip(row, sheets):
            ax.set_xscale("log")
            ax.set_yscale("log")
            for name in names:
                knobs = [knob for n, knob in variants if n == name]
                points = []
                for knob in knobs:
                    rows = table[(table["method"] == name) & (table["knob"] == knob) & (table["sheet"] == sheet)]
                    points.append((median(rows, "us_per_crossed"), median(rows, column)))
                x, y = np.array(points).T
                look = looks[name]
                joined = slice(1 if name in OFF_AT_ZERO else 0, None)
                ax.plot(x[joined], y[joined], color=look.colour, linewidth=0.8)
                for (px, py), knob in zip(points, knobs):
                    is_default = (name, knob) in defaults
                    ax.plot(px, py, look.marker, color=look.colour, markersize=4.2 if is_default else 2.4, zorder=3,
                            markeredgecolor="#111111" if is_default else "white", markeredgewidth=0.4)
                    if np.isfinite(px) and np.isfinite(py) and knob in (knobs[0], knobs[-1]):
                        ax.annotate(knob.partition("=")[2], (px, py), xytext=(1.5, 1.5), textcoords="offset points",
                                    fontsize=4.2, color=look.colour)
        row[0].set_ylabel(label)
    for ax, sheet in zip(axes[0], sheets):
        ax.set_title(style.sheet_title(sheet))
    for ax in axes[-1]:
        ax.set_xlabel("µs per crossed triangle")
    style.finish(figure, [looks[name] for name in names], caption)
    style.save(figure, folder, "method_comparison_knobs")


def draw_ablation(folder, table, caption):
    """What comes before the split, by row, and after it, by column; a panel per measure, its numbers in the cells."""
    measures = [("largest eigenvalue / uncut", lambda rows: median(rows, "eigenvalue_ratio"), "{:.3g}", LogNorm(1, 1e4)),
                ("cuts with AR < 3", below_three, "{:.0%}", Normalize(0, 1)),
                ("vertices per crossed tri.", lambda rows: median(rows, "vertices_per_crossed"), "{:.2f}",
                 Normalize(0, 3)),
                ("µs per crossed triangle", lambda rows: median(rows, "us_per_crossed"), "{:.2g}", LogNorm(0.3, 10))]
    figure, axes = style.panels(2, 2, 4.4)
    for ax, (label, measure, text, norm) in zip(axes.flat, measures):
        cells = np.array([[measure(table[table["method"] == f"ablation:{before}:{after}"]) for after in AFTER]
                          for before in BEFORE])
        ax.imshow(cells, norm=norm, cmap="viridis_r" if "AR" not in label else "viridis", aspect="auto", alpha=0.55)
        for i, row in enumerate(cells):
            for j, value in enumerate(row):
                shown = f"{value / 1000:.0f}k" if value >= 1000 else text.format(value) if np.isfinite(value) else "-"
                ax.text(j, i, shown, ha="center", va="center", fontsize=5)
        ax.set_title(label, pad=3)
        ax.set_xticks(range(len(AFTER)), AFTER, fontsize=5, rotation=30, ha="right", rotation_mode="anchor")
        ax.set_yticks(range(len(BEFORE)), BEFORE, fontsize=5)
        ax.tick_params(length=0)
        ax.grid(False)
        ax.spines[:].set_visible(False)
    style.finish(figure, [], caption)
    style.save(figure, folder, "method_comparison_ablation")
