"""The same cut by every method. Runs the program that experiments/reproduce builds."""

import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from analysis import load

PROGRAM = load.REPOSITORY / "build/release/cutbench"
SQUARES = 20
CURVE = [[0.0, 0.36], [0.3, 0.62], [0.55, 0.28], [0.72, 0.55]]  # from the border to a tip inside


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
