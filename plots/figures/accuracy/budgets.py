"""A fixed number of iterations of conjugate gradients against the direct solve."""

from analysis import naming
from analysis.accuracy.records import cells_of
from analysis.load import of
from figures.accuracy.axes import label_edges, log_x_axis, percent_axis, zero_line
from figures.common import front, style


def write_iterations(figure, curves):
    """Beside the points of each (panel, points, look), where the number covers no other. The limits must be set."""
    figure.draw_without_rendering()
    taken = []
    for ax, points, look in curves:
        for _, p in points.iterrows():
            text = ax.annotate(f"{p['budget']:.0f}", (p["x"], p["y"]), xytext=(3.5, 0.5), textcoords="offset points",
                               fontsize=4.2, color=look.colour, zorder=5)
            box = text.get_window_extent()
            if any(box.overlaps(other) for other in taken):
                text.remove()
            else:
                taken.append(box)


def budgets_figure(records):
    """A row per sheet, a column per solver: excess error over time at the highest resolution with an ensemble, a point per
    budget."""
    if not records.budgets:
        return None
    records = records.in_plane().ranked()
    members = records.table.groupby("resolution")["case"].nunique()
    top = members[members >= min(2, members.max())].index.max()
    records = records.with_rows(records.rows(resolution=top))
    table = records.table
    figure, axes = style.panels(len(records.sheets), len(records.solvers), 3.7, sharex=True, sharey=True)
    everything, numbered = [], []
    for row, sheet in zip(axes, records.sheets):
        for ax, solver in zip(row, records.solvers):
            here = table[(table["sheet"] == sheet) & (table["direct"] | (table["solver"] == solver))]
            cells = cells_of(here, "ms", "excess_percent", ["method", "parameter", "budget"])
            everything += list(cells["y"])
            for variant, look in records.looks.items():
                points = of(cells, variant).sort_values("budget")
                front.draw(ax, points[points["budget"] > 0], look)
                if look.program or variant == next(iter(records.looks)):
                    numbered.append((ax, points[(points["budget"] > 0) & (points["layer"] > 0)], look))
                done = points[(points["budget"] == 0) & (points["layer"] > 0)]
                ax.plot(done["x"], done["y"], linestyle="", marker=look.marker, markersize=4.5, markeredgewidth=0.9,
                        markerfacecolor="none", markeredgecolor=look.colour, zorder=4)
            front.draw_front(ax, cells)
            front.draw_failures(ax, cells, records.looks)
            zero_line(ax)
            log_x_axis(ax)
            ax.set_title(solver.replace("_", " ") if sheet == records.sheets[0] else "", loc="left")
    for ax in axes.flat:
        percent_axis(ax, everything)
    write_iterations(figure, numbered)
    label_edges(axes, "total time, ms", "")
    for row, sheet in zip(axes, records.sheets):
        row[0].set_ylabel(f"{naming.sheet_title(sheet)}\nexcess error, %")
    style.finish(figure, records.looks.values(), records.caption(
        f"Excess error at {top} triangles, by conjugate gradients (filled markers) and by a direct solver (hollow). "
        f"Conjugate gradients start from zero and end after {', '.join(map(str, records.budgets))} iterations. "
        "Preconditioner: the diagonal block of each vertex (cg), or joint blocks of the vertices round slivers (cg sliver "
        "blocks). Beside the markers of the first method, and of programs: the iterations, where there is room. Marker: "
        "median over problems and ensembles; bars: quartiles."), front.legend_entries(records.looks.values()))
    return figure
