#!/usr/bin/env python3
"""Do 'Which method?' of README.md and the table of docs/how-to/choose_a_method.md say what the published rows say? Recomputed here
from results/reference with nothing of plots/, which fills them in. Prints every disagreement; exit code 1 if there is any."""

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
FITTED, PLAIN = "body_fitted (reference)", "conventional_split"
KINDS = ("centre_crack|inclined_crack|arc_crack|edge_crack|kirsch_hole|williams|collinear_cracks|loaded_lips|crossed_cracks|corner|elliptic_hole|"
         "bent_plate|free_strip")


def solved():
    """The direct solves that came out right, and those of them of the cases that all methods made: but for those that refuse that kind of
    problem on that kind of sheet."""
    rows = pd.read_csv(ROOT / "results/reference/method_comparison_accuracy.direct.records.csv.xz", low_memory=False,
                       usecols=[*CASE, "method", "status", "verdict", "unknowns", "error", "error_energy_norm"])
    rows["kind"] = rows["problem"].str.extract(f"^({KINDS})")[0].replace({"centre_crack": "crack", "inclined_crack": "crack"})
    rows = rows[rows["kind"].notna()]
    right = (rows["verdict"] == "ok") & rows["status"].isin(["ok", "deviated"])
    refuses = ~right.groupby([rows["method"], rows["sheet"], rows["kind"]]).transform("any")
    common = (right | refuses).groupby([rows[c] for c in CASE]).transform("all") & ~refuses
    return rows[right], rows[common]


def errors(right, rows):
    """A row per method, as in docs/explanation/measuring.md, Accuracy: the mean over kinds, in bent plates, the interval. In
    percent over a fitted mesh with as many unknowns: the case's own, refined at the rate of all of its problem and sheet."""
    rate = {}
    for key, of_all in right[right["method"] == FITTED].groupby(["problem", "sheet"]):
        if of_all["unknowns"].nunique() > 1:
            logs = np.log(of_all[["unknowns", "error"]]).cov().to_numpy()
            rate[key] = min(0.0, logs[0, 1] / logs[0, 0])
    rows = rows.merge(rows.loc[rows["method"] == FITTED, [*CASE, "unknowns", "error"]], on=CASE, suffixes=("", "_fitted"))
    power = np.array([rate.get(key, np.nan) for key in zip(rows["problem"], rows["sheet"])])
    rows["log"] = np.log(rows["error"] / rows["error_fitted"]) - power * np.log(rows["unknowns"] / rows["unknowns_fitted"])
    rows = rows[np.isfinite(rows["log"])]
    logs_of = rows.set_index(["method", "kind", *CASE])["log"]
    plain = logs_of[PLAIN]
    draw, found = np.random.default_rng(7), {}
    for method, own in logs_of.groupby(level="method"):
        own = own[method]
        over_plain = (own - plain).groupby(level="kind").mean().dropna()  # in the cases that both made
        few = own.groupby(level="kind").size() / plain.groupby(level="kind").size() < 0.5  # then easy cases alone would flatter it
        logs = own.groupby(level="kind").mean()
        logs = logs.where(~few.reindex(logs.index), plain.groupby(level="kind").mean() + over_plain)
        bent = logs.get("bent_plate", np.nan)
        of_plain = plain.groupby(level="kind").mean()
        shared = logs.index.intersection(of_plain.index)  # a kind that it refuses: a plain split's, times its own ratio elsewhere
        logs = logs.reindex(of_plain.index).fillna(of_plain + (logs[shared] - of_plain[shared]).mean())
        ends = np.quantile(draw.choice(logs, (200_000, len(logs))).mean(axis=1), [0.025, 0.975])
        found[method] = 100 * np.expm1([logs.mean(), bent, *ends])
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


def step_after(method, mass):
    """Median of the largest explicit step after single cuts, over that of the uncut sheet."""
    rows = pd.read_csv(ROOT / "results/reference/stability.records.csv.xz", low_memory=False,
                       usecols=["sweep", "method", "mass", "explicit_step_ratio"])
    rows = rows[rows["sweep"].str.fullmatch("single_cuts(_added_mass)?") & (rows["method"] == method) & (rows["mass"] == mass)]
    return rows["explicit_step_ratio"].median()


def time_after_twenty(method):
    """Median of the time of a motion after twenty cuts over that of the same case after a plain split, by multigrid."""
    rows = pd.read_csv(ROOT / "results/reference/whole_step.records.csv.xz", low_memory=False)
    rows = rows[(rows["place"] == 20) & (rows["solver"] == "multigrid") & rows["method"].isin([method, "conventional_split"])]
    others = np.round(0.25 / rows["step_s"]) - 1
    ms = (rows["cut_update_us"] / 20 + rows["first_step_us"] + others * rows["step_us"]) / 1000
    ms = ms.where(rows["verdict"].isin(["ok", "energy_growth", "inverted"]), float("inf"))
    both = ms.groupby([rows[c] for c in ("sheet", "resolution", "case", "step_s", "stiffness_n_m", "method")]).first().unstack()
    return (both[method] / both["conventional_split"]).dropna().median()


PAGE = "docs/how-to/choose_a_method.md"
NAMES = {4: "eigenvalue", 5: "eigenvalue, 95 %", 6: "AR < 3", 9: "vertices added", 10: "us"}  # columns of its table
OF_MEASURED = {4: 0, 5: 1, 6: 5, 9: 7, 10: 8}  # and their places in measured()


def check_table(truth, error):
    seen = set()
    for cells in rows_of((ROOT / PAGE).read_text(encoding="utf-8"), "## All methods in one table"):
        name = cells[0].strip("`")
        seen.add(name)
        for place, what in NAMES.items():
            if cells[place] != "none changed":
                expect(f"{PAGE}, {name}, {what}", cells[place], truth[name][OF_MEASURED[place]])
        mean, bent, *ends = error[name]
        said = re.fullmatch(r"(\S+) \[(\S+), (\S+)\]", cells[7])
        expect(f"{PAGE}, {name}, error", said[1], mean)
        expect(f"{PAGE}, {name}, in bent plates", cells[8], bent)
        for number, value in zip(said.groups()[1:], ends):  # drawn: to two percent of the interval
            if abs(float(number) - value) > 0.5 + 0.02 * (ends[1] - ends[0]):
                problems.append(f"{PAGE}, {name}: an end of the interval is {number}, the rows give {value:.4g}")
    if seen != set(truth):
        problems.append(f"{PAGE}: other methods than in the rows: {', '.join(sorted(seen ^ set(truth)))}")


def check_decision(charted):
    """Row by row: the numbers of README.md."""
    found = [step_after("cut_polygons", "lumped"), step_after("conventional_split", "stabilised"), charted["cut_polygons"][1],
             charted["adaptive_remesh"][1], time_after_twenty("active_node")]
    rows = rows_of((ROOT / "README.md").read_text(encoding="utf-8"), "## Which method?")
    if len(rows) != len(found):
        problems.append(f"README.md, Which method?: {len(rows)} rows, the test knows {len(found)}")
    for cells, value in zip(rows, found):
        expect(f"README.md, Which method?, {cells[0]}", re.search(r"\d[\d.]*", cells[2])[0], value)


right, solves = solved()
check_table(measured(), errors(right, solves))
check_decision(chart(solves))
print("\n".join(problems))
sys.exit(bool(problems))
