"""The figure of errors against the shape of the triangles that a cut left."""

from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

from analysis import naming
from analysis.accuracy.shape import but_programs, decades, of_harness, shape_columns, shape_statements
from analysis.load import of
from figures.common import style


def shape_figure(records):
    """A row per sheet: error ratio over the largest aspect ratio the cut left, every case in plane a dot."""
    records = records.in_plane().ranked()
    columns = shape_columns(records)
    figure, axes = style.panels(len(records.sheets), len(columns), 3.2, sharex=True, sharey=True)
    for row, sheet in zip(axes, records.sheets):
        for ax, (title, condition) in zip(row, columns):
            here = records.rows(sheet=sheet, **condition)
            for variant, look in records.methods.items():
                dots = of(here, variant).dropna(subset=["ratio", "ar_max_cut"])
                ax.plot(dots["ar_max_cut"], dots["ratio"], linestyle="", marker="o",
                        markersize=1.8 if look.program else 1.3, markeredgewidth=0, color=look.colour,
                        alpha=0.9 if look.program else 0.45, zorder=3 if look.program else 2, rasterized=True)
            bins = decades(of_harness(records, here))
            ax.plot(bins.index, bins["ratio"], color="#c00000", linewidth=1.1, marker="_", markersize=4, zorder=4)
            ax.axhline(1, color="#111111", linewidth=0.5, zorder=1)
            ax.set_xscale("log")
            ax.set_yscale("log")
            ax.set_title(title if sheet == records.sheets[0] else "", fontsize=6.3)
        row[0].set_ylabel(f"{naming.sheet_title(sheet)}\nerror / fitted mesh's", fontsize=6)
    for ax in axes.flat:
        ax.xaxis.set_major_locator(LogLocator(numticks=4))
        ax.xaxis.set_minor_formatter(NullFormatter())
        style.plain_numbers(ax)
    for ax in axes[-1]:
        ax.set_xlabel("max AR of the cut")
    dots = [Line2D([], [], linestyle="", marker="o", markersize=3, color=look.colour, label=look.label)
            for look in records.methods.values()]
    line = Line2D([], [], color="#c00000", linewidth=1.1, label="median per decade of AR")
    style.finish(figure, [], records.caption(
        "Error over the fitted mesh's (direct solver), against the largest aspect ratio that the cut left. Plane problems, a dot for "
        "each case; the aspect ratio is of the triangles that the cut made or changed. "
        f"{but_programs(records)}"
        f"{' '.join(shape_statements(records))} {naming.AR_DEFINITION}"), [*dots, line])
    return figure
