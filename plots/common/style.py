"""The style of every figure: one colour, marker and line for each method and parameter, sizes for a column of 8.5 cm, two lines
of the caption below the axes and all of it in a file beside the figure. The same data give the same bytes."""

import re
import zlib
from dataclasses import dataclass

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter

from common.load import VARIANT, count, cut_columns, family_column, stop

WIDTH = 8.5 / 2.54  # inches, of a column
PAGE = 17.4 / 2.54  # of two, and the space between them
CAPTION_SIZE = 7
matplotlib.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 7, "axes.titlesize": 7, "axes.labelsize": 7, "legend.fontsize": 7,
    "xtick.labelsize": 7, "ytick.labelsize": 7, "axes.linewidth": 0.6,
    "axes.grid": True, "grid.color": "#e3e3e3", "grid.linewidth": 0.5,
    "axes.axisbelow": True, "legend.frameon": False,
    "xtick.major.width": 0.6, "ytick.major.width": 0.6, "xtick.minor.width": 0.4, "ytick.minor.width": 0.4,
    "xtick.major.size": 2.5, "ytick.major.size": 2.5, "xtick.minor.size": 1.5, "ytick.minor.size": 1.5,
    "axes.spines.top": False, "axes.spines.right": False, "pdf.fonttype": 42,
})

AR_DEFINITION = ("Aspect ratio AR = longest edge / height on it = l_max² / (2 area): right isosceles 2, "
                 "equilateral 1.155.")


@dataclass(frozen=True)
class Look:
    label: str
    colour: str
    marker: str
    line: str = "-"
    width: float = 1.0  # points; curves drawn first are wider, so that one hidden behind another can still be seen
    program: bool = False  # a program of its own, no method of the harness

    def drawn(self):
        """Keywords for plot()."""
        return dict(color=self.colour, marker=self.marker, linestyle=self.line, linewidth=self.width,
                    markersize=2.2 + self.width, markeredgewidth=0.3, markeredgecolor="white")


KNOWN = {  # in the order of the legend
    ("conventional_split", ""): Look("conventional split", "#444444", "s", width=2.4),
    ("bowyer_watson", "rounds=0"): Look("Bowyer-Watson, rounds=0", "#56b4e9", "o", width=2.1),
    ("bowyer_watson", "rounds=1"): Look("Bowyer-Watson, rounds=1", "#0072b2", "^"),
    ("bowyer_watson", "rounds=3"): Look("Bowyer-Watson, rounds=3", "#0b2f66", "v"),
    ("cgal_cdt", ""): Look("CGAL CDT", "#d55e00", "D"),
    ("body_fitted (reference)", ""): Look("body-fitted mesh (reference)", "#111111", "*", "--"),
    ("every_edge", ""): Look("every edge tested", "#8a8a8a", "h", ":"),
}
PROGRAM = " (program)"
PROGRAM_TIME = (" The time of a program is that of its process, from start to end unless it reports its own, not of the "
                "geometry with warm caches.")
FREE_COLOURS = ["#009e73", "#cc79a7", "#e69f00", "#7b3294", "#8c564b", "#b2182b", "#66a61e", "#01665e"]
FREE_MARKERS = ["P", "X", "<", ">", "p", "H", "d", "8"]
SHEETS = {"grid": "the paper's grid", "alternating": "alternating", "delaunay": "Delaunay", "graded": "graded"}


def looks(variants, programs=()):
    """The Look of each (method, parameter), in the order of the legend; those whose method is one of `programs` say so. A method
    that KNOWN does not name gets the free colour its name hashes to (the next one if another method of this figure has
    it), its parameters lighter shades of it."""
    chosen = {v: look for v, look in KNOWN.items() if v in variants}
    unknown = sorted(set(variants) - set(KNOWN), key=lambda v: (v[0], natural(v[1])))
    colours = {method: look.colour for (method, _), look in reversed(KNOWN.items())}
    names = {method: look.label.partition(",")[0] for (method, _), look in KNOWN.items()}
    for method in dict.fromkeys(method for method, _ in unknown):
        if method not in colours:
            slot = zlib.crc32(method.encode())
            some_free = not set(FREE_COLOURS) <= set(colours.values())
            while some_free and FREE_COLOURS[slot % len(FREE_COLOURS)] in colours.values():
                slot += 1
            colours[method] = FREE_COLOURS[slot % len(FREE_COLOURS)]
        for i, (_, parameter) in enumerate(v for v in unknown if v[0] == method):
            label = names.get(method, method.replace("_", " ")) + (f", {parameter}" if parameter else "")
            label += PROGRAM * (method in programs)
            marker = FREE_MARKERS[(zlib.crc32(method.encode()) + i) % len(FREE_MARKERS)]
            line = ("-", "--", "-.", ":")[(i + any(m == method for m, _ in KNOWN)) % 4]
            chosen[method, parameter] = Look(label, lighter(colours[method], min(0.25 * i, 0.6)), marker, line,
                                        program=method in programs)
    return chosen


def natural(parameter):
    """Sorts rounds=2 before rounds=10."""
    name, _, value = parameter.partition("=")
    try:
        return name, float(value), value
    except ValueError:
        return name, 0.0, value


def lighter(colour, share):
    return matplotlib.colors.to_hex(np.array(to_rgb(colour)) * (1 - share) + share)


def sheet_order(sheets):
    """The paper's grid first, then by SHEETS, then the rest by name."""
    return [s for s in SHEETS if s in set(sheets)] + sorted(set(sheets) - set(SHEETS))


def sheet_title(sheet):
    return SHEETS.get(sheet, sheet)


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
    return Line2D([], [], label=look.label, **drawn)


def provenance(run, cases, with_machine=False, with_crosses=True, per=("sheet", "resolution")):
    """The sentences at the end of every caption. `cases`: the table of the cuts drawn; those with equal variant and `per`
    make one point."""
    context = run.context
    made = cases.drop_duplicates(VARIANT + cut_columns(cases)).groupby(VARIANT + list(per)).size()
    n = "0" if made.empty else str(made.min()) if made.min() == made.max() else f"{made.min()} to {made.max()}"
    everything = run.everything()
    refused = run.failed["status"] == "refused"
    failed = count(run.failed[(run.failed["verdict"] != "ok") | (run.failed["status"] == "failed")])  # in some row
    commit = str(context.get("commit") or "unknown")[:10]
    state = {True: " with uncommitted changes", None: " (state of the tree unknown)"}.get(context.get("dirty"), "")
    families = ", ".join(sorted(set(everything[family_column(everything)])))
    text = [f"n = {n} cuts per point ({families}); {failed} of {count(everything)} cuts failed"
            + (f", {count(run.failed[refused])} refused" if refused.any() else "") + (" (×, with their number)." if len(run.failed) and with_crosses else "."),
            f"Seed {context.get('seed', ', '.join(sorted(set(everything['seed']))))}, commit {commit}{state}."]
    if with_machine:
        text.append(f"{context.get('cpu', 'unknown CPU')}; {context.get('compiler', 'unknown compiler')} "
                    f"{context.get('flags', '')}, one thread.")
    return " ".join(text + [f"Command: {context.get('command', 'unknown')}"])


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
    """Writes folder/stem.pdf and .png (300 dpi), the whole caption to stem.caption.txt, and prints where."""
    if figure.get_label():
        try:
            (folder / f"{stem}.caption.txt").write_text(f"{figure.get_label()}\n", encoding="utf-8")
        except OSError as error:
            stop(f"{folder / stem}.caption.txt can't be written: {error.strerror}")
    for suffix, metadata in (("pdf", {"CreationDate": None}), ("png", {"Software": None})):
        path = folder / f"{stem}.{suffix}"
        try:
            figure.savefig(path, dpi=300, metadata=metadata)
        except OSError as error:
            stop(f"{path} can't be written: {error.strerror}")
        print(path)
    plt.close(figure)
