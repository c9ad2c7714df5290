#!/usr/bin/env python3
"""The stability sweeps: one page of small multiples, a figure for each sweep, and the table of breaking points. Reads
results/stability; writes stability.png, stability_SWEEP.png and stability.md there."""

import sys
from pathlib import Path

import matplotlib.pyplot as plt

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load
from analysis.stability import points, table
from figures.common import style
from figures.stability import panels

DISTANCE, NUMBER = "distance, h", "number of cuts"
INTEGRATORS = {"backward_euler": "backward Euler", "midpoint": "midpoint"}
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
ON_THE_PAGE = [  # rows of the page: height and the space below, inches, and the panels
    (1.5, 0.45, ["vertex", "edge", "border", "tip"]),
    (1.5, 0.55, ["angle", "strip", "piece", "in_a_row"]),
    (1.5, 0.62, ["single_cuts", "several_cuts", "explicit"]),
    (1.8, 0.55, ["vertex_solvers", "angle_solvers", "strip_solvers", "in_a_row_solvers"]),
    (0.85, 0.55, ["map_0", "map_1", "map_2", "map_3", "map_4", "map_5", "map_6", "map_7"]),
    (1.2, 0.3, ["iterations", "tolerance", "rolled", "turned_over", "step_poisson"]),
]
OWN_ROWS = {"in_a_row", "explicit", "in_a_row_solvers", "step_poisson"}  # panels whose methods are not those to their left
MAPS = [(integrator, newton, damping) for damping in (0.0, 1e-3) for integrator in INTEGRATORS for newton in (1, 3)]
SECTIONS = ["a   one cut comes near something: explicit step (bending included), as a share of the uncut sheet's", None,
            "b   after single cuts: time of the cut (without finding polygons or ties), explicit step; after four; explicit runs",
            "c   implicit steps of 1/240 s; rows of a method, from the top: CG, sliver blocks, multigrid, CHOLMOD, constant factor",
            "d   step × stiffness right after a cut by conventional split: verdicts, solved by CHOLMOD",
            "e   solvers cut short, and large deformations (in each method by solvers, or by integrators × Newton iterations)"]


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
    return f"{INTEGRATORS[integrator]}\n{newton} it.{', damped' if damping else ''}"


def page(rows, caption):
    above, below = 0.42, 0.9  # inches
    total = sum(height + gap for height, gap, _ in ON_THE_PAGE) + above + below
    figure = plt.figure(figsize=(style.PAGE, total))
    top = total - above
    for (height, space, names), section in zip(ON_THE_PAGE, SECTIONS):
        if section:
            figure.text(0.05 / style.PAGE, (top + 0.2) / total, section, fontsize=7, fontweight="bold", va="bottom")
        left = 0.5 if names[0] == "map_0" else 0.95
        gaps = [left] + [0.95 if name in OWN_ROWS else 0.08 for name in names[1:]]
        width = (style.PAGE - 0.05 - sum(gaps)) / len(names)
        x = 0
        for name, gap in zip(names, gaps):
            x += gap
            ax = figure.add_axes([x / style.PAGE, (top - height) / total, width / style.PAGE, height / total])
            draw(ax, rows, name, ylabels=gap >= 0.5)
            x += width
        top -= height + space
    drawn = {name for _, _, names in ON_THE_PAGE for name in names if name in CELLS} | {"step_stiffness"}
    for y, (words, handles) in zip((0.78, 0.61, 0.44), panels.legends(set(rows[rows["sweep"].isin(drawn)]["verdict"]))):
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
    handles = [h for _, some in panels.legends(set(rows[rows["sweep"] == panel]["verdict"]), panel) for h in some]
    if handles:
        figure.legend(handles=handles, loc="lower center", ncol=4, fontsize=5.5, handlelength=1)
    path = folder / f"stability_{panel}.png"
    style.write_png(figure, path)


def main():
    folder = load.results_folder("stability", __doc__)
    rows, context = points.read(folder), load.read_context(folder / "context.json")
    caption = ("A cell is one setting and one method: the worst of its cuts. Values go from harmless (left) to harmful; h is the "
               "mean edge of the uncut sheet. Why steps shrink: the largest eigenvalue of the membrane grows as (h / altitude)² of the thinnest "
               "triangle, that of bending faster. At 1e-12 h, below the snap distance, the path goes through the vertex. Tie: corners of thin triangles "
               "follow their neighbours. Ghost: a penalty on jumps of the gradient across the edges of cut triangles. Stabilised mass: "
               "thin triangles of a conventional split get mass against their stiff modes; hatched: in some cases its eigenvalue came out as no number. (To scale all of "
               "their mass would add 88 times the sheet's.) Ties and phantom nodes: their explicit step is predicted, the program makes none. b, left: time of a cut (without finding ties or polygons) over that of the conventional "
               "split, and incision error, medians; a dot at the median of the explicit step, a line to what 95 % of the cuts have; dashed "
               "0.3, dotted 0.1; green: above both. b, right: 300 steps of symplectic Euler without damping, ok where the energy stays. d: a row "
               f"is a stiffness, a column a step. e: Euler, midpoint with 1 and 3 Newton iterations each. {len(rows)} points, "
               f"{rows['sweep'].nunique()} sweeps; seed {context.get('seed')}, commit {str(context.get('commit'))[:10]}. How to read "
               f"it: docs/explanation/stability.md. Command: {context.get('command')}")
    style.save(page(points.on_the_page(rows), caption), folder, "stability")
    for panel in set(CELLS) & set(rows["sweep"]):
        alone(rows, panel, folder)
    load.write_beside(folder / "stability.md", table.text_of(rows, context))


if __name__ == "__main__":
    main()
