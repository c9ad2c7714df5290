#!/usr/bin/env python3
"""Prints the numbers that docs/robustness.md quotes of the stages robustness, near_coincident and in_a_row and that are no cell of
their tables, in the order of the page, labelled by its words. Of what is published in --results."""

import sys
from pathlib import Path

import pandas as pd

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from analysis import load
from pages.quoted import say, span

CROSS_CHECK = "cgal_whole_sheet (cross-check)"
OUTCOMES = ["tried", "ok", "noop", "deviated", "refused", "failed", "wrong", "crashed", "timed_out", "carefully"]


def lines(path):
    try:
        return path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        load.stop(f"{path} can't be read: {error.strerror}")


def robustness(folder):
    print("Half a million adversarial cuts")
    context = load.read_context(folder / "robustness.context.json")
    say("commit and seed", context["commit"][:7], str(context["seed"]))
    rows = load.read_counts(folder / "robustness.records.csv.xz")
    by_cross_check = rows["method"] == CROSS_CHECK
    own, cross_check = rows[~by_cross_check], rows[by_cross_check]
    say("methods; sheets", *map(str, (own["method"].nunique(), len(own[["sheet", "resolution"]].drop_duplicates()))))
    one = own[own["method"] == "example"]
    cases, near = one["cases"].sum(), one["near_event_cases"].sum()
    say("cases; with an event nearer than 1e-9 mean edges, %", f"{cases:,.0f}", 100 * near / cases)
    for outcome in OUTCOMES:
        say(outcome, f"{own[outcome].sum():,.0f}")
    refused = own.groupby("method")["refused"].sum().sort_values(ascending=False)
    say("refused most; by all others", *(f"{method} {n:,.0f}" for method, n in refused.head(2).items()), f"{refused[2:].sum():,.0f}")
    say("wrong by the cross-check", f"{cross_check['wrong'].sum():,.0f} of {cross_check['tried'].sum():,.0f}")
    say("... by family", *(f"{family} {n:.0f}" for family, n in cross_check.groupby("cut_family")["wrong"].sum().sort_values().items()))


def near_coincident(folder):
    print("A cut beside an older cut")
    names = ["eps", "method", "tried", "ok", "noop", "deviated", "refused", "failed", "wrong", "incision", "moved"]
    words = [line.split() for line in lines(folder / "near_coincident.txt") if line[:1].isdigit()]
    rows = pd.DataFrame([[*line, "nan"][:len(names)] for line in words], columns=names)
    rows[["eps", *names[2:]]] = rows[["eps", *names[2:]]].astype(float)
    rows["method"] = rows["method"].replace(load.OLD_METHODS)
    own, cross_check = rows[rows["method"] != "cross_check"], rows[rows["method"] == "cross_check"]
    say("methods; cuts of each at each eps; refused, failed, wrong of all", str(own["method"].nunique()), span(own["tried"]),
        *(f"{own[c].sum():.0f}" for c in ("refused", "failed", "wrong")))
    for row in cross_check[cross_check["wrong"] > 0].itertuples():
        say(f"cross_check, eps {row.eps:g}: wrong; constraint moved", f"{row.wrong:.0f} of {row.tried:.0f}", row.moved)


def in_a_row(folder):
    print("A thousand cuts in one sheet")
    names = ["method", "failed", "refused", "judged", "wrong", "crossed", "triangles", "first", "last", "ratio", "anew", "made", "made_last",
             "bytes", "bytes_anew"]
    words = [line.split() for line in lines(folder / "in_a_row.txt")]
    rows = pd.DataFrame([line for line in words if len(line) == len(names) and line[1].isdigit()], columns=names)
    rows[names[1:]] = rows[names[1:]].astype(float)
    say("methods; failed, wrong", str(len(rows)), f"{rows['failed'].sum():.0f}", f"{rows['wrong'].sum():.0f}")
    say("heap above that of a sheet begun anew", *(f"{row.method} {row.bytes:.0f} to {row.bytes_anew:.0f}" for row in rows.itertuples()
                                                   if row.bytes > row.bytes_anew))
    of_time = rows.dropna(subset=["ratio"]).sort_values("ratio")
    say("a crossed triangle in the last tenth over at first", *(f"{row.method} {row.ratio:.2f}" for row in of_time.itertuples()))
    anew = of_time.assign(anew=of_time["anew"] / of_time["last"]).sort_values("anew")
    say("in a sheet begun anew over in the old one", *(f"{row.method} {row.anew:.2f}" for row in anew.itertuples()))


def main():
    folder = load.results_folder("reference", __doc__)
    robustness(folder)
    near_coincident(folder)
    in_a_row(folder)


if __name__ == "__main__":
    main()
