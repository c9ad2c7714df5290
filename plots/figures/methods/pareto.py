#!/usr/bin/env python3
"""Any two recorded columns against each other, for one cut family or, of accuracy records, one problem. Draws a panel
for each sheet, a curve for each method over the resolutions (and for each solver and budget where the records have them)
and the Pareto front, and prints a ranking."""

import argparse
import difflib
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.lines import Line2D

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming, pareto
from figures.common import front, style

LINES = ["-", "--", ":", "-."]


def nearest(wanted, known, what):
    """Ends the program unless `wanted` is known."""
    if wanted in known:
        return wanted
    close = difflib.get_close_matches(wanted, known, 1, 0)
    load.stop(f'{what} "{wanted}" is not in the records; ' + (f'did you mean "{close[0]}"? ' if close else "") +
              f"There are: {', '.join(sorted(known))}")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--x", required=True, metavar="COLUMN", help="column on the horizontal axis, such as total_us")
    parser.add_argument("--y", required=True, metavar="COLUMN", help="column on the vertical axis, such as excess_error")
    chosen = parser.add_mutually_exclusive_group(required=True)
    chosen.add_argument("--problem", metavar="NAME", help="the problem of accuracy records, such as centre_crack")
    chosen.add_argument("--cut-family", metavar="NAME", help="the cut family of other records, such as curved")
    parser.add_argument("--records", type=Path, metavar="FILE",
                        default=load.REPOSITORY / "results" / "accuracy" / "records.csv",
                        help="context.json is read beside it (default: results/accuracy/records.csv)")
    parser.add_argument("--out", type=Path, metavar="FILE", help="without suffix: .png and .pdf are written (default: "
                        "pareto_NAME_X_Y beside the records)")
    parser.add_argument("--where", action="append", default=[], metavar="COLUMN=VALUE",
                        help="only these rows, such as solver=cholmod; may be repeated")
    parser.add_argument("--maximise", action="append", default=[], metavar="COLUMN", help="larger values of it are better")
    args = parser.parse_args()
    args.column, args.name = ("problem", args.problem) if args.problem else ("cut_family", args.cut_family)
    return args


def chosen_rows(table, args):
    conditions = [(nearest(args.column, table.columns, "the column"), args.name)]
    for text in args.where:
        column, equals, value = text.partition("=")
        if not equals:
            load.stop(f"--where {text}: give COLUMN=VALUE")
        conditions.append((nearest(column, table.columns, "--where: column"), value))
    for column, value in conditions:
        texts = table[column].map(lambda v: v if isinstance(v, str) else f"{v:g}")
        nearest(value, set(texts), f"--{column.replace('_', '-')}" if column == args.column else f"--where: {column}")
        table = table[texts == value]
        if table.empty:
            load.stop(f"no row is left with {', '.join('='.join(c) for c in conditions)}")
    return table


def columns_asked(table, args):
    axes = []
    for flag, column in (("--x", args.x), ("--y", args.y)):
        nearest(column, table.columns, f"{flag}: column")
        if column in load.TEXT + load.TEXT_OF_SOME:
            load.stop(f"{flag}: column {column} holds text; give one of numbers")
        axes.append(pareto.Axis(column, column not in args.maximise))
    for column in args.maximise:
        if column not in (args.x, args.y):
            load.stop(f"--maximise {column}: is neither --x nor --y")
    return axes


def curve_looks(cells, present, run):
    """The Look of each curve: the method's, its line by the solver; and the legend's entries of the solvers."""
    looks = naming.looks_of(run, set(zip(cells["method"], cells["parameter"])))
    solvers = list(dict.fromkeys(cells["solver"])) if "solver" in present else []
    lines = dict(zip(solvers, LINES * len(solvers)))
    entries = [Line2D([], [], color="#777777", linestyle=line, linewidth=0.8, label=solver)
               for solver, line in lines.items()] if len(solvers) > 1 else []
    return looks, lines, entries


def axis_label(axis):
    """That of results/columns.json; a file may have columns that it does not list."""
    return load.axis_label(axis.column) if axis.column in load.columns() else axis.column


def figure_of(cells, run, args, x, y, present):
    sheets = naming.sheet_order(cells["sheet"])
    looks, lines, entries = curve_looks(cells, present, run)
    columns = min(2, len(sheets))
    figure, axes = style.panels(-(-len(sheets) // columns), columns, 4.4 if columns > 1 else 6, sharex=True,
                                sharey=True)
    budgets = sorted(set(cells.get("budget", [])))
    for i, ax in enumerate(axes.flat):
        ax.set_visible(i < len(sheets))
    for i, (sheet, ax) in enumerate(zip(sheets, axes.flat)):
        here = cells[cells["sheet"] == sheet]
        front.scale(ax.set_xscale, cells["x"])
        front.scale(ax.set_yscale, cells["y"])
        ax.set_title(naming.sheet_title(sheet), pad=12 if cells["failed"].any() else None)
        for key, points in here.groupby(["method", "parameter"] + present, sort=False):
            named = dict(zip(["method", "parameter"] + present, key))
            look = looks[named["method"], named["parameter"]]
            if len(lines) > 1:
                look = replace(look, line=lines[named["solver"]])
            size = 0.7 + 0.6 * budgets.index(named["budget"]) / max(1, len(budgets) - 1) if "budget" in named else 1
            front.draw(ax, points.sort_values("resolution"), look, size)
        if ax.get_yscale() == "log":
            style.plain_numbers(ax)
        front.draw_front(ax, here)
        front.draw_failures(ax, here, looks)
        ax.set_xlabel(axis_label(x) if i + columns >= len(sheets) else "")
        ax.set_ylabel("" if i % columns else axis_label(y))
    where = f" Rows with {', '.join(args.where)}." if args.where else ""
    more = " Larger markers: more iterations (0: direct solve)." if len(budgets) > 1 else ""
    style.finish(figure, looks.values(), " ".join([
        f"{args.name}: {axis_label(y)} against {axis_label(x)}. Marker: median of the ensemble at one resolution; bars: "
        f"quartiles. A failed case counts as infinitely bad (×: failed/tried).{where}{more}",
        naming.provenance(run, run.rows, with_machine="_us" in x.column + y.column, with_crosses=False)]),
        front.legend_entries(looks.values()) + entries)
    return figure


def print_ranking(cells, x, y, present):
    """The best first: by front, then from left to right."""
    for sheet in naming.sheet_order(cells["sheet"]):
        here = cells[cells["sheet"] == sheet].assign(order=lambda t: t["layer"].replace(0, np.inf))
        rows = []
        for _, p in here.sort_values(["order", "x"]).iterrows():
            name = naming.looks([(p["method"], p["parameter"])])[p["method"], p["parameter"]].label
            rows.append([str(p["layer"] or "-"), name, *(str(p[c]) for c in present), str(int(p["resolution"])),
                         p["x"], p["x_q1"], p["x_q3"], p["y"], p["y_q1"], p["y_q3"], str(p["n"]), str(p["failed"])])
        load.print_table(f"{y.column} against {x.column}, {sheet}: front 1 is beaten by none in both",
                         ["front", "method", *present, "triangles", x.column, "q1", "q3", y.column, "q1", "q3", "cases",
                          "failed"], rows)


def main():
    args = arguments()
    table = load.read_records(args.records, load.TEXT + load.COUNTS, all_columns=True)
    x, y = columns_asked(table, args)
    table = chosen_rows(table, args)
    present = [c for c in [*pareto.SOLVE, "cache"] if c in table and (c in pareto.SOLVE or table[c].nunique() > 1)]
    if "budget" in present:
        table = table.astype({"budget": int})
    cells = pareto.cells(table, x, y, ["sheet", "method", "parameter", *present, "resolution"], ["sheet"])
    if cells.empty or not cells["layer"].any():
        load.stop(f"no row of {args.name} has both {x.column} and {y.column}")
    failed = pareto.failed_rows(table)
    run = load.Run(table[~failed], table[failed], load.read_context(args.records.with_name("context.json")))
    out = args.out or args.records.with_name(f"pareto_{args.name}_{x.column}_{y.column}")
    out = out.with_suffix("") if out.suffix in (".png", ".pdf") else out
    style.save(figure_of(cells, run, args, x, y, present), out.parent, out.name)
    print_ranking(cells, x, y, present)


if __name__ == "__main__":
    main()
