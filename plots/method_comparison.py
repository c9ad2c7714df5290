#!/usr/bin/env python3
"""All methods on the same cuts: the shapes of their triangles, their cost, the jumps of energy and residual at the cut,
and tables of all of these, ranked by largest eigenvalue, smallest altitude and largest angle. Reads
results/method_comparison and, where they exist, its neighbours method_comparison_fine (a smaller chord tolerance),
method_comparison_accuracy (against exact solutions), method_comparison_jumps (cuts in a running scene),
method_comparison_knobs and method_comparison_ablation (parts of
warp_and_refine)."""

from dataclasses import dataclass
from functools import partial

import numpy as np
import pandas as pd
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullLocator

import method_gallery
from accuracy_parts.ranking import at_equal_unknowns
from accuracy_parts.records import Records
from common import load, style
from common.load import of
from method_parts import accuracy as method_accuracy
from method_parts import details as method_details
from method_parts import kinds as method_kinds
from method_parts import sweeps as method_sweeps

STEM = "method_comparison"
MEASURES = ["crossed_triangles", "vertices_added", "angle_max_deg_cut", "altitude_min_h_cut", "ar_max_cut", "ar_p99_cut",
            "ar_max_cut_strict", "ar_p99_cut_strict", "ar_max_cut_outside_wedges", "ar_max_cut_away_from_wedges",
            "ar_p99_cut_outside_wedges",
            "wedge_area_rest2", "forced_corners", "eigenvalue_ratio", "incision_error_h", "area_change", "geometry_us"]
JUMPS = ["membrane_j", "membrane_jump_j", "bending_j", "bending_jump_j", "residual_n", "residual_jump_n", "kinetic_j",
         "kinetic_jump_j", "momentum_jump_kg_m_s"]
MARKERS = {"grid": ("o", "#0072b2"), "alternating": ("s", "#e69f00"), "delaunay": ("^", "#009e73"),
           "graded": ("D", "#cc79a7")}
OTHER = ("P", "#666666")


@dataclass(frozen=True)
class Measure:
    """A column, its label on the axis, and whether large or small values are bad."""
    column: str
    label: str
    worst: float = np.inf  # what a failed cut counts as
    linear: bool = False


SHAPES = [Measure("eigenvalue_ratio", "largest eigen-\nvalue / uncut"),
          Measure("altitude_min_h_cut", "smallest\naltitude (h)", -np.inf),
          Measure("angle_max_deg_cut", "largest\nangle (°)", linear=True)]
PRICE = [Measure("vertices_per_crossed", "vertices added\nper crossed tri.", linear=True),
         Measure("incision_error_h", "incision\nerror (h)"),
         Measure("us_per_crossed", "µs per\ncrossed tri.")]
JUMP = [Measure("membrane_jump", "membrane\nenergy"), Measure("bending_jump", "bending\nenergy"),
        Measure("residual_jump", "residual\nforce")]
ROUNDING = 1e-12  # relative jumps below it are rounding errors
OURS = "warp_and_refine"  # the project's own method
BY_SHEET, AGAINST, ALTITUDE = f"{STEM}_by_sheet", f"{STEM}_pairs", f"{STEM}_altitude"
TITLES = {  # of the tables that are not medians over all cuts
    method_accuracy.STEM: method_accuracy.WHAT,
    method_kinds.STEM: method_kinds.WHAT,
    BY_SHEET: "cuts with every AR < 3 outside forced wedges, and farther than 0.02 h from them; median largest eigenvalues",
    f"{STEM}_jumps": "jumps at a cut in a moving sheet, over the value before the cut; 1e-12 stands for no jump",
    ALTITUDE: "largest eigenvalue against the square of the smallest altitude (h), of cuts with an eigenvalue over 100, on even sheets",
    AGAINST: f"the cuts of {OURS} and the same cuts by each other method",
    f"{AGAINST}_fine": f"the cuts of {OURS} and the same cuts by each other method, chord tolerance 0.01",
}
DERIVED = {  # groups of the columns that are computed from those of the records
    "vertices_per_crossed": "size", "us_per_crossed": "time", "ar_below_3": "forced", "excess_percent": "accuracy_run",
    "more_unknowns_percent": "accuracy_run", **{f"{name}_jump": "jump" for name in ("membrane", "bending", "residual")},
    **method_details.GROUPS,
}
BLOCKS = [["accuracy_run"], ["stability", "shape"], ["forced"], ["size", "accuracy", "time", "outcome"], ["jump"], ["pairs"]]


def measured(run):
    """Each cut once, with the columns that are computed from others. A failed cut gets the worst value of each measure."""
    rows = run.rows[run.rows["status"] != "noop"].copy()
    rows["vertices_per_crossed"] = rows["vertices_added"] / rows["crossed_triangles"]
    shapes = [c for c in MEASURES if c.startswith(("ar_", "angle_", "altitude_"))]
    rows.loc[rows["ar_max_cut"] == 0, shapes] = np.nan  # edges were released and no triangle was changed
    rows.loc[rows["area_change"].abs() > 1e-6, "incision_error_h"] = np.nan  # removed triangles: no incision
    rows["us_per_crossed"] = rows["geometry_us"] / rows["crossed_triangles"]
    failed = run.failed.copy()
    for m in SHAPES + PRICE:
        failed[m.column] = m.worst
    failed["eigenvalue_ratio"] = np.nan  # computed for some cuts only
    return pd.concat([rows, failed], ignore_index=True)


def jumped(run):
    rows = run.rows[(run.rows["cache"] == "simulation") & run.rows["membrane_j"].notna()].copy()
    for name, unit in (("membrane", "j"), ("bending", "j"), ("residual", "n")):
        rows[f"{name}_jump"] = (rows[f"{name}_jump_{unit}"].abs() / rows[f"{name}_{unit}"]).clip(lower=ROUNDING)
    return rows


def spread(values, worst=np.inf):
    """q1, median and q3, in which a failed cut is infinitely bad, and the worst of the cuts that did not fail."""
    values = np.asarray(values.dropna(), float)
    if not len(values):
        return (np.nan,) * 4
    sign = 1 if worst > 0 else -1
    q = sign * np.array(load.with_failures(sign * values))
    return (*(q if sign > 0 else q[::-1]), sign * max(sign * values[np.isfinite(values)], default=-np.inf))


def ranking(table, variants, sheets):
    """The variants, best first: by the sum of their ranks in the three measures of shape, each the mean over the sheets
    of the rank of the median there. Also the ranks."""
    ranks = pd.DataFrame(index=variants, columns=[m.column for m in SHAPES], dtype=float)
    for m in SHAPES:
        per_sheet = pd.DataFrame({s: {v: np.sign(m.worst) * spread(of(table, v, s)[m.column], m.worst)[1] for v in variants}
                                  for s in sheets})
        per_sheet = per_sheet.rank(na_option="bottom")
        there = pd.DataFrame({s: {v: len(of(table, v, s)) > 0 for v in variants} for s in sheets})
        ranks[m.column] = per_sheet.where(there).mean(axis=1).reindex(ranks.index)
    ranks["sum"] = ranks.sum(axis=1)
    return ranks.sort_values("sum", kind="stable")


def label(variant, programs=()):
    look = style.KNOWN.get(variant)
    name = look.label if look else variant[0].replace("_", " ") + (f", {variant[1]}" if variant[1] else "")
    return name + style.PROGRAM * (variant[0] in programs)


def dot_figure(table, fine, order, sheets, measures, programs):
    """A row per method, best shapes on top, a panel per measure; a marker per sheet at the median, a line from quartile
    to quartile, a tick at the worst. Hollow: with the closer chord tolerance."""
    height = 0.34 * len(order) + 1.5
    figure, axes = style.panels(1, len(measures), height, sharey=True)
    offsets = np.linspace(-0.3, 0.3, len(sheets)) if len(sheets) > 1 else [0]
    for ax, m in zip(axes[0], measures):
        if not m.linear:
            ax.set_xscale("log")
        for row, variant in enumerate(order):
            if row % 2:
                ax.axhspan(row - 0.5, row + 0.5, color="#f4f4f4", linewidth=0, zorder=0)
            for sheet, offset in zip(sheets, offsets):
                marker, colour = MARKERS.get(sheet, OTHER)
                for data, hollow in ((table, False), (fine, True)):
                    if data is None or m.column not in data:
                        continue
                    q1, median, q3, worst = spread(of(data, variant, sheet)[m.column], m.worst)
                    if not np.isfinite(median):
                        continue
                    if not hollow:
                        ax.hlines(row + offset, q1, min(q3, 1e30), color=colour, linewidth=0.8, alpha=0.6, zorder=2)
                        if np.isfinite(worst):
                            failed = np.isinf(of(data, variant, sheet)[m.column]).any()
                            ax.plot(worst, row + offset, "x" if failed else "|", color=colour, markersize=2.6,
                                    markeredgewidth=0.5, alpha=0.8)
                    ax.plot(median, row + offset, marker, color="white" if hollow else colour, markersize=2.3,
                            markeredgecolor=colour, markeredgewidth=0.5, zorder=3 if hollow else 4)
        ax.set_xlabel(m.label)
        ax.grid(axis="y", visible=False)
        ax.tick_params(axis="y", length=0)
        if not m.linear:
            low, high = ax.get_xlim()
            decades = int(np.ceil(np.log10(high / low) / 3))  # three labels have room
            ax.xaxis.set_major_locator(LogLocator(base=10.0 ** max(1, decades)))
            ax.xaxis.set_minor_locator(NullLocator())
    axes[0, 0].set_yticks(range(len(order)), [label(v, programs) for v in order])
    axes[0, 0].set_ylim(len(order) - 0.5, -0.5)
    return figure, axes[0]


def legend(sheets, fine, some_failed):
    entries = [Line2D([], [], linestyle="", marker=MARKERS.get(s, OTHER)[0], color=MARKERS.get(s, OTHER)[1], markersize=3,
                      label=style.sheet_title(s)) for s in sheets]
    entries.append(Line2D([], [], linestyle="", marker="|", color="#444444", markersize=4, label="worst cut"))
    if some_failed:
        entries.append(Line2D([], [], linestyle="", marker="x", color="#444444", markersize=3,
                              label="worst cut that did not fail"))
    if fine is not None:
        entries.append(Line2D([], [], linestyle="", marker="o", color="white", markeredgecolor="#444444", markersize=3,
                              label="chord tolerance 0.01"))
    return entries


def caption(what, run, rows):
    families = ", ".join(sorted(set(rows["cut_family"])))
    sizes = sorted(set(rows["resolution"]))
    size = f"{sizes[0]}" if len(sizes) == 1 else f"{sizes[0]} to {sizes[-1]}"
    return (f"{what} Marker: median of the cuts on one kind of sheet (cut families: {families}; {size} triangles). Line: "
            "quartiles. The method with the best shapes is on top, by the sum of the ranks of its median eigenvalue, "
            "altitude and angle. All knobs have their defaults. A method has no marker for a kind of sheet that it refuses. "
            + style.provenance(run, rows, with_crosses=False, per=["sheet"]))


def summary(table, jumps, order, ranks):
    """The table: a row per method over all sheets, families and resolutions."""
    rows = []
    for variant in order:
        cuts = of(table, variant)
        row = {"method": variant[0], "knob": variant[1], "cuts": len(cuts), "failed": int(cuts["failed"].sum()),
               "rank": ranks.loc[[variant], "sum"].iloc[0] / len(SHAPES)}
        for m in SHAPES + PRICE:
            _, row[f"{m.column}_median"], _, row[f"{m.column}_worst"] = spread(cuts[m.column], m.worst)
        for kind in ("strict", "outside_wedges"):
            for which in ("max", "p99"):
                row[f"ar_{which}_cut_{kind}_median"] = spread(cuts[f"ar_{which}_cut_{kind}"])[1]
            of_cuts = cuts[f"ar_max_cut_{kind}"].notna() | cuts["failed"]  # else no triangle was changed
            below = (cuts[f"ar_max_cut_{kind}"] < 3) & ~cuts["failed"]
            row[f"ar_below_3_{kind}"] = f"{int(below.sum())}/{int(of_cuts.sum())}"
        row["wedge_area_rest2_mean"] = cuts["wedge_area_rest2"].mean()
        if jumps is not None:
            for m in JUMP:
                row[f"{m.column}_median"] = of(jumps, variant)[m.column].median()
        rows.append(row)
    return pd.DataFrame(rows)


def blocks(table):
    """The columns of a table, in blocks that fit beside the method's name: one for each of BLOCKS."""
    groups = {column: load.group(column, DERIVED) for column in table.columns}
    return [found for block in BLOCKS if (found := [c for c, group in groups.items() if group in block])]


def as_text(name, table):
    """The title of the table and its blocks, numbers with three digits."""
    shown = table.copy()
    for column in shown.columns[shown.dtypes == float]:
        shown[column] = [f"{x:.3g}" if np.isfinite(x) else "-" for x in shown[column]]
    of_all = [c for c in ("method", "knob", "cuts", "failed", "rank") if c in shown]
    what = TITLES.get(name, "medians over the cuts of all families, sheets and sizes; the best shapes first")
    if table.attrs.get("note"):
        what += f". {table.attrs['note']}"
    return "\n".join([f"{name}: {what}\n"] + [shown[of_all + block].to_string(index=False) + "\n"
                                               for block in blocks(shown[shown.columns.difference(of_all, sort=False)])])


def write_tables(folder, tables):
    """A CSV of each table of {name: table}, and one text of all."""
    for name, table in tables.items():
        table.to_csv(folder / f"{name}.csv", index=False, float_format="%.6g")
        print(folder / f"{name}.csv")
    text = "\n".join(as_text(name, table) for name, table in tables.items())
    (folder / f"{STEM}.txt").write_text(text, encoding="utf-8")
    print(folder / f"{STEM}.txt", text, sep="\n\n")


def read_cuts(folder):
    return cuts_of(load.read(folder, MEASURES))


def cuts_of(run):
    """Each cut of a run once, as measured(), but for the kinds of sheets that a method refuses altogether."""
    run = run.first_repetition()
    table = measured(run)
    table["failed"] = (table["verdict"] != "ok") | table["status"].isin(["failed", "refused"])
    # A kind of sheet that a method is not made for says nothing about it.
    refused = (table["status"] == "refused").groupby([table[c] for c in ("method", "knob", "sheet")]).transform("all")
    return run, table[~refused]


def main():
    folder = load.results_folder(STEM, __doc__)
    run, table = read_cuts(folder)
    fine_folder, jumps_folder = (folder.with_name(f"{folder.name}_{kind}") for kind in ("fine", "jumps"))
    fine = read_cuts(fine_folder)[1] if (fine_folder / "records.csv").is_file() else None
    jumps_run = load.read(jumps_folder, JUMPS) if (jumps_folder / "records.csv").is_file() else None
    jumps = jumped(jumps_run) if jumps_run else None
    sheets = style.sheet_order(table["sheet"])
    ranks = ranking(table, sorted(set(zip(table["method"], table["knob"]))), sheets)
    order = list(ranks.index)
    programs = load.programs(run.everything(), run.context)

    for name, measures, what in (
            (f"{STEM}_shapes", SHAPES, "Shapes of triangles after a cut, by method. Altitude and angle: of the triangles "
             "that the cut made or changed, where there are any. Eigenvalue: the largest one of stiffness and lumped mass; "
             "the largest stable step of an explicit integrator shrinks by its square root."),
            (f"{STEM}_price", PRICE, "The cost of a cut, by method: vertices added at rest, distance between the "
             "requested path and the incision, and time of the geometry (warm caches)."
             + style.PROGRAM_TIME * bool(programs))):
        figure, axes = dot_figure(table, fine, order, sheets, measures, programs)
        if measures is SHAPES:
            axes[2].set_xlim(90, 182)
        style.finish(figure, [], caption(what, run, run.rows),
                     legend(sheets, fine, table["failed"].any()))
        style.save(figure, folder, name)
    if jumps is not None:
        figure, _ = dot_figure(jumps, None, order, sheets, JUMP, programs)
        style.finish(figure, [], caption(
            "Jumps of energies and of the residual force at the instant of a cut in a moving sheet, relative to the value "
            "before the cut. Jumps below 10⁻¹² are drawn at 10⁻¹².", jumps_run, jumps), legend(sheets, None, False))
        style.save(figure, folder, f"{STEM}_jumps")
    ours = next((v for v in order if v[0] == OURS), order[0])
    tables = {STEM: summary(table, jumps, order, ranks), BY_SHEET: method_details.by_sheet_and_family(table, order, sheets),
              ALTITUDE: method_details.altitude_law(table, order), AGAINST: method_details.against(table, ours, order)}
    if jumps is not None:
        tables[f"{STEM}_jumps"] = method_details.jumps(jumps, order)
    if fine is not None:
        tables[f"{STEM}_fine"] = summary(fine, None, order, ranks)
        tables[f"{AGAINST}_fine"] = method_details.against(fine, ours, order)
    defaults = set(order)
    for kind, draw, what in (
            ("knobs", partial(method_sweeps.draw_knobs, defaults=defaults), "Medians for each setting of each method's knob. "
             "The first and the last setting are written beside their markers; the default has a large marker. Lower left "
             "is better. AR: of the triangles outside forced wedges. A marker without a line: bound 0, which sets no bound."),
            ("ablation", method_sweeps.draw_ablation, "The parts of warp_and_refine: the steps before the split "
             "(rows) and after it (columns). Medians. AR: of the triangles outside forced wedges.")):
        beside = folder.with_name(f"{folder.name}_{kind}")
        if not (beside / "records.csv").is_file():
            continue
        swept_run, swept = read_cuts(beside)
        swept_ranks = ranking(swept, sorted(set(zip(swept["method"], swept["knob"]))), style.sheet_order(swept["sheet"]))
        draw(folder, swept, what + " " + style.provenance(
            swept_run, swept_run.rows, with_crosses=False, per=["sheet"] if kind == "knobs" else []))
        tables[f"{STEM}_{kind}"] = summary(swept, None, list(swept_ranks.index), swept_ranks)
    if (folder.with_name(method_accuracy.STEM) / "records.csv").is_file():
        beside = folder.with_name(method_accuracy.STEM)
        tables[method_accuracy.STEM] = method_accuracy.draw(folder, beside)
        tables[method_kinds.STEM] = method_kinds.table_of(at_equal_unknowns(Records(beside)).ranked())
    write_tables(folder, tables)
    method_gallery.draw(folder, set(run.everything()["method"]))


if __name__ == "__main__":
    main()
