#!/usr/bin/env python3
"""The same cut by every method, a detail near its tip. Runs the program that experiments/reproduce builds."""

import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LogNorm

from common import load, style

STEM = "method_comparison"
PROGRAM = load.REPOSITORY / "build/release/cutbench"
SQUARES = 20
CURVE = [[0.0, 0.36], [0.3, 0.62], [0.55, 0.28], [0.72, 0.55]]  # from the border to a tip inside
WINDOW = (0.36, 0.76, 0.32, 0.58)
COLOURS = "YlOrBr"


def write_grid(path):
    n = SQUARES
    points = [(i / n, j / n) for j in range(n + 1) for i in range(n + 1)]
    corner = lambda i, j: j * (n + 1) + i + 1
    triangles = [t for j in range(n) for i in range(n) for t in (
        (corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)), (corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)))]
    path.write_text("".join(f"v {x!r} {y!r} 0\n" for x, y in points) + "".join("f %d %d %d\n" % t for t in triangles),
                    encoding="utf-8")


def read_result(path):
    """Rest points and triangles of an OBJ with vt; those are of the opened sheet."""
    points, triangles = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        kind, *rest = line.split()
        if kind == "vt":
            points.append([float(x) for x in rest[:2]])
        elif kind == "f":
            triangles.append([int(corner.split("/")[1]) - 1 for corner in rest])
    return np.array(points), np.array(triangles)


def requested():
    """Points of the requested path."""
    t = np.linspace(0, 1, 200)[:, None]
    a, b, c, d = np.array(CURVE)
    return (1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t ** 2 * (1 - t) * c + t ** 3 * d


def incision(points, triangles):
    """Border edges that lie on another one."""
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    half = {tuple(e) for e in edges.tolist()}
    border = [points[list(e)] for e in half if e[::-1] not in half]
    places = {tuple(e.ravel()) for e in border}
    return [e for e in border if tuple(e[::-1].ravel()) in places]


def aspect_ratio(corners):
    edges = np.roll(corners, -1, axis=1) - corners
    twice = np.abs(edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0])
    return (edges ** 2).sum(axis=2).max(axis=1) / twice


def run(*arguments):
    try:
        done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)
    except OSError as error:
        load.stop(f"{PROGRAM} can't be run: {error.strerror}; experiments/reproduce builds it")
    return done


def cut_by(method, folder):
    """Rest points, triangles and the program's report; None where the method failed or refused the cut."""
    out, report = folder / f"{method}.obj", folder / f"{method}.json"
    run("cut", "--mesh", str(folder / "sheet.obj"), "--path", str(folder / "path.json"), "--method", method,
        "--out", str(out), "--report", str(report))
    if not report.is_file():
        return None
    return *read_result(out), json.loads(report.read_text(encoding="utf-8"))


def all_methods():
    """What the program says of its methods: names, parameters, promises."""
    return json.loads(run("methods", "--json").stdout)


def cut_by_all(methods):
    """cut_by() of each."""
    with tempfile.TemporaryDirectory() as scratch:
        scratch = Path(scratch)
        write_grid(scratch / "sheet.obj")
        (scratch / "path.json").write_text(json.dumps({"cuts": [{"bezier": CURVE}]}), encoding="utf-8")
        return [cut_by(m["name"], scratch) for m in methods]


def title(method):
    """Its name, and its parameter's default."""
    parameter = f" {method['parameter']['default']:g}" if method["parameter"] else ""
    return method["name"].replace("_", " ") + parameter


def draw_method(ax, title, result, norm):
    ax.set_xlim(WINDOW[:2])
    ax.set_ylim(WINDOW[2:])
    ax.set_aspect("equal")
    ax.set_xticks([])
    ax.set_yticks([])
    ax.grid(False)
    ax.spines[:].set_visible(True)
    ax.set_title(title, pad=2, fontsize=6.2)
    if result is None:
        ax.text(0.5, 0.5, "failed", transform=ax.transAxes, ha="center")
        return None
    points, triangles, report = result
    corners = points[triangles]
    faces = PolyCollection(corners, array=aspect_ratio(corners), cmap=COLOURS, norm=norm, edgecolor="#555555",
                           linewidth=0.25)
    ax.add_collection(faces)
    ax.plot(*requested().T, color="#0072b2", linewidth=2.2, alpha=0.45, zorder=2, solid_capstyle="butt")
    ax.add_collection(LineCollection(incision(points, triangles), color="#b0001e", linewidth=0.7, zorder=3))
    ratio = report["ar_max_cut"]
    shapes = f"AR ≤ {load.number(ratio, 2)}" if ratio else "none changed"
    ax.set_xlabel(f"{shapes}, {report['vertices_added']:+d} vertices", fontsize=5.6, labelpad=2)
    return faces


def draw(folder, only=None):
    """Writes folder/method_gallery.png and .pdf. \\param only  names, those of other methods are left out; None: all"""
    methods = [m for m in all_methods() if only is None or m["name"] in only]
    if not methods:
        return
    left_out = sorted(set(only or ()) - {m["name"] for m in methods})
    results = cut_by_all(methods)
    columns = 3
    figure, axes = style.panels(-(-len(methods) // columns), columns, 2.75)
    norm = LogNorm(1.2, 60)
    faces = None
    for i, ax in enumerate(axes.flat):
        ax.set_visible(i < len(methods))
        if i < len(methods):
            faces = draw_method(ax, title(methods[i]), results[i], norm) or faces
    if faces is not None:
        bar = figure.colorbar(faces, ax=list(axes.flat), orientation="horizontal", aspect=50, pad=0.02, extend="max")
        bar.set_label("aspect ratio")
        bar.set_ticks([2, 3, 5, 10, 20, 50], labels=["2", "3", "5", "10", "20", "50"])
        bar.ax.minorticks_off()
    which = "every method" if only is None else "every method of the run"
    missing = f"Not drawn, as `cutbench methods` does not have them: {', '.join(left_out)}. " if left_out else ""
    style.finish(figure, [], f"The same cut by {which}, at rest, near the tip of the cut. Each parameter (the number beside "
                 f"the name) has its default. The sheet is the paper's grid of {2 * SQUARES ** 2} triangles; the chord "
                 "tolerance is 0.05 h. Blue: requested path. Red: incision. AR: largest aspect ratio of the triangles that "
                 f"the cut made or changed. {missing}Constrained vertices are not marked. {style.AR_DEFINITION} "
                 "Command: plots/method_gallery.py")
    style.save(figure, folder, "method_gallery")


if __name__ == "__main__":
    target = load.results_folder(STEM, __doc__)
    target.mkdir(parents=True, exist_ok=True)
    draw(target)
