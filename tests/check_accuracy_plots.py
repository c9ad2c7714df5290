#!/usr/bin/env python3
"""Draws the records of a small accuracy run and looks at what comes out: files, the methods in the tables, failures shown
as failures, and one line with exit code 2 for records that lack a column. Prints every disagreement; exit code 1 if there
is any.
usage: check_accuracy_plots.py RESULTS with RESULTS/accuracy of such a run"""

import contextlib
import csv
import io
import json
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

PLOTS = Path(__file__).resolve().parent.parent / "plots"
LABELS = ["conventional split", "bowyer watson, rounds=0", "bowyer watson, rounds=1"]
FITTED = "body-fitted mesh (reference)"
problems = []


def expect(what, condition):
    if not condition:
        problems.append(what)


def run(script, *arguments):
    return subprocess.run([sys.executable, PLOTS / script, *map(str, arguments)], capture_output=True,
                          text=True)


def read(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def write(path, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def of(row, method, parameter):
    return row["method"] == method and row["parameter"] == parameter


def check_all_there(results):
    folder = results / "accuracy"
    done = run("figures/accuracy/accuracy.py", "--results", folder)
    expect(f"accuracy.py: {done.returncode} {done.stderr}", done.returncode == 0 and not done.stderr)
    for stem in ("", "_unknowns", "_problems", "_budgets", "_shape", "_profile"):
        for suffix in ("png", "pdf"):
            path = folder / f"accuracy{stem}.{suffix}"
            expect(f"{path.name} is not there", path.is_file() and path.stat().st_size > 5000)
    table = done.stdout.partition("Error after so many")[0]
    for label in [*LABELS, FITTED]:
        in_both = 2 if label == FITTED else 4  # grid, all; of the ranking and its intervals, where the fitted mesh is 0
        expect(f"the ranking or its intervals lack {label}", sum(label in line for line in table.splitlines()) == in_both)
    kept = folder / "accuracy.txt"
    expect("accuracy.txt is not what was printed",
           kept.is_file() and kept.read_text(encoding="utf-8").strip() in done.stdout)
    done = run("figures/accuracy/verification.py", "--results", folder)
    expect(f"verification.py: {done.returncode} {done.stderr}", done.returncode == 0 and not done.stderr)
    for label in LABELS:
        expect(f"the verification lacks {label}", label in done.stdout)
    expect("the fitted mesh, no method, is verified", FITTED not in done.stdout)
    expect("verification.png is not there", (folder / "verification.png").is_file())
    done = run("figures/methods/pareto.py", "--x", "total_us", "--y", "error", "--problem", "centre_crack", "--records",
               folder / "records.csv")
    expect(f"pareto.py: {done.returncode} {done.stderr}", done.returncode == 0 and not done.stderr)
    expect("no Pareto figure", (folder / "pareto_centre_crack_total_us_error.png").is_file())
    for label in [*LABELS, FITTED]:
        expect(f"pareto.py's table lacks {label}", label in done.stdout)
    done = run("pages/claims.py", "--results", results)
    expect(f"claims.py: {done.returncode} {done.stderr}", done.returncode == 0 and not done.stderr)
    claims = (results / "claims.md").read_text(encoding="utf-8") if done.returncode == 0 else ""
    lines = [line for line in claims.splitlines() if line.startswith("| ")]
    for stem in ("fig9_aspect_ratio", "table1_timing"):  # no records of these
        expect(f"claims of {stem} are judged", any(f"reproduce {stem}" in line and "| untested |" in line for line in lines))
        expect(f"claims of {stem} have figures", f"({stem}/" not in claims)
    expect("claims with records are not judged", sum("(accuracy/accuracy" in line for line in lines) >= 2)


def check_equal_unknowns(folder):
    """Worked out anew for one case: by the power law through the two sizes' fitted meshes."""
    sys.path.insert(0, str(PLOTS))
    from analysis.accuracy import ranking
    from analysis.accuracy.records import REFERENCE, Records
    records = Records(folder)
    rows = ranking.at_equal_unknowns(records).rows(direct=True)
    fitted = rows[(rows["method"] == REFERENCE[0])]
    expect("the fitted mesh is not its own measure", (abs(fitted["ratio_equal"] - 1) < 1e-12).all())
    # Were all fitted meshes on one power law, error = c N^-0.5, that of as many unknowns would be that of N.
    table = records.table.copy()
    is_fitted = table["method"] == REFERENCE[0]
    table.loc[is_fitted, "error"] = 3 * table.loc[is_fitted, "unknowns"] ** -0.5
    keys = ["problem", "sheet", "resolution", "case"]
    error = table[is_fitted & table["direct"]].set_index(keys)["error"]
    table["ratio"] = table["error"] / error.reindex(table.set_index(keys).index).to_numpy()
    rows = ranking.at_equal_unknowns(records.with_rows(table)).rows(direct=True)
    expected = rows["error"] / (3 * rows["unknowns"] ** -0.5)
    expect("errors at equal unknowns are not those of the power law",
           (abs(rows["ratio_equal"] / expected - 1) < 1e-9).all())


def check_failures(results):
    """A third of one method's cases failed."""
    folder = results / "failed"
    shutil.copytree(results / "accuracy", folder)
    rows = read(folder / "records.csv")
    for row in rows:
        if of(row, "bowyer_watson", "rounds=1") and row["case"] == "0":
            row["verdict"], row["reason"] = "inverted", "on purpose"
            for column in row:
                if column.startswith(("error", "value_", "excess")) or column in ("total_us", "unknowns"):
                    row[column] = ""
    write(folder / "records.csv", rows)
    from figures.accuracy import accuracy
    from analysis.accuracy.ranking import at_equal_unknowns, print_ranking
    from analysis.accuracy.records import Records
    records = at_equal_unknowns(Records(folder))
    for x in ("ms", "unknowns"):
        figure = accuracy.error_figure(records, x, x)
        texts = [t.get_text() for ax in figure.axes for t in ax.texts]
        expect(f"failures are not shown over {x}: {texts}", any(t.startswith("× ") for t in texts))
    ranking = io.StringIO()
    with contextlib.redirect_stdout(ranking):
        print_ranking(records, "some")
    lines = [line for line in ranking.getvalue().splitlines() if line.startswith("all ") and LABELS[2] in line]
    expect(f"failures are not in the ranking: {lines}", lines and "67/0/33" in lines[0].split())
    check_ranked_cases(records)


def check_ranked_cases(records):
    """Who failed the hardest cases is not the better for it: means are over the cases that all made."""
    from analysis.accuracy.ranking import made_by_all
    made = made_by_all(records.rows(direct=True))
    expect(f"cases that somebody failed are ranked: {set(made['case'])}", set(made["case"]) == {1, 2})
    sizes = made.groupby(["method", "parameter"]).size()
    expect(f"methods are ranked on different cases: {sizes.to_dict()}", sizes.nunique() == 1)


def check_errors(folder):
    """Of errors that are known: every method's 3 times the fitted mesh's, whatever the problem; and x is the median."""
    from analysis.accuracy import errors
    from analysis.accuracy.records import REFERENCE, Records
    records = Records(folder)
    table = records.table.copy()
    levels = {"centre_crack": 0.02, "arc_crack_45": 0.08}
    table["error"] = table["problem"].map(levels) * table["method"].map(lambda m: 1 if m == REFERENCE[0] else 3)
    points = errors.points(errors.throughout(records.with_rows(table).in_plane().ranked()), "unknowns")
    wanted = [4 if m == REFERENCE[0] else 12 for m in points["method"]]  # the geometric mean of 2 and 8 %, and 3 times it
    expect(f"errors that are known: {points}", all((abs(points[y] - wanted) < 1e-9).all() for y in ("y", "y_q1", "y_q3")))
    expect(f"sheets and sizes: {len(points)}", len(points) == 3 * 4)


def check_factor(folder):
    """Errors that follow a power of the aspect ratio, with levels of their own for every sheet and for even members; a
    case that is alone on its level says nothing."""
    import numpy as np
    from analysis.accuracy.records import Records
    from analysis.accuracy.shape import factor_per_decade
    table = Records(folder).rows(direct=True)
    table = table[table["method"] == "conventional_split"].copy()
    level = (1 + table["resolution"] / 1000) * table["problem"].map(len) * np.where(table["case"] % 2 == 0, 1, 3)
    table["ratio"] = level * table["ar_max_cut"] ** 0.1
    factor, low, high, n = factor_per_decade(table)
    expect(f"the factor of a power law: {factor} [{low}, {high}] {n}",
           max(abs(x - 10 ** 0.1) for x in (factor, low, high)) < 1e-6 and n == len(table))
    one = table[(table["case"] == 0) | (table["resolution"] != table["resolution"].max())]
    expect("a case alone on its level counts", factor_per_decade(one)[3] == (one["resolution"] != 200).sum())
    expect("cases that are all alone have a factor", np.isnan(factor_per_decade(table[table["case"] == 0])[0]))


def check_commands():
    """A shell makes of a caption's command the words that were given, though the context has only their text."""
    sys.path.insert(0, str(PLOTS))
    from analysis import load
    for words in (["--out", "r", "--command", "mine=python3 mine.py {mesh} {path} {out}"],
                  ["--command", "a=node --flag x {mesh}", "--command", "b=python3 it's.py {out}", "--seed", "3"],
                  ["--command", "plain", "--cases", "1"], ["--cases", "1"]):
        shown = load.pasteable(" ".join(["cutbench run e.toml", *words]))
        expect(f"not as given: {shown}", shlex.split(shown)[3:] == words)
        expect(f"quoted again: {shown}", load.pasteable(shown) == shown)


def check_quantiles():
    from analysis import load
    inf = float("inf")
    for values, median in (([4, 1, 3, 2], 2.5), ([2, inf, 1], 2), ([1, inf], inf), ([float("nan"), 3], 3)):
        expect(f"the median of {values} is {load.median(values)}", load.median(values) == median)
    expect("quartiles", list(load.quantiles([1, 2, 3, 4, inf], [0.25, 0.75, 1])) == [2, 4, inf])
    expect("not all draws of two values", sorted(load.drawn_means([0, 1])) == [0, 0.5, 0.5, 1])


def check_program(results):
    """One resolution, and one of the methods a program: figures and tables without nan, and the program named as one."""
    folder = results / "one_size"
    shutil.copytree(results / "accuracy", folder)
    rows = [row for row in read(folder / "records.csv") if row["resolution"] == "200"]
    for row in rows:
        if of(row, "bowyer_watson", "rounds=1"):
            row["method"], row["parameter"] = "my_own", ""
    write(folder / "records.csv", rows)
    context = json.loads((folder / "context.json").read_text(encoding="utf-8"))
    context["command"] += " --command my_own=python3 my_own.py {mesh} {path} {out}"
    (folder / "context.json").write_text(json.dumps(context), encoding="utf-8")
    from analysis.accuracy import shape
    from figures.accuracy import accuracy, budgets
    from analysis.accuracy.ranking import at_equal_unknowns
    from analysis.accuracy.records import Records
    from analysis.methods import errors, kinds
    from analysis.methods.comparison import as_text
    from figures.methods import error_dots
    records = at_equal_unknowns(Records(folder))
    expect(f"not the one program: {records.programs}", records.programs == {"my_own"})
    expect("errors at equal unknowns, of one size", records.table["ratio_equal"].isna().all())
    for name, figure in (("accuracy", accuracy.error_figure(records, "ms", "time")),
                         ("problems", accuracy.problems_figure(records)), ("budgets", budgets.budgets_figure(records))):
        for ax in figure.axes:
            if not ax.get_visible():
                continue
            named = [t for t in ax.texts if t.get_text() == "my own"]
            pale = [line for line in ax.lines if line.get_color() == records.looks["my_own", ""].colour
                    and (line.get_alpha() or 1) < 1]
            expect(f"the program has no name in a panel of {name}", len(named) == 1)
            expect(f"the program is pale in {name}", not pale)
        expect(f"{name} does not say that it is a program",
               any(t.get_text() == "my own (program)" for t in figure.legends[0].get_texts()))
    numbers = {t.get_text() for ax in budgets.budgets_figure(records).axes for t in ax.texts}
    expect(f"no iterations in the figure of budgets: {numbers}", "10" in numbers)
    all_rows = records.rows(direct=True)
    kept = set(shape.of_harness(records, all_rows)["method"])
    expect(f"in the fit over shape: {kept}", kept == {"conventional_split", "bowyer_watson"})
    text = io.StringIO()
    with contextlib.redirect_stdout(text):
        accuracy.write_text(folder, records)
        table = error_dots.draw(folder, folder)
    text = text.getvalue() + as_text(errors.STEM, table) + as_text(kinds.STEM, kinds.table_of(records.ranked()))
    expect("a table has nan", "nan" not in text.lower())
    expect("the program is in no table", "my own (program)" in text and "my_own" in text)
    order = table["excess_percent_all"]
    expect("there is no ranking", order.notna().all() and order.is_monotonic_increasing)
    expect("method_comparison_accuracy.png is not there", (folder / "method_comparison_accuracy.png").is_file())


def check_missing_columns(results):
    folder = results / "without"
    shutil.copytree(results / "accuracy", folder / "accuracy")
    rows = read(folder / "accuracy/records.csv")
    write(folder / "accuracy/records.csv", [{k: v for k, v in row.items() if k != "unknowns"} for row in rows])
    for script, arguments in (("figures/accuracy/accuracy.py", ["--results", folder / "accuracy"]),
                              ("figures/accuracy/verification.py", ["--results", folder / "accuracy"]),
                              ("pages/claims.py", ["--results", folder]),
                              ("figures/methods/pareto.py", ["--x", "unknowns", "--y", "error", "--problem", "centre_crack",
                                                             "--records", folder / "accuracy/records.csv"])):
        done = run(script, *arguments)
        expect(f"{script} without a column: {done.returncode} {done.stderr}",
               done.returncode == 2 and len(done.stderr.splitlines()) == 1 and "unknowns" in done.stderr)


def check_kinds():
    """Kinds weigh alike, and one that a method refuses counts as the base's times the method's ratio to it elsewhere."""
    sys.path.insert(0, str(PLOTS))
    import numpy as np
    import pandas as pd
    from analysis.accuracy import intervals
    from analysis.methods import kinds
    base, some = {"crack": 10.0, "hole": 0.0, "ellipse": 300.0}, {"crack": 120.0, "hole": 100.0}
    whole = kinds.completed(some, base)
    expect(f"a refused kind is {whole}", abs(whole["ellipse"] - 700) < 1e-9 and whole["crack"] == 120)
    expect("what all make is changed", kinds.completed(base, base) == base)
    table = pd.DataFrame({"kind": ["crack"] * 9 + ["hole"], "ratio": [1.0] * 9 + [4.0]})
    mean, ends = intervals.interval(table, "ratio")
    expect(f"kinds do not weigh alike: {mean}, {ends}", abs(mean - 100) < 1e-9 and ends == "+5 to +280")  # of four draws
    logs = pd.Series(np.log([2.0, 2.0, 2.0, 8.0, 50.0]))
    problems = pd.Series(["centre_crack", "inclined_crack", "centre_crack", "kirsch_hole", kinds.TWICE])
    found = np.round(kinds.weighed_alike(logs, problems))  # of 2 and 8, and of the draws 2 2, 2 8, 8 2, 8 8
    expect(f"kinds do not weigh alike in weighed_alike(): {found}", list(found) == [300, 111, 659])
    named = [kinds.kind_of(problem) for problem in ("corner_315", "elliptic_hole_3", "free_strip", "flap")]
    expect(f"kinds of problems: {named}", named == ["corner", "ellipse", "frequency", None])


def main():
    results = Path(sys.argv[1])
    check_kinds()
    check_all_there(results)
    if problems:  # the rest would only repeat them
        print("\n".join(problems))
        return 1
    check_commands()
    check_quantiles()
    check_equal_unknowns(results / "accuracy")
    check_errors(results / "accuracy")
    check_factor(results / "accuracy")
    check_failures(results)
    check_program(results)
    check_missing_columns(results)
    print("\n".join(problems))
    return bool(problems)


if __name__ == "__main__":
    sys.exit(main())
