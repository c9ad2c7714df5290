#!/usr/bin/env python3
"""The numbers that docs/paper.md and docs/limits.md quote of the stages `paper` and `accuracy` of experiments/publish and that are no
cells of a published text, a line each, in the order of the pages, labelled by their words. Reads the published records; of the
scenes of figures 8 and 10 and of the blade it reads the frames, which are not published: experiments/reproduce makes them."""

import argparse
import re
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from analysis import load, naming
from analysis.accuracy.ranking import at_equal_unknowns, made_by_all, mean_excess
from analysis.accuracy.records import CASE, Records
from analysis.methods.kinds import kind_of
from analysis.paper import fig10_level_of_detail, fig8_edge_quality, fig9_aspect_ratio, table1_timing
from pages.quoted import say, span

SPLIT, ALONE, PAPERS, CGAL = ("conventional_split", ""), ("bowyer_watson", "rounds=0"), ("bowyer_watson", "rounds=1"), ("cgal_cdt", "")
PLAIN = (SPLIT, ALONE, CGAL)  # without local split
VARIANTS = (*PLAIN, PAPERS)


def outer(ratios):
    """load.ratio() of each sheet: the lowest and highest mean, and the lowest and highest end of the intervals."""
    return (f"{span(r[0] for r in ratios)} [{load.number(min(r[1] for r in ratios))}, {load.number(max(r[2] for r in ratios))}]")


def factor(logs):
    """The geometric mean and its 95 % interval."""
    return table1_timing.interval(load.ratio(np.exp(logs), 1))


def method(variant):
    return " ".join(variant).strip()


def shapes(run):
    print("Shapes and cost: figure 9")
    say("results that failed", f"{load.count(run.failed)} of {load.count(run.everything())}")
    for parameter, cuts in fig9_aspect_ratio.paper_method(run).items():
        good, n = fig9_aspect_ratio.held(cuts, "ar_mean_all")
        medians = cuts.rows.groupby(["sheet", "resolution"])["ar_mean_all"].median()
        say(f"{parameter}: mean over the sheet below 3; medians by sheet and size", f"{good} of {n}, {100 * good / n:.1f} %", span(medians))


def cost(timings):
    print("Shapes and cost: table 1, by sheet")
    top = max(timings[0].resolutions)
    growths = [t.growth(PAPERS)[2] for t in timings]
    say("as long as 16 times fewer triangles take, one round", span(growths))
    for variant in (SPLIT, ALONE):
        warm = [t.of(variant, top) for t in timings]
        cold = [t.of(variant, top, t.medians("cold"))["geometry_us"].median() for t in timings]
        say(f"{method(variant)} at {top}: us per crossed triangle, warm; cold over warm",
            span(cuts["ns_per_crossed"].median() / 1000 for cuts in warm),
            span(c / cuts["geometry_us"].median() for c, cuts in zip(cold, warm)))
    for upper, lower in ((SPLIT, ALONE), (CGAL, ALONE), (CGAL, SPLIT), (table1_timing.BASELINE, SPLIT), (table1_timing.BASELINE, ALONE)):
        say(f"time of {method(upper)} over {method(lower)} at {top}", outer([t.ratio(upper, lower, top) for t in timings]))


def inside(sheets):
    """`sheets`: the cuts of each, made in motion."""
    print("Inside the running simulation, by sheet")
    sizes = sorted(set(sheets[0]["resolution"]))
    tops = [cuts[cuts["resolution"] == sizes[-1]] for cuts in sheets]
    say(f"crossed triangles at {sizes[-1]}, medians", span(cuts["crossed_triangles"].median() for cuts in tops))

    def medians(variants, column):
        return span((load.of(cuts, v)[column].median() for cuts in tops for v in variants), 4)
    for column in ("update_us", "bending_us"):
        say(f"{column}, without local split; with one round", medians(PLAIN, column), medians([PAPERS], column))
    for upper, lower in (("rebuild_us", "pattern_us"), ("triplets_us", "pattern_us"), ("bending_rebuild_us", "bending_us")):
        for size in sizes[::len(sizes) - 1]:
            here = [cuts[cuts["resolution"] == size] for cuts in sheets]
            say(f"{upper} over {lower} at {size}", outer([load.ratio(cuts[upper], cuts[lower]) for cuts in here]))
    papers = load.of(sheets[0], PAPERS)
    say(f"update without bending on the {sheets[0]['sheet'].iloc[0]}, one round, ms, over the sizes",
        span(papers.groupby("resolution")["update_us"].median() / 1000))
    for column in ("assemble_us", "solve_us", "solver_iterations"):
        say(f"first step: {column}", medians(VARIANTS, column))
    say("setFromTriplets over assembly", outer([load.ratio(cuts["triplets_us"], cuts["assemble_us"]) for cuts in tops]))


def accuracy(records):
    print("Accuracy")
    table = records.table[records.table["direct"]]
    bad = table[table["failed"]]
    cases = table.groupby(["method", "parameter"]).size()
    say("cuts by each variant, failed of all", span(cases, 4), f"{len(bad)} of {len(table)}")
    say("problems of those that failed", *(f"{p} {n}" for p, n in bad["problem"].value_counts().items()))
    say("largest AR of bending_patch_slit", records.rows(problem="bending_patch_slit")["ar_max_cut"].max())
    hole = made_by_all(table[table["problem"] == "kirsch_hole"])
    for variant in VARIANTS:
        say(f"at the hole, %, {method(variant)}", f"{mean_excess(load.of(hole, variant), 'ratio_equal'):+.1f}")
    pairs = load.of(table, PAPERS).merge(load.of(table, SPLIT), on=CASE)
    pairs = pairs.assign(kind=pairs["problem"].map(kind_of),
                         log=np.log(pairs["ratio_equal_x"] / pairs["ratio_equal_y"])).dropna(subset=["kind", "log"])
    at_hole = pairs["kind"] == "hole"
    say("one round over conventional split, equal unknowns: at tips, kinds drawn anew; at the hole, cases drawn anew",
        factor(pairs[~at_hole].groupby("kind")["log"].mean()), factor(pairs[at_hole]["log"]))


def edge(results):
    print("The cut edge: figure 8")
    rows, _ = fig8_edge_quality.measured(results)
    for scene in fig8_edge_quality.SCENES:
        own, others = (fig8_edge_quality.turns_of(rows, scene, of_split) for of_split in (True, False))
        say(f"{scene}: degrees, conventional split; others; largest over largest", span(own), span(others), max(own) / max(others))
        for time in fig8_edge_quality.TIMES:
            here = sorted((r for r in rows if r[:2] == (scene, time)), key=lambda r: -r[4])
            say(f"{scene}, {time:g} s: mm and degrees, most turned first", *(f"{method(r[2])} {r[3]:.1f} mm {r[4]:.2f}" for r in here))
        grown = [method(r[2]) for r in rows if r[:2] == (scene, fig8_edge_quality.TIMES[-1]) and r[5] != "ok"]
        say(f"{scene}: not ok", f"{len(grown)}", *grown)
    by_cg = {r[1:3]: r[4] for r in rows if r[0] == "cg"}
    say("CG to 0.01 against direct, degrees at most", max(abs(by_cg[r[1:3]] - r[4]) for r in rows if r[0] == "patches"))
    early = [r for r in rows if r[0] == "unconverged"]
    for ours in (False, True):
        say(f"stopped at 0.3, {'warp_and_refine' if ours else 'the others'}",
            span(r[4] for r in early if (r[2][0] == "warp_and_refine") == ours))


def detail(results):
    print("The cut edge: figure 10")
    levels, _ = fig10_level_of_detail.read_levels(results)
    split = levels.pop(SPLIT)
    for variant, of_variant in levels.items():
        ratios = [own[1] / other[1] for tolerance in split for own, other in zip(sorted(of_variant[tolerance]), sorted(split[tolerance]))]
        say(f"error of the incision, {method(variant)} over conventional split", span(ratios))


def blade(results):
    """From the logs: what energy.csv has is not relative to the largest energy so far."""
    print("docs/limits.md: the blade, largest rises of the energy")
    for log in sorted(results.glob("*/*/log.txt")):
        text = log.read_text(encoding="utf-8")
        say(log.parent.name, re.search(r"^gains .*: (.*)$", text, re.M)[1], "energy_growth" if "energy_growth" in text else "ok")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, default=load.REPOSITORY / "results/reference", help="the published records")
    parser.add_argument("--scenes", type=Path, default=load.REPOSITORY / "results", help="holds STEM/SCENE/METHOD with frames")
    options = parser.parse_args()

    def published(stem, measures):
        return load.run_of(options.results / f"{stem}.records.csv.xz", options.results / f"{stem}.context.json", measures)
    shapes(published(fig9_aspect_ratio.STEM, fig9_aspect_ratio.MEASURES).first_repetition())
    run = published(table1_timing.STEM, table1_timing.MEASURES + table1_timing.IN_MOTION)
    sheets = naming.sheet_order(run.everything()["sheet"])
    cost([table1_timing.Timings(run, sheet) for sheet in sheets])
    inside([table1_timing.in_motion(run, sheet) for sheet in sheets])
    accuracy(at_equal_unknowns(Records(options.results, "accuracy.direct.records.csv.xz", "accuracy.context.json")))
    for stem, find in ((fig8_edge_quality.STEM, edge), (fig10_level_of_detail.STEM, detail), ("progressive_cut", blade)):
        if (options.scenes / stem).is_dir():
            find(options.scenes / stem)
        else:
            print(f"{options.scenes / stem} is missing: experiments/reproduce {stem} makes it")


if __name__ == "__main__":
    main()
