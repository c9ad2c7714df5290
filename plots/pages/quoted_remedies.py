#!/usr/bin/env python3
"""The numbers that docs/remedies.md quotes of the stages `remedies`, `one_change`, `tips` and `parameters` of experiments/publish and that are
no cells of their texts, a line each, in the order of the page. Reads the published records. In brackets: 95 % intervals, by drawing
the cuts anew (bootstrap), or the problems where errors are compared, or the paths where all sheets have the same."""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from analysis import load
from analysis.accuracy import tip_functions
from analysis.accuracy.ranking import at_equal_unknowns, made_by_all
from analysis.accuracy.records import CASE, Records
from analysis.methods import one_change, remedies
from analysis.methods.details import KEY
from pages.quoted import say

SPLIT, POLYGONS, REMESH, NODE = "conventional_split", "cut_polygons", "adaptive_remesh", "active_node"
SIZES = [800, 3200]
MEASURES = ["eigenvalue_ratio", "bending_eigenvalue_ratio", "stabilised_eigenvalue_ratio", "stabilised_bending_eigenvalue_ratio",
            "ar_max_cut", "ar_max_cut_outside_wedges", "over_3_cut", "vertices_added", "geometry_us", "constrain_us", "crossed_triangles", "pieces"]
RELEASED = "error_released_energy"


def by(rows, method, **values):
    """\\param method  its name, or (method, parameter)"""
    rows = rows[rows["method"] == method] if isinstance(method, str) else load.of(rows, method)
    for column, value in values.items():
        rows = rows[rows[column] == value]
    return rows


def bracket(value, drawn):
    low, high = np.quantile(drawn, [0.025, 0.975])
    return f"{load.number(value)} [{load.number(low)}, {load.number(high)}]"


def ratios(one, other, column, key):
    """Of one over the other on the same cuts."""
    pairs = one[[*key, column]].merge(other[[*key, column]], on=key, suffixes=("", "_other"))
    return pairs.assign(ratio=(pairs[column] / pairs[f"{column}_other"]).abs())


def median_ratio(*pairs):
    values = ratios(*pairs)["ratio"].to_numpy()
    return bracket(np.median(values), np.median(np.random.default_rng(1).choice(values, (10000, len(values))), axis=1))


def mean_ratio(*pairs):
    """Geometric; problems are drawn anew."""
    pairs = ratios(*pairs)
    logs = np.log(pairs["ratio"])
    return bracket(np.exp(logs.mean()), np.exp(load.drawn_group_means(logs, pairs["problem"])))


def spread(values):
    return [f"{value:.3g}" for value in np.quantile(values, [0.5, 0.95, 1])]


def per_crossed(cuts, column="geometry_us"):
    return (cuts[column] / cuts["crossed_triangles"]).median()


# ---- the sections of the page


def chart(cuts, accuracy):
    print("The table below the chart")
    for (method, parameter), here in cuts[cuts["cut_family"] != "several"].groupby(["method", "parameter"], sort=False):
        say(f"without several: {method} {parameter}", *spread(here["eigenvalue_ratio"]))
        if method in remedies.ADDED_MASS["stabilised"]:
            say(f"without several: {method}, stabilised mass", *spread(here["stabilised_eigenvalue_ratio"]))
    exact = accuracy.table[accuracy.table["problem"].isin(accuracy.exact)]
    medians = 100 * exact.groupby("method")["error"].median()
    say(f"{', '.join(accuracy.exact)}: medians of {len(by(exact, SPLIT))} cases, %, the three largest",
        *(f"{method} {error:.2g}" for method, error in medians.nlargest(3).items()))


def changes(results):
    print("\nOne change at a time")
    cuts = load.read_records(results / "one_change.records.csv.xz", load.TEXT + ["cut", "mass", "solver"] + load.COUNTS
                             + ["eigenvalue_ratio", "iterations", "step_us"])
    errors = load.read_records(results / "one_change_accuracy.direct.records.csv.xz",
                               load.TEXT + ["problem", "tip_functions", one_change.ERROR] + load.COUNTS)
    for method in ("warp_and_refine", POLYGONS):
        for size in SIZES:
            cg, multigrid = (by(cuts, method, mass="lumped", solver=s, resolution=size) for s in ("cg", "multigrid"))
            say(f"{method}, {size} triangles: a step by multigrid over one by CG", one_change.in_words(*one_change.ratio(multigrid, cg, "step_us")))
    say("multigrid: iterations at most", cuts.loc[cuts["solver"] == "multigrid", "iterations"].max())
    polygons = by(cuts, POLYGONS).pivot_table(index=one_change.CUT, columns="mass", values="eigenvalue_ratio")
    say("polygons: eigenvalue with a lumped mass over that with a stabilised one", *spread(polygons["lumped"] / polygons["stabilised"]))
    merged = by(cuts, POLYGONS, mass="lumped", solver="cg")
    for path, values in merged[merged["cut"] == "several"].groupby("case")["eigenvalue_ratio"]:
        say(f"polygons, several, path {path}: eigenvalue from, to", values.min(), values.max())
    say("polygons, all others: eigenvalue at most", merged[merged["cut"] != "several"]["eigenvalue_ratio"].max())
    grew = cuts[cuts["verdict"] == "energy_growth"].groupby(["method", "mass", "solver"]).size()
    say("energy grew, cuts of 64", *(f"{' '.join(key)} {n}" for key, n in grew.items()))
    tips = (SPLIT, 1)
    for pair in ((tips, (POLYGONS, 0)), (tips, (SPLIT, 0)), *(((POLYGONS, on), (other, on)) for on in (0, 1) for other in (REMESH, SPLIT))):
        for size in SIZES:
            of_pair = (by(errors, method, tip_functions=on, resolution=size) for method, on in pair)
            say(f"{size} triangles: error by " + " over that by ".join(f"{method}, tip functions {tip_functions.ON[on]}," for method, on in pair),
                mean_ratio(*of_pair, one_change.ERROR, CASE))


def polygons(cuts, errors):
    print("\nMerge: cut_polygons")
    here = by(cuts, POLYGONS)
    say(f"error at equal unknowns over that of {REMESH}", mean_ratio(by(errors, POLYGONS), by(errors, REMESH), "ratio_equal", CASE))
    for column, limit in (("eigenvalue_ratio", 100), ("bending_eigenvalue_ratio", 1000)):
        large = here[here[column] > limit]
        say(f"{column}: worst; cuts above {limit}, families, pieces", here[column].max(), str(len(large)), *set(large["cut_family"]),
            large["pieces"].min(), large["pieces"].max())
    say(f"kirsch_hole, rim stress, {SIZES[1]} triangles: {POLYGONS}, {SPLIT}, %", *(
        100 * by(errors, m, problem="kirsch_hole", resolution=SIZES[1])["error_rim_stress"].abs().mean() for m in (POLYGONS, SPLIT)))
    for size in SIZES:
        for method in (POLYGONS, "split_and_tie"):
            say(f"{method}, {size} triangles: us per crossed triangle, of them to find polygons or ties",
                *(per_crossed(by(cuts, method, resolution=size), column) for column in ("geometry_us", "constrain_us")))
    say(f"time over that of {SPLIT}", median_ratio(here, by(cuts, SPLIT), "geometry_us", KEY))


def node(cuts, errors, parameters):
    print("\nMove a node with the blade: active_node")
    cracks = errors[errors["problem"].str.contains("_crack")]
    for method in (NODE, "warp_and_refine", "snap_or_split", SPLIT):
        here = by(cuts, method)
        for size in SIZES:
            of_size = by(here, method, resolution=size)
            say(f"{method}, {size} triangles: AR median, 95 %; vertices added; us", *of_size["ar_max_cut"].quantile([0.5, 0.95]),
                of_size["vertices_added"].median(), per_crossed(of_size))
        say(f"{method}: every AR < 3, % of the cuts", 100 * (here["ar_max_cut"] < 3).sum() / here["ar_max_cut"].notna().sum())
        say(f"{method}: released energy at {cracks['problem'].nunique()} cracks, {SIZES} triangles, %",
            *(100 * by(cracks, method, resolution=n)[RELEASED].mean() for n in SIZES))
        if method != NODE:
            say(f"error at equal unknowns over that of {method}", mean_ratio(by(errors, NODE), by(errors, method), "ratio_equal", CASE))
    for family, here in by(cuts, NODE).groupby("cut_family", sort=False):
        say(f"{family}: eigenvalue at 50, 90, 95, 100 %", *here["eigenvalue_ratio"].quantile([0.5, 0.9, 0.95, 1]))
    for sizes in ([800], [3200], SIZES):
        of_sizes = cuts[cuts["resolution"].isin(sizes)]
        say(f"time over that of {SPLIT}, {sizes} triangles", median_ratio(by(of_sizes, NODE), by(of_sizes, SPLIT), "geometry_us", KEY))
    for parameter, here in by(parameters, NODE, resolution=800).groupby("parameter", sort=False):
        say(f"{parameter}, 800 triangles: eigenvalue, AR, vertices added", *here[["eigenvalue_ratio", "ar_max_cut", "vertices_added"]].median())


def remesh(cuts):
    print("\nRemesh: adaptive_remesh")
    for size in SIZES:
        here, split = (by(cuts, m, resolution=size) for m in (REMESH, SPLIT))
        say(f"{size} triangles: eigenvalue, of {SPLIT}; triangles of an AR above 3", here["eigenvalue_ratio"].median(),
            split["eigenvalue_ratio"].median(), here["over_3_cut"].median())
        families = here.groupby("cut_family")["eigenvalue_ratio"].median()
        say(f"{size} triangles: eigenvalue by family", *(f"{family} {load.number(value)}" for family, value in families.items()))


def doubled(errors):
    print("\nDouble: phantom_node")
    for problem in ("centre_crack", "inclined_crack"):
        for method in (("phantom_node", "ghost=0"), ("phantom_node", "ghost=0.01"), (SPLIT, "")):
            say(f"{problem}, {' '.join(method)}: released energy, {SIZES} triangles, %",
                *(100 * by(errors, method, problem=problem, resolution=n)[RELEASED].mean() for n in SIZES))
    for other in (("phantom_node", "ghost=0"), (SPLIT, "")):
        say(f"error at equal unknowns with a lumped mass over that of {' '.join(other)}", mean_ratio(
            by(errors, "phantom_node:lumped_mass"), by(errors, other), "ratio_equal", CASE))


def mass(cuts):
    print("\nChange the mass")
    for method in remedies.ADDED_MASS["stabilised"]:
        say(f"{method}, stabilised: worst, with bending", *by(cuts, method)[MEASURES[2:4]].max())
    refined = by(cuts, "delaunay_refine")
    for column in ("ar_max_cut", "ar_max_cut_outside_wedges"):
        say(f"delaunay_refine, {column}: below 3; worst", f"{(refined[column] < 3).sum()} of {len(refined)}", refined[column].max())


def tips(results):
    print("\nChange the functions: tip functions")
    columns = [*load.TEXT, "problem", *load.COUNTS, "tip_functions", tip_functions.MEASURE]
    rows = load.read_records(results / "tip_functions.records.csv.xz", columns, all_columns=True)
    rows = rows.assign(error=rows[tip_functions.MEASURE].abs(), ms=rows[["assemble_us", "setup_us", "solve_us"]].sum(axis=1) / 1000,
                       soft=rows["value_released_energy"] > rows["exact_released_energy"])
    say("largest relative residual", f"{rows['residual'].max():.1e}")
    inside = rows[(rows["tip_functions"] == 1) & ~rows["problem"].str.startswith("edge_crack")]
    for size in (*SIZES, 12800):
        say(f"{POLYGONS} with over {SPLIT} with, inside the sheet, {size} triangles", mean_ratio(
            *(by(inside, method, resolution=size) for method in (POLYGONS, SPLIT)), "error", CASE))
    for method, here in rows.groupby("method", sort=False):
        cases = here.pivot(index=["problem", "sheet", "case"], columns=["tip_functions", "resolution"], values="error")
        for size in SIZES:
            say(f"{method}, {size} triangles with over 12,800 without: smaller cases; geometric means by problem, cases drawn anew",
                f"{(cases[1, size] < cases[0, 12800]).sum()} of {len(cases)}", *(
                    "{} {:.2f} [{:.2f}, {:.2f}]".format(problem, *load.ratio(c[1, size], c[0, 12800])[:3]) for problem, c in cases.groupby("problem")))
        say(f"{method}: released energy too large without, with, % of the cases", *(100 * here.groupby("tip_functions")["soft"].mean()))
        for column, on in (("error_tip_k1", 1), ("error_k1", 1), ("error_k1", 0)):
            of_k = by(here, method, tip_functions=on).groupby(["problem", "resolution"])[column].mean().groupby("resolution").mean()
            say(f"{method}: {column}, tip functions {tip_functions.ON[on]}, by size, %", *(100 * of_k))
    ms = rows.pivot(index=["method", "problem", "sheet", "case", "resolution"], columns="tip_functions", values="ms")
    say("assembly, set-up and solve with over without, by size; ms with", *(ms[1] / ms[0]).groupby("resolution").median(),
        *ms[1].groupby("resolution").median())


def main():
    results = load.results_folder("reference", __doc__)
    cuts, parameters = (load.run_of(results / f"{stem}.records.csv.xz", results / f"{stem}.context.json", MEASURES).first_repetition().rows
                   for stem in ("remedies", "method_comparison_parameters"))
    accuracy = Records(results, "remedies_accuracy.direct.records.csv.xz", "remedies_accuracy.context.json")
    errors = made_by_all(at_equal_unknowns(accuracy).ranked().table)
    chart(cuts, accuracy)
    changes(results)
    polygons(cuts, errors)
    node(cuts, errors, parameters)
    remesh(cuts)
    doubled(errors)
    mass(cuts)
    tips(results)


if __name__ == "__main__":
    main()
