"""Figures of scenes: a column for each scene, a row for each method. All panels of a column have the same camera and time.
The frames are in results/<stem>/<scene>/<method>, one folder per `cutbench simulate --frames`."""

import argparse
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.cm import ScalarMappable

from analysis import load, naming
from analysis.scenes.scene_frames import commits, read_shot, same, solvers
from figures.common import render, style

GAP, TITLE = 0.04, 0.28  # inches


@dataclass(frozen=True)
class Shot:
    scene: str
    title: str
    time: float  # s
    camera: render.Camera = render.Camera()
    ground: float | None = -0.6  # m; None: no shadow
    box: tuple = ()  # (x0, x1, y0, y1) of the picture, m at the camera's centre; empty: all that moves
    sheet: str = "1 m square, the skin of paper_table1"


def arguments(stem, description):
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results" / stem,
                        help=f"holds the frames, receives the figures (default: results/{stem})")
    parser.add_argument("--colour", choices=sorted(render.SCALARS), help="of the triangles, instead of the skin's")
    return parser.parse_args()


def look_of(description):
    method, _, parameter = description["method"].partition(" ")
    return naming.looks([(method, parameter)])[method, parameter]


def caption(stem, shots, panels, extra, colour=None):
    """n, material, times, seed, tolerance, commit and command of the figure."""
    described = [d for column in panels for d, _ in column]
    n = same((d["triangles_before"] for d in described), "the number of triangles")
    same((d["commit"] for d in described), "the commit")
    times = ", ".join(f"{s.title} {same((f.time for _, f in column), 'time'):.3f} s (cut at "
                      + ", ".join(f"{c['time_s']:g}" for c in column[0][0]["cuts"]) + " s)"
                      for s, column in zip(shots, panels))
    seeds = sorted({c["seed"] for d in described for c in d["cuts"] if "seed" in c})
    failed = dict.fromkeys(f"{d['scene']} by {d['method']}: {d['verdict']}" for d in described if d["verdict"] != "ok")
    tolerance = same((d.get("chord_tolerance", "inf") for d in described), "the chord tolerance")
    return " ".join([
        *extra, f"n = {n} triangles before the cut, {same((s.sheet for s in shots), 'the sheet')}; time: {times}. Red: "
        f"lips of the incision. Backward Euler, {same((1 / d['step_s'] for d in described), 'the step'):.0f} steps per s, "
        f"{solvers(shots, panels)}; chord tolerance {tolerance} h.",
        f"{'Seed: ' + ', '.join(map(str, seeds)) if seeds else 'No seed: the cuts are in the scene files'}; "
        f"{commits(described)}.",
        *([f"FAILED: {'; '.join(failed)}."] if failed else []),
        f"Command: experiments/reproduce {stem}" + (f"; {load.script_of(stem)} --colour {colour}" if colour else "")])


def arranged(shots, panels):
    """(column, row, shot, description, frame) of each panel: a column per scene, of a single scene two columns."""
    if len(shots) == 1:
        return [(i % 2, i // 2, shots[0], *panel) for i, panel in enumerate(panels[0])]
    return [(c, r, shot, *panel) for c, (shot, column) in enumerate(zip(shots, panels))
            for r, panel in enumerate(column)]


def draw(shots, panels, wireframe, colour, text, label):
    """The figure, 8.5 cm wide and as high as it needs. `label(description, frame)`: a second line over each panel."""
    cells = arranged(shots, panels)
    rows = 1 + max(r for _, r, *_ in cells)
    width, heading = style.WIDTH / 2, 0.17 if len(shots) > 1 else 0
    boxes = {s: s.box or render.extent([f for _, f in column], s.camera, s.ground) for s, column in zip(shots, panels)}
    height = max((width - GAP) * (b[3] - b[2]) / (b[1] - b[0]) for b in boxes.values())
    figure = plt.figure(figsize=(style.WIDTH, 1))
    lines = style.two_lines(figure, text, style.WIDTH - 0.1)
    below = 0.125 * len(lines) + 0.08 + (0.38 if colour else 0)
    total = below + rows * (height + TITLE) + heading
    figure.set_size_inches(style.WIDTH, total)
    figure.text(0.05 / style.WIDTH, 0.04 / total, "\n".join(lines), fontsize=style.CAPTION_SIZE, va="bottom",
                linespacing=1.2, parse_math=False)
    for c, r, shot, description, frame in cells:
        bottom, middle = below + (rows - 1 - r) * (height + TITLE), (c + 0.5) * width / style.WIDTH
        ax = figure.add_axes([(c * width + GAP / 2) / style.WIDTH, bottom / total, (width - GAP) / style.WIDTH,
                              height / total])
        render.draw(ax, frame, shot.camera, wireframe=wireframe, colour=colour, ground=shot.ground)
        render.blank(ax, boxes[shot])
        figure.text(middle, (bottom + height + 0.01) / total,
                    f"{look_of(description).label}\n{label(description, frame)}", ha="center", va="bottom", fontsize=7,
                    linespacing=1.1)
    if heading:
        for c, shot in enumerate(shots):
            figure.text((c + 0.5) / len(shots), 1 - 0.02 / total, shot.title, ha="center", va="top", fontsize=7.5,
                        fontweight="bold")
    if colour:
        name, norm, colours = render.SCALARS[colour]
        ax = figure.add_axes([0.2, (below - 0.16) / total, 0.6, 0.07 / total])
        bar = figure.colorbar(ScalarMappable(norm, colours), cax=ax, orientation="horizontal", extend="max")
        bar.set_label(name, labelpad=1)
        bar.ax.tick_params(pad=1)
    return figure


def triangles(_, frame):
    return f"{len(frame.triangles)} triangles"


def main(stem, description, shots, label=triangles, kinds=("", "mesh"), notes=lambda results: []):
    """`kinds` of figure: "" is shaded, "mesh" shows the triangles. `notes(results)`: sentences that the caption has,
    too. Returns the arguments."""
    options = arguments(stem, description)
    panels = [read_shot(options.results, shot.scene, shot.time) for shot in shots]
    extra = [" ".join(description.split()), *notes(options.results)]
    if options.colour:
        largest = max(frame.cell[options.colour].max() for column in panels for _, frame in column)
        extra.append(f"Largest {render.SCALARS[options.colour][0]}: {load.number(largest, 2)}.")
    text = caption(stem, shots, panels, extra, options.colour)
    for kind in [options.colour] if options.colour else kinds:
        figure = draw(shots, panels, kind != "", options.colour, text, label)
        style.save(figure, options.results, stem + (f"_{kind}" if options.colour or (kind and len(kinds) > 1) else ""))
    return options
