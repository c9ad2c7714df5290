#!/usr/bin/env python3
"""The numbers that docs/stability.md quotes of the stage `stability` of experiments/publish and that are no cell of stability.md, a line
each, in the order of the page, labelled by their words. Reads the published records; those of a run by --results results/stability."""

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from analysis import load
from analysis.stability import points
from analysis.stability.points import EXPLICIT, text
from analysis.stability.table import rounded
from pages.quoted import drawn_whole, say, span
from pages.quoted_comparison import bracket

SPLIT, MASS, POLYGONS, RELEASE = "conventional split", "stabilised mass", "cut polygons", "edge release"
DISTANCES = ["vertex", "edge", "border", "tip"]
TO_REMEDY = [*DISTANCES, "angle", "strip", "piece", "in_a_row"]
REMEDIES = [SPLIT, "snap or split", "warp and refine", "active node", RELEASE, POLYGONS, MASS]
BY_DISTANCE = [f"{sweep}_solvers" for sweep in [*DISTANCES, "angle", "strip", "in_a_row"]]
STIFFNESSES = [1e1, 1e3, 1e5, 1e6, 1e7]


def of(rows, sweep, name=None):
    rows = rows[rows["sweep"] == sweep]
    return rows if name is None else rows[rows["name"] == name]


def ok(rows):
    return f"{(rows['rank'] == 0).sum()} of {len(rows)}"


def places(rows):
    return ", ".join(text(place) for place in dict.fromkeys(rows["place"])) or "none"


def with_quartiles(ratios):
    q1, middle, q3 = ratios.quantile([0.25, 0.5, 0.75])
    return f"{load.number(middle)} [quartiles {load.number(q1)}, {load.number(q3)}]"


def quantile(rows, share):
    """Of the explicit step. Each cut is on several sheets; the cuts are drawn anew, each with all of its sheets."""
    drawn = drawn_whole(rows, ["cut", "case"], [EXPLICIT])[:, :, 0]
    return bracket(rows[EXPLICIT].quantile(share), np.quantile(drawn, share, axis=1), rounded)


def breaks_first(rows):
    print("What breaks first, and the cheapest cure")
    for name in dict.fromkeys(of(rows, "vertex")["name"]):
        for place, here in of(rows, "vertex", name).groupby("place"):
            low = here[here[EXPLICIT] < 0.1]
            if 1e-12 < place < 1e-6 and 0 < len(low) < len(here) and name in ["adaptive remesh", "warp and refine", MASS]:
                say(f"{name} at {text(place)} h: step, places below 0.1", rounded(low[EXPLICIT].min()), f"{len(low)} of {len(here)}")
    for name in (MASS, POLYGONS):
        say(f"{name}: least after single and after four cuts",
            *(of(rows, sweep, name)[EXPLICIT].min() for sweep in ("single_cuts", "several_cuts")))
    for name in (MASS, SPLIT):
        cuts = rows[(rows["name"] == name) & rows["sweep"].isin(["single_cuts", "several_cuts"])]
        say(f"docs/remedies.md: {name}, after {len(cuts)} cuts: median, least", *(rounded(cuts[EXPLICIT].quantile(share)) for share in (0.5, 0)))
    runs = of(rows, "explicit")
    pairs = of(runs, "explicit", MASS).merge(of(runs, "explicit", SPLIT), on=["case", "step_share"], suffixes=("", "_split"))
    for column in ("cut_update_us", "step_us"):
        say(f"{MASS}: {column}, that of {SPLIT}, ratio", pairs[column].median(), pairs[f"{column}_split"].median(),
            with_quartiles(pairs[column] / pairs[f"{column}_split"]))


def remedies(rows):
    print("Which remedy moves which border: least (last value to which all places have 0.1)")
    for sweep in TO_REMEDY:
        cells = []
        for name in REMEDIES:
            table = points.worst(of(rows, sweep, name), ["place"])
            last = points.breaking_point(table["place"], table["explicit"] >= 0.1)[0]
            cells.append(f"{rounded(table['least_known'].min())} ({text(last)})")
        say(sweep, *cells)
    stabilised = rows[(rows["name"] == MASS) & rows["sweep"].isin(TO_REMEDY)]
    for sweep in TO_REMEDY:
        for place, here in of(stabilised, sweep).groupby("place", sort=False):
            if here[EXPLICIT].isna().any() or here[EXPLICIT].min() < 0.58:
                say(f"{MASS}, {sweep} {text(place)}: least, not known", rounded(here[EXPLICIT].min()),
                    f"{here[EXPLICIT].isna().sum()} of {len(here)}", *here["verdict"].unique())
    warped = rows[(rows["name"] == "warp and refine") & rows["sweep"].isin(["vertex", "edge"]) & (rows["place"] == 1e-10)]
    say("warping at 1e-10 h, below 0.1", *(f"{r.sweep} {r.sheet} {rounded(r.explicit_step_ratio)}"
                                         for r in warped[warped[EXPLICIT] < 0.1].itertuples()))
    ghost = rows[rows["name"] == "phantom, ghost 0.01"]
    say("ghost=0.01: least", *(f"{sweep} {rounded(of(ghost, sweep)[EXPLICIT].min())}" for sweep in TO_REMEDY))
    small = of(rows, "piece")[lambda piece: piece["place"] <= 1e-8]
    stalled = small[small["verdict"] == "solver_stalled"].groupby(["name", "place"]).size()
    say("pieces of 1e-8 and less: CG stalls in cases of three", span(stalled, 1))
    say("after none of", *sorted(set(small["name"]) - {name for name, _ in stalled.index}))
    thousand = of(rows, "in_a_row")[lambda row: row["place"] == 1000]
    say("a thousand cuts: not ok", *(f"{r.name} {r.verdict}" for r in thousand[thousand["rank"] > 0].itertuples(index=False)))


def solvers(rows):
    print("The solver")
    swept = rows[rows["sweep"].isin(BY_DISTANCE)]
    say(f"{POLYGONS}: points ok", ok(swept[swept["name"] == POLYGONS]))
    for solver, here in of(rows, "vertex_solvers", SPLIT).groupby("solver", sort=False):
        say(f"{SPLIT} that passes a vertex, {solver}: not ok at", places(here[here["rank"] > 0]))
    strip = of(rows, "strip_solvers").groupby("name", sort=False)["rank"].max()
    say("between two parallel cuts, by all solvers, ok", *strip[strip == 0].index)
    whole = swept.groupby(["name", "solver", "sweep"], sort=False)["rank"].max().eq(0).groupby(["name", "solver"], sort=False)
    for name, sums in whole.agg(["sum", "size"]).groupby("name", sort=False):
        say(f"sweeps ok, {name}", *(f"{solver} {n} of {tried}" for (_, solver), n, tried in sums.itertuples()))
    last = of(rows, "in_a_row_cholmod")
    say("in a row by CHOLMOD", *(f"{r.name} {text(r.place)} {r.verdict}" for r in last.itertuples(index=False)))
    same = ["name", "case", "place", "integrator", "solver"]
    masses = of(rows, "vertex_mass")
    pairs = masses[masses["mass"] == "lumped"].merge(masses[masses["mass"] == "consistent"], on=same, suffixes=("", "_other"))
    changed = pairs[(pairs["rank"] == 0) != (pairs["rank_other"] == 0)]
    say("consistent mass changes whether a point is ok, for the worse", f"{len(changed)} of {len(pairs)}", f"{(changed['rank'] == 0).sum()}")


def everything(rows):
    print("Does any method have everything? Median and 95 %; on even sheets; after four cuts. In brackets 95 %, the cuts drawn anew")
    for name, here in of(rows, "single_cuts").groupby("name", sort=False):
        say(name, *(quantile(cuts, share) for cuts in (here, here[here["sheet"] != "graded"], of(rows, "several_cuts", name))
                    for share in (0.5, 0.05)))
    rolled = of(rows, "rolled", POLYGONS)
    say(f"{POLYGONS}: energy grows rolled up by", ", ".join(
        f"{angle:g}" for angle in sorted(set(rolled[rolled["verdict"] == "energy_growth"]["pose_amount"]))))
    for name, here in of(rows, "turned_over").groupby("name", sort=False):
        still = here[here["pose_amount"] == 1]
        grown = still["reason"].str.extract(r"rose by (\S+) %")[0].dropna().astype(float)
        say(f"not stretched, {name}: ok, energy rises in %", ok(still), span(grown, 2) if len(grown) else "none")


def last_steps(maps, **values):
    """For each stiffness the largest step up to which all were ok."""
    for column, value in values.items():
        maps = maps[maps[column] == value]
    for stiffness in STIFFNESSES:
        series = points.worst(maps[maps["stiffness_n_m"] == stiffness], ["step_s"])
        yield points.breaking_point(series["step_s"], series["rank"] == 0)[0]


def steps(rows):
    print("Steps, stiffness and Newton: largest step (with damping)")
    maps = of(rows, "step_stiffness")
    for (integrator, newton, name), here in maps.groupby(["integrator", "newton", "name"], sort=False):
        plain, damped = (list(last_steps(here, stiffness_damping_s=value)) for value in (0, 1e-3))
        say(f"{integrator}, {newton:g}, {name}", *(f"{text(one)} ({text(other)})" for one, other in zip(plain, damped)))
    three = maps[(maps["newton"] == 3) & (maps["rank"] > 0)]
    say("three iterations: verdicts", *(f"{verdict} {n}" for verdict, n in three["verdict"].value_counts().items()))
    for part, here in of(rows, "vertex_stress").groupby("stress_stiffness", sort=False):
        say(f"stiffness from stress: {part}", ok(here))
    for (name, integrator, poisson), here in of(rows, "step_poisson").groupby(["name", "integrator", "poisson"], sort=False):
        series = points.worst(here[here["newton"] == 1], ["step_s"])
        say(f"Poisson's ratio {poisson:g}, {integrator}, {name}: ok up to, with three iterations", *(
            text(points.breaking_point(table["step_s"], table["rank"] == 0)[0])
            for table in (series, points.worst(here[here["newton"] == 3], ["step_s"]))))
    grown = of(rows, "rolled")[lambda rolled: rolled["verdict"] == "energy_growth"]
    jumps = grown["reason"].str.extract(r"by jumps at cuts the energy rose by (\S+) %")[0].dropna().astype(float)
    say("rolled up: energy grows, by a jump at the cut, by more than 10 %", *(f"{n}" for n in (len(grown), len(jumps), (jumps > 10).sum())))
    say("begins at degrees", *(f"{name} {angle:g}" for name, angle in grown.groupby("name")["pose_amount"].min().items()))
    over = of(rows, "turned_over")
    for amount in (1.5, 0.8, 0.5):
        here = over[over["pose_amount"] == amount]
        say(f"stretched to {amount}: turned over, cases of {len(here) // here['name'].nunique()}", *(
            f"{name} {n}" for name, n in (here["verdict"] == "inverted").groupby(here["name"], sort=False).sum().items()))
    free = of(rows, "piece_static")
    say("a free piece at rest is found", f"{(free['verdict'] == 'solver_stalled').sum()} of {len(free)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results/reference")
    rows = points.read(parser.parse_args().results)
    say("points", f"{len(rows):,}")
    breaks_first(rows)
    remedies(rows)
    solvers(rows)
    everything(rows)
    steps(rows)


if __name__ == "__main__":
    main()
