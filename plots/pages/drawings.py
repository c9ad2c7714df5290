#!/usr/bin/env python3
"""The drawings of docs/explanation: docs/pictures/phases.svg, the phases of a cut of a small sheet by the program; families.svg, what
families of methods do where a path passes close to a vertex; local_split.svg, why the local split of the paper leaves a smaller copy."""

import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from analysis import load

PROGRAM = load.REPOSITORY / "build/release/cutbench"
PICTURES = load.REPOSITORY / "docs/pictures"
EDGE, PATH, INCISION, SLIVER, MERGED, MARK = "#9aa0a6", "#6db3f2", "#b00020", "#f4b183", "#a9d8b8", "#333333"
PANEL, GAP, HEAD = 150, 14, 20  # pixels


# ---- SVG


def polygon(points, fill="none", stroke=EDGE, width=1.0):
    return f'<polygon points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in points)}" fill="{fill}" stroke="{stroke}" stroke-width="{width}"/>'


def polyline(points, stroke, width):
    return (f'<polyline points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in points)}" fill="none" stroke="{stroke}" '
            f'stroke-width="{width}" stroke-linecap="round" stroke-linejoin="round"/>')


def dot(point, colour=INCISION, radius=3):
    return f'<circle cx="{point[0]:.1f}" cy="{point[1]:.1f}" r="{radius}" fill="{colour}"/>'


def drawing(panels, height):
    """\\param panels  [(title, shapes in pixels of a panel)]"""
    width = len(panels) * (PANEL + GAP) - GAP
    text = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height + HEAD}" width="{width}" font-family="sans-serif" '
            f'font-size="12"><rect width="100%" height="100%" fill="white"/>\n')
    for i, (title, shapes) in enumerate(panels):
        text += f'<g transform="translate({i * (PANEL + GAP)},{HEAD})"><text x="0" y="-7">{title}</text>\n' + "\n".join(shapes) + "</g>\n"
    return text + "</svg>\n"


# ---- phases: what the program makes of a small sheet

COLUMNS, ROWS = 6, 5
BEZIER = [[-0.1, 0.62], [0.35, 0.95], [0.6, 0.1], [0.8, 0.5]]


def to_panel(x, y):
    return x * PANEL, (1 - y) * PANEL


def curve():
    points = []
    for k in range(41):
        t = k / 40
        weights = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3)
        points.append(to_panel(*(sum(w * p[axis] for w, p in zip(weights, BEZIER)) for axis in (0, 1))))
    return points


def write_sheet(path):
    lines = [f"v {i / COLUMNS} {j / ROWS} 0" for j in range(ROWS + 1) for i in range(COLUMNS + 1)]
    for j in range(ROWS):
        for i in range(COLUMNS):
            a = j * (COLUMNS + 1) + i + 1
            b = a + COLUMNS + 1
            lines += [f"f {a} {a + 1} {b + 1}", f"f {a} {b + 1} {b}"]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def read_rest(path):
    """Rest positions and triangles of an OBJ of the program, and the border edges that are inside the sheet: the lips."""
    rest, triangles = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[:1] == ["vt"]:
            rest.append((float(words[1]), float(words[2])))
        elif words[:1] == ["f"]:
            triangles.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    edges = {(t[k], t[(k + 1) % 3]) for t in triangles for k in range(3)}
    inside = {(a, b) for a, b in edges if (b, a) not in edges
              and not any(rest[a][axis] == rest[b][axis] and rest[a][axis] in (0, 1) for axis in (0, 1))}
    return rest, triangles, inside


def cut(method, folder):
    write_sheet(folder / "sheet.obj")
    (folder / "path.json").write_text(json.dumps({"cuts": [{"bezier": BEZIER}]}), encoding="utf-8")
    subprocess.run([PROGRAM, "cut", "--mesh", folder / "sheet.obj", "--path", folder / "path.json", "--method", method,
                    "--out", folder / "cut.obj"], check=True, capture_output=True)
    return read_rest(folder / "cut.obj")


def mesh(rest, triangles):
    """Each edge once, as one path."""
    edges = {tuple(sorted((rest[t[k]], rest[t[(k + 1) % 3]]))) for t in triangles for k in range(3)}
    ends = [(*to_panel(*a), *to_panel(*b)) for a, b in sorted(edges)]
    return [f'<path d="{"".join(f"M{a:.0f} {b:.0f}L{c:.0f} {d:.0f}" for a, b, c, d in ends)}" fill="none" stroke="{EDGE}"/>']


def lips_apart(rest, triangles, inside, by=0.022):
    """Each triangle with its lip vertices drawn back to its own side."""
    normals = {}
    for a, b in inside:
        dx, dy = rest[b][0] - rest[a][0], rest[b][1] - rest[a][1]
        for v in (a, b):
            x, y = normals.get(v, (0, 0))
            normals[v] = (x - dy / math.hypot(dx, dy), y + dx / math.hypot(dx, dy))  # to the left, where the triangle is
    moved = list(rest)
    for v, (x, y) in normals.items():
        if math.hypot(x, y) > 0.5:  # not the tip, whose two normals cancel
            moved[v] = (rest[v][0] + by * x / math.hypot(x, y), rest[v][1] + by * y / math.hypot(x, y))
    return mesh(moved, triangles) + [polyline([to_panel(*moved[a]), to_panel(*moved[b])], INCISION, 2) for a, b in inside]


def phases(folder):
    split, warped = cut("conventional_split", folder), cut("warp_and_refine", folder)
    path = polyline(curve(), PATH, 4)
    write_sheet(folder / "sheet.obj")
    corners = [(i / COLUMNS, j / ROWS) for j in range(ROWS + 1) for i in range(COLUMNS + 1)]
    before = []
    for j in range(ROWS):
        for i in range(COLUMNS):
            a = j * (COLUMNS + 1) + i
            b = a + COLUMNS + 1
            before += [[a, a + 1, b + 1], [a, b + 1, b]]
    grid = mesh(corners, before)
    on_path = {v for edge in split[2] for v in edge}
    dots = [dot(to_panel(*split[0][v])) for v in on_path]

    def closed(result):
        return mesh(*result[:2]) + [polyline([to_panel(*result[0][a]), to_panel(*result[0][b])], INCISION, 2) for a, b in result[2]]
    return [("path", grid + [path]), ("trace", grid + [path] + dots), ("embed", closed(split)), ("improve (some methods)", closed(warped)),
            ("open", lips_apart(*warped))]


# ---- families: a path close to one vertex

CLOSE = 0.2
RING = [(math.cos(math.radians(60 * k)), math.sin(math.radians(60 * k))) for k in range(6)]
ON_RING = 1 - CLOSE / math.tan(math.radians(60))  # where the path meets the ring
ON_EDGE = CLOSE / math.tan(math.radians(60))
P = [(ON_RING, CLOSE), (ON_EDGE, CLOSE), (-ON_EDGE, CLOSE), (-ON_RING, CLOSE)]
CENTRE = (0.0, 0.0)


def place(x, y):
    return PANEL / 2 + x * (PANEL / 2 - 4), PANEL / 2 - y * (PANEL / 2 - 4)


def shapes(triangles, fill="none"):
    return [polygon([place(*p) for p in t], fill) for t in triangles]


def line(points, colour=INCISION, width=2.5):
    return polyline([place(*p) for p in points], colour, width)


ASKED = line([(-1, CLOSE), (1, CLOSE)], PATH, 5)
LOWER = [(CENTRE, RING[k], RING[(k + 1) % 6]) for k in (3, 4, 5)]
UPPER = [(P[0], RING[1], P[1]), (P[1], RING[1], RING[2]), (P[1], RING[2], P[2]), (P[2], RING[2], P[3])]
SIDES = [(CENTRE, RING[0], P[0]), (CENTRE, P[3], RING[3])]
SLIVERS = [(CENTRE, P[0], P[1]), (CENTRE, P[1], P[2]), (CENTRE, P[2], P[3])]


def refined():
    """The same with more vertices, by the circumcircle test of a few points."""
    from scipy.spatial import Delaunay
    points = [*RING, CENTRE] + [(ON_RING * (2 * k / 8 - 1), CLOSE) for k in range(9)] + [
        (0.55 * x, 0.55 * y) for x, y in RING] + [(0.3 * math.cos(a), 0.1 + 0.3 * math.sin(a)) for a in (0.9, 2.24)]
    return [tuple(points[v] for v in t) for t in Delaunay(points).simplices]


def families():
    moved = (0.0, CLOSE)
    around = [(moved, RING[k], RING[(k + 1) % 6]) for k in (1, 3, 4, 5)] + [
        (moved, RING[0], P[0]), (moved, P[0], RING[1]), (moved, RING[2], P[3]), (moved, P[3], RING[3])]
    merged = [[CENTRE, RING[0], P[0], P[1], P[2], P[3], RING[3]]]
    return [("split", [ASKED] + shapes(LOWER + UPPER + SIDES) + shapes(SLIVERS, SLIVER) + [line(P)]),
            ("move the vertex", [ASKED] + shapes(around) + [line([P[0], moved, P[3]]), dot(place(*moved), MARK, 4)]),
            ("move the path", [ASKED] + shapes([(CENTRE, RING[k], RING[(k + 1) % 6]) for k in range(6)])
             + [line([RING[0], CENTRE, RING[3]]), dot(place(*CENTRE), MARK, 4)]),
            ("merge", [ASKED] + shapes(LOWER + UPPER) + shapes(merged, MERGED) + [line(P)]),
            ("refine", [ASKED] + shapes(refined()) + [line([P[0], P[3]])])]


# ---- the local split: a triangle, and the circle that shows its half-size copy to be Delaunay

T = [(-0.95, -0.45), (0.95, -0.45), (0.55, -0.1)]  # its two longest edges meet in the first corner


def middle(a, b):
    return (a[0] + b[0]) / 2, (a[1] + b[1]) / 2


def circle_through(a, b, c):
    """Centre and radius."""
    (bx, by), (cx, cy) = ((p[0] - a[0], p[1] - a[1]) for p in (b, c))
    d = 2 * (bx * cy - by * cx)
    x, y = (cy * (bx * bx + by * by) - by * (cx * cx + cy * cy)) / d, (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) / d
    return (a[0] + x, a[1] + y), math.hypot(x, y)


def local_split():
    a, b, c = T
    p, q = middle(a, b), middle(a, c)
    centre, radius = circle_through(a, p, q)
    (x, y), scale = place(*centre), PANEL / 2 - 4
    circle = f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius * scale:.1f}" fill="none" stroke="{PATH}" stroke-width="1.5"/>'
    names = [f'<text x="{place(*at)[0] + dx:.1f}" y="{place(*at)[1] + dy:.1f}">{name}</text>'
             for name, at, dx, dy in (("a", a, -3, 14), ("p", p, 2, 14), ("q", q, 0, -6), ("b", b, -6, 14), ("c", c, 0, -6))]
    dots = [dot(place(*at), MARK) for at in (a, b, c, p, q)]
    halves = shapes([(p, b, c), (p, c, q)]) + shapes([(a, p, q)], SLIVER)
    return [("a thin triangle", shapes([T], SLIVER) + dots + names[:1] + names[3:]), ("after one round", [circle, *halves, *dots, *names])]


def main():
    with tempfile.TemporaryDirectory() as folder:
        load.write_page(PICTURES / "phases.svg", drawing(phases(Path(folder)), PANEL))
    load.write_page(PICTURES / "families.svg", drawing(families(), PANEL))
    load.write_page(PICTURES / "local_split.svg", drawing(local_split(), PANEL))


if __name__ == "__main__":
    main()
