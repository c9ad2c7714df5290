#!/usr/bin/env python3
"""Table 1 of the paper. Its geometry column: what a cut costs over the resolution of the sheet, in all and per crossed
triangle, beside the paper's wording taken literally (every edge of the mesh tested against the path). Its solver and
total columns: the same inside a running simulation, with the update and the first step after the cut."""

import sys
from pathlib import Path

import pandas as pd
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming
from analysis.paper.table1_timing import (
    IN_MOTION, MEASURES, PHASES, STEM, Timings, in_motion, label, motion_statements, other_sheets, print_motion,
    print_numbers, published, statements)
from figures.common import style


def time_figure(timings, paper, others):
    looks = naming.looks_of(timings.run, timings.variants)
    figure, (upper, lower) = style.panels(2, 1, 5.2, subplot_kw={"yscale": "log"})
    upper, lower = upper[0], lower[0]
    for variant, look in looks.items():
        for ax, column in ((upper, "geometry_us"), (lower, "ns_per_crossed")):
            table = load.quartiles(timings.of(variant), "resolution", column)
            style.curve(ax, look, table)
    style.resolution_axis(upper, timings.resolutions, "log", labelled=False)
    style.resolution_axis(lower, timings.resolutions, "log")
    draw_paper(upper, paper)
    upper.set_ylabel("geometry of a cut, µs")
    lower.set_ylabel("per crossed triangle, ns")
    for ax in (upper, lower):
        style.plain_numbers(ax)
    style.failures([upper], [timings.run], looks)
    repetitions = timings.run.rows["repetition"].nunique()
    style.finish(figure, looks.values(), " ".join([
        f"Time of the geometry of a cut on {naming.sheet_title(timings.sheet)}, {timings.cache} caches. Line: median of the cuts; "
        f"band: quartiles. The geometry is {', '.join(PHASES).replace('_us', '')}; of {repetitions} repetitions the median is taken. "
        f"'Every edge tested' finds the crossings but does not cut.",
        *statements(timings, paper), *others, naming.provenance(timings.run, timings.cuts, with_machine=True)]))
    return figure


def draw_paper(ax, paper):
    low, high = ax.get_xlim()
    shown = paper[(paper.index >= low) & (paper.index <= high)]
    if len(shown):
        ax.plot(shown.index, shown, color="#b07aa1", marker="*", linestyle="-.", markersize=4.5, linewidth=0.8)
        ax.annotate("the paper's Table 1: other CPU (i7-4790S),\nunknown cut length, local split included",
                    (low, 1.5 * shown.max()), (3, 0), textcoords="offset points", va="bottom", fontsize=6,
                    color="#8c4f7c")
        ax.set_ylim(top=6 * shown.max())


def sheets_figure(run, timings):
    """The cost per crossed triangle, a panel per sheet."""
    variants = set().union(*(t.variants for t in timings))
    looks = naming.looks_of(run, variants)
    figure, axes = style.sheet_panels([t.sheet for t in timings], run.everything()["resolution"], "sqrt",
                                      "ns per crossed triangle")
    for ax, t in zip(axes, timings):
        for variant, look in looks.items():
            style.curve(ax, look, load.quartiles(t.of(variant), "resolution", "ns_per_crossed"))
    style.plain_numbers(axes[0])
    style.failures(axes, [t.run for t in timings], looks)
    style.finish(figure, looks.values(), " ".join([
        "Time of the geometry per crossed triangle on every sheet. Line: median of the cuts; band: quartiles. Of the repetitions "
        "the median is taken.", naming.provenance(run, pd.concat([t.cuts for t in timings]), with_machine=True)]))
    return figure


def phases_figure(timings):
    """Stacked phases per crossed triangle at the lowest and the highest resolution; None if no method has phases."""
    cuts = timings.cuts.dropna(subset=list(PHASES), how="all")
    looks = naming.looks_of(timings.run, set(zip(cuts["method"], cuts["parameter"])))
    resolutions = sorted({cuts["resolution"].min(), cuts["resolution"].max()}) if len(cuts) else []
    if not resolutions:
        return None
    figure, axes = style.panels(len(resolutions), 1, 0.55 * len(looks) + 1.4, sharex=True)
    for ax, resolution in zip(axes.flat, resolutions):
        for y, variant in enumerate(looks):
            draw_phases(ax, y, timings.of(variant, resolution, cuts))
        ax.set_title(f"{resolution} triangles", loc="left")
        ax.set_yticks(range(len(looks)), [look.label + look.share for look in looks.values()])
        ax.set_ylim(len(looks) - 0.4, -0.6)
        ax.grid(visible=False, axis="y")
    axes.flat[-1].set_xlabel("ns per crossed triangle")
    patches = [Patch(color=colour, label=phase[:-3]) for phase, colour in PHASES.items()]
    style.finish(figure, [], " ".join([
        f"Time of a cut by phase on {naming.sheet_title(timings.sheet)}, {timings.cache} caches. Bars: median of the cuts "
        "for each phase. Black: median and quartiles of the total.",
        naming.provenance(timings.run, cuts, with_machine=True, with_crosses=False)]), patches)
    return figure


def draw_phases(ax, y, cuts):
    """One stacked bar and the whole's median and quartiles."""
    if cuts.empty:
        ax.annotate("no cut succeeded", (0, y), (3, 0), textcoords="offset points", va="center", fontsize=6)
        return
    per_crossed = 1000 * cuts[list(PHASES)].div(cuts["crossed_triangles"], axis=0)
    left = 0.0
    for phase, width in per_crossed.median().fillna(0).items():
        ax.barh(y, width, left=left, height=0.62, color=PHASES[phase], linewidth=0)
        left += width
    q1, median, q3 = cuts["ns_per_crossed"].quantile([0.25, 0.5, 0.75])
    ax.errorbar(median, y, xerr=[[median - q1], [q3 - median]], color="black", marker="|", markersize=6, capsize=1.5,
                linewidth=0.8)


CURVES = {  # of the figure in motion: label, colour, marker, the paper's column beside it
    "geometry_us": ("geometry", "#0072b2", "o", "geometry_ms"),
    "update_us": ("update: transfer, pattern", "#009e73", "s", "solver_ms"),
    "bending_us": ("update: bending", "#8fcfb5", "D", None),
    "step_us": ("first step: rotate, assemble, setup, solve", "#d55e00", "^", None),
    "total_us": ("all of it", "#222222", "P", "total_ms"),
}
PAPERS = dict(markerfacecolor="white", linestyle="-.", markersize=3, linewidth=0.7)  # the column beside it


def motion_figure(run, sheet):
    """What a cut costs inside the running simulation, beside all three columns of the paper's table."""
    cuts = in_motion(run, sheet)
    variants = [v for v in naming.looks(set(zip(cuts["method"], cuts["parameter"])))
                if v in (("bowyer_watson", "rounds=0"), ("bowyer_watson", "rounds=1"))]
    if cuts.empty or not variants:
        return None
    figure, axes = style.panels(len(variants), 1, 5.0, subplot_kw={"yscale": "log"}, sharey=True)
    legend = []
    for ax, variant in zip(axes.flat, variants):
        here = cuts[(cuts["method"] == variant[0]) & (cuts["parameter"] == variant[1])]
        for column, (name, colour, marker, beside) in CURVES.items():
            look = naming.Look(name, colour, marker)
            table = load.quartiles(here, "resolution", column)
            style.curve(ax, look, table.assign(**table[["q1", "median", "q3"]] / 1000))
            if ax is axes.flat[0]:
                legend.append(look)
            if beside:
                paper = published(beside) / 1000
                ax.plot(paper.index, paper, **PAPERS, color=colour, marker=marker, zorder=2)
        ax.set_title(label(variant), loc="left")
        ax.set_ylabel("ms")
        style.resolution_axis(ax, cuts["resolution"], "log", labelled=ax is axes.flat[-1])
    for ax in axes.flat:
        style.plain_numbers(ax)
    style.finish(figure, legend, " ".join([
        f"A cut inside the running simulation on {naming.sheet_title(sheet)}, cold caches. Line: median of the cuts; band: quartiles. "
        "Hollow markers, dash-dotted: the paper's Table 1 (another CPU; cut, material and solver tolerance are unknown). Its "
        "'solver' column is drawn beside the update, which grows in the same way. The first step is one backward Euler step by conjugate "
        "gradients to 1e-2, of experiments/scenes/paper_table1.toml.",
        *motion_statements(cuts), naming.provenance(run, cuts, with_machine=True, with_crosses=False)]),
        [Line2D([], [], **PAPERS, color="#222222", label="dash-dotted: the paper's Table 1")])
    return figure


def main():
    folder = load.results_folder(STEM, __doc__)
    run, paper = load.read(folder, [*MEASURES, *PHASES, *IN_MOTION]), published()
    timings = [Timings(run, sheet) for sheet in naming.sheet_order(run.everything()["sheet"])]
    style.save(time_figure(timings[0], paper, other_sheets(timings[1:])), folder, STEM)
    if len(timings) > 1:
        style.save(sheets_figure(run, timings), folder, f"{STEM}_sheets")
    phases = phases_figure(timings[0])
    if phases:
        style.save(phases, folder, f"{STEM}_phases")
    motion = motion_figure(run, timings[0].sheet)
    if motion:
        style.save(motion, folder, f"{STEM}_in_motion")
    for t in timings:
        print_numbers(t, paper)
        print_motion(run, t.sheet)


if __name__ == "__main__":
    main()
