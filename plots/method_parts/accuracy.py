"""The accuracy figure and table of method_comparison.py: the error of every method's cut sheet against the cost of the
cut, after a direct solve and after a fixed number of iterations of conjugate gradients."""

import numpy as np
import pandas as pd
from matplotlib.lines import Line2D

from accuracy_parts.ranking import at_equal_unknowns, made_by_all, mean_excess, ranked_by
from accuracy_parts.records import Records, log_x_axis, percent_axis, zero_line
from common import style
from common.load import of

STEM = "method_comparison_accuracy"
WHAT = ("error over that of a body-fitted mesh, minus one: of a mesh with as many triangles as the uncut sheet, or with as "
        "many unknowns as the cut sheet; geometric means over the cases that no method failed; the most accurate first")
BUDGET = 100  # iterations of conjugate gradients
MARKERS = ["o", "s", "^", "D", "v", "P"]


def summary(folder):
    """The records, and a row per method, most accurate first: geometric means over problems, sheets, sizes and members,
    of the cases that no method failed; by ranked_by()."""
    records = at_equal_unknowns(Records(folder)).ranked()
    measure = ranked_by(records)
    kept = {"all": records.table} | {sheet: records.rows(sheet=sheet) for sheet in records.sheets}
    common = {sheet: made_by_all(of_methods_there(table)) for sheet, table in kept.items()}
    rows = []
    for variant in records.methods:
        row = {"method": variant[0], "knob": variant[1]}
        for sheet, table in kept.items():
            made = of(common[sheet], variant)
            direct = made[made["direct"]]
            stopped = made[~made["direct"] & (made["budget"] == BUDGET)]
            row[f"excess_percent_{sheet}"] = mean_excess(direct, measure.column)
            row[f"us_per_crossed_{sheet}"] = (direct["cut_us"] / direct["crossed_triangles"]).median()
            if sheet == "all":
                everything = of(table, variant)
                row |= {"cuts": len(everything[everything["direct"]]),
                        "failed": int(everything.loc[everything["direct"], "failed"].sum()),
                        "excess_percent_as_many_triangles": mean_excess(direct, "ratio"),
                        "more_unknowns_percent": 100 * (direct["more"].median() - 1),
                        f"excess_percent_cg_{BUDGET}": mean_excess(stopped, measure.column)}
        rows.append(row)
    table = pd.DataFrame(rows).sort_values("excess_percent_all", kind="stable")
    table.attrs["note"] = measure.note
    return records, table


def of_methods_there(table):
    """Without the methods that refuse a kind of sheet altogether, which would leave no case that all made."""
    key = [table[c] for c in ("method", "knob", "sheet")]
    return table[~table["failed"].groupby(key).transform("all")]


def written(method, programs):
    return method.replace("_", " ") + style.PROGRAM * (method in programs)


def write_names(figure, ax, table, programs):
    """Each method's name at the mean of its sheets, moved up until it covers no other. The limits of the axes must be set."""
    figure.draw_without_rendering()
    taken = []
    for _, row in table.sort_values("excess_percent_all").iterrows():
        text = ax.annotate(written(row["method"], programs), (row["us_per_crossed_all"], row["excess_percent_all"]),
                           xytext=(0, 0), textcoords="offset points", fontsize=5, color="#222222", ha="center",
                           va="center", zorder=5)
        for up in range(5, 45):
            text.set_position((0, up))
            box = text.get_window_extent()
            if not any(box.overlaps(other) for other in taken):
                break
        taken.append(box)


def draw(folder, beside):
    """Left: error against the price of the cut, a small marker per sheet and the name at the mean of all. Right: solved to
    the end, and by a few iterations."""
    records, table = summary(beside)
    measure = ranked_by(records)
    figure, axes = style.panels(1, 2, 9.5, width=style.PAGE)
    left, right = axes[0]
    looks = style.many_looks(table["method"])
    for _, row in table.iterrows():
        colour = looks[row["method"]].colour
        for sheet, marker in zip(records.sheets, MARKERS):
            left.plot(row[f"us_per_crossed_{sheet}"], row[f"excess_percent_{sheet}"], marker, color=colour, markersize=2.2,
                      alpha=0.55, markeredgewidth=0)
        # Where the name goes, so that the limits of the axes include it.
        left.plot(row["us_per_crossed_all"], row["excess_percent_all"], "o", color=colour, markersize=3)
    left.set_xlabel("µs per crossed triangle, the cut alone")
    left.set_ylabel(f"excess error {measure.short}, %")
    order = list(table["method"])
    for i, (_, row) in enumerate(table.iterrows()):
        ends = row["excess_percent_all"], row[f"excess_percent_cg_{BUDGET}"]
        right.plot(ends, (i, i), color="#999999", linewidth=0.8, zorder=1)
        right.plot(-0.015, i, "s", color=looks[row["method"]].colour, markersize=2.5, clip_on=False,
                   transform=right.get_yaxis_transform())
        right.plot(ends[0], i, "o", color="#0072b2", markersize=3.2)
        right.plot(ends[1], i, "D", color="white", markeredgecolor="#d55e00", markeredgewidth=0.8, markersize=3)
    right.set_yticks(range(len(order)), [written(name, records.programs) for name in order], fontsize=5.5)
    right.set_ylim(len(order) - 0.5, -0.5)
    right.tick_params(axis="y", length=0, pad=6)
    right.set_xlabel(f"excess error {measure.short}, %")
    left.margins(x=0.15)  # for the names
    log_x_axis(left)
    percent_axis(left, table["excess_percent_all"])
    zero_line(left)
    write_names(figure, left, table, records.programs)
    right.axvline(0, color="#111111", linewidth=0.6, zorder=0)
    values = np.concatenate([table["excess_percent_all"], table[f"excess_percent_cg_{BUDGET}"]])
    if (values > 100).any():
        right.set_xscale("symlog", linthresh=10, linscale=0.7)
        right.xaxis.set_major_formatter("{x:g}")
    entries = [Line2D([], [], linestyle="", marker=m, color="#666666", markersize=3, label=style.sheet_title(s))
               for s, m in zip(records.sheets, MARKERS)]
    entries.append(Line2D([], [], linestyle="", marker="o", color="#0072b2", markersize=3.2, label="solved directly"))
    stopped = ""
    if table[f"excess_percent_cg_{BUDGET}"].notna().any():
        entries.append(Line2D([], [], linestyle="", marker="D", color="white", markeredgecolor="#d55e00", markersize=3,
                              label=f"{BUDGET} iterations of CG"))
        stopped = f", and after {BUDGET} iterations of conjugate gradients (Jacobi preconditioner)"
    style.finish(figure, [], records.caption(
        "Left: error against the cost of the cut; lower left is better. Large marker, with the name: all sheets; colours are "
        "those beside the names on the right. Excess error: the error of each problem's primary measure over that of "
        f"{measure.fitted}, minus one; geometric means over {len(records.problems)} plane problems, all sizes and members. "
        f"{measure.note}{style.PROGRAM_TIME * bool(records.programs)} Right: the same after a direct solve"
        f"{stopped}."), entries)
    style.save(figure, folder, STEM)
    return table
