"""The same cut by every method. Runs the program that experiments/reproduce builds."""

import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from analysis import cut_result, load, naming

PROGRAM = load.REPOSITORY / "build/release/cutbench"
SQUARES = 20
CURVE = [[0.0, 0.36], [0.3, 0.62], [0.55, 0.28], [0.72, 0.55]]  # from the border to a tip inside


def sheet_points():
    n = SQUARES
    return np.array([(i / n, j / n) for j in range(n + 1) for i in range(n + 1)])


def write_grid(path):
    n = SQUARES
    corner = lambda i, j: j * (n + 1) + i + 1
    triangles = [t for j in range(n) for i in range(n) for t in (
        (corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)), (corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)))]
    path.write_text("".join(f"v {x!r} {y!r} 0\n" for x, y in sheet_points().tolist()) + "".join("f %d %d %d\n" % t for t in triangles),
                    encoding="utf-8")


def requested():
    """Points of the requested path."""
    return cut_result.curve_points({"bezier": CURVE})


def run(*arguments):
    try:
        done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)
    except OSError as error:
        load.stop(f"{PROGRAM} can't be run: {error.strerror}; experiments/reproduce builds it")
    return done


def cut_by(method, folder):
    """Rest points, triangles, the program's report and details; None where the method failed or refused the cut."""
    out, report, parents = (folder / f"{method}.{end}" for end in ("obj", "json", "parents.json"))
    run("cut", "--mesh", str(folder / "sheet.obj"), "--path", str(folder / "path.json"), "--method", method,
        "--out", str(out), "--report", str(report), "--parents", str(parents))
    if not report.is_file():
        return None
    return *cut_result.read_obj(out), json.loads(report.read_text(encoding="utf-8")), cut_result.Details(parents)


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
    return naming.words(method["name"]) + parameter
