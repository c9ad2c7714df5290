#!/usr/bin/env python3
"""The numbers that docs/results.md and docs/remedies.md quote of the stage `parameters` of experiments/publish and that are no cells of
method_comparison_parameters.txt, a line each. Reads the published records; those of a run by --results results. In brackets: 95 %
intervals. Of the parameters and the ablation each curve is on two sheets of two sizes: the curves are drawn anew, each with all of them."""

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from analysis import load
from analysis.methods.comparison import MEASURES, cuts_of
from analysis.methods.details import KEY
from analysis.methods.parameters import AFTER, BEFORE
from pages.quoted import drawn_whole, say, span
from pages.quoted_comparison import bracket, by, files

EIGENVALUE = "eigenvalue_ratio"
CURVE = ["cut_family", "case"]


def cuts(results, stem):
    return cuts_of(load.run_of(*files(results, stem), MEASURES))[1]


def quantile(rows, share=0.5):
    return bracket(rows[EIGENVALUE].quantile(share), np.quantile(drawn_whole(rows, CURVE, [EIGENVALUE])[:, :, 0], share, axis=1))


def ratio(rows, others, column, share=0.5):
    """The median, or another quantile, over that of the others, of the same cuts."""
    both = [column, f"{column}_other"]
    pairs = rows.merge(others, on=KEY, suffixes=("", "_other"))
    drawn = np.quantile(drawn_whole(pairs, CURVE, both), share, axis=1)
    return bracket(np.divide(*pairs[both].quantile(share)), drawn[:, 0] / drawn[:, 1])


def tail(rows):
    return quantile(rows), f"95 % {quantile(rows, 0.95)}", f"worst {load.number(rows[EIGENVALUE].max())}"


def ablation(parts, polygons):
    print("Parts: eigenvalue, median; 95 %; worst")
    for before in BEFORE:
        for after in AFTER:
            say(f"{before}, then {after}", *tail(by(parts, f"ablation:{before}:{after}")))
    say("cut_polygons", *tail(polygons))
    for before in ("nothing", "snap", "warp+thin"):
        tied = by(parts, f"ablation:{before}:tie")
        say(f"{before}: with constraints over without, at 95 %", ratio(tied, by(parts, f"ablation:{before}:nothing"), EIGENVALUE, 0.95))
    tied = [by(parts, f"ablation:{before}:tie") for before in ("snap", "warp+thin")]
    say("constraints after snap over those after warp+thin, at 95 %", ratio(*tied, EIGENVALUE, 0.95))
    print("Aspect ratio below 3 outside forced wedges, %")
    good = parts["ar_max_cut_outside_wedges"] < 3
    share = 100 * good.groupby(parts["method"]).mean()
    refined = share.index.str.endswith(":refine")
    say("with refinement, without", span(share[refined]), span(share[~refined]))


def parameters(settings, default):
    print("Parameters: median eigenvalue and us, over those of the default")
    for (method, parameter), rows in settings.groupby(["method", "parameter"]):
        if parameter != default.get(method, parameter):
            usual = load.of(settings, (method, default[method]))
            say(f"{method} {parameter}", ratio(rows, usual, EIGENVALUE), ratio(rows, usual, "us_per_crossed"))


def ghosts(settings):
    print("Phantom nodes: eigenvalue, median; 95 %; worst")
    for method, parameter in (("phantom_node", "ghost=0.1"), ("phantom_node:lumped_mass", "")):
        say(f"{method} {parameter}", *tail(load.of(settings, (method, parameter))))


def spacing(settings):
    print("docs/remedies.md: active_node at 800 triangles: median eigenvalue, largest aspect ratio, vertices added")
    for parameter, rows in by(settings[settings["resolution"] == 800], "active_node").groupby("parameter"):
        say(parameter, *(rows[column].median() for column in (EIGENVALUE, "ar_max_cut", "vertices_added")))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results/reference")
    results = parser.parse_args().results
    settings = cuts(results, "method_comparison_parameters")
    fine = cuts(results, "method_comparison_fine")
    default = dict(zip(fine["method"], fine["parameter"]))
    ablation(cuts(results, "method_comparison_ablation"), settings[(settings["method"] == "cut_polygons")
                                                                  & (settings["parameter"] == default["cut_polygons"])])
    parameters(settings, default)
    ghosts(settings)
    spacing(settings)


if __name__ == "__main__":
    main()
