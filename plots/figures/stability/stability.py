#!/usr/bin/env python3
"""The stability sweeps: pages of at most six panels, a figure for each sweep, and the table of breaking points. Reads
results/stability; writes stability_PAGE.png, stability_SWEEP.png and stability.md there."""

import sys
from pathlib import Path

import matplotlib.pyplot as plt

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load
from analysis.stability import points, table
from figures.common import style
from figures.stability import panels

DISTANCE, NUMBER = "distance, h", "number of cuts"
STEPS = [1e-4, 1e-2, 1]
NEAR = [0.5, 0.01, 1e-6, 1e-12]
CELLS = {  # a panel: title, label of the x axis; column of the group, of x, those within the group, measure, ticks
    "vertex": ("cut passes a vertex", DISTANCE, "name", "place", (), "explicit", NEAR),
    "edge": ("cut beside an edge", DISTANCE, "name", "place", (), "explicit", NEAR),
    "border": ("cut along the border", DISTANCE, "name", "place", (), "explicit", NEAR),
    "tip": ("tip stops before an edge", DISTANCE, "name", "place", (), "explicit", NEAR),
    "angle": ("re-cut at an angle", "degrees", "name", "place", (), "explicit", [90, 20, 5, 1, 0.1]),
    "strip": ("two parallel cuts", DISTANCE, "name", "place", (), "explicit", [1, 0.1, 0.01, 1e-4, 1e-6]),
    "piece": ("a piece cut out", "size, triangles", "name", "place", (), "explicit", [1, 0.1, 1e-3, 1e-6, 1e-10]),
    "in_a_row": ("cuts in a row", NUMBER, "name", "place", (), "explicit", [1, 10, 100, 1000]),
    **{sweep: (title, DISTANCE, "name", "place", ("solver",), "cost", NEAR) for sweep, title in
       {"edge_solvers": "cut beside an edge", "border_solvers": "cut along the border", "tip_solvers": "tip stops before an edge"}.items()},
    "vertex_solvers": ("cut passes a vertex", DISTANCE, "name", "place", ("solver",), "cost", NEAR),
    "angle_solvers": ("re-cut at an angle", "degrees", "name", "place", ("solver",), "cost", [90, 20, 5, 1, 0.1]),
    "strip_solvers": ("two parallel cuts", DISTANCE, "name", "place", ("solver",), "cost", [1, 0.1, 0.01, 1e-4, 1e-6]),
    "in_a_row_solvers": ("cuts in a row", NUMBER, "name", "place", ("solver",), "cost", [1, 10, 100]),
    "iterations": ("iterations allowed", "in a solve", "name", "max_iterations", ("solver",), "cost", [3, 30, 300, 3000]),
    "tolerance": ("tolerance of the solver", "relative residual", "name", "tolerance", ("solver",), "cost", [0.9, 0.1, 1e-4, 1e-8]),
    "rolled": ("rolled up by", "degrees", "name", "pose_amount", ("integrator", "newton"), "", [0, 180, 350]),
    "turned_over": ("stretched in a plane", "factor", "name", "pose_amount", ("integrator", "newton"), "",
                    [1.5, 1, 0.2, -1]),
    "step_poisson": ("step × Poisson's ratio", "step, s", "name", "step_s", ("integrator", "newton", "poisson"), "", STEPS),
    "vertex_static": ("at rest, passes a vertex", DISTANCE, "name", "place", ("solver",), "", NEAR),
    "piece_static": ("at rest, a free piece", "size, triangles", "name", "place", (), "", [1, 0.1, 1e-4, 1e-8]),
    "vertex_mass": ("lumped, consistent mass", DISTANCE, "name", "place", ("mass", "integrator", "solver"), "cost", NEAR),
    "vertex_stress": ("stiffness from stress: none, positive, full", DISTANCE, "name", "place",
                      ("stress_stiffness", "pose_amount", "newton", "solver"), "cost", NEAR),
}
PAGES = {  # stem: title, rows of panels, height of a row in inches, legends, what the caption says of it
    "stability_near": (
        "One cut comes near something: what is left of an explicit step", [["vertex", "edge", "border"], ["tip", "angle", "strip"]], 2.0,
        ["explicit"],
        "A cell is one setting and one method: the worst of its cuts; to the right the cut comes nearer. The explicit step, bending included, is a "
        "share of the uncut sheet's. Why it shrinks: the largest eigenvalue of the membrane grows as (h / altitude)² of the thinnest triangle, that of "
        "bending faster. At 1e-12 h, below the snap distance, the path goes through the vertex. Tie: corners of thin triangles follow their neighbours. "
        "Ghost: a penalty on jumps of the gradient across the edges of cut triangles. Stabilised mass: thin triangles of a conventional split get mass "
        "against their stiff modes; hatched: its eigenvalue came out as no number. Ties and copies: their explicit step is predicted, the program makes none."),
    "stability_cuts": (
        "Small pieces, many cuts, ordinary cuts: what is left of an explicit step",
        [["piece", "in_a_row"], ["single_cuts", "several_cuts", "explicit"]], 2.0, ["explicit"],
        "Above, a cell is one setting and one method: the worst of its cuts. Below, a dot is the median of the explicit step and a line leads to what 95 % "
        "of the cuts have; dashed 0.3, dotted 0.1; green: above both. Single cuts: time of a cut (without finding polygons or ties) over that of the "
        "conventional split, and incision error, medians. Right: 300 steps of symplectic Euler without damping, ok where the energy stays."),
    "stability_solvers": (
        "Implicit steps of 1/240 s: which solver works, and what a step costs",
        [["vertex_solvers", "angle_solvers"], ["strip_solvers", "in_a_row_solvers"]], 2.7, ["cost"],
        "The sheet is stretched, cut, and springs open. A row of a method is a solver, named in the first. A cell "
        "is the worst of its cuts; to the right they are harder."),
    "stability_steps": (
        "How long may an implicit step be, and how stiff the sheet?", [["map_0", "map_1", "map_4"], ["map_2", "map_3", "map_6"]], 1.15, [],
        "Steps right after a cut by conventional split, solved by CHOLMOD. A row is a stiffness, a column a step."),
    "stability_limits": (
        "Solvers cut short, and large deformations", [["iterations", "tolerance", "rolled"], ["turned_over", "step_poisson"]], 1.9, ["cost"],
        "A row of a method is a solver, or an integrator with 1 or 3 Newton iterations, named in the first. Step × Poisson's ratio: backward Euler with 1 "
        "and 3, then midpoint."),
}
OWN_ROWS = {"in_a_row", "explicit", "in_a_row_solvers", "step_poisson"}  # panels whose methods are not those to their left
MAPS = [(integrator, newton, damping) for damping in (0.0, 1e-3) for integrator in points.INTEGRATORS for newton in (1, 3)]


def draw(ax, rows, panel, ylabels=True):
    """A panel by its name; nothing where its sweep was not run."""
    if not ({panel} if not panel.startswith("map_") else {"step_stiffness"}) & set(rows["sweep"]):
        return ax.set_axis_off()
    if panel in CELLS:
        title, label, group, x, inner, measure, ticks = CELLS[panel]
        panels.cells(ax, rows[rows["sweep"] == panel], group, x, inner, measure, ylabels, ticks)
    elif panel.startswith("map_"):
        title, label = draw_map(ax, rows, MAPS[int(panel[4:])], ylabels), "step, s"
    elif panel == "explicit":
        panels.share_ok(ax, rows[rows["sweep"] == panel], "name", "step_share", ylabels)
        title, label = "runs: % of curved cuts ok", "step / uncut limit"
    else:
        some = rows[rows["sweep"] == panel]
        panels.ratio_lines(ax, some, list(dict.fromkeys(some["name"])), ylabels, prices=panel == "single_cuts")
        title = {"single_cuts": "single: time, error; median, 5 %", "several_cuts": "four cuts: the same"}[panel]
        label = "largest step / uncut limit"
    ax.set_title(title, loc="left", fontsize=6, pad=2)
    return ax.set_xlabel(label, labelpad=1, fontsize=5.5)


def draw_map(ax, rows, which, ylabels):
    integrator, newton, damping = which
    some = rows[(rows["sweep"] == "step_stiffness") & (rows["method"] == "conventional_split")
                & (rows["integrator"] == integrator) & (rows["newton"] == newton) & (rows["stiffness_damping_s"] == damping)]
    some = some.sort_values("stiffness_n_m", ascending=False, kind="stable")
    panels.cells(ax, some, "stiffness_n_m", "step_s", ylabels=ylabels, labels=panels.short, ticks=STEPS)
    if ylabels:
        ax.set_ylabel("E t, N/m", fontsize=5.5, labelpad=1)
    return f"{points.INTEGRATORS[integrator]}, {newton} Newton it.{', damped' if damping else ''}"


def page(rows, stem, caption):
    title, panels_of_rows, height, bands, _ = PAGES[stem]
    sweeps = {"step_stiffness" if name.startswith("map_") else name for names in panels_of_rows for name in names}
    legends = panels.legends(set(rows[rows["sweep"].isin(sweeps)]["verdict"]), bands)
    above, gap, below = 0.55, 0.47, 0.36 + 0.17 * len(legends)  # inches
    total = above + len(panels_of_rows) * (height + gap) + below
    figure = plt.figure(figsize=(style.PAGE, total))
    figure.text(0.05 / style.PAGE, (total - 0.16) / total, title, fontsize=8, fontweight="bold", va="center")
    top = total - above
    for names in panels_of_rows:
        gaps = [0.5 if names[0].startswith("map_") else 0.95] + [0.95 if name in OWN_ROWS else 0.08 for name in names[1:]]
        width = (style.PAGE - 0.05 - sum(gaps)) / len(names)
        x = 0
        for name, space in zip(names, gaps):
            x += space
            ax = figure.add_axes([x / style.PAGE, (top - height) / total, width / style.PAGE, height / total])
            draw(ax, rows, name, ylabels=space >= 0.5)
            x += width
        top -= height + gap
    for y, (words, handles) in zip((below - 0.02 - 0.17 * i for i in range(len(legends))), legends):
        figure.text(0.05 / style.PAGE, y / total, words, fontsize=6, va="center")
        figure.legend(handles=handles, loc="center left", ncol=len(handles), bbox_to_anchor=(0.16, y / total), fontsize=6,
                      handlelength=1.1, handleheight=0.9, columnspacing=0.9, handletextpad=0.4, borderpad=0)
    figure.text(0.05 / style.PAGE, 0.05 / total, "\n".join(style.two_lines(figure, caption, style.PAGE - 0.1)),
                fontsize=style.CAPTION_SIZE, va="bottom", linespacing=1.2, parse_math=False)
    return figure


def alone(rows, panel, folder):
    """A sweep as a figure of its own."""
    figure, ax = plt.subplots(figsize=(style.WIDTH, 2.8))
    figure.subplots_adjust(left=0.27, right=0.99, top=0.93, bottom=0.26)
    draw(ax, rows, panel)
    handles = [h for _, some in panels.legends(set(rows[rows["sweep"] == panel]["verdict"]), panels.bands_of(panel)) for h in some]
    if handles:
        figure.legend(handles=handles, loc="lower center", ncol=4, fontsize=5.5, handlelength=1)
    path = folder / f"stability_{panel}.png"
    style.write_png(figure, path)


def main():
    folder = load.results_folder("stability", __doc__)
    rows, context = points.read(folder), load.read_context(folder / "context.json")
    source = (f"{len(rows)} points, {rows['sweep'].nunique()} sweeps; seed {context.get('seed')}, commit {str(context.get('commit'))[:10]}. How to "
              f"read it: docs/explanation/stability.md. Command: {context.get('command')}")
    for stem, (*_, words) in PAGES.items():
        style.save(page(points.on_the_page(rows), stem, f"{words} {source}"), folder, stem)
    for panel in set(CELLS) & set(rows["sweep"]):
        alone(rows, panel, folder)
    load.write_beside(folder / "stability.md", table.text_of(rows, context))


if __name__ == "__main__":
    main()
