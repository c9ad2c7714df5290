"""The style of every figure: sizes for a column of 8.5 cm, axes, two lines of the caption below them and all of it in a file beside
the figure. The same data give the same bytes."""

import io
import re

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter
from PIL import Image

from analysis.load import count, stop
from analysis.naming import sheet_title

matplotlib.use("Agg")

WIDTH = 8.5 / 2.54  # inches, of a column
PAGE = 17.4 / 2.54  # of two, and the space between them
CAPTION_SIZE = 7
DPI, COLOURS = 150, 64  # of a PNG: PAGE is as wide as a page of text on a screen
matplotlib.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 7, "axes.titlesize": 7, "axes.labelsize": 7, "legend.fontsize": 7,
    "xtick.labelsize": 7, "ytick.labelsize": 7, "axes.linewidth": 0.6,
    "axes.grid": True, "grid.color": "#e3e3e3", "grid.linewidth": 0.5,
    "axes.axisbelow": True, "legend.frameon": False,
    "xtick.major.width": 0.6, "ytick.major.width": 0.6, "xtick.minor.width": 0.4, "ytick.minor.width": 0.4,
    "xtick.major.size": 2.5, "ytick.major.size": 2.5, "xtick.minor.size": 1.5, "ytick.minor.size": 1.5,
    "axes.spines.top": False, "axes.spines.right": False, "pdf.fonttype": 42,
})


def panels(rows, columns, height, width=WIDTH, **shared):
    """A figure with `rows` x `columns` axes, each `height` cm high with its labels."""
    figure, axes = plt.subplots(rows, columns, figsize=(width, rows * height / 2.54), squeeze=False, **shared)
    return figure, axes


def sheet_panels(sheets, resolutions, scale, label):
    """A panel per sheet family, two beside each other, on one y axis: the figure, its axes in the order of `sheets`."""
    columns = min(2, len(sheets))
    rows = -(-len(sheets) // columns)
    figure, axes = panels(rows, columns, 4.1 if columns > 1 else 5.5, sharey=True, subplot_kw={"yscale": "log"})
    for i, ax in enumerate(axes.flat):
        ax.set_visible(i < len(sheets))
        if i < len(sheets):
            ax.set_title(sheet_title(sheets[i]))
            resolution_axis(ax, resolutions, scale, labelled=i + columns >= len(sheets))
            ax.set_ylabel("" if i % columns else label)
    return figure, list(axes.flat)[:len(sheets)]


def curve(ax, look, table):
    """Median line and quartile band of load.quartiles(), which may be empty; a single point gets a bar."""
    if table.empty:
        return
    ax.plot(table.index, table["median"], zorder=3, **look.drawn())
    if len(table) > 1:
        ax.fill_between(table.index, table["q1"], table["q3"], color=look.colour, alpha=0.15, linewidth=0, zorder=1)
    else:
        ax.vlines(table.index, table["q1"], table["q3"], color=look.colour, linewidth=3, alpha=0.3, zorder=1)


def failures(axes, runs, looks):
    """At the top of each panel, a row for each method that failed anywhere: a cross at the resolution and the number of
    failed cuts. Call it last: it raises the upper limit of the logarithmic y axis, which all panels must share."""
    failed = {(method, parameter): look for (method, parameter), look in looks.items()
              if any(len(run.select(method=method, parameter=parameter).failed) for run in runs)}
    if not failed:
        return
    row = 0.26 / 2.54 / axes[0].get_window_extent().height * axes[0].figure.dpi  # 0.26 cm, as part of the panel
    low, high = np.log10(axes[0].get_ylim())
    axes[0].set_ylim(top=10 ** (low + (high - low) / (1 - row * len(failed))))
    for ax, run in zip(axes, runs):
        for i, ((method, parameter), look) in enumerate(failed.items()):
            for resolution, cuts in run.select(method=method, parameter=parameter).failed.groupby("resolution"):
                place = dict(xy=(resolution, 1 - row * (i + 0.5)), xycoords=ax.get_xaxis_transform(), va="center",
                             textcoords="offset points", color=look.colour, annotation_clip=False)
                ax.annotate("×", xytext=(0, 0), ha="center", fontsize=7, **place)
                ax.annotate(str(count(cuts)), xytext=(2.6, 0), ha="left", fontsize=4.8, **place)


def resolution_axis(ax, resolutions, scale="sqrt", labelled=True):
    """A tick at every resolution, a number where there is room for one. On the "sqrt" scale sheets of n x n squares, and
    with them the triangles that a cut crosses, are evenly spaced; "log" makes powers straight."""
    to_axis, back = {"sqrt": (np.sqrt, np.square), "log": (np.log, np.exp)}[scale]
    ax.set_xscale("function", functions=(lambda x: to_axis(np.maximum(x, 1e-9)), back))
    resolutions = sorted(set(resolutions))
    first, last = to_axis(resolutions[0]), to_axis(resolutions[-1])
    span = (last - first) or 0.5 * last
    ax.set_xlim(back(first - 0.07 * span), back(last + 0.07 * span))
    gap = span * (0.3 if ax.get_subplotspec().get_gridspec().ncols > 1 else 0.13)
    shown = [resolutions[0]]
    for r in resolutions[1:]:
        if to_axis(r) - to_axis(shown[-1]) >= gap and (r == resolutions[-1] or last - to_axis(r) >= gap):
            shown.append(r)
    ax.xaxis.set_major_locator(FixedLocator(shown))
    ax.xaxis.set_minor_locator(FixedLocator([r for r in resolutions if r not in shown]))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:.0f}"))
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.tick_params(labelbottom=labelled)
    if labelled:
        ax.set_xlabel("triangles, uncut sheet")


def decade_ticks(low, high, most=5):
    """At most `most` round numbers on a logarithmic axis, evenly over its decades; none on a very short one."""
    first, last = int(np.floor(np.log10(low))), int(np.ceil(np.log10(high)))
    for parts in ((1, 1.5, 2, 3, 5, 7), (1, 2, 3, 5), (1, 2, 5), (1, 3), (1,)):
        ticks = [p * 10.0**d for d in range(first, last + 1) for p in parts if low <= p * 10.0**d <= high]
        if len(ticks) <= most:
            return ticks
    return ticks[::-(-len(ticks) // most)]


def plain_numbers(ax, axis="y", most=5):
    """On a logarithmic axis whose limits are set: round numbers without exponents."""
    ruled = ax.yaxis if axis == "y" else ax.xaxis
    ruled.set_major_locator(FixedLocator(decade_ticks(*(ax.get_ylim() if axis == "y" else ax.get_xlim()), most)))
    ruled.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ruled.set_minor_formatter(NullFormatter())


def legend_entry(look):
    drawn = look.drawn()
    if look.marker == "*":  # looks smaller than others of its size
        drawn |= dict(markersize=drawn["markersize"] + 2.5, markeredgecolor=look.colour)
    return Line2D([], [], label=look.label + look.share, **drawn)


def finish(figure, looks_drawn, caption, extra=()):
    """Puts the legend above the panels and the caption's beginning below, and makes the figure higher by their heights."""
    renderer, (width, height) = figure.canvas.get_renderer(), figure.get_size_inches()
    text = figure.text(0.05 / width, 0, "\n".join(two_lines(figure, caption, width - 0.1)), fontsize=CAPTION_SIZE,
                       va="bottom", linespacing=1.2, parse_math=False, in_layout=False)
    caption_height = text.get_window_extent(renderer).height / figure.dpi + 0.08
    handles = [legend_entry(look) for look in looks_drawn] + list(extra)
    for columns in range(8, 0, -1):
        legend = figure.legend(handles=handles, loc="upper center", ncol=columns, handlelength=2.1, columnspacing=1.2,
                               handletextpad=0.5, borderaxespad=0.2)
        box = legend.get_window_extent(renderer)
        if box.width / figure.dpi <= width or columns == 1:
            break
        legend.remove()
    total = height + caption_height + box.height / figure.dpi + 0.04
    figure.set_size_inches(width, total)
    text.set_y(0.04 / total)
    figure.set_layout_engine("constrained", rect=(0, caption_height / total, 1, height / total), h_pad=0.03, w_pad=0.03)
    figure.draw_without_rendering()
    figure.set_layout_engine("none")  # so that the PDF and the PNG have the same layout


def two_lines(figure, caption, width):
    """The first sentences of a caption, those that fit into two lines of at most `width` inches; an ellipsis ends a first
    sentence that does not. save() writes the whole caption to a file."""
    figure.set_label(caption)
    sentences = re.split(r"(?<=[.;]) (?=[A-Z×])", caption)
    for n in range(len(sentences), 0, -1):
        lines = wrapped(figure, " ".join(sentences[:n]), width)
        if len(lines) <= 2:
            return lines
    return [lines[0], lines[1].rpartition(" ")[0] + " …"]


def wrapped(figure, text, width):
    """Lines of at most `width` inches in the caption's font; a longer word is broken."""
    renderer = figure.canvas.get_renderer()
    font = matplotlib.font_manager.FontProperties(size=CAPTION_SIZE)

    def fits(line):
        return renderer.get_text_width_height_descent(line, font, False)[0] / figure.dpi <= width

    lines = [""]
    for word in text.split():
        if lines[-1] and not fits(f"{lines[-1]} {word}"):
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
        while not fits(lines[-1]):
            cut = next(i for i in range(len(lines[-1]) - 1, 0, -1) if fits(lines[-1][:i]))
            lines[-1:] = [lines[-1][:cut], lines[-1][cut:]]
    return lines


def save(figure, folder, stem):
    """Writes folder/stem.pdf and .png, the whole caption to stem.caption.txt, and prints where."""
    if figure.get_label():
        try:
            (folder / f"{stem}.caption.txt").write_text(f"{figure.get_label()}\n", encoding="utf-8")
        except OSError as error:
            stop(f"{folder / stem}.caption.txt can't be written: {error.strerror}")
    path = folder / f"{stem}.pdf"
    try:
        figure.savefig(path, metadata={"CreationDate": None})
    except OSError as error:
        stop(f"{path} can't be written: {error.strerror}")
    print(path)
    write_png(figure, folder / f"{stem}.png")


def write_png(figure, path):
    """Writes a figure in the resolution of a page and few colours, a sixth of the bytes of one for print, which the PDF is; closes
    it and prints where."""
    picture = io.BytesIO()
    figure.savefig(picture, dpi=DPI)
    plt.close(figure)
    try:
        few = Image.open(picture).convert("RGB").quantize(COLOURS, Image.Quantize.MAXCOVERAGE, kmeans=2, dither=Image.Dither.NONE)
        few.save(path, "PNG", optimize=True)
    except OSError as error:
        stop(f"{path} can't be written: {error.strerror}")
    print(path)
