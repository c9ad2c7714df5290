#!/usr/bin/env python3
"""Figures and tables of remedies, one change, motion and stability: a method that makes the easy cuts alone must not look better
for it. The records are made up: one method makes under half of its cuts, the easy ones, with the numbers of conventional_split. So
it stands beside that one, comes last, is drawn hollow, and has its share beside its name.
usage: tests/check_fair_tables.py      exit code 1 and a line per fault"""

import itertools
import sys
import warnings
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
warnings.simplefilter("ignore", RuntimeWarning)  # medians of paths of which no cut was made
sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "plots"))
import numpy as np  # noqa: E402
import pandas as pd  # noqa: E402
from analysis import load, shares  # noqa: E402
from analysis.accuracy import motion  # noqa: E402
from analysis.methods import one_change, remedies  # noqa: E402
from analysis.stability import points, table  # noqa: E402
from figures.accuracy import motion as motion_figure  # noqa: E402
from figures.methods import one_change as one_change_figure, remedies as remedies_figure  # noqa: E402
from figures.stability import panels  # noqa: E402

PLAIN, SHY = "conventional_split", "snap_or_split"
CASES, MADE = 10, 4  # of each kind of cut; the first ones, which are the easiest
SHARE = shares.Share(made=4, refused=3, wrong=3)
faults = []


def expect(what, condition):
    if not condition:
        faults.append(what)


def value(case):
    """Hard cuts have large ones."""
    return 2.0 ** case


def outcome(method, case, shy=SHY):
    if method != shy or case < MADE:
        return "ok", "ok"
    return ("refused", "refused") if case < 7 else ("failed", "crashed")


def provenance():
    return {"commit": "0", "seed": 1, "programs": []}


def rows_of_cuts(methods, shy=SHY, **columns):
    """A row for each method and cut; `columns` are functions of the case, NaN where no cut was made."""
    rows = []
    for method, case in itertools.product(methods, range(CASES)):
        status, verdict = outcome(method, case, shy)
        row = {"suite_version": "6", "sheet": "grid", "method": method, "parameter": "", "seed": "1", "cache": "cold", "status": status,
               "verdict": verdict, "reason": f"no {case}" if verdict != "ok" else "", "resolution": 800, "case": case, "repetition": 0}
        rows.append(row | {name: of(case) if verdict == "ok" or isinstance(of(case), str) else np.nan for name, of in columns.items()})
    return pd.DataFrame(rows)


def hollow_at(ax, y):
    """Are the round or other single markers at that height hollow?"""
    found = [line.get_markerfacecolor() for line in ax.lines if len(line.get_ydata()) == 1 and line.get_marker() not in ("None", "|")
             and abs(line.get_ydata()[0] - y) < 1e-9]
    return bool(found) and all(face == "white" for face in found)


def check_remedies():
    columns = ["eigenvalue_ratio", "bending_eigenvalue_ratio", "geometry_us"]
    everything = rows_of_cuts([PLAIN, SHY, "cut_polygons"], cut_family=lambda _: "straight", crossed_triangles=lambda _: 5.0,
                              **dict.fromkeys(columns, value))
    everything.loc[everything["method"] == "cut_polygons", columns] *= 3
    made = everything["verdict"] == "ok"
    run = load.Run(everything[made], everything[~made], provenance())
    ends = np.array([1.0, 3.0])
    rows = remedies.rows_of(run, {(m, ""): [5.0 + i, ends, 7.0] for i, m in enumerate((PLAIN, SHY, "cut_polygons"))})
    expect(f"remedies: it is not last: {[row[0] for row in rows]}", [row[0] for row in rows] == [PLAIN, "cut_polygons", SHY])
    plain, shy = rows[0], rows[-1]
    expect(f"remedies: its eigenvalues are those of its survivors: {shy[2:9]}", np.allclose(plain[2:9], shy[2:9]))
    expect("remedies: the ratio of the cuts that both made is not 1", remedies.beside_split(run)[SHY, ""] == 1)
    expect("remedies: the share is wrong", remedies.counts_of(run)[SHY, ""] == SHARE)
    figure = remedies_figure.figure_of(run, rows, 10, 2)
    texts = [text.get_text() for text in figure.axes[0].texts]
    expect(f"remedies: no share beside its name: {texts}", any(SHARE.text() in text.replace("\n", " ") for text in texts))
    expect("remedies: it is not hollow", hollow_at(figure.axes[0], shy[9]) and not hollow_at(figure.axes[0], plain[9]))


def check_one_change():
    shy = "cut_polygons"
    methods = [PLAIN, shy, "warp_and_refine", "adaptive_remesh", "split_and_tie", "phantom_node"]
    columns = ["eigenvalue_ratio", "iterations", "step_us", "first_step_us", "cut_update_us"]
    one = rows_of_cuts(methods, shy, cut=lambda _: "straight", **dict.fromkeys(columns, value))
    cuts = pd.concat([one.assign(mass=mass, solver=solver) for mass in ("lumped", "stabilised") for solver in ("cg", "multigrid")],
                     ignore_index=True)
    cracks = pd.concat([one.assign(problem=f"p{i}", tip_functions=tips, **{one_change.ERROR: 0.1}) for i in (1, 2) for tips in (0, 1)])
    rows, sizes = one_change.rows_of(cuts, cracks)
    names = [change.method for change, _ in rows if change.kind != "together"]
    expect(f"one change: it is not last: {names}", names[-1] == shy)
    base, last = rows[0][1], rows[len(names) - 1][1]
    same = ("eigenvalue", "95 %", "worst", "iterations, 800")
    expect(f"one change: it is not like a plain split: {last}", all(np.isclose(base[key], last[key]) for key in same))
    expect("one change: the share is wrong", last[one_change.MADE] == SHARE)
    figure = one_change_figure.figure_of(rows, 800, "")
    labels = [text.get_text() for text in figure.axes[0].get_yticklabels()]
    expect(f"one change: no share beside its name: {labels}", labels[len(names) - 1].endswith(f"[{SHARE.text()} %]"))
    expect("one change: it is not hollow", hollow_at(figure.axes[0], 1 - len(names)) and not hollow_at(figure.axes[0], 0))


def check_motion():
    methods = [PLAIN, SHY, "warp_and_refine", motion.REFERENCE]
    measures = [f"error_{m}" for _, of_one in motion.PROBLEMS.values() for m in of_one]
    problems = [f"{problem}_{rule}" for problem in motion.PROBLEMS for rule in motion.INTEGRATORS]
    everything = pd.concat([rows_of_cuts(methods, **dict.fromkeys(measures, value)).assign(problem=problem) for problem in problems],
                           ignore_index=True)
    everything.loc[everything["method"] == "warp_and_refine", measures] *= 2
    failed = everything["verdict"] != "ok"
    names = motion.names_of(everything, failed)
    expect(f"motion: it is not last: {list(names)}", list(names) == [PLAIN, "warp_and_refine", SHY])
    expect(f"motion: no share beside its name: {names}", names[SHY].endswith(f"[{SHARE.text()} %]"))
    here = motion.of_problem(everything[~failed], "hanging_sheet")
    means = [motion.errors_of(here, name, name == SHY).mean() for name in (PLAIN, SHY)]
    expect(f"motion: its error is that of its survivors: {means}", np.isclose(*means))
    run = load.Run(everything[~failed], everything[failed], provenance())
    figure = motion_figure.figure_of(run, run.rows, names, {SHY})
    expect("motion: it is not hollow", hollow_at(figure.axes[0], 2) and not hollow_at(figure.axes[0], 0))


def check_stability():
    columns = [points.EXPLICIT, "geometry_us", "incision_error_h", "vertices_added"]
    rows = rows_of_cuts([PLAIN, SHY], sweep=lambda _: "single_cuts", cut=lambda _: "curved", place=lambda _: "", mass=lambda _: "lumped",
                        **dict.fromkeys(columns, lambda case: 1 / value(case)))
    rows["geometry_us"] = [value(case) if verdict == "ok" else np.nan for case, verdict in zip(rows["case"], rows["verdict"])]
    rows["name"] = [points.name_of(*row) for row in zip(rows["method"], rows["parameter"], rows["mass"])]
    rows["rank"] = rows["verdict"].map(points.WORST_LAST.index)
    plain, shy = (points.name_of(method, "", "lumped") for method in (PLAIN, SHY))
    expect("stability: the share is wrong", points.shares_of(rows)[shy] == SHARE)
    steps = [points.steps_of(rows, name, plain, name == shy).quantile([0.05, 0.5]) for name in (plain, shy)]
    expect(f"stability: its steps are those of its survivors: {steps}", np.allclose(*steps))
    _, ax = matplotlib.pyplot.subplots()
    panels.ratio_lines(ax, rows, [plain, shy])
    labels = [text.get_text() for text in ax.get_yticklabels()]
    expect(f"stability: no share beside its name: {labels}", labels == [plain, f"{shy} [{SHARE.text()} %]"])
    expect("stability: it is not hollow", hollow_at(ax, 1) and not hollow_at(ax, 0))
    four = rows.assign(sweep="several_cuts")
    lines = table.cures(pd.concat([rows, four])).splitlines()[2:]
    expect(f"stability: the table has no share: {lines}", SHARE.text() in lines[-1])
    price = [line.split(" | ")[7] for line in lines]
    expect(f"stability: its price is that of its survivors: {price}", price[0] == price[1])


for check in (check_remedies, check_one_change, check_motion, check_stability):
    check()
print("\n".join(faults), end="\n" if faults else "")
sys.exit(bool(faults))
