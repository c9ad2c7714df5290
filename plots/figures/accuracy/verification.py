#!/usr/bin/env python3
"""Verification, not a ranking: energies and stress intensities extrapolated to h = 0 are compared with the exact ones, and
rates of convergence with the expected ones, for all methods that promise the exact incision and with the direct solver. This
checks the code, not the methods."""

import contextlib
import io
import sys
from pathlib import Path

import numpy as np
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter, NullLocator

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming
from analysis.accuracy.records import Records
from analysis.accuracy.verification import ROUNDING, STEM, WITHIN, WITHIN_FIT, findings, print_findings, tolerance
from analysis.load import of
from figures.accuracy.axes import label_edges
from figures.common import style


def spaced(values):
    """Those of the ascending values that are a factor 1.4 apart."""
    kept = []
    for value in values:
        if not kept or value >= 1.4 * kept[-1]:
            kept.append(value)
    return kept


def figure_of(records, table):
    """A panel per problem: error of the primary measure over the resolution, with the fitted rates."""
    problems = [p for p in records.problems if p in set(table["problem"])]
    columns = min(4, len(problems))
    figure, axes = style.panels(-(-len(problems) // columns), columns, 3.9, sharex=True, width=style.PAGE)
    for i, ax in enumerate(axes.flat):
        ax.set_visible(i < len(problems))
    direct = records.rows(direct=True, failed=False)
    for problem, ax in zip(problems, axes.flat):
        here = direct[(direct["problem"] == problem) & (direct["exact_incision"] == 1)]
        primary = here["primary"].iloc[0]
        for variant, look in records.methods.items():
            rows = of(here, variant)
            rows = rows[rows["error"] > 0]
            means = np.exp(np.log(rows["error"]).groupby(rows["resolution"]).mean())
            ax.plot(np.sqrt(means.index / 2), means, **look.drawn())
        rates = table[(table["problem"] == problem) & (table["measure"] == primary)]["rate"].dropna()
        found = sorted({f"{r:.2f}" for r in (rates.min(), rates.max())}) if len(rates) else []
        exact = not found or here["error"].median() < ROUNDING
        text = "exact but for round-off" if exact else f"rate {'–'.join(found)}"
        ax.text(0.05, 0.87 if exact else 0.07, text, transform=ax.transAxes, fontsize=5.6)
        ax.set_title(f"{problem}:\n{primary}".replace("_", " "), loc="left", fontsize=5.6)
        ax.set_xscale("log")
        ax.set_yscale("log")
        style.plain_numbers(ax)
        ax.xaxis.set_major_locator(FixedLocator(spaced(np.sqrt(np.array(records.resolutions) / 2))))
        ax.xaxis.set_minor_locator(NullLocator())
        ax.xaxis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
        ax.xaxis.set_minor_formatter(NullFormatter())
    label_edges(axes, "n (squares per side)", "relative error")
    style.finish(figure, records.methods.values(), records.caption(
        "Verification, not a ranking: error of the primary measure over the resolution, direct solver, geometric mean over "
        "sheets and ensemble, for the methods that promise the exact incision. This checks the code."))
    return figure


def extrapolation_figure(records, table):
    """A row per problem and measure: the deviation from exact at h = 0, with its interval, by method."""
    table = table[np.isfinite(table["deviation"])]
    lines = list(dict.fromkeys(zip(table["problem"], table["measure"])))
    figure, axes = style.panels(1, 1, 0.42 * len(lines) + 1)
    ax = axes[0, 0]
    ax.axvspan(-WITHIN, WITHIN, color="#e8f3e8", linewidth=0, zorder=0)
    ax.axvline(0, color="#111111", linewidth=0.6, zorder=1)
    for row, (problem, measure) in enumerate(lines):
        here = table[(table["problem"] == problem) & (table["measure"] == measure)]
        for variant, offset in zip(records.methods, np.linspace(-0.3, 0.3, len(records.methods))):
            for _, found in here[here["variant"] == variant].iterrows():
                look = records.methods[variant]
                ax.hlines(row + offset, found["deviation"] - found["width"], found["deviation"] + found["width"],
                          color=look.colour, linewidth=0.8, zorder=2)
                ax.plot(found["deviation"], row + offset, marker=look.marker, color=look.colour, markersize=2.4,
                        markeredgewidth=0, zorder=3)
        if tolerance(problem) > WITHIN:
            for end in (-tolerance(problem), tolerance(problem)):
                ax.vlines(end, row - 0.5, row + 0.5, color="#7aa87a", linewidth=0.8, zorder=1)
    ax.set_yticks(range(len(lines)), [f"{problem}: {measure}".replace("_", " ") for problem, measure in lines])
    ax.set_ylim(len(lines) - 0.4, -0.6)
    ax.grid(axis="y", visible=False)
    ax.set_xlabel("deviation at h = 0, %")
    style.finish(figure, records.methods.values(), records.caption(
        "Verification, not a ranking: deviation of energies and stress intensities, extrapolated to h = 0, from the exact "
        f"ones. Bars: 95 % intervals. Green: required accuracy, {WITHIN:g} %. Edge cracks are compared with a fit from a "
        f"handbook, which is accurate to {WITHIN_FIT:g} % (short vertical lines)."))
    return figure


def main():
    folder = load.results_folder(STEM, __doc__)
    records = Records(folder)
    table = findings(records)
    if table.empty:
        load.stop(f"{folder / 'records.csv'} has no method with exact incision on two resolutions, solved directly")
    style.save(figure_of(records, table), folder, STEM)
    if np.isfinite(table["deviation"]).any():
        style.save(extrapolation_figure(records, table), folder, f"{STEM}_extrapolated")
    text = io.StringIO()
    with contextlib.redirect_stdout(text):
        print_findings(table)
        print(f"\n{naming.provenance(records.run, records.run.rows, with_crosses=False)}")
    load.write_beside(folder / f"{STEM}.txt", text.getvalue())


if __name__ == "__main__":
    main()
