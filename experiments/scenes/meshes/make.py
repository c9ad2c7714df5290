#!/usr/bin/env python3
"""The sheets of three scenes: a shirt of two panels sewn together, a sleeve, a patch of curved skin. Made here, since no
such file that we know may be copied freely; each is like those that cloth and surgery programs come with.
usage: experiments/scenes/meshes/make.py    writes shirt.obj, sleeve.obj and skin.obj beside itself"""

import math
import pathlib

folder = pathlib.Path(__file__).parent


def number(x):
    return f"{x:.6g}"


def write(name, text, points, places, triangles):
    """`places`: texture coordinates of corners, or none; triangles of (v) or of (v, vt), from 0."""
    lines = [f"# {line}" for line in text]
    lines += ["v " + " ".join(map(number, p)) for p in points]
    lines += ["vt " + " ".join(map(number, p)) for p in places]
    for corners in triangles:
        lines.append("f " + " ".join(f"{v + 1}/{t + 1}" if places else f"{v + 1}" for v, t in corners))
    (folder / name).write_text("\n".join(lines) + "\n")


def cells(columns, rows):
    """Two triangles for each cell, their diagonals turned from cell to cell."""
    for j in range(rows):
        for i in range(columns):
            a, b, c, d = (i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)
            for triangle in ((a, b, c), (a, c, d)) if (i + j) % 2 == 0 else ((a, b, d), (b, c, d)):
                yield (i, j), triangle


def shirt(cell=0.05):
    """Body 0.4 x 0.6 m, sleeves 0.2 x 0.15 m, in each panel; sewn along sides, sleeves and shoulders. It hangs along -z,
    its front towards -y, and is filled out a little, as if it were worn."""
    columns, rows = 16, 12

    def is_cloth(i, j):
        body = 4 <= i < 12
        sleeve = 8 <= j < 11
        neck = 6 <= i < 10 and j >= 11
        return (body or sleeve) and not neck

    def is_open(p, q):
        """Hem, cuffs and neck: edges that are not sewn."""
        cuff = p[0] == q[0] and p[0] in (0, columns)
        hem = p[1] == q[1] == 0
        neck = min(p[1], q[1]) >= 11 and 6 <= min(p[0], q[0]) and max(p[0], q[0]) <= 10
        return cuff or hem or neck

    kept = [t for at, t in cells(columns, rows) if is_cloth(*at)]
    uses = {}
    for triangle in kept:
        for k in range(3):
            edge = frozenset((triangle[k], triangle[(k + 1) % 3]))
            uses[edge] = uses.get(edge, 0) + 1
    sewn = {p for edge, count in uses.items() if count == 1 and not is_open(*edge) for p in edge}

    def depth(p):
        """Of the front; 0 where it is sewn to the back."""
        away = min((math.hypot(p[0] - q[0], p[1] - q[1]) for q in sewn), default=0)
        return 0.03 * (1 - (1 - min(away / 4, 1)) ** 2)

    points, places, number_of, triangles = [], [], {}, []
    for side in (1, -1):
        for triangle in kept:
            corners = []
            for p in triangle if side == 1 else triangle[::-1]:
                own = (p, 0 if p in sewn else side)
                if own not in number_of:
                    number_of[own] = len(points)
                    points.append((cell * p[0], -side * depth(p), cell * p[1]))
                place = (cell * p[0], cell * p[1]) if side == 1 else (1.8 - cell * p[0], cell * p[1])
                if place not in places:
                    places.append(place)
                corners.append((number_of[own], places.index(place)))
            triangles.append(corners)
    write("shirt.obj", ["vt: rest positions", "a shirt of two panels, m"], points, places, triangles)


def sleeve(around=18, along=16):
    points = []
    for j in range(along + 1):
        radius = 0.07 - 0.02 * j / along
        for i in range(around):
            angle = -2 * math.pi * i / around
            points.append((radius * math.cos(angle), radius * math.sin(angle), -0.4 * j / along))
    triangles = [[((j * around + i % around),) * 2 for i, j in t] for _, t in cells(around, along)]
    write("sleeve.obj", ["a sleeve, m: its rest shape is the mesh itself"], points, [], triangles)


def skin(n=16, size=0.1, radius=0.25):
    points = []
    for j in range(n + 1):
        for i in range(n + 1):
            x, y = size * (i / n - 0.5), size * (j / n - 0.5)
            points.append((x, y, math.sqrt(radius**2 - x**2 - y**2) - radius))
    triangles = [[((j * (n + 1) + i),) * 2 for i, j in t] for _, t in cells(n, n)]
    write("skin.obj", ["a patch of a ball of 0.25 m, m: its rest shape is the mesh itself"], points, [], triangles)


if __name__ == "__main__":
    shirt()
    sleeve()
    skin()
