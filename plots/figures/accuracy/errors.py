"""The figure of errors: a panel for each sheet."""

from analysis import naming
from analysis.accuracy.errors import points, throughout
from analysis.load import of
from figures.accuracy.axes import label_edges, log_x_axis
from figures.common import front, style


def error_figure(records, x, label):
    """A panel per sheet: error of the direct solve over `x`, a point per resolution."""
    records = throughout(records.in_plane().ranked())
    cells = points(records, x)
    columns = min(2, len(records.sheets))
    figure, axes = style.panels(-(-len(records.sheets) // columns), columns, 5.2, width=style.PAGE, sharex=True, sharey=True)
    for ax in axes.flat[len(records.sheets):]:
        ax.set_visible(False)
    for sheet, ax in zip(records.sheets, axes.flat):
        here = cells[cells["sheet"] == sheet]
        for variant, look in records.looks.items():
            front.draw(ax, of(here, variant).sort_values("resolution"), look)
        front.draw_failures(ax, here, records.looks)
        log_x_axis(ax)
        ax.set_yscale("log")
        style.plain_numbers(ax)
        ax.set_title(naming.sheet_title(sheet), loc="left")
    label_edges(axes, label, "relative error, %")
    style.finish(figure, records.looks.values(), records.caption(
        f"Error of a cut sheet's solution against {label.partition(',')[0]}, a marker for each size of the sheet: lower left is "
        f"better. Geometric mean over {len(records.problems)} plane problems, solved directly. The error is the relative one of each "
        "primary measure, over the cases that no method failed. Bars: quartiles over the cases, and the 95 % interval of the error "
        "over the fitted mesh's, by drawing the problems anew. The time (cut, assembly, solve) of the fitted mesh includes meshing the "
        "whole sheet. ×: failed/tried."))
    return figure
