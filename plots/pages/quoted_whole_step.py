#!/usr/bin/env python3
"""Prints the numbers that docs/results.md and docs/step.md quote from whole_step and that are no cell of its tables, in the order
of the pages, labelled by their words. Of the published rows in --results."""

import itertools
import sys
from pathlib import Path

import numpy as np
import pandas as pd

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from analysis import load
from analysis.whole_step import points, runs
from analysis.whole_step.draws import fronts as fronts_drawn
from analysis.whole_step.points import SETTING
from pages.quoted import say, span

SIZES = [800, 3200, 12800]
CASE = ["sheet", "resolution", "case", *SETTING]
REFINE = ["delaunay_refine", "cgal_refine", "global_remesh", "longest_edge"]
NAMED = ["adaptive_remesh", "cut_polygons", "warp_and_refine", "conventional_split", "edge_release"]
SLOW = ["delaunay_refine", "cgal_refine", "longest_edge", "bowyer_watson", "warp_and_refine", "conventional_split"]
GREW = ["element_deletion", "conventional_split", "example", "split_and_tie"]


def ratios(motions, other):
    """The motions by runs.SAME with `ratio`, their time over that of the same case by another method."""
    motions = motions[motions["solver"] == runs.SAME]
    others = motions.loc[motions["method"] == other, [*CASE, "ms"]]
    pairs = motions.merge(others, on=CASE, suffixes=("", "_other"))
    with np.errstate(invalid="ignore"):  # both ended early
        return pairs.assign(ratio=pairs["ms"] / pairs["ms_other"])


def interval(rows, draws=1000):
    """95 % of the median ratio: the cuts are drawn anew, each with all of its settings."""
    cuts = [here["ratio"].to_numpy() for _, here in rows.groupby(["sheet", "resolution", "case"])]
    which = np.random.default_rng(1).integers(0, len(cuts), (draws, len(cuts)))
    return load.quantiles([load.median(np.concatenate([cuts[i] for i in drawn])) for drawn in which], [0.025, 0.975])


def with_interval(rows):
    low, high = interval(rows)
    return f"{load.number(load.median(rows['ratio']))} [{load.number(low)}, {load.number(high)}]"


def of(rows, method, cuts, size=None):
    rows = rows[(rows["method"] == method) & (rows["place"] == cuts)]
    return rows if size is None else rows[rows["resolution"] == size]


def method_table(to_split, to_warp):
    for cuts in (1, 20):
        say(f"adaptive_remesh: a motion after {cuts} cut(s), over conventional_split", with_interval(of(to_split, "adaptive_remesh", cuts)))
    for method in ("conventional_split", "example"):
        after_one = of(to_warp, method, 1)
        say(f"{method}: after one cut its motion takes ... times as long as that after warp_and_refine [quartiles], by size",
            *load.quantiles(after_one["ratio"], [0.5, 0.25, 0.75]), *(with_interval(of(to_warp, method, 1, n)) for n in SIZES))
        say(f"{method}: after 20 cuts, by size", *(with_interval(of(to_warp, method, 20, n)) for n in SIZES))


def settings_of(table):
    """In how many settings a method is on the front."""
    return table[table["layer"] == 1].drop_duplicates([*SETTING, "method"])["method"].value_counts()


def drawn_counts(motions, folder, draws=300):
    """settings_of() the fronts of cuts and kinds of problems that are drawn anew: 95 %."""
    counts = [settings_of(table) for table in fronts_drawn(motions, points.LEADS, draws, folder)]
    return pd.concat(counts, axis=1).fillna(0).quantile([0.025, 0.975], axis=1)


def on_fronts(motions, fronts, errors, folder):
    counts, drawn = settings_of(fronts[points.LEADS]), drawn_counts(motions, folder)
    for method in sorted(drawn, key=lambda m: -counts.get(m, 0)):
        say(f"on the front of how many settings [95 %]: {method}", f"{counts.get(method, 0)} [{drawn[method].min():g}, {drawn[method].max():g}]")
    percent = 100 * errors[points.LEADS].set_index(["method", "resolution"])["error"]
    for method in NAMED:
        say(f"errors at {SIZES} triangles, %: {method}", *(percent[method, n] for n in SIZES))
    front = fronts[points.LEADS].query("layer == 1")
    share = 100 * front["cut_ms"] / front["ms"]
    say("on the fronts the cut and its update are, % of the time (quartiles; at most)", *load.quantiles(share, [0.25, 0.75, 1]))


def times(to_split):
    """After one cut, and after twenty: by all methods, the fastest first."""
    for cuts, only in ((1, None), (20, None), (20, 12800)):
        found = {m: of(to_split, m, cuts, only) for m in sorted(set(to_split["method"]) - {"cisamr"})}  # not on all sheets
        size = f", {only} triangles" if only else ""
        for method in sorted(found, key=lambda m: load.median(found[m]["ratio"])):
            say(f"over conventional_split after {cuts} cut(s){size}: {method}", with_interval(found[method]))
        say(f"... of {', '.join(REFINE)}", span([load.median(found[m]["ratio"]) for m in REFINE]))


def iterations(rows):
    rows = rows[(rows["solver"] == runs.SAME) & (rows["place"] == 20) & (rows["verdict"] != "refused")]
    median = rows.groupby(["method", "resolution"])["iterations"].agg(load.median)
    for method in SLOW:
        say(f"iterations a step after twenty cuts at {SIZES} triangles: {method}", *(median[method, n] for n in SIZES))
    say("... after all others", span(median.drop(index=SLOW, level="method")))


def fastest(motions):
    """Shares of the cases in which a solver is the fastest; cases that no solver brings to the end have none."""
    best = motions[motions["made"]].sort_values("ms").drop_duplicates(["method", *CASE])
    for words, solver, here in (("after one or four cuts", runs.SAME, best[best["place"] < 20]),
                                ("after twenty cuts", "cholmod", best[best["place"] == 20])):
        share = 100 * (here["solver"] == solver).groupby(here["resolution"]).mean()
        say(f"{solver} is the fastest {words} at {SIZES} triangles, % of the cases", *(share[n] for n in SIZES))


def growth(motions, folder):
    """In the motions of the sheets that a method does not refuse, those that ended early among them."""
    for stiffness, size in itertools.product(sorted(set(motions["stiffness_n_m"])), (None, 12800)):
        here = motions[(motions["stiffness_n_m"] == stiffness) & (motions["resolution"].eq(size) | (size is None))]
        grew = 100 * (here["verdict"] == "energy_growth").groupby(here["method"]).mean()
        words = f"energy grew in % of the motions at {stiffness:g} N/m" + (f", {size} triangles" if size else "")
        for method in GREW:
            say(f"{words}: {method}", grew[method])
        say(f"{words}: the others", span(grew.drop(GREW)))
    chart = runs.read_chart(folder)[0].query(f"method == 'conventional_split' and solver == '{runs.SAME}'")
    for size, verdicts in chart.groupby("resolution")["verdict"]:
        say(f"README's chart, conventional_split at {size} triangles, {runs.SAME}: energy grew in",
            f"{verdicts.eq('energy_growth').sum()} of {len(verdicts)}")
    others = motions[motions["method"] != "element_deletion"]
    for key, here in others.groupby(["stiffness_n_m", "step_s", "place"]):
        say(f"energy grew by all but element_deletion, % of the motions: {runs.setting_name(key[::-1])}",
            100 * (here["verdict"] == "energy_growth").mean())
    for stiffness, here in others.groupby("stiffness_n_m"):
        say(f"... all at {stiffness:g} N/m", 100 * (here["verdict"] == "energy_growth").mean())
    off = points.best_of(points.costs(motions)).groupby([*SETTING, "method"])["grew"].min().gt(0.5).groupby(SETTING).sum()
    say("the setting in which energy grew in over half of the motions at all sizes after the most methods",
        runs.setting_name(off.idxmax()), str(off.max()), f"of {motions['method'].nunique()}; next", str(off.nlargest(2).iloc[1]))


def other_errors(fronts, errors):
    for key, table in fronts.items():
        say(f"on the front by {points.MEASURES[key].title}, of 12", *(f"{m} {n}" for m, n in settings_of(table).items()))
    for key, table in errors.items():
        say(f"{points.MEASURES[key].title}: means over", f"{table['kinds'].max()} {points.MEASURES[key].of}", "of sizes",
            *map(str, sorted(set(table["resolution"]))))
    polygons = errors["released_energy"].query("method == 'cut_polygons' and resolution == 800").iloc[0]
    say("primary error: cut_polygons at 800 triangles, % [95 %]", *(100 * polygons[["error", "error_low", "error_high"]]))


def rank_correlations(errors):
    """As tables.print_ranks()."""
    rest, motion = (errors[key].set_index(["resolution", "method"])["error"] for key in (points.LEADS, "motion"))
    both = rest.to_frame("rest").join(motion.rename("motion")).join(
        errors["out_of_plane"].set_index(["resolution", "method"])["error"].rename("out"), how="inner").dropna()
    for size in (3200, 800):
        here = both.loc[size]
        say(f"In motion: rank correlation of the gape in motion and the energy norm at rest, {size} triangles, {len(here)} points",
            here["rest"].corr(here["motion"], method="spearman"))


def main():
    folder = load.results_folder("reference", __doc__)
    rows, context = runs.read(folder)
    motions, best = points.motions(rows), points.best_of(points.costs(rows))
    errors = {key: points.errors(key, folder) for key in points.MEASURES}
    fronts = {key: points.joined(best, error) for key, error in errors.items()}
    say("commit and seed", str(context["commit"])[:7], str(context["seed"]))
    say("cases at each size", *(f"{n}: {motions[motions['resolution'] == n]['case'].nunique()}" for n in SIZES))
    print("\nWhich method? (docs/results.md)")
    to_split = ratios(motions, "conventional_split")
    method_table(to_split, ratios(motions, "warp_and_refine"))
    on_fronts(motions, fronts, errors, folder)
    times(to_split)
    iterations(rows)
    fastest(motions)
    growth(motions, folder)
    other_errors(fronts, errors)
    print("\nIn motion, The step after the cut (docs/results.md)")
    rank_correlations(errors)
    one_cut = fronts[points.LEADS].query("layer == 1 and resolution == 12800 and place == 1")
    say("cut and update together at 12,800 triangles, one cut, on the fronts, ms", span(one_cut["cut_ms"]))
    print("\nWhich solver when? (docs/step.md)\nsee: cholmod is the fastest after twenty cuts")


if __name__ == "__main__":
    main()
