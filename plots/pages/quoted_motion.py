#!/usr/bin/env python3
"""Prints the numbers that docs/results.md quotes of the stages `motion` and `out_of_plane` of experiments/publish and that are no
cells of motion.txt and out_of_plane.txt, in the order of the page, labelled by its words. Of the published rows in --results. In
brackets: 95 % by drawing the cuts anew (bootstrap). The rank correlation is printed by plots/pages/quoted_whole_step.py."""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from analysis import load, pareto
from analysis.accuracy import motion
from analysis.accuracy.ranking import at_equal_unknowns
from analysis.accuracy.records import Records
from pages.quoted import say, span

SIZES = [800, 3200]
WRONG_PATH = ["snap_or_split", "edge_release", "element_deletion"]
NAMED = ["adaptive_remesh", "cut_polygons", "global_remesh", "longest_edge", "delaunay_refine", "cgal_refine", "bowyer_watson",
         "warp_and_refine", "split_and_tie", "phantom_node"]


def read(folder, stem):
    """The rows of the cuts that were made; says what was not."""
    rows = load.read_records(folder / f"{stem}.records.csv.xz", [*load.TEXT, "problem", *load.COUNTS, "unknowns", "error"],
                             all_columns=True)
    context = load.read_context(folder / f"{stem}.context.json")
    say("commit and seed", str(context["commit"])[:7], str(context["seed"]))
    lost = pareto.failed_rows(rows)
    rows = rows.assign(lost=np.where(rows["status"] == "refused", "refused", np.where(lost, "failed", "")))
    for (method, problem), here in rows.groupby(["method", "problem"]):
        for how in sorted(set(here["lost"]) - {""}):
            those = here[here["lost"] == how]
            say(f"{how}: {method}, {problem}", f"{len(those)} of {len(here)}", *sorted(set(those["sheet"])))
    return rows[~lost]


def in_motion(folder):
    print("In motion")
    rows = read(folder, "motion")
    at = {n: {row[0]: row[1:4] for row in motion.ratios(rows, n)} for n in SIZES}
    for method in NAMED:
        ratio, low, high = at[3200][method]
        say(f"3,200 triangles: error of the flap's motion over that after {motion.PLAIN}: {method}; less that at 800",
            f"{load.number(ratio)} [{load.number(low)}, {load.number(high)}]", ratio - at[800][method][0])
    flap = rows[rows["problem"].str.startswith("hanging_sheet") & (rows["resolution"] == 3200)]
    unknowns = flap.pivot_table(index=["problem", "sheet", "case"], columns="method", values="unknowns")
    more = 100 * (unknowns.div(unknowns[motion.PLAIN], axis=0) - 1)
    for method in NAMED[:6]:
        by_sheet = more[method].groupby("sheet").median()
        say(f"more unknowns than {motion.PLAIN}, %: {method}, median; by sheet", more[method].median(),
            *(f"{sheet} {value:.1f}" for sheet, value in by_sheet.items()))
    strip = motion.of_problem(rows, "severed_strip")
    lips = strip[strip["resolution"] == 3200].groupby("method")["error"].mean().drop(motion.REFERENCE)
    say(f"the strip's lips, midpoint rule, 3,200 triangles, %: all {len(lips) - 2} but {', '.join(WRONG_PATH[1:])}",
        span(lips.drop(WRONG_PATH[1:])))


def out_of_plane(folder):
    print("\nOut of plane")
    made = read(folder, "out_of_plane")
    medians = 100 * made[made["resolution"] == 3200].groupby(["problem", "method"])["error"].median()
    for problem in ("slit_strip", "flap"):
        near = medians[problem].drop([motion.REFERENCE, "bowyer_watson", *WRONG_PATH])
        say(f"{problem} at 3,200 triangles, median, %: {len(near)} methods, all but bowyer_watson, {', '.join(WRONG_PATH)}", span(near))
    table = at_equal_unknowns(Records(folder, "out_of_plane.records.csv.xz", "out_of_plane.context.json")).table
    flap = table[(table["problem"] == "flap") & (table["resolution"] == 3200) & ~table["failed"]]
    for method, here in flap.groupby("method"):
        logs = np.log(here["ratio_equal"])
        low, high = 100 * np.expm1(np.quantile(load.drawn_means(logs), [0.025, 0.975]))
        say(f"flap at equal unknowns, % over the fitted mesh, {len(logs)} cuts; times its unknowns: {method}",
            f"{100 * np.expm1(logs.mean()):+.0f} [{low:.0f}, {high:.0f}]", here["more"].median())


def main():
    folder = load.results_folder("reference", __doc__)
    in_motion(folder)
    out_of_plane(folder)


if __name__ == "__main__":
    main()
