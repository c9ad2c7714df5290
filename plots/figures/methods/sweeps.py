"""Two more figures of method_comparison.py: shapes against cost for each setting of each method's parameter
(method_comparison_parameters), and the effect of each part of warp_and_refine (method_comparison_ablation)."""

import numpy as np
from matplotlib.colors import LogNorm, Normalize
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from analysis import families, naming
from analysis.load import of
from analysis.methods.parameters import AFTER, BEFORE, below_three, median_of, settings_by_method
from figures.common import style

CURVES = [  # column, label, and how it is drawn
    ("eigenvalue_ratio", "largest eigenvalue / uncut", dict(color="#0072b2", marker="o", markersize=3.4, linewidth=1.2)),
    ("ar_max_cut_outside_wedges", "largest aspect ratio", dict(color="#d55e00", marker="s", markersize=3, linewidth=1.2)),
    ("us_per_crossed", "µs per crossed triangle", dict(color="#666666", marker="^", markersize=3, linewidth=1, linestyle="--")),
]
OFF_AT_ZERO = {"cgal_refine", "delaunay_refine"}  # bound=0 sets no bound


def draw_parameters(folder, table, caption, defaults):
    """A panel for each method: medians of eigenvalue, aspect ratio and time by the setting of its parameter, on one axis. Grey: the
    default. A line does not join bound=0 to the others, which sets no bound, nor a variant that has no parameter."""
    methods = settings_by_method(table)
    groups = families.grouped(methods)
    methods = {m: methods[m] for _, names in groups for m in names}
    columns = min(4, len(methods))
    figure, axes = style.panels(-(-len(methods) // columns), columns, 3.4, width=style.PAGE, sharey=True)
    for ax in axes.flat[len(methods):]:
        ax.set_visible(False)
    for (method, settings), ax in zip(methods.items(), axes.flat):
        part, parameter = next(((m.partition(":")[2], k.partition("=")[0]) for (m, k), _ in settings if k), ("", ""))
        joined = [i for i, ((_, k), value) in enumerate(settings) if k and not (method in OFF_AT_ZERO and value == "0")]
        for column, _, looks in CURVES:
            values = [median_of(of(table, variant), column) for variant, _ in settings]
            x = np.arange(len(values))
            ax.plot(x[joined], np.array(values)[joined], **looks | dict(marker=""))
            ax.plot(x, values, **looks | dict(linestyle=""))
        for x, (variant, _) in enumerate(settings):
            if variant in defaults:
                ax.axvspan(x - 0.4, x + 0.4, color="#e6e6e6", linewidth=0, zorder=0)
        ax.set_yscale("log")
        ax.set_xticks(range(len(settings)), [written for _, written in settings])
        ax.grid(axis="x", visible=False)
        ax.set_title(families.name(method), loc="left", fontweight="bold", color=families.family(method).colour)
        ax.set_title(parameter, loc="right")
        ax.text(0.98, 0.97, naming.words(part), transform=ax.transAxes, ha="right", va="top", fontsize=6)
    entries = [Line2D([], [], label=label, **looks) for _, label, looks in CURVES]
    style.finish(figure, [], caption, entries + [Patch(color="#e6e6e6", label="default")])
    style.save(figure, folder, "method_comparison_parameters")


def draw_ablation(folder, table, caption):
    """What comes before the split, by row, and after it, by column; a panel per measure, its numbers in the cells."""
    measures = [("largest eigenvalue / uncut", lambda rows: median_of(rows, "eigenvalue_ratio"), "{:.3g}", LogNorm(1, 1e4)),
                ("cuts with AR < 3", below_three, "{:.0%}", Normalize(0, 1)),
                ("vertices per crossed tri.", lambda rows: median_of(rows, "vertices_per_crossed"), "{:.2f}",
                 Normalize(0, 3)),
                ("µs per crossed triangle", lambda rows: median_of(rows, "us_per_crossed"), "{:.2g}", LogNorm(0.3, 10))]
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
