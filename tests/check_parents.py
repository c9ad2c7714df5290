#!/usr/bin/env python3
"""What `cutbench cut --parents` says, checked by every method on random cuts, by an oracle that shares no code with it:
attributes carried over by the parents are those interpolated in the old sheet to 1e-12, on each lip its own; in old
triangles thinner than 2e-3, to what the rounding of a place makes of them. The old sheet has lips
itself. In half of the cases ten cuts are made at once, in the other half one after the other, each in the result of the one
before. And the example that the documents show is run.
usage: tests/check_parents.py PROGRAM [--cases N] [--squares N] [--methods A,B] [--seed N]
  exit code 1 and a line for each fault; a line for each method says how many cuts were made, and the largest errors"""

import argparse
import collections
import json
import math
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

import numpy as np

CUTS, TOLERANCE = 10, 1e-12
PLAIN = {"cisamr"}  # cuts structured grids alone, which have no incision yet
ROUNDED = 4 * 2.0 ** -52  # what is nearer to an edge of the unit sheet lies on it
FLAT = 1e-12  # the sine of a new triangle's angle: its sides are one line to rounding
root = pathlib.Path(__file__).resolve().parents[1]
faults = []


class Mesh:
    """An opened sheet of an OBJ with `vt`, or of a flat one."""

    def __init__(self, file):
        lines = [line.split() for line in file.read_text().splitlines()]
        points = [line[1:3] for line in lines if line[:1] == ["vt"]] or [line[1:3] for line in lines if line[:1] == ["v"]]
        self.rest = np.array(points, float)
        self.triangles = np.array([[int(c.split("/")[0]) - 1 for c in line[1:]] for line in lines if line[:1] == ["f"]])

    def border(self):
        """Directed edges with one triangle alone, and the number of that."""
        edges = {(t[k], t[(k + 1) % 3]): n for n, t in enumerate(self.triangles.tolist()) for k in range(3)}
        return {e: n for e, n in edges.items() if e[::-1] not in edges}


def write_sheet(file, n, most, rng):
    """A grid whose inner vertices are moved by at most so many squares, so that no coordinate is a round number."""
    shift = lambda i, j: rng.uniform(-most, most) / n if 0 < i < n and 0 < j < n else 0
    points = [(i / n + shift(i, j), j / n + shift(i, j)) for j in range(n + 1) for i in range(n + 1)]
    corner = lambda i, j: j * (n + 1) + i + 1
    squares = [(i, j) for j in range(n) for i in range(n)]
    triangles = [t for i, j in squares for t in ((corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)),
                                                 (corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)))]
    file.write_text("".join(f"v {x!r} {y!r} 0\n" for x, y in points) + "".join("f %d %d %d\n" % t for t in triangles))


def random_cut(rng):
    """From side to side, from a side to a tip, or between two tips: a polyline or a Bezier."""
    start, along = rng.uniform(0, 2 * math.pi), rng.uniform(0.35, 1.5)
    middle = [rng.uniform(0.3, 0.7), rng.uniform(0.3, 0.7)]
    at = lambda s, side: [middle[0] + s * along * math.cos(start) - side * math.sin(start),
                          middle[1] + s * along * math.sin(start) + side * math.cos(start)]
    bent = [at(-0.5, 0), at(-0.2, rng.uniform(-0.2, 0.2)), at(0.2, rng.uniform(-0.2, 0.2)), at(0.5, 0)]
    return {rng.choice(["bezier", "polyline"]): bent}


def run(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)


def cross(u, v):
    return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]


class OldSheet:
    """Interpolates values of the vertices of a sheet, each on its own side of an incision."""

    def __init__(self, mesh):
        self.mesh = mesh
        self.corners = mesh.rest[mesh.triangles]
        self.twice = cross(self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0])
        sides = np.roll(self.corners, -1, axis=1) - self.corners
        self.lengths = np.linalg.norm(sides, axis=2)[:, [1, 2, 0]]  # of the side opposite each corner
        self.per_cell = max(1, int(np.sqrt(len(self.corners) / 2)))  # cells along a side of the unit sheet
        self.cells = collections.defaultdict(list)  # the triangles that may be in each
        low, high = self.cell(self.corners.min(axis=1) - 1e-9), self.cell(self.corners.max(axis=1) + 1e-9)
        for t, ((x0, y0), (x1, y1)) in enumerate(zip(low.tolist(), high.tolist())):
            for x in range(x0, x1 + 1):
                for y in range(y0, y1 + 1):
                    self.cells[x, y].append(t)

    def cell(self, points):
        return np.floor(points * self.per_cell).astype(int)

    def distances(self, triangles, p):
        """Per triangle of these, of p from the side opposite each corner, above zero inside."""
        c = self.corners[triangles]
        areas = np.stack([cross(c[:, (k + 1) % 3] - p, c[:, (k + 2) % 3] - p) for k in range(3)], axis=1)
        return areas / self.lengths[triangles]

    def near(self, p):
        """All triangles that p is in or on."""
        here = np.array(self.cells[tuple(self.cell(p).tolist())] or range(len(self.corners)))
        return here[self.distances(here, p).min(axis=1) >= -ROUNDED]

    def triangle(self, p, inside):
        """The triangle that p is in or on, seen from `inside`, a point of a new triangle at p."""
        here = np.array(self.cells[tuple(self.cell(p).tolist())] or range(len(self.corners)))
        depth = self.distances(here, p).min(axis=1)
        near = here[depth >= -ROUNDED]
        if len(near) <= 1:
            return here[depth.argmax()]
        for part in (1e-3, 1e-5, 1e-7):
            q = p + part * (inside - p)
            depth = (self.distances(near, q) * self.lengths[near] / self.twice[near, None]).min(axis=1)
            if depth.max() > 0:
                break
        return near[depth.argmax()]

    def values(self, triangles, points, attribute):
        """(points, 4): at each point by the three corners of its triangle; and where it is off a side by a rounding, at the place on
        that side, too."""
        corner = self.mesh.triangles[triangles]
        c, p, value = (x.astype(np.longdouble) for x in (self.corners[triangles], points, attribute[corner]))
        side = [(c[:, (k + 1) % 3], c[:, (k + 2) % 3]) for k in range(3)]
        area = np.stack([cross(a - p, b - p) for a, b in side], axis=1)
        found = np.full((len(points), 4), np.nan)
        found[:, 3] = (area * value).sum(axis=1) / area.sum(axis=1)
        for k, (a, b) in enumerate(side):
            s = ((p - a) * (b - a)).sum(axis=1) / ((b - a) ** 2).sum(axis=1)
            on_side = self.sides(triangles, points)[:, k] <= ROUNDED
            found[on_side, k] = ((1 - s) * value[:, (k + 1) % 3] + s * value[:, (k + 2) % 3])[on_side]
        return found

    def sides(self, triangles, points):
        """(points, 3): how far each is from the lines through the sides of its triangle."""
        c = self.corners[triangles]
        return np.stack([abs(cross(c[:, (k + 1) % 3] - points, c[:, (k + 2) % 3] - points)) for k in range(3)], axis=1) / self.lengths[triangles]


def widest_corners(mesh):
    """Per vertex, the centroid of the triangle that is widest there, and the sine of its angle."""
    c = mesh.rest[mesh.triangles]
    best = {}
    for k in range(3):
        u, v = c[:, (k + 1) % 3] - c[:, k], c[:, (k + 2) % 3] - c[:, k]
        sine = cross(u, v) / np.linalg.norm(u, axis=1) / np.linalg.norm(v, axis=1)
        for t, vertex in enumerate(mesh.triangles[:, k].tolist()):
            if vertex not in best or sine[t] > best[vertex][0]:
                best[vertex] = sine[t], c[t].mean(axis=0)
    return {vertex: centre for vertex, (_, centre) in best.items()}, {vertex: sine for vertex, (sine, _) in best.items()}


def curve_points(cut):
    if "polyline" in cut:
        return np.array(cut["polyline"] + cut["polyline"][:1] * cut.get("closed", False))
    t, p = np.linspace(0, 1, 401)[:, None], np.array(cut["bezier"])
    return np.concatenate([(1 - t) ** 3 * p[i] + 3 * t * (1 - t) ** 2 * p[i + 1] + 3 * t ** 2 * (1 - t) * p[i + 2] + t ** 3 * p[i + 3]
                           for i in range(0, len(p) - 1, 3)])


def off_pieces(p, a, b):
    """How far p is from each piece."""
    s = (((p - a) * (b - a)).sum(axis=1) / np.maximum(((b - a) ** 2).sum(axis=1), 1e-300)).clip(0, 1)
    return np.linalg.norm(a + s[:, None] * (b - a) - p, axis=1)


class Check:
    """One method's results."""

    def __init__(self, method, rng):
        self.method, self.rng = method, rng
        self.count = collections.Counter()
        self.largest = collections.defaultdict(float)
        self.case = ""

    def fault(self, text):
        faults.append(f"{self.method['name']}, {self.case}: {text}")

    def note(self, what, value):
        self.largest[what] = max(self.largest[what], float(value))

    def vertices(self, old, new, parents):
        if len(parents["vertices"]) != len(new.rest):
            return self.fault("not one entry for each vertex")
        attribute = np.array([self.rng.uniform(0, 1) for _ in old.mesh.rest])
        beside, sine = widest_corners(new)
        carried = np.array([sum(w * attribute[o] for o, w in parts) for parts in parents["vertices"]])
        place = np.array([sum(w * old.mesh.rest[o] for o, w in parts) for parts in parents["vertices"]])
        count = np.array([len(parts) for parts in parents["vertices"]])
        in_triangle = np.array([old.triangle(p, beside[v]) for v, p in enumerate(new.rest)])
        error = np.nanmin(abs(carried[:, None] - old.values(in_triangle, new.rest, attribute)), axis=1)
        for v in (v for v in range(len(new.rest)) if sine[v] < FLAT):  # nothing tells on which lip it is: on one of those there
            near = old.near(new.rest[v])
            values = old.values(near, np.repeat(new.rest[v][None], len(near), axis=0), attribute)
            error[v] = np.nanmin(np.append(abs(carried[v] - values), error[v]))
            self.count["flat"] += 1
        rounded = ROUNDED / 2 * abs(old.corners[in_triangle]).max(axis=(1, 2))
        off_corner = np.linalg.norm(old.corners[in_triangle] - new.rest[:, None], axis=2).min(axis=1)
        on_side = (old.sides(in_triangle, new.rest).min(axis=1) <= rounded) & (off_corner > 1e-13)  # nearer, sides of several triangles are
        most = np.where(off_corner <= rounded, 1, np.where(on_side, 2, 3))
        self.note("sum", max(abs(sum(w for _, w in parts) - 1) for parts in parents["vertices"]))
        self.note("place", abs(place - new.rest).max())
        altitude = old.twice[in_triangle] / old.lengths[in_triangle].max(axis=1)
        allowed = np.maximum(TOLERANCE, 2 * ROUNDED / altitude)  # in a thin triangle the rounding of the place itself says more
        self.note("error", error[allowed == TOLERANCE].max())
        self.note("in thin ones", error.max())
        self.count["thin"] += int((allowed > TOLERANCE).sum())
        for v in np.flatnonzero(~(error <= allowed)):
            self.fault(f"vertex {v} at {new.rest[v]} of {parents['vertices'][v]} is off by {error[v]}")
        for v in np.flatnonzero(count > most):
            self.fault(f"vertex {v} at {new.rest[v]} is of {parents['vertices'][v]}, not of {most[v]} at most")
        for n in (1, 2, 3):
            self.count[f"of {n}"] += int((count == n).sum())
        self.count["renumbered"] += sum(len(parts) == 1 and parts[0][0] != v for v, parts in enumerate(parents["vertices"][:len(old.mesh.rest)]))

    def triangles(self, old, new, parents):
        centres = new.rest[new.triangles].mean(axis=1)
        if len(parents["triangles"]) != len(centres):
            return self.fault("not one entry for each triangle")
        c = old.corners[parents["triangles"]]
        depth = np.min([cross(c[:, (k + 1) % 3] - centres, c[:, (k + 2) % 3] - centres) for k in range(3)], axis=0)
        for t in np.flatnonzero(depth < -1e-15):
            self.fault(f"triangle {t} is not in {parents['triangles'][t]}")

    def incision(self, old, new, parents, cuts, step):
        """Every border edge that is not on the old border is on one lip, once, of the cut whose curve it lies on."""
        lips, curves = {}, [curve_points(cut) for cut in cuts]
        for edge in parents["incision"]:
            left, right = edge["left"], edge["right"]
            if left and right and (new.rest[left[1:]] != new.rest[right[1:]]).any():
                self.fault(f"the lips of {edge} are not at one place")
            for lip in ([left[0], left[1], left[2]] if left else None, [right[0], right[2], right[1]] if right else None):
                if lip is None:
                    continue
                if tuple(lip[1:]) in lips:
                    self.fault(f"edge {lip} is listed twice")
                lips[tuple(lip[1:])] = lip[0]
            points = curves[edge["cut"]]
            ends = new.rest[(left or right)[1:]]
            if "exact_incision" in self.method["promises"]:
                off = [off_pieces(p, points[:-1], points[1:]) for p in ends]
                self.note("off curve", max(o.min() for o in off) / step)
                along = np.diff(points, axis=0)[(off[0] + off[1]).argmin()]
                if along @ (ends[1] - ends[0]) < 0:
                    self.fault(f"{edge} does not run along its path")
        border = new.border()
        old_border = np.array([[old.mesh.rest[a], old.mesh.rest[b]] for a, b in old.mesh.border()])
        whole = {edge.tobytes() for edge in old_border}
        for (a, b), t in border.items():
            places = [new.rest[a], new.rest[b], (new.rest[a] + new.rest[b]) / 2]
            on_old = new.rest[[a, b]].tobytes() in whole or all(off_pieces(p, old_border[:, 0], old_border[:, 1]).min() < 1e-11 for p in places)
            if on_old == ((a, b) in lips):
                self.fault(f"border edge {a} {b} is {'' if on_old else 'not '}old, but {'' if on_old else 'not '}on a lip")
            elif (a, b) in lips and lips[a, b] != t:
                self.fault(f"edge {a} {b} is of triangle {t}, not {lips[a, b]}")
        for e in lips.keys() - border.keys():
            self.fault(f"{e} is on a lip, but not on the border")

    def constraints(self, new, parents):
        """The masters of a constrained vertex reproduce its place; no triangle is in two polygons."""
        place = np.concatenate([new.rest, [self.old_rest[o] for o in parents["copies"]]]) if parents["copies"] else new.rest
        for vertex, masters in parents["constraints"]:
            self.note("master sum", abs(sum(w for _, w in masters) - 1))
            error = abs(sum(w * place[m] for m, w in masters) - place[vertex]).max()
            self.note("master place", error)
            self.count["constraints"] += 1
        members = [t for polygon in parents["polygons"] for t in polygon]
        self.count["polygons"] += len(parents["polygons"])
        if len(members) != len(set(members)):
            self.fault("a triangle is in two polygons")

    def results(self, sheet, result, parents, cuts, step):
        old, new = OldSheet(Mesh(sheet)), Mesh(result)
        self.old_rest = old.mesh.rest
        parents = json.loads(parents.read_text())
        self.vertices(old, new, parents)
        self.triangles(old, new, parents)
        self.incision(old, new, parents, cuts, step)
        self.constraints(new, parents)

    def line(self):
        parts = [f"{self.count[f'of {n}']} of {n}" for n in (1, 2, 3)]
        return (f"{self.method['name']:20} {self.count['cuts']:5} cuts, {self.count['refused']} refused, {self.count['failed']} failed; "
                f"vertices {', '.join(parts)}, {self.count['thin']} in thin old triangles, {self.count['flat']} in flat new ones, {self.count['renumbered']} renumbered; {self.count['polygons']} polygons, "
                f"{self.count['constraints']} constraints; " +
                ", ".join(f"{what} {value:.1e}" for what, value in sorted(self.largest.items())))


def check_method(program, method, options, folder):
    check = Check(method, random.Random(options.seed))
    for case in range(options.cases):
        rng = random.Random(f"{options.seed} {case}")
        check.case = f"case {case}"
        sheet, path, result, parents = (folder / name for name in ("sheet.obj", "path.json", "result.obj", "parents.json"))
        plain = method["name"] in PLAIN
        write_sheet(folder / "flat.obj", options.squares, 0 if plain else 0.3, rng)
        path.write_text(json.dumps({"cuts": [random_cut(rng), random_cut(rng)]}))
        run(program, "cut", "--mesh", folder / "flat.obj", "--path", path, "--method", "conventional_split", "--allow-miss", "--out", sheet)
        cuts = [random_cut(rng) for _ in range(CUTS)]
        for group in ([cuts] if case % 2 == 0 and not plain else [[c] for c in cuts]):
            if plain:
                shutil.copy(folder / "flat.obj", sheet)
            while group:
                path.write_text(json.dumps({"cuts": group}))
                done = run(program, "cut", "--mesh", sheet, "--path", path, "--method", method["name"], "--allow-miss",
                           "--out", result, "--parents", parents)
                if done.returncode == 0:
                    break
                check.count["refused" if done.returncode == 2 else "failed"] += 1
                group = group[:-1]
            if not group:
                continue
            check.count["cuts"] += len(group)
            check.results(sheet, result, parents, group, 1 / options.squares)
            os.replace(result, sheet)
    print(check.line(), flush=True)
    return check


def check_example(program, folder):
    """The ten lines that docs/how-to/take_a_cut_home.md shows."""
    example = root / "experiments/examples/carry_over.py"
    shown = (root / "docs/how-to/take_a_cut_home.md").read_text()
    code = example.read_text().partition('"""\n')[2].strip("\n")
    if "".join(f"    {line}".rstrip() + "\n" for line in code.splitlines()) not in shown:
        faults.append(f"docs/how-to/take_a_cut_home.md does not show {example.name} as it is")
    sheet = root / "experiments/examples/sheet.obj"
    done = run(program, "cut", "--mesh", sheet, "--path", root / "experiments/examples/path.json", "--method",
               "warp_and_refine", "--out", folder / "cut.obj", "--parents", folder / "parents.json")
    old, new = Mesh(sheet), Mesh(folder / "cut.obj")
    np.savetxt(folder / "vertices.txt", old.rest @ [2, 3] + 1, "%.17g")
    np.savetxt(folder / "triangles.txt", np.arange(len(old.triangles)))
    done = subprocess.run([sys.executable, example], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0 or "cut 0 left [" not in done.stdout:
        return faults.append(f"{example.name}: {done.stderr.strip()} {done.stdout[:80]}")
    if abs(np.loadtxt(folder / "new_vertices.txt") - (new.rest @ [2, 3] + 1)).max() > TOLERANCE:
        faults.append(f"{example.name} carries vertices over wrongly")
    if len(np.loadtxt(folder / "new_triangles.txt")) != len(new.triangles):
        faults.append(f"{example.name} carries triangles over wrongly")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--cases", type=int, default=2, help="of ten cuts, by each method")
    parser.add_argument("--squares", type=int, default=4, help="along a side of the sheet")
    parser.add_argument("--methods", help="only these")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    methods = json.loads(run(options.program, "methods", "--json").stdout)
    with tempfile.TemporaryDirectory() as folder:
        for method in methods:
            if not options.methods or method["name"] in options.methods.split(","):
                check_method(options.program, method, options, pathlib.Path(folder))
        check_example(options.program, pathlib.Path(folder))
    print("\n".join(faults[:40]), end="\n" if faults else "")
    sys.exit(bool(faults))


main()
