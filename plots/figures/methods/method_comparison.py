#!/usr/bin/env python3
"""All methods on the same cuts: the shapes of their triangles, their cost, the jumps of energy and residual at the cut,
and tables of all of these, ranked by largest eigenvalue, smallest altitude and largest angle. Reads
results/method_comparison and, where they exist, its neighbours method_comparison_accuracy (against exact solutions) and
method_comparison_jumps (cuts in a running scene). Other settings of the methods: method_comparison_parameters.py."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load, naming, shares
from analysis.accuracy.ranking import at_equal_unknowns
from analysis.accuracy.records import Records
from analysis.methods import details, errors, kinds
from analysis.methods.comparison import (
    AGAINST, ALTITUDE, BY_SHEET, JUMP, JUMPS, OURS, PRICE, SHAPES, STEM, counts_of, jumped, ranking, read_cuts, summary,
    write_tables)
from figures.common import style
from figures.methods import dots, error_dots, method_gallery


def caption(what, run, rows):
    families = ", ".join(sorted(set(rows["cut_family"])))
    sizes = sorted(set(rows["resolution"]))
    size = f"{sizes[0]}" if len(sizes) == 1 else f"{sizes[0]} to {sizes[-1]}"
    return (f"Dots, bars and numbers: cuts in the even sheets; diamonds: in the graded one. {what} Families: {families}; {size} triangles. "
            "Within a family of methods, and among the families, the best shapes are on top, by the sum of the ranks of "
            "median eigenvalue, altitude and angle. All parameters have their defaults. A method has no marker for a kind of sheet "
            f"that it declares not to take. {shares.HOLLOW} " + naming.provenance(run, rows, with_crosses=False, per=["sheet"]))


def draw_dots(folder, name, table, order, measures, text, programs, counts):
    figure = dots.figure_of(table, order, measures, [1 if m.linear else 1.5 for m in measures], programs, counts)
    style.finish(figure, [], text, dots.legend(table))
    style.save(figure, folder, name)


def main():
    folder = load.results_folder(STEM, __doc__)
    run, table = read_cuts(folder)
    jumps_folder = folder.with_name(f"{folder.name}_jumps")
    jumps_run = load.read(jumps_folder, JUMPS) if (jumps_folder / "records.csv").is_file() else None
    jumps = jumped(jumps_run) if jumps_run else None
    sheets = naming.sheet_order(table["sheet"])
    counts = counts_of(run)
    ranks = ranking(table, sheets, counts)
    order = list(ranks.index)
    programs = load.programs(run.everything(), run.context)

    for name, measures, what in (
            (f"{STEM}_shapes", SHAPES, "Triangles after a cut: a small altitude makes a large eigenvalue, by whose square root the "
             "stable explicit step shrinks. Altitude and angle: of the triangles that the cut made or changed, where there are "
             "any. Eigenvalue: the largest one of stiffness and lumped mass."),
            (f"{STEM}_price", PRICE, "What a cut costs: time of the geometry (warm caches), distance between the requested path and "
             "the incision (h: mean edge), vertices added at rest." + naming.PROGRAM_TIME * bool(programs))):
        draw_dots(folder, name, table, order, measures, caption(dots.beside_split(table, measures) + what, run, run.rows), programs,
                  counts)
    if jumps is not None:
        of_jumps = counts_of(jumps_run)
        draw_dots(folder, f"{STEM}_jumps", jumps.assign(failed=False), shares.last_if_few(order, of_jumps), JUMP, caption(
            "Jumps at the instant of a cut in a moving sheet, relative to the value before the cut. Jumps below 10⁻¹² are drawn "
            "at 10⁻¹².", jumps_run, jumps), programs, of_jumps)
    ours = next((v for v in order if v[0] == OURS), order[0])
    tables = {STEM: summary(table, jumps, order, ranks), BY_SHEET: details.by_sheet_and_family(table, order, sheets),
              ALTITUDE: details.altitude_law(table, order), AGAINST: details.against(table, ours, order)}
    if jumps is not None:
        tables[f"{STEM}_jumps"] = details.jumps(jumps, order)
    if (folder.with_name(errors.STEM) / "records.csv").is_file():
        beside = folder.with_name(errors.STEM)
        tables[errors.STEM] = error_dots.draw(folder, beside)
        tables[kinds.STEM] = kinds.table_of(at_equal_unknowns(Records(beside)).ranked())
    of_errors = errors.counts_of(Records(folder.with_name(errors.STEM))) if errors.STEM in tables else {}
    write_tables(folder, STEM, tables, {name: counts for name in tables} | ({f"{STEM}_jumps": of_jumps} if jumps is not None else {})
                 | {errors.STEM: of_errors, kinds.STEM: of_errors})
    method_gallery.draw(folder, set(run.everything()["method"]))


if __name__ == "__main__":
    main()
