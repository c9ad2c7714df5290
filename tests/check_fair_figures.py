#!/usr/bin/env python3
"""A program that fails on purpose where cuts are hard must not look better for it. It is conventional_split, but refuses or
crashes where that leaves a triangle worse than the median: so over the cuts that both made it is neither better nor worse, it
comes last, hollow, and its share stands beside its name. Prints every disagreement; exit code 1 if there is any.
usage: check_fair_figures.py PROGRAM, that of this tree"""

import csv
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

PLOTS = Path(__file__).resolve().parent.parent / "plots"
sys.dont_write_bytecode = True
sys.path.insert(0, str(PLOTS))
import matplotlib  # noqa: E402
from analysis import shares  # noqa: E402
from analysis.methods import comparison, errors  # noqa: E402
from analysis.accuracy.records import Records  # noqa: E402
from figures.methods import dots  # noqa: E402
from pages.report.comparison import Comparison  # noqa: E402

EXPERIMENT = """claim = "who fails where it is hard is not the better for it"
sheets = ["grid", "graded"]
resolutions = [200]
methods = ["conventional_split", "warp_and_refine", "cisamr"]
cut_families = ["straight", "curved"]
cases = 6
eigenvalue_cases = 6
"""
ACCURACY = """claim = "the same, of errors"
sheets = ["grid"]
resolutions = [72, 200]
methods = ["conventional_split", "warp_and_refine"]
[accuracy]
problems = ["centre_crack", "arc_crack_45"]
members = [4, 4]
direct = ["cholmod"]
"""
SHY = """import json, os, subprocess, sys, tempfile
mesh, path, out = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    report = folder + "/report.json"
    subprocess.run([PROGRAM, "cut", "--mesh", mesh, "--path", path, "--out", out, "--report", report, "--method",
                    "conventional_split"], check=True,
                   stdout=subprocess.DEVNULL)
    worst = json.load(open(report))["ar_max_cut"]
if worst > 40:
    os.remove(out)
    print("too thin for me", file=sys.stderr)
    sys.exit(3 if worst < 200 else 1)
"""
SHY_ONE, SPLIT, CISAMR = ("shy", ""), ("conventional_split", ""), ("cisamr", "")
problems = []


def expect(what, condition):
    if not condition:
        problems.append(what)


def counted(records):
    """Made, refused and wrong of the shy program, by hand."""
    rows = [row for row in csv.DictReader(line for line in records.open() if not line.startswith("#")) if row["method"] == "shy"]
    refused = sum(row["status"] == "refused" for row in rows)
    made = sum(row["status"] in ("ok", "deviated") and row["verdict"] == "ok" for row in rows)
    return made, refused, len(rows) - made - refused


def check_tables(folder, made, refused, wrong):
    run, table = comparison.read_cuts(folder)
    counts = comparison.counts_of(run)
    expect(f"the shares are not those counted by hand, {made}, {refused}, {wrong}: {counts[SHY_ONE]}",
           counts[SHY_ONE] == shares.Share(made, refused, wrong))
    expect(f"cisamr's irregular sheet does not count apart: {counts[CISAMR]}", counts[CISAMR] == shares.Share(12, 0, 0, 12))
    order = list(comparison.ranking(table, ["grid", "graded"], counts).index)
    expect(f"the shy program is not last: {order}", order[-1] == SHY_ONE)
    rows = comparison.summary(table, None, order, comparison.ranking(table, ["grid", "graded"], counts)).set_index("method")
    expect("over the cuts that both made, it is not like conventional_split",
           abs(rows.loc["shy", "eigenvalue_ratio_over_split"] - 1) < 1e-12)
    expect("its median eigenvalue is that of its survivors", not rows.loc["shy", "eigenvalue_ratio_median"] < 1e300)
    return table, order, counts


def check_figure(table, order, counts):
    figure = dots.figure_of(table, order, comparison.SHAPES, [1] * 3, {"shy"}, counts)
    names = [text.get_text() for text in figure.axes[0].get_yticklabels()]
    expect(f"the last name is not the shy program with its share: {names}", names[-1] == f"shy (program) [{counts[SHY_ONE].text()} %]")
    y = figure.axes[0].get_yticks()[-1]
    markers = [line.get_markerfacecolor() for line in figure.axes[0].lines if line.get_marker() == "o" and list(line.get_ydata()) == [y]]
    expect(f"its marker is not hollow: {markers}", markers == ["white"])
    full = [line.get_markerfacecolor() for line in figure.axes[0].lines if line.get_marker() == "o" and list(line.get_ydata()) != [y]]
    expect("others are hollow", full and "white" not in full)
    matplotlib.pyplot.close(figure)


def check_scripts(folder, text):
    done = subprocess.run([sys.executable, PLOTS / "figures/methods/method_comparison.py", "--results", folder], capture_output=True,
                          text=True)
    expect(f"method_comparison.py: {done.stderr[-500:]}", done.returncode == 0)
    tables = re.split(r"\n(?=method_comparison\w*: )", (folder / "method_comparison.txt").read_text(encoding="utf-8"))
    expect("there are no tables", len(tables) > 3)
    for table in tables:
        line = next((line for line in table.splitlines() if line.split()[:1] == ["shy"]), "")
        share = r" \d+/\d+/\d+ " if table.startswith("method_comparison_accuracy") else f" {text} "  # those are of other cuts
        expect(f"no share in {table.partition(':')[0]}: {line}", not line or re.search(share, line))


def check_errors(folder):
    records, table = errors.summary(folder)
    counts = errors.counts_of(records)[SHY_ONE]
    expect(f"the program made half of the errors' cuts and more: {counts}", counts.is_few)
    expect(f"it is not last: {list(table['method'])}", table["method"].iloc[-1] == "shy")
    rows = table.set_index("method")["excess_percent_all"]
    expect(f"its errors are not those of conventional_split: {dict(rows)}", abs(rows["shy"] - rows["conventional_split"]) < 1e-6)
    others = table[table["method"] != "shy"]
    expect("others lose their cases to it", others["excess_percent_all"].notna().all())
    look = Records(folder).looks[SHY_ONE]
    expect("the legend lacks its share", look.few and look.share == f" [{counts.text()} %]")


def check_page(results, text):
    page = Comparison(results).as_json()
    shy = next(method for method in page["methods"] if method["name"] == "shy")
    expect(f"the report's page lacks the share: {shy}", shy["share"] == f"[{text} %]" and shy["few"])


def main():
    program = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "shy.py").write_text(SHY.replace("PROGRAM", repr(str(program))))
        for stem, experiment in (("method_comparison", EXPERIMENT), ("method_comparison_accuracy", ACCURACY)):
            (folder / f"{stem}.toml").write_text(experiment)
            done = subprocess.run([program, "run", f"{stem}.toml", "--out", "results", "--command",
                                   f"shy={sys.executable} shy.py {{mesh}} {{path}} {{out}}"], cwd=folder, capture_output=True, text=True)
            expect(f"cutbench run {stem}: {done.stdout[-500:]} {done.stderr[-500:]}", (folder / f"results/{stem}/records.csv").is_file())
        here = folder / "results/method_comparison"
        made, refused, wrong = counted(here / "records.csv")
        expect(f"the test is of nothing: {made} made, {refused} refused, {wrong} wrong", 0 < made < refused + wrong and refused and wrong)
        table, order, counts = check_tables(here, made, refused, wrong)
        check_figure(table, order, counts)
        check_scripts(here, counts[SHY_ONE].text())
        check_errors(folder / "results/method_comparison_accuracy")
        check_page(folder / "results", counts[SHY_ONE].text())


main()
print("\n".join(problems))
sys.exit(1 if problems else 0)
