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


def textured(name, n, islands):
    """A square of n x n cells with a texture, ten times as large; with `islands` the right half's is elsewhere, and turned."""
    grid("plain.obj", n, 1.0)
    lines = pathlib.Path("plain.obj").read_text().splitlines()
    points = np.array([line.split()[1:3] for line in lines if line.startswith("v ")], float)
    out, places = [line for line in lines if line.startswith("v ")], []
    for line in (line for line in lines if line.startswith("f ")):
        corners = [int(v) - 1 for v in line.split()[1:]]
        here = texture_at(points[corners], points[corners].mean(axis=0), islands)
        out.append("f " + " ".join(f"{v + 1}/{len(places) + k + 1}" for k, v in enumerate(corners)))
        places += here.tolist()
    pathlib.Path(name).write_text("\n".join([f"vt {u!r} {v!r}" for u, v in places] + out) + "\n")


def texture_at(points, middle, islands):
    if islands and middle[0] > 0.5:
        return points @ [[0, 7], [-11, 2]] + [40, 3]
    return points @ [[10, 1], [2, 9]] + [0.5, -1]


def corners_of(file):
    """Places and textures of the corners of each triangle, triangles x 3 x 2."""
    lines = [line.split() for line in pathlib.Path(file).read_text().splitlines()]
    points, places = (np.array([line[1:3] for line in lines if line[:1] == [key]], float) for key in ("v", "vt"))
    numbers = np.array([[c.split("/") for c in line[1:]] for line in lines if line[:1] == ["f"]], int) - 1
    return points[numbers[:, :, 0]], places[numbers[:, :, 1]]


def check_texture():
    """After ten cuts, each of the result of the one before, every corner has the texture of its place; and JSON and VTU say the same."""
    rng = np.random.default_rng(3)
    for method, islands in (("conventional_split", True), ("warp_and_refine", False), ("adaptive_remesh", False), ("cut_polygons", True)):
        textured("now.obj", 8, islands)
        for i in range(10):
            start, end = rng.uniform(0.05, 0.95, (2, 2))
            pathlib.Path("one.json").write_text(json.dumps({"cuts": [{"polyline": [start.tolist(), end.tolist()]}]}))
            done = run("cut", "--mesh", "now.obj", "--path", "one.json", "--method", method, "--out", "next.obj", "--parents", "t.json")
            expect(f"texture: {method}, cut {i}: {done.stderr}", done.returncode == 0)
            points, found = corners_of("next.obj")
            middles = points.mean(axis=1)
            right = np.array([texture_at(p, m, islands) for p, m in zip(points, middles)])
            clear = np.abs(middles[:, 0] - 0.5) > 1e-9
            expect(f"texture: {method}, cut {i}: off by {abs(found - right)[clear].max()}", abs(found - right)[clear].max() < 1e-11)
            told = np.array(json.loads(pathlib.Path("t.json").read_text())["texture"])
            expect(f"texture: {method}, cut {i}: JSON says the same", (told == found).all())
            os.replace("next.obj", "now.obj")
        run("cut", "--mesh", "now.obj", "--path", "one.json", "--method", method, "--out", "same.vtu", "--parents", "t.json")
        columns, told = arrays("same.vtu"), np.array(json.loads(pathlib.Path("t.json").read_text())["texture"])
        expect(f"texture: {method}: the VTU says the same", (columns["texture_corners"].reshape(-1, 3, 2) == told).all())
        expect(f"texture: {method}: of vertices where it has no seams", ("texture" in columns) == (not islands))
    run(*CUT, "example", "--out", "cut.obj")
    expect("a sheet without a texture gets none", "texture" not in pathlib.Path("cut.obj").read_text())


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
