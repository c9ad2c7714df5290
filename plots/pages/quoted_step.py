#!/usr/bin/env python3
"""Prints the numbers that docs/step.md quotes of the stages solvers and limits, in the order of the page, labelled by its words. Reads
solver_table.csv.xz, limits.txt and scaling.txt in --results. Milliseconds are of a step, in the median of its run. --before FILE is the
solver_table.csv of another run, whose times say how far runs differ: git show 256d83a:results/reference/solver_table.csv."""

import argparse
import itertools
import sys
from pathlib import Path

import pandas as pd

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from analysis import load
from pages.quoted import say, span

SPLIT, WARP = "conventional_split", "warp_and_refine"
MOTION = [WARP, "snap_or_split", "cgal_cdt", SPLIT, "delaunay_refine", "bowyer_watson"]
SOLVERS = ["multigrid", "constant_factor", "cholmod_stale", "cg", "cg_sliver_blocks", "eigen_cg", "eigen_cg_ichol", "cholmod",
           "cholmod_same_order", "eigen_ldlt"]
SIMPLE = ["eigen_cg", "eigen_cg_ichol", "cg", "cg_sliver_blocks"]  # conjugate gradients with simpler preconditioners
DIRECT = ["cholmod", "cholmod_same_order", "eigen_ldlt"]
SCENE = ["sweep", "method", "cuts", "resolution", "material", "step", "tolerance"]
SHORT, LONG = 1 / 240, 1 / 60


def table(path, first):
    """The rows of a text whose first word is one of `first`, as lists of words."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        load.stop(f"{path} can't be read: {error.strerror}")
    return [line.split() for line in lines if line.startswith(first)]


class Solvers:
    def __init__(self, file):
        try:
            rows = pd.read_csv(file, dtype={"cuts": str}).replace({"solver": load.OLD_SOLVERS})
        except (OSError, ValueError) as error:
            load.stop(f"{file} can't be read: {error}")
        self.rows = rows.assign(step=rows["step"].round(6))

    def of(self, sweep, **values):
        rows = self.rows[self.rows["sweep"] == sweep]
        for column, value in values.items():
            rows = rows[rows[column] == (round(value, 6) if column == "step" else value)]
        return rows

    def each(self, sweep, column="step_ms", **values):
        """{solver: a column} of one scene."""
        rows = self.of(sweep, **values)
        assert not rows.duplicated(["solver"]).any()
        return rows.set_index("solver")[column]


def same_work(rows):
    """How far rows of the same work differ, in percent of the smaller time: pairs of solvers, and one scene in several sweeps."""
    pairs = []
    for _, here in rows.groupby(SCENE):
        here = here.set_index("solver")
        for one, other in (("cholmod", "cholmod_same_order"), ("cg", "cg_sliver_blocks")):
            if one in here.index and other in here.index and here.loc[one, "iterations"] == here.loc[other, "iterations"]:
                pairs.append(here.loc[[one, other], "step_ms"])
    differences = [100 * (max(pair) / min(pair) - 1) for pair in pairs]
    say("pairs of the same work differ by at most, %; their number", max(differences), str(len(pairs)))
    one_scene = rows[rows["solver"].isin(DIRECT) & (rows["resolution"] == 3200) & (rows["cuts"] == "4") & (rows["tolerance"] == 0.01)
                     & (rows["material"] == "skin") & (rows["step"] == round(SHORT, 6)) & rows["method"].isin([SPLIT, WARP])]
    times = one_scene.groupby(["solver", "method"])["step_ms"]
    say("rows of a direct solver for one scene in three sweeps, %", span(100 * (times.max() / times.min() - 1)))


def against(rows, before):
    """Times of another run over those here."""
    both = rows.merge(before, on=[*SCENE, "solver"], suffixes=("", "_before"))
    same = both["iterations"].fillna(-1) == both["iterations_before"].fillna(-1)
    say("rows of both runs; with the same iterations", str(len(both)), str(same.sum()))
    both = both.assign(ratio=both["step_ms_before"] / both["step_ms"])
    for sweep, here in both.groupby("sweep"):
        say(f"times of the other run over these, {sweep}: median, 5 to 95 %, all", here["ratio"].median(),
            *(span(here["ratio"].quantile(ends)) for ends in ([0.05, 0.95], [0, 1])))
    for row in both[both["sweep"] == "two cuts in motion"].sort_values("ratio").tail(4).itertuples():
        say(f"  {row.method}, {row.solver}", row.ratio)


def two_cuts(solvers):
    print("Two cuts in a moving sheet")
    same_work(solvers.rows)
    ms, worst = {}, {}
    for method in MOTION:
        ms[method], worst[method], iterations, with_cut = (
            solvers.each("two cuts in motion", column, method=method)
            for column in ("step_ms", "worst_step_ms", "iterations", "worst_step_with_cut_ms"))
        say(f"{method}: cg, iterations and ms; multigrid, iterations and ms; cholmod, ms", iterations["cg"], ms[method]["cg"],
            iterations["multigrid"], ms[method]["multigrid"], ms[method]["cholmod"])
        say("  the longest step with a cut, and of all, by multigrid", with_cut["multigrid"], worst[method]["multigrid"])
        say("  blocks around slivers over cg: ms, iterations", ms[method]["cg_sliver_blocks"] / ms[method]["cg"],
            iterations["cg_sliver_blocks"] / iterations["cg"])
    for method in MOTION[1:]:
        say(f"{method} over {WARP}: cg, multigrid", *(ms[method][s] / ms[WARP][s] for s in ("cg", "multigrid")))


def ten_solvers(solvers):
    print("Ten solvers")
    columns = [solvers.each("size", method=WARP, resolution=12800), solvers.each("size", method=SPLIT, resolution=12800),
               solvers.each("size", method=SPLIT, resolution=51200), solvers.each("cuts", method=SPLIT, cuts="20"),
               solvers.each("cuts", method=WARP, cuts="20")]
    for solver in SOLVERS:
        say(solver, *(column[solver] for column in columns))
    for method in (SPLIT, WARP):
        for size in sorted(set(solvers.of("size")["resolution"])):
            ms = solvers.each("size", method=method, resolution=size)
            others = ms.drop("multigrid")
            say(f"{method}, {size}: the fastest other over multigrid; multigrid over it", others.min() / ms["multigrid"],
                ms["multigrid"] / others.min(), others.idxmin())
    for solver, method in itertools.product(("multigrid", "cg"), (SPLIT, WARP)):
        rows = solvers.of("size", solver=solver, method=method).set_index("resolution")["iterations"]
        say(f"iterations of {solver} at 800 and 51,200, {method}", rows[800], rows[51200])
    say("iterations of constant_factor in the sweep of cuts", span(solvers.of("cuts", solver="constant_factor")["iterations"]))
    for method in MOTION:
        ms = solvers.each("cuts", method=method, cuts="20")
        failed = {row.solver: row.verdict for row in solvers.of("cuts", method=method, cuts="20").itertuples() if row.verdict != "ok"}
        say(f"20 cuts by {method}: constant_factor, multigrid, cg, blocks", *ms[["constant_factor", "multigrid", "cg", "cg_sliver_blocks"]],
            *(f"{solver} {verdict}" for solver, verdict in failed.items()))
        say("  eigen_cg_ichol over eigen_cg", ms["eigen_cg_ichol"] / ms["eigen_cg"])
    with_cut = solvers.each("size", "worst_step_with_cut_ms", method=SPLIT, resolution=12800)
    say("the step with a cut at 12,800, four cuts by conventional_split: constant_factor, multigrid", *with_cut[["constant_factor", "multigrid"]])
    stale = solvers.rows[solvers.rows["sweep"].isin(["cuts", "size"]) & (solvers.rows["solver"] == "cholmod_stale")]
    say("iterations of cholmod_stale in the sweeps of sizes and cuts", span(stale["iterations"]))
    say("eigen_ldlt over cholmod at 12,800", *(columns[i]["eigen_ldlt"] / columns[i]["cholmod"] for i in (0, 1)))
    saves = solvers.of("size", solver="eigen_cg_ichol").merge(solvers.of("size", solver="eigen_cg"), on=SCENE)
    say("eigen_cg_ichol over eigen_cg in the sweep of sizes", span(saves["step_ms_x"] / saves["step_ms_y"]))


def settings(solvers):
    print("Tolerance, step, material")
    four = [("skin", SHORT, 1e-2), ("skin", SHORT, 1e-4), ("skin", LONG, 1e-2), ("cotton", SHORT, 1e-2)]
    for solver in ("multigrid", "cg", "constant_factor", "cholmod_stale", "cholmod"):
        rows = [solvers.of("settings", method=SPLIT, solver=solver, material=m, step=h, tolerance=t).iloc[0] for m, h, t in four]
        say(solver, *(f"{load.number(row.step_ms)} ({load.number(row.iterations)})" for row in rows))
    for method, tolerance in itertools.product((SPLIT, WARP), (1e-2, 1e-4)):
        error = 1000 * solvers.each("settings", "error", method=method, material="skin", step=SHORT, tolerance=tolerance)
        say(f"error, mm, {method}, tolerance {tolerance:g}: direct", span(error[DIRECT]))
        for solver in [s for s in SOLVERS if s not in DIRECT]:
            say(f"  {solver}", error[solver])
        say("  the four simpler ones", span(error[SIMPLE]))
    bad = solvers.of("settings").query("verdict != 'ok'")
    for key, rows in bad.groupby(["material", "step", "verdict"]):
        say(f"{key[0]}, 1/{1 / key[1]:.0f} s, {key[2]}: rows", str(len(rows)), "of",
            str(len(solvers.of("settings", material=key[0], step=key[1]))))
    given = solvers.of("settings").dropna(subset=["error"])[["material", "step"]].drop_duplicates()
    say("an error is given of", *(f"{row.material}, 1/{1 / row.step:.0f} s" for row in given.itertuples()))
    at_12800 = solvers.of("size", resolution=12800)
    at_12800 = at_12800[at_12800["solver"].isin(["multigrid", "cg", "cg_sliver_blocks", "eigen_cg"])]
    say("all of a step but set-up and solve at 12,800, ms, median of four solvers and two methods (What binds a step)",
        (at_12800["step_ms"] - at_12800["setup_ms"] - at_12800["solve_ms"]).median())


def limits(folder):
    print("What binds a step")
    phases = ("rotate", "assemble", "right side", "set-up", "product", "cycle")
    rows = table(folder / "limits.txt", phases)
    large = rows[len(rows) // 2:]
    say("shares at 204,800 triangles, %", span(row[-1] for row in large))
    say("Gflop/s of all phases at both sizes", span(row[-2] for row in rows))


def larger(folder):
    print("Larger sheets")
    names = ["method", "triangles", "crossed", "geometry", "state", "pattern", "bending", "levels", "bytes"]
    rows = pd.DataFrame(table(folder / "scaling.txt", (SPLIT, "cgal_cdt", WARP)), columns=names)
    rows[names[1:]] = rows[names[1:]].astype(float)
    at = rows.set_index(["triangles", "method"])
    for column in ("geometry", "bending", "pattern", "levels"):
        say(f"{column}: 3,276,800 triangles over 12,800", span(at[column][3276800] / at[column][12800]))
    say(f"pattern by {SPLIT} at 204,800 and 819,200", *(at["pattern"][n, SPLIT] for n in (204800, 819200)))
    say("bytes per triangle", span(rows["bytes"]))
    for size in (12800, 819200, 3276800):
        say(f"state at {size}", span(at["state"][size]))
    split = rows["method"] == SPLIT
    for name, here in ((SPLIT, rows[split]), ("the other two", rows[~split])):
        say(f"over the geometry: levels, bending, {name}", *(span(here[c] / here["geometry"]) for c in ("levels", "bending")))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results/reference")
    parser.add_argument("--before", type=Path, metavar="FILE")
    options = parser.parse_args()
    folder = options.results
    solvers = Solvers(folder / "solver_table.csv.xz")
    if options.before:
        against(solvers.rows, Solvers(options.before).rows)
    two_cuts(solvers)
    ten_solvers(solvers)
    settings(solvers)
    limits(folder)
    larger(folder)


if __name__ == "__main__":
    main()
