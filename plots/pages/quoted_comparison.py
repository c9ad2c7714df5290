#!/usr/bin/env python3
"""The numbers that docs/results.md, and pages after it, quote of the stage `comparison` of experiments/publish and that are not
cells of method_comparison.txt, a line each, in the order of the pages. Reads the published records; those of a run by --results
results. In brackets: 95 % intervals by drawing the cuts anew (bootstrap), where nothing else is said."""

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from analysis import load
from analysis.accuracy.ranking import at_equal_unknowns, made_by_all, mean_excess
from analysis.accuracy.records import CASE, REFERENCE, Records
from analysis.methods import kinds
from analysis.methods.comparison import JUMPS, MEASURES, OURS, cuts_of, jumped
from analysis.methods.details import KEY
from analysis.methods.errors import BUDGET, of_methods_there
from pages.quoted import say

SPLIT = "conventional_split"
REFINING = ["adaptive_remesh", "longest_edge", "global_remesh", "cgal_refine", "delaunay_refine"]
TIED = ["cut_polygons", "split_and_tie", "phantom_node"]
MORE = ["stabilised_bending_eigenvalue_ratio", "angle_min_deg_cut", "constrain_us"]
PHASES = [f"{phase}_us" for phase in ("geometry", "transfer", "pattern", "bending", "rotate", "assemble", "setup", "solve")]
DRAWS = 5000


# ---- numbers in words


def signed(value):
    return f"{value:+,.1f}"


def bracket(value, drawn, written=load.number):
    """A number and the interval of those that were drawn."""
    return f"{written(value)} [{', '.join(written(end) for end in np.quantile(drawn, [0.025, 0.975]))}]"


def largest(values, n):
    """Of {name: value}, the n largest."""
    return [f"{name} {load.number(value)}" for name, value in sorted(values.items(), key=lambda item: -item[1])[:n]]


# ---- draws


def anew(values):
    """A row for each draw."""
    return np.random.default_rng(1).choice(np.asarray(values, float), (DRAWS, len(values)))


def quantile(values, share=0.5):
    return bracket(np.quantile(values, share), np.quantile(anew(values), share, axis=1))


def percent(yes):
    return bracket(100 * np.mean(yes), 100 * load.drawn_means(yes))


def off_by(values, statistic):
    """How far the interval of a statistic reaches to either side: the larger one of the two factors."""
    low, high = np.quantile(statistic(anew(values)), [0.025, 0.975]) / statistic(np.asarray(values, float)[None])[0]
    return max(high, 1 / low)


def medians(drawn):
    return np.median(drawn, axis=1)


def geometric_means(drawn):
    return np.exp(np.log(drawn).mean(axis=1))


def wilson(yes):
    """A share close to one, %, and its interval by Wilson's score, as draws of those that are all one say nothing."""
    n, p, z2 = len(yes), np.mean(yes), 1.96**2
    half = np.sqrt(z2 * (p * (1 - p) / n + z2 / (4 * n * n)))
    low, high = (100 * (p + z2 / (2 * n) + side * half) / (1 + z2 / n) for side in (-1, 1))
    return f"{np.sum(yes)} of {n} [{low:.1f}, {high:.2f}] %"


# ---- rows


def files(results, stem, direct=""):
    """The records and the context of a run below `results`, or of what is published there."""
    if (results / stem / "records.csv").is_file():
        return results / stem / "records.csv", results / stem / "context.json"
    return results / f"{stem}{direct}.records.csv.xz", results / f"{stem}.context.json"


def by(rows, method):
    return rows[rows["method"] == method]


def several(rows):
    return rows[rows["cut_family"] == "several"]


def even(rows):
    return rows[rows["sheet"] != "graded"]


def pairs(rows, one, other):
    """Of the same cuts; columns of `other` end in _other."""
    return by(rows, one).merge(by(rows, other), on=KEY, suffixes=("", "_other"))


def times(rows, one, other, columns=("geometry_us",)):
    both = pairs(rows, one, other)
    return both[list(columns)].sum(axis=1) / both[[f"{c}_other" for c in columns]].sum(axis=1)


def total(rows, one, other):
    """Time of all cuts over all their crossed triangles, over that of the other."""
    columns = ["geometry_us", "crossed_triangles", "geometry_us_other", "crossed_triangles_other"]
    both = pairs(rows, one, other)[columns].to_numpy()
    picks = np.random.default_rng(1).integers(0, len(both), (DRAWS, len(both)))
    us, crossed, us_other, crossed_other = both[picks].sum(axis=1).T
    return bracket(np.divide(*both.sum(axis=0)[:2]) / np.divide(*both.sum(axis=0)[2:]), us / crossed / (us_other / crossed_other))


class Accuracy:
    """Errors in plane, solved directly: `by_kind` is the table of kinds.py, `rows` are those of the cases that all methods made."""

    def __init__(self, results):
        records, context = files(results, "method_comparison_accuracy", ".direct")
        self.records = at_equal_unknowns(Records(results, records.relative_to(results), context.relative_to(results))).ranked()
        self.by_kind = self.kinds_at()
        table = self.records.table[self.records.table["direct"] & (self.records.table["problem"] != kinds.TWICE)]
        table = table.assign(kind=table["problem"].map(kinds.kind_of))
        self.rows = made_by_all(of_methods_there(table[table["kind"].notna()]))

    def kinds_at(self, **values):
        return kinds.table_of(self.records.with_rows(self.records.rows(**values))).set_index("method")

    def hole(self, method):
        return by(self.rows[self.rows["kind"] == "hole"], method)["ratio_equal"]

    def over(self, one, other):
        """The mean over kinds of one method's error over the other's, kinds drawn anew."""
        ratios = [(1 + self.by_kind.loc[one, f"error, {k}"] / 100) / (1 + self.by_kind.loc[other, f"error, {k}"] / 100)
                  for k in kinds.KINDS]
        return ratio_in_percent(np.log(ratios))

    def by_measure(self, method, measure):
        """Logarithms of its error over the fitted mesh's, of as many triangles, and the kinds and problems."""
        column = f"error_{measure}"
        both = by(self.rows, method).merge(by(self.rows, REFERENCE[0])[[*CASE, column]], on=CASE, suffixes=("", "_fitted"))
        both["log"] = np.log(both[column].abs() / both[f"{column}_fitted"].abs())
        return both[np.isfinite(both["log"])]


def ratio_in_percent(logs, groups=None):
    drawn = load.drawn_means(logs) if groups is None else load.drawn_group_means(logs, groups)
    return bracket(100 * np.expm1(np.mean(logs)), 100 * np.expm1(drawn), signed)


# ---- the pages


def which_method(cuts, accuracy):
    print("The run, and which method?")
    say("results, of them judged wrong or failed", f"{len(cuts):,}", f"{cuts['failed'].sum()}")
    for method in (OURS, "adaptive_remesh", *TIED):
        say(f"{method}: times {SPLIT}, median of the ratios of the same cuts", quantile(times(cuts, method, SPLIT)))
    say(f"{OURS}: in total", total(cuts, OURS, SPLIT))
    for method in ("snap_or_split", "cut_polygons"):
        say(f"{method}: error at a hole, its cases drawn anew", ratio_in_percent(np.log(accuracy.hole(method))))
        say("... by size", *(f"{100 * np.expm1(np.log(here).mean()):+.0f}"
                             for _, here in accuracy.hole(method).groupby(accuracy.rows["resolution"])))
    say("medians in us are within a factor of", *largest(
        {m: off_by(rows["us_per_crossed"], medians) for m, rows in cuts.groupby("method")}, 3))
    for method in ("adaptive_remesh", "delaunay_refine", OURS, "active_node", "split_and_tie", "cut_polygons", "snap_or_split"):
        say(f"error over that of {SPLIT} at equal unknowns, kinds drawn anew, {method}", accuracy.over(method, SPLIT))
    norms = {m: accuracy.by_measure(m, "energy_norm").groupby("kind")["log"].mean() for m in ("adaptive_remesh", "longest_edge")}
    norms = norms["adaptive_remesh"] - norms["longest_edge"]
    say("energy norm at as many triangles, adaptive_remesh over longest_edge", ratio_in_percent(norms),
        *(f"{kind} {signed(100 * np.expm1(log))}" for kind, log in norms.items()))


def the_table(cuts, accuracy):
    print("\nThe table, with a digit to spare")
    for method, rows in cuts.groupby("method"):
        errors, changed = accuracy.by_kind.loc[method], max(1, rows["ar_max_cut_strict"].notna().sum())
        say(method, even(rows)["eigenvalue_ratio"].median(), even(rows)["eigenvalue_ratio"].quantile(0.95),
            several(even(rows))["eigenvalue_ratio"].median(), rows[rows["sheet"] == "graded"]["eigenvalue_ratio"].median(),
            even(rows)["bending_eigenvalue_ratio"].quantile(0.95),
            *(100 * (rows[f"ar_max_cut_{where}"] < 3).sum() / changed for where in ("strict", "outside_wedges")),
            f"{signed(errors['error, kinds'])} [{errors['error, its 95 %']}]", signed(errors["error, hole"]),
            rows["vertices_per_crossed"].median(), rows["us_per_crossed"].median(),
            rows["geometry_us"].sum() / rows["crossed_triangles"].sum())
    for column in ("stabilised_eigenvalue_ratio", "stabilised_bending_eigenvalue_ratio"):
        say(f"even sheets, 95 %, {column}", *largest(even(cuts).groupby("method")[column].quantile(0.95).dropna(), 3))
    for method in (OURS, "split_and_tie", SPLIT):
        say(f"four cuts, {method}", quantile(several(by(even(cuts), method))["eigenvalue_ratio"]))
    say("four cuts, known within a factor of", *largest(
        {m: off_by(rows["eigenvalue_ratio"], medians) for m, rows in several(even(cuts)).groupby("method")}, 3))
    ours = by(cuts, OURS)
    for where in ("strict", "outside_wedges", "away_from_wedges"):
        say(f"{OURS}: AR < 3 {where}", wilson(ours[f"ar_max_cut_{where}"] < 3))
    say("at a hole the ratio of the errors is known within a factor of", *largest(
        {m: off_by(accuracy.hole(m), geometric_means) for m in accuracy.by_kind.index}, 5))
    us = several(ours)["geometry_us"].sum()
    say(f"{OURS}: share of its time by the cases of four cuts, us in total", us / ours["geometry_us"].sum(),
        us / several(ours)["crossed_triangles"].sum())
    for method in TIED:
        for which, rows in (("after one cut or a re-cut", cuts[cuts["cut_family"] != "several"]), ("after four", several(cuts))):
            say(f"{method} {which}: us, times {SPLIT}, times {OURS}, share of time to find ties or polygons",
                by(rows, method)["us_per_crossed"].median(), quantile(times(rows, method, SPLIT)), quantile(times(rows, method, OURS)),
                by(rows, method)["constrain_us"].sum() / by(rows, method)["geometry_us"].sum())


def findings(cuts, accuracy):
    print("\nFindings")
    for size in (800, 12800):
        at = accuracy.kinds_at(resolution=size)
        say(f"at a hole, {size}", *(f"{m} {at.loc[m, 'error, hole']:+.0f}" for m in REFINING))
    say("one case in twenty leaves an eigenvalue above", quantile(by(even(cuts), OURS)["eigenvalue_ratio"], 0.95))


def shapes_and_price(cuts):
    print("\nShapes")
    for method in (OURS, "active_node", "cut_polygons"):
        say(f"{method}: eigenvalue on even sheets at 90 and 95 %, four cuts; on all sheets",
            *(even(by(cuts, method))["eigenvalue_ratio"].quantile(share) for share in (0.9, 0.95)),
            several(even(by(cuts, method)))["eigenvalue_ratio"].median(),
            *(by(cuts, method)["eigenvalue_ratio"].quantile(share) for share in (0.9, 0.95)))
    polygons = by(cuts, "cut_polygons")
    say("cut_polygons: at most after one cut or a re-cut, in all; cuts above 100",
        polygons[polygons["cut_family"] != "several"]["eigenvalue_ratio"].max(), polygons["eigenvalue_ratio"].max(),
        f"{(polygons['eigenvalue_ratio'] > 100).sum()} of {len(polygons)}")
    print(f"\nPrice: times {OURS}")
    for method in ("cgal_refine", "delaunay_refine", *TIED, "adaptive_remesh", "active_node", SPLIT):
        ratios = times(cuts, method, OURS)
        say(method, quantile(ratios), f"5 % below {load.number(ratios.quantile(0.05))}", f"5 % above {load.number(ratios.quantile(0.95))}")
    print("\nsplit_and_tie or warp_and_refine?")
    for other in ("split_and_tie", "cut_polygons"):
        both = pairs(even(cuts), OURS, other)
        smaller = both["eigenvalue_ratio"] < both["eigenvalue_ratio_other"]
        of_four = smaller[both["cut_family"] == "several"]
        say(f"smaller eigenvalue by {OURS} than by {other}, %, after four cuts", percent(smaller), percent(of_four),
            f"{of_four.sum()} of {len(of_four)}")
    say(f"time of split_and_tie over {OURS}, even sheets, after four cuts", *(
        quantile(times(rows, "split_and_tie", OURS)) for rows in (even(cuts), several(even(cuts)))))


def accuracy_in_plane(accuracy):
    print("\nAccuracy in plane: by size")
    for size in (800, 12800):
        at = accuracy.kinds_at(resolution=size)
        for method in (*REFINING, "edge_release", "snap_or_split", SPLIT, OURS):
            say(f"{size}, {method}", f"{at.loc[method, 'error, kinds']:+.1f} [{at.loc[method, 'error, its 95 %']}]")
    print("by measure, problems drawn anew")
    for measure, methods in (("k1", ("edge_release", OURS, "bowyer_watson", SPLIT)),
                             ("opening", (OURS, *REFINING, SPLIT, "element_deletion"))):
        for method in methods:
            rows = accuracy.by_measure(method, measure)
            say(f"{measure}, {method}", ratio_in_percent(rows["log"], rows["problem"]))
    cracks = accuracy.by_measure("element_deletion", "released_energy")
    cracks = cracks[cracks["kind"] == "crack"]
    say("released energy at cracks, element_deletion", ratio_in_percent(cracks["log"], cracks["problem"]))
    table = accuracy.records.table
    stopped = made_by_all(of_methods_there(table[(table["budget"] == BUDGET) & (table["resolution"] == 12800)]))
    if len(stopped):
        errors = [1 + mean_excess(by(stopped, m), "ratio_equal") / 100 for m in accuracy.by_kind.index]
        say(f"12,800 triangles, {BUDGET} iterations: errors over the fitted mesh's, solved directly", min(errors), max(errors))


def jumps_in_motion(jumps):
    print("\nJumps in a moving sheet, of the bending energy: median, 95 %, worst; of the membrane energy, worst")
    for method in (OURS, SPLIT, "adaptive_remesh", "cut_polygons", *REFINING[1:], "bowyer_watson"):
        rows = by(jumps, method)
        say(method, quantile(rows["bending_jump"]), quantile(rows["bending_jump"], 0.95), rows["bending_jump"].max(),
            rows["membrane_jump"].max())
    print("\ndocs/limits.md")
    for name, columns in (("assembly of the first step", ["assemble_us"]), ("cut, update and first step", PHASES)):
        say(f"split_and_tie over {SPLIT}: {name}", quantile(times(jumps, "split_and_tie", SPLIT, columns)))
    say("that assembly, us", by(jumps, "split_and_tie")["assemble_us"].median())


def stability(cuts):
    print("\ndocs/stability.md, README.md")
    bad = by(cuts, OURS).query("eigenvalue_ratio > 100")
    free = bad.query("forced_corners == 0")
    fine = free.query("ar_max_cut < 3")
    say(f"{OURS}: cuts above 100, without a forced corner", f"{len(bad)}", f"{len(free)}")
    say("without: altitudes from, to; with all AR below 3, their smallest angle", free["altitude_min_h_cut"].min(),
        free["altitude_min_h_cut"].max(), f"{len(fine)}", fine["angle_min_deg_cut"].min())
    say("the others: AR, smallest angle", *free.drop(fine.index)[["ar_max_cut", "angle_min_deg_cut"]].to_numpy().ravel())
    say("delaunay_refine: median stable step", by(cuts, "delaunay_refine")["eigenvalue_ratio"].median() ** -0.5)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results/reference")
    results = parser.parse_args().results
    cuts = cuts_of(load.run_of(*files(results, "method_comparison"), MEASURES + MORE))[1]
    jumps = jumped(load.run_of(*files(results, "method_comparison_jumps"), JUMPS + PHASES))
    accuracy = Accuracy(results)
    which_method(cuts, accuracy)
    the_table(cuts, accuracy)
    findings(cuts, accuracy)
    shapes_and_price(cuts)
    accuracy_in_plane(accuracy)
    jumps_in_motion(jumps)
    stability(cuts)


if __name__ == "__main__":
    main()
