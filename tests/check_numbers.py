#!/usr/bin/env python3
"""Do 'Which method?' of README.md and docs/results.md and the table of docs/results.md say what the published rows say?
Recomputed here from results/reference with nothing of plots/. Prints every disagreement; exit code 1 if there is any."""

import itertools
import re
import sys
from pathlib import Path

import numpy as np
import pandas as pd

ROOT = Path(__file__).resolve().parent.parent
COLUMNS = ["sheet", "cut_family", "method", "status", "crossed_triangles", "vertices_added", "geometry_us", "eigenvalue_ratio",
           "bending_eigenvalue_ratio", "ar_max_cut", "ar_max_cut_strict", "ar_max_cut_outside_wedges"]
problems = []


def expect(where, said, measured):
    """\\param said  a cell; it has to be `measured` rounded to the digits it shows"""
    said = said.strip()
    if said == "-" or measured != measured:
        if said != "-" or measured == measured:
            problems.append(f"{where}: says {said}, the rows give {measured:.4g}")
        return
    digits = said.replace(",", "").lstrip("+-")
    mantissa, _, exponent = digits.partition("e")
    decimals = len(mantissa.partition(".")[2])
    unit = 10.0 ** (int(exponent or 0) - decimals)
    if not exponent and not decimals:  # trailing zeros of a whole number are no digits: 7,200
        unit = 10.0 ** (len(digits) - len(digits.rstrip("0"))) if float(digits) >= 100 else 1.0
    if abs(float(said.replace(",", "")) - measured) > 0.501 * unit:
        problems.append(f"{where}: says {said}, the rows give {measured:.4g}")


def rows_of(text, heading):
    """The cells of the first table after a heading, without its two head lines."""
    lines = text[text.index(heading):].splitlines()
    first = next(i for i, line in enumerate(lines) if line.startswith("|"))
    table = []
    for line in lines[first + 2:]:
        if not line.startswith("|"):
            break
        table.append([cell.strip() for cell in line.strip("|").split("|")])
    return table


def measured():
    """A row per method: what the cells of the tables claim to be."""
    rows = pd.read_csv(ROOT / "results/reference/method_comparison.records.csv.xz", usecols=COLUMNS, low_memory=False)
    rows = rows[rows["status"] != "refused"]
    rows = rows.assign(us=rows["geometry_us"] / rows["crossed_triangles"],
                       added=rows["vertices_added"] / rows["crossed_triangles"])
    found = {}
    for method, all_sheets in rows.groupby("method"):
        even = all_sheets[all_sheets["sheet"] != "graded"]
        changed = all_sheets["ar_max_cut"].notna().sum()
        below = {c: 100 * (all_sheets[c] < 3).sum() / changed if changed else float("nan")
                 for c in ("ar_max_cut_strict", "ar_max_cut_outside_wedges")}
        found[method] = [
            even["eigenvalue_ratio"].median(), even["eigenvalue_ratio"].quantile(0.95),
            even.loc[even["cut_family"] == "several", "eigenvalue_ratio"].median(),
            all_sheets.loc[all_sheets["sheet"] == "graded", "eigenvalue_ratio"].median(),
            even["bending_eigenvalue_ratio"].quantile(0.95), *below.values(), all_sheets["added"].median(),
            all_sheets["us"].median(), all_sheets["geometry_us"].sum() / all_sheets["crossed_triangles"].sum()]
    return found


CASE = ["problem", "sheet", "resolution", "case"]
FITTED = "body_fitted (reference)"


def solved():
    """The direct solves in plane of the cases that all methods made, but for those that refuse that kind of sheet."""
    rows = pd.read_csv(ROOT / "results/reference/method_comparison_accuracy.direct.records.csv.xz", low_memory=False,
                       usecols=[*CASE, "method", "status", "verdict", "unknowns", "error", "error_energy_norm"])
    rows["kind"] = rows["problem"].str.extract("^(centre_crack|inclined_crack|arc_crack|edge_crack|kirsch_hole|williams)")[0].replace(
        {"centre_crack": "crack", "inclined_crack": "crack"})
    rows = rows[rows["kind"].notna()]
    right = (rows["verdict"] == "ok") & rows["status"].isin(["ok", "deviated"])
    refuses = ~right.groupby([rows["method"], rows["sheet"]]).transform("any")  # this kind of sheet, altogether
    right |= refuses
    return rows[right.groupby([rows[c] for c in CASE]).transform("all") & ~refuses]


def errors(rows):
    """A row per method, as in docs/measuring.md, Accuracy, and below the table: the mean over kinds, at a hole, the interval. In
    percent over a fitted mesh with as many unknowns: the case's own, refined at the rate of all of its problem and sheet."""
    fitted = rows[rows["method"] == FITTED]
    rate = {}
    for key, of_all in fitted.groupby(["problem", "sheet"]):
        logs = np.log(of_all[["unknowns", "error"]]).cov().to_numpy()
        rate[key] = min(0.0, logs[0, 1] / logs[0, 0])
    rows = rows.merge(fitted[[*CASE, "unknowns", "error"]], on=CASE, suffixes=("", "_fitted"))
    power = np.array([rate[key] for key in zip(rows["problem"], rows["sheet"])])
    rows["log"] = np.log(rows["error"] / rows["error_fitted"]) - power * np.log(rows["unknowns"] / rows["unknowns_fitted"])
    found = {}
    for method, logs in rows.groupby(["method", "kind"])["log"].mean().groupby("method"):
        draws = [np.mean(draw) for draw in itertools.product(logs, repeat=len(logs))]  # of the bootstrap, all there are
        ends = np.quantile(draws, [0.025, 0.975])
        found[method] = 100 * np.expm1([logs.mean(), logs[method, "kirsch_hole"], *ends])
    return found


def chart(solves):
    """{method: [ms, error in percent]} of README's chart at 12,800 triangles: 4 cuts, steps of 1/240 s, 1,000 N/m."""
    rows = pd.read_csv(ROOT / "results/reference/whole_step_chart.records.csv.xz", low_memory=False)
    rows = rows[(rows["place"] == 4) & (rows["step_s"] < 0.005) & (rows["stiffness_n_m"] == 1000) & (rows["resolution"] == 12800)]
    ms = (rows["cut_update_us"] / 4 + rows["first_step_us"] + 59 * rows["step_us"]) / 1000  # a cut each 0.25 s, which is 60 steps
    ms = ms.where(rows["verdict"].isin(["ok", "energy_growth", "inverted"]), float("inf"))
    fastest = ms.groupby([rows["method"], rows["solver"]]).median().groupby("method").min()
    solves = solves[(solves["resolution"] == 12800) & solves["error_energy_norm"].notna()]
    solves = solves.assign(log=np.log(solves["error_energy_norm"].abs()))
    fitted = solves[solves["method"] == FITTED]
    level = fitted.groupby("kind")["log"].mean().mean()
    pairs = solves.merge(fitted[[*CASE, "log"]], on=CASE, suffixes=("", "_fitted"))
    ratio = (pairs["log"] - pairs["log_fitted"]).groupby([pairs["method"], pairs["kind"]]).mean().groupby("method").mean()
    return {method: [fastest[method], 100 * np.exp(level + ratio[method])] for method in fastest.index if method in ratio}


NAMES = ["eigenvalue", "eigenvalue, 95 %", "four cuts", "graded sheet", "with bending", "AR < 3", "outside forced wedges",
         "vertices added", "us, median", "us, total"]
PLACES = [4, 5, 6, 7, 8, 9, 10, 13, 14, 15]  # of these in the table of docs/results.md
US = NAMES.index("us, median")

truth = measured()
solves = solved()
error, charted = errors(solves), chart(solves)
whole_step = (ROOT / "results/reference/whole_step.txt").read_text(encoding="utf-8")
results = (ROOT / "docs/results.md").read_text(encoding="utf-8")
readme = (ROOT / "README.md").read_text(encoding="utf-8")
seen = set()
for cells in rows_of(results, "## The table"):
    method = cells[1].strip("`")
    seen.add(method)
    for name, place, value in zip(NAMES, PLACES, truth[method]):
        expect(f"docs/results.md, The table, {method}, {name}", cells[place], value)
    mean, hole, *ends = error[method]
    said = re.fullmatch(r"(\S+) \[(\S+), (\S+)\]", cells[11])
    if not said:
        problems.append(f"docs/results.md, The table, {method}, error: {cells[11]} is no number with an interval")
        continue
    expect(f"docs/results.md, The table, {method}, error", said[1], mean)
    expect(f"docs/results.md, The table, {method}, at a hole", cells[12], hole)
    for end, value in zip(said.groups()[1:], ends):
        expect(f"docs/results.md, The table, {method}, interval", end, value)
if seen != set(truth):
    problems.append(f"docs/results.md, The table: other methods than in the rows: {', '.join(sorted(seen ^ set(truth)))}")
for cells in rows_of(readme, "## Which method?"):
    if cells[2:] == ["-"] * 3:  # of no implicit step
        continue
    method = re.search(r"`(\w+)`", cells[1])[1]
    for name, said, value in zip(["ms", "error"], cells[2:], charted[method]):
        expect(f"README.md, Which method?, {method}, {name}", said, value)
    share = re.search(rf"^12800 +{method} .* (\d+) *$", whole_step, re.MULTILINE)  # drawn by chance, so of the published table
    if not share or cells[4] != share[1]:
        problems.append(f"README.md, Which method?, {method}: on the front in {cells[4]} %, whole_step.txt says {share and share[1]}")
costs = rows_of(results, "## Which method?")
for cells in costs:
    said = re.match(r"([\d.]+) us", cells[2])
    if said:
        expect(f"docs/results.md, Which method?, {cells[0]}", said[1], truth[re.search(r"`(\w+)`", cells[1])[1]][US])
if not any(" us" in cells[2] for cells in costs) or len(rows_of(readme, "## Which method?")) < 3:
    problems.append("Which method?: no times were found in it; has its form changed?")
print("\n".join(problems))
sys.exit(bool(problems))
