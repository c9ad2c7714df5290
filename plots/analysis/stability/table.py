"""The table of breaking points, and what single cuts leave of an explicit step, as Markdown."""

import pandas as pd

from analysis import shares
from analysis.stability import points
from analysis.stability.points import text

SERIES = {  # columns, beside the method, that make a series of a sweep; the swept column
    "vertex": ([], "place"), "edge": ([], "place"), "border": ([], "place"), "tip": ([], "place"),
    "angle": ([], "place"), "strip": ([], "place"), "piece": ([], "place"), "in_a_row": ([], "place"),
    "vertex_solvers": (["solver"], "place"), "angle_solvers": (["solver"], "place"), "strip_solvers": (["solver"], "place"),
    "edge_solvers": (["solver"], "place"), "border_solvers": (["solver"], "place"), "tip_solvers": (["solver"], "place"),
    "in_a_row_solvers": (["solver"], "place"), "in_a_row_cholmod": (["solver"], "place"), "vertex_mass": (["mass", "integrator", "solver"], "place"),
    "vertex_stress": (["stress_stiffness", "pose_amount", "newton", "solver"], "place"),
    "vertex_static": (["solver"], "place"), "piece_static": ([], "place"),
    "iterations": (["solver"], "max_iterations"), "tolerance": (["solver"], "tolerance"),
    "step_stiffness": (["integrator", "newton", "stiffness_damping_s", "stiffness_n_m"], "step_s"),
    "step_poisson": (["integrator", "newton", "poisson"], "step_s"),
    "rolled": (["integrator", "newton"], "pose_amount"), "turned_over": (["integrator", "newton"], "pose_amount"),
    "explicit": ([], "step_share"),
}
FROM_HARMFUL = {"iterations", "explicit"}  # their values begin where it breaks
TIED = ["split_and_tie", "ablation:warp+thin:tie", "phantom_node", "phantom_node:consistent_mass", "virtual_node"]  # whose vertices an explicit step does not take
WITH_EXPLICIT = {"vertex", "edge", "border", "tip", "angle", "strip", "piece", "in_a_row"}


def series_of(rows, sweep):
    """(words that name the series, its points from harmless to harmful)"""
    columns, x = SERIES[sweep]
    some = rows[(rows["sweep"] == sweep) & ~((sweep == "turned_over") & (rows["pose_amount"] > 1.05))]  # pressed, not pulled
    for key, series in some.groupby(["name", *columns] if columns else "name", sort=False):
        key = key if columns else (key,)
        table = points.worst(series, [x])
        if sweep in FROM_HARMFUL:
            table = table[::-1]
        yield [key[0], *(f"{v:g}" if isinstance(v, float) else str(v) for v in key[1:])], table, x


def breaking_points(rows, sweep):
    lines = []
    for words, table, x in series_of(rows, sweep):
        last, first = points.breaking_point(table[x], table["rank"] == 0)
        verdict = "-" if first is None else table.loc[table[x] == first, "verdict"].iloc[0]
        line = [words[0], ", ".join(words[1:]) or "-", text(last), text(first), verdict.replace("_", " ")]
        if sweep in WITH_EXPLICIT:
            good = [points.breaking_point(table[x], (table["rank"] == 0) & (table["explicit"] >= least))[0] for least in (0.3, 0.1)]
            line += [text(v) for v in good] + [least_of(table)]
        lines.append(line)
    methods = list(dict.fromkeys(line[0] for line in lines))
    return sorted(lines, key=lambda line: methods.index(line[0]))


def least_of(table):
    """Of the cases that are known, where any is, and how many are not."""
    unknown = table.loc[table["explicit"].isna() & (table["rank"] == 0), "unknown"].sum()
    least = rounded(table["least_known"].min())
    return f"{least} ({unknown:.0f} not known)" if unknown and least != "-" else least


def rounded(value):
    return "-" if pd.isna(value) else f"{value:.2g}"


def markdown(head, lines):
    return "\n".join(["| " + " | ".join(line) + " |" for line in [head, ["---"] * len(head), *lines]])


def cures(rows):
    """A line per method: explicit steps of single and of four cuts, price, and the sweeps that it passes whole."""
    lines = []
    single, several = (rows[(rows["sweep"] == s)] for s in ("single_cuts", "several_cuts"))
    base = single[single["name"] == "conventional split"]["geometry_us"].median()  # not with an added mass
    counts = points.shares_of(single)
    plain = single[(single["name"] == "conventional split") & (single["rank"] == 0)]
    for name in shares.last_if_few(dict.fromkeys(single["name"]), counts):
        mine = single[single["name"] == name]
        made = mine[mine["rank"] == 0]
        ratio, four = mine[points.EXPLICIT].fillna(0), several[several["name"] == name][points.EXPLICIT].fillna(0)
        low = ratio.quantile(0.05)
        every = rows[(rows["name"] == name) & rows["sweep"].isin(WITH_EXPLICIT)]
        broken = [s for s in WITH_EXPLICIT if (every[every["sweep"] == s]["rank"] > 0).any()]
        lines.append([name + counts[name].beside(), f"{ratio.median():.2g}", f"{low:.2g}", "yes" if ratio.median() >= 0.3 and low >= 0.1 else "no",
                      "no" if mine["method"].isin(TIED).all() else "yes",
                      f"{four.median():.2g}", f"{four.quantile(0.05):.2g}",
                      f"{shares.fair_values(made, plain, 'geometry_us', points.CUT, counts[name].is_few).median() / base:.1f}", f"{made['vertices_added'].median():.0f}",
                      f"{made['incision_error_h'].median():.2g}", f"{len(made)}/{len(mine)}",
                      ", ".join(sorted(broken)).replace("_", " ") or "none"])
    return markdown(["method", "explicit step, median", "95 % have at least", "0.3 and 0.1?", "step made?", "four cuts, median", "95 %",
                     "time of a cut without finding polygons or ties / conventional", "vertices added", "incision error, h", "cuts ok",
                     "sweeps with a verdict that is not ok"], lines)


def prediction(rows):
    """How often explicit runs agree with the step that the eigenvalue allows: ok below it, and not ok above."""
    runs = rows[(rows["sweep"] == "explicit") & (rows["verdict"] != "refused")].copy()
    if runs.empty:
        return ""
    predicted = runs.groupby(["name", "case"])[points.EXPLICIT].max()
    runs["over"] = runs["step_share"] / [predicted.get(key) for key in zip(runs["name"], runs["case"])]
    clear = runs[(runs["over"] < 0.9) | (runs["over"] > 1.1)]
    agree = (clear["over"] < 1) == (clear["rank"] == 0)
    return (f"Of {len(clear)} explicit runs whose step is not within 10 % of the predicted limit, {agree.sum()} "
            f"({100 * agree.mean():.1f} %) end as predicted: {((clear['over'] < 1) & ~agree).sum()} failed below it, "
            f"{((clear['over'] > 1) & ~agree).sum()} were ok above it.\n")


def implicit(rows):
    """For each method and solver the sweeps over places, of the steps after the cut, that are ok whole, and the others."""
    places = ["vertex_solvers", "edge_solvers", "border_solvers", "tip_solvers", "angle_solvers", "strip_solvers",
              "in_a_row_solvers", "in_a_row_cholmod"]
    some = rows[rows["sweep"].isin(places)]
    lines = []
    for (name, solver), mine in some.groupby(["name", "solver"], sort=False):
        tried = [s for s in places if (mine["sweep"] == s).any()]
        broken = []
        for sweep in tried:
            table = points.worst(mine[mine["sweep"] == sweep], ["place"])
            last, first = points.breaking_point(table["place"], table["rank"] == 0)
            if first is not None:
                verdict = table.loc[table["place"] == first, "verdict"].iloc[0].replace("_", " ")
                broken.append(f"{sweep.removesuffix('_solvers').replace('_', ' ')} at {text(first)} ({verdict})")
        lines.append([name, points.SOLVERS[solver], f"{len(tried) - len(broken)} of {len(tried)}", "; ".join(broken) or "none"])
    methods = list(dict.fromkeys(line[0] for line in lines))
    return markdown(["method", "solver", "sweeps ok", "first failure of the others"],
                    sorted(lines, key=lambda line: methods.index(line[0])))


def explicit_by_place(rows, sweep):
    """The least explicit step of the cases of each point."""
    some = rows[rows["sweep"] == sweep]
    places = list(dict.fromkeys(some["place"]))
    least = some.groupby(["name", "place"], sort=False)[points.EXPLICIT].min()
    return markdown(["explicit step at", *(text(p) for p in places)],
                    [[name, *(rounded(least.get((name, p))) for p in places)] for name in dict.fromkeys(some["name"])])


def explicit_runs(rows):
    """% of the cuts whose explicit run is ok, by its step over the largest one of the uncut sheet."""
    some = rows[rows["sweep"] == "explicit"]
    shares = list(dict.fromkeys(some["step_share"]))
    ok = (some["rank"] == 0).groupby([some["name"], some["step_share"]]).mean()
    return markdown(["% of runs ok at", *(text(s) for s in shares)],
                    [[name, *(f"{100 * ok[name, s]:.0f}" for s in shares)] for name in dict.fromkeys(some["name"])])


def in_a_row(rows):
    """What the n-th of many cuts meets and costs."""
    some = rows[(rows["sweep"] == "in_a_row") & rows["place"].isin([1, 10, 100, 1000])]
    return markdown(["method", "cuts", "triangles", "smallest altitude of changed, h", "explicit step", "time of the last cut, ms",
                     "verdict"],
                    [[r.name, text(r.place), text(r.triangles), rounded(r.altitude_min_h_cut), rounded(r.explicit_step_ratio),
                      rounded(r.geometry_us / 1000), r.verdict.replace("_", " ")]
                     for r in some.sort_values("name", kind="stable").itertuples(index=False)])


def verdicts(rows):
    table = pd.crosstab(rows["sweep"], rows["verdict"])
    names = [v for v in points.WORST_LAST if v in table]
    order = [s for s in dict.fromkeys(rows["sweep"])]
    return markdown(["sweep", *(n.replace("_", " ") for n in names)],
                    [[s.replace("_", " "), *(str(table.loc[s, n] or "") for n in names)] for s in order])


def text_of(rows, context):
    parts = [f"# Breaking points\n\n{len(rows)} points, seed {context.get('seed')}, commit {context.get('commit')}. Each line "
             "is a series of points from harmless to harmful; a point is ok where all of its cases are.\n",
             "## Explicit steps\n\nLargest stable explicit step, bending included, over that of the uncut sheet; a cut that was "
             "not made counts as 0. The program makes no explicit step of tied vertices and phantom nodes: theirs is what it "
             "could be.\n", cures(rows), "\n" + prediction(rows), explicit_runs(rows), "\n## Implicit steps after the cut\n", implicit(rows), "\n## Many cuts in a row\n",
             in_a_row(rows), "\n## Verdicts\n", verdicts(rows)]
    for sweep in dict.fromkeys(rows["sweep"]):
        if sweep not in SERIES:
            continue
        head = ["method", "series", "last ok", "first not ok", "verdict"]
        if sweep in WITH_EXPLICIT:
            head += ["explicit ≥ 0.3 down to", "≥ 0.1 down to", "least"]
        parts += [f"\n## {sweep.replace('_', ' ')}\n\n`{SERIES[sweep][1]}`\n", markdown(head, breaking_points(rows, sweep))]
        if sweep in WITH_EXPLICIT:
            parts += ["", explicit_by_place(rows, sweep)]
    return "\n".join(parts) + "\n"
