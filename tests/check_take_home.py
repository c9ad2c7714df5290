#!/usr/bin/env python3
"""What a user takes home of a cut and of a simulation: pictures, animations, columns of a VTU, numbers of the sheet's own file;
and scenes in other units. usage: tests/check_take_home.py PROGRAM      exit code 1 and a line for each fault"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

import numpy as np
from PIL import Image

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
examples = pathlib.Path(__file__).resolve().parents[1] / "experiments/examples"
CUT = ["cut", "--mesh", "sheet.obj", "--path", "path.json", "--method"]
SCENE = """effect = "e"
truth = "none"
duration = 0.05
[sheet]
file = "{file}"
{scale}
[physics]
gravity = [0.0, 0.0, -9.81]
[[pins]]
box = [[-inf, -inf], [0.0, inf]]
[integrator]
step = 0.01
[[cuts]]
time = 0.02
{cut}
"""
faults = []


def expect(what, right):
    if not right:
        faults.append(what)


def run(*arguments, **environment):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, env={**os.environ, **environment})


def grid(name, n, size):
    points = [(size * i / n, size * j / n) for j in range(n + 1) for i in range(n + 1)]
    corner = lambda i, j: j * (n + 1) + i + 1
    squares = [(i, j) for j in range(n) for i in range(n)]
    pathlib.Path(name).write_text("".join(f"v {x!r} {y!r} 0\n" for x, y in points) + "".join(
        f"f {corner(i, j)} {corner(i + 1, j)} {corner(i + 1, j + 1)}\nf {corner(i, j)} {corner(i + 1, j + 1)} {corner(i, j + 1)}\n"
        for i, j in squares))


def arrays(file):
    return {a.get("Name"): np.array(a.text.split(), float).reshape(-1, int(a.get("NumberOfComponents")))
            for a in xml.parse(file).getroot().iter("DataArray")}


def check_pictures():
    done = run(*CUT, "cut_polygons", "--out", "cut.obj", "--picture", "cut.png")
    expect(f"a picture is drawn: {done.stderr}", done.returncode == 0 and min(Image.open("cut.png").size) > 400)
    done = run(*CUT, "phantom_node", "--out", "cut.obj", "--picture", "cut.svg")
    expect(f"an SVG is drawn: {done.stderr}", done.returncode == 0 and "copied vertices" in pathlib.Path("cut.svg").read_text())
    done = run("simulate", "m.toml", "--animation", "run.webp")
    expect(f"an animation is drawn: {done.stderr}", done.returncode == 0 and Image.open("run.webp").n_frames >= 2)
    for option, command in (("--picture new.png", [*CUT, "example", "--out", "new.obj"]), ("--animation new.webp", ["simulate", "m.toml"])):
        done = run(*command, *option.split(), CUTBENCH_PYTHON="/bin/false")
        told = done.stderr.splitlines()
        expect(f"{option} says that Python is missing: {told}", done.returncode == 2 and len(told) == 1 and "python3-matplotlib" in told[0])
    done = run(*CUT, "example", "--out", "new.obj", "--picture", "new.jpg")
    expect("a format that is not known is refused", done.returncode == 2 and ".png" in done.stderr)
    done = run(*CUT, "example", "--out", "new.obj", "--picture", "path.json")
    expect("a picture takes no place of what was read", done.returncode == 2)
    expect("nothing is left of what was refused", not list(pathlib.Path().glob("new.*")))


def check_columns():
    """A VTU says what the JSON says."""
    for method, name in (("cut_polygons", "polygon"), ("phantom_node", "copies"), ("split_and_tie", "masters")):
        run(*CUT, method, "--out", "cut.vtu", "--parents", "parents.json")
        columns, told = arrays("cut.vtu"), json.loads(pathlib.Path("parents.json").read_text())
        expect(f"{method}: {name} is there", name in columns)
        parts = [[[int(v), w] for v, w in zip(*row) if v >= 0] for row in zip(columns["parents"], columns["parent_weights"])]
        expect(f"{method}: parents", parts == told["vertices"])
        expect(f"{method}: copies", columns.get("copies", np.zeros((0, 1)))[:, 0].tolist() == told["copies"])
        expect(f"{method}: parent", columns["parent"][:, 0].tolist() == told["triangles"])
        lips = {(side, edge["cut"], edge[side][0]) for edge in told["incision"] for side in ("left", "right")}
        found = {("left" if lip > 0 else "right", abs(int(lip)) - 1, t) for t, row in enumerate(columns["lips"]) for lip in row if lip}
        expect(f"{method}: lips", lips == found)
    polygons = arrays("cut.vtu").get("polygon")
    expect("no polygons where there are none", polygons is None)
    run(*CUT, "cut_polygons", "--out", "cut.vtu", "--parents", "parents.json")
    polygons = arrays("cut.vtu")["polygon"][:, 0]
    for p, members in enumerate(json.loads(pathlib.Path("parents.json").read_text())["polygons"]):
        expect(f"polygon {p}", np.flatnonzero(polygons == p).tolist() == sorted(members))


def check_numbers():
    """Of a file with vertices that no triangle has, parents are numbers of the file."""
    lines = (examples / "sheet.obj").read_text().splitlines()
    moved = ["v 9 9 0"] + [line for line in lines if line.startswith("v ")]
    moved += ["f " + " ".join(str(int(v) + 1) for v in line.split()[1:]) for line in lines if line.startswith("f ")]
    pathlib.Path("moved.obj").write_text("\n".join(moved) + "\n")
    for mesh in ("sheet.obj", "moved.obj"):
        run("cut", "--mesh", mesh, "--path", "path.json", "--method", "example", "--out", "cut.obj", "--parents", f"{mesh}.json")
    plain, shifted = (json.loads(pathlib.Path(f"{mesh}.json").read_text()) for mesh in ("sheet.obj", "moved.obj"))
    expect("numbers are those of the file", [[[v + 1, w] for v, w in parts] for parts in plain["vertices"]] == shifted["vertices"])


def check_units():
    one, other = (run("simulate", f"{unit}.toml", "--out", f"end_{unit}.obj") for unit in ("m", "mm"))
    expect(f"a scene in mm runs: {other.stderr}", other.returncode == 0 and not other.stderr)
    for done in (one, other):
        expect(f"the first line says what is simulated: {done.stdout[:90]}",
               done.stdout.startswith("sheet: 72 triangles, 0.3 x 0.3 m, h = 0.05621 m, 0.09 kg; step 0.01 s, "))
    ends = [np.array([line.split()[1:] for line in pathlib.Path(f"end_{unit}.obj").read_text().splitlines() if line.startswith("v ")], float)
            for unit in ("m", "mm")]
    expect("a scene in mm is the scene in m", ends[0].shape == ends[1].shape and abs(ends[0] - ends[1]).max() < 1e-9)
    told = run("simulate", "wrong.toml").stderr
    expect(f"a sheet of 300 m is noticed: {told}", "300 m long" in told and "scale" in told)
    done = run("simulate", "both.toml")
    expect(f"a cut from a file has no curve beside: {done.stderr}", done.returncode == 2 and "polyline" in done.stderr)


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for name in ("sheet.obj", "path.json"):
        pathlib.Path(name).write_bytes((examples / name).read_bytes())
    grid("m.obj", 6, 0.3)
    grid("mm.obj", 6, 300)
    pathlib.Path("cut.json").write_text('{"cuts": [{"polyline": [[100, -10], [130, 170]]}, {"polyline": [[200, 310], [210, 180]]}]}')
    lines = "polyline = [[0.1, -0.01], [0.13, 0.17]]\n[[cuts]]\ntime = 0.02\npolyline = [[0.2, 0.31], [0.21, 0.18]]"
    for name, values in (("m", {"file": "m.obj", "scale": "", "cut": lines}),
                         ("mm", {"file": "mm.obj", "scale": "scale = 0.001", "cut": 'path = "cut.json"'}),
                         ("wrong", {"file": "mm.obj", "scale": "", "cut": 'path = "cut.json"'}),
                         ("both", {"file": "m.obj", "scale": "", "cut": lines + '\npath = "cut.json"'})):
        pathlib.Path(f"{name}.toml").write_text(SCENE.format(**values))
    for check in (check_pictures, check_columns, check_numbers, check_units):
        check()
print("\n".join(faults), end="\n" if faults else "")
sys.exit(bool(faults))
