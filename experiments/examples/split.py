#!/usr/bin/env python3
"""Cuts a sheet along a path: every crossed edge gets a vertex, which divides the triangles beside it; edges on the path
are opened. The plainest method there is, as a program of its own: copy it, and change what it does.
usage: split.py mesh.obj path.json out.obj"""

import json
import math
import sys

NEAR = 1e-10  # rest units: nearer than this, a vertex lies on the path


def read_obj(name):
    """Rest positions (`vt`, or those of a flat mesh) and triangles."""
    rows = {"v": [], "vt": [], "f": []}
    for words in (line.split() for line in open(name)):
        if words and words[0] in rows:
            rows[words[0]].append(words[1:])
    rest = [(float(x), float(y)) for x, y, *_ in rows["vt"] or rows["v"]]
    return rest, [tuple(int(corner.split("/")[0]) - 1 for corner in face) for face in rows["f"]]


def flattened(cut, tolerance):
    """The path as a polyline: each cubic Bezier in as many equal steps as Wang's formula asks for, or 3."""
    points = [tuple(p) for p in cut.get("polyline") or cut["bezier"]]
    if "polyline" in cut:
        return points + points[:1] * cut.get("closed", False)
    line = points[:1]
    for a, b, c, d in (points[i:i + 4] for i in range(0, len(points) - 1, 3)):
        bend = max(math.hypot(p[0] - 2 * q[0] + r[0], p[1] - 2 * q[1] + r[1]) for p, q, r in ((a, b, c), (b, c, d)))
        steps = max(3, math.ceil(math.sqrt(0.75 * bend / tolerance)))
        for t, s in ((i / steps, 1 - i / steps) for i in range(1, steps + 1)):
            line.append(tuple(s**3 * a[k] + 3 * s * s * t * b[k] + 3 * s * t * t * c[k] + t**3 * d[k] for k in (0, 1)))
    return line


def beside(a, b, p):
    """How far p lies to the left of the line from a to b; 0 where it is near."""
    distance = ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / math.dist(a, b)
    return distance if abs(distance) > NEAR else 0


class Sheet:
    def __init__(self, rest, triangles):
        self.rest, self.triangles, self.path = rest, set(), set()
        self.left_of = {}  # the triangle on the left of each edge, from vertex to vertex
        self.replace(None, triangles)

    def replace(self, old, new):
        self.triangles.discard(old)
        self.triangles.update(new)
        self.left_of.update({(t[k - 1], t[k]): t for t in new for k in range(3)})

    def divide_edge(self, a, b, p):
        self.rest.append(p)
        v = len(self.rest) - 1
        for tail, head in ((a, b), (b, a)):
            if triangle := self.left_of.pop((tail, head), None):
                apex, = set(triangle) - {a, b}
                self.replace(triangle, [(tail, v, apex), (v, head, apex)])
        if (a, b) in self.path:
            self.path |= {(a, v), (v, a), (b, v), (v, b)}

    def insert(self, p):
        """Makes p a vertex, where it lies in the sheet; on each lip where it lies on an older incision."""
        for t in list(self.triangles):
            sides = [beside(self.rest[t[k - 1]], self.rest[t[k]], p) for k in range(3)]
            on = [(t[k - 1], t[k]) for k in range(3) if sides[k] == 0]
            if min(sides) > 0:
                self.rest.append(p)
                self.replace(t, [(t[k - 1], t[k], len(self.rest) - 1) for k in range(3)])
            elif min(sides) == 0 and len(on) == 1 and t in self.triangles:
                self.divide_edge(*on[0], p)

    def embed(self, p, q):
        """Divides the edges that the straight piece from p to q crosses, and puts the edges along it on the path."""
        self.insert(p), self.insert(q)
        side = [beside(p, q, r) for r in self.rest]
        for a, b in [(a, b) for a, b in self.left_of if side[a] * side[b] < 0]:
            (ra, sa), (rb, sb) = sorted((self.rest[v], side[v]) for v in (a, b))  # both lips get the very same place
            if (a, b) in self.left_of and beside(ra, rb, p) * beside(ra, rb, q) < 0:
                self.divide_edge(a, b, tuple(x + sa / (sa - sb) * (y - x) for x, y in zip(ra, rb)))
        middle, reach = [(x + y) / 2 for x, y in zip(p, q)], math.dist(p, q) / 2 + NEAR
        on = {v for v, r in enumerate(self.rest) if math.dist(r, middle) <= reach and beside(p, q, r) == 0}
        self.path |= {way for a, b in self.left_of if a in on and b in on for way in ((a, b), (b, a))}

    def divide_lone_edges(self):
        """A slit of one edge, whose ends could not part, gets a vertex in its middle."""
        starts = [a for a, _ in self.path]
        for a, b in [e for e in self.path if e[0] < e[1] and {e, e[::-1]} <= self.left_of.keys()]:
            if starts.count(a) == starts.count(b) == 1:
                self.divide_edge(a, b, tuple((x + y) / 2 for x, y in zip(self.rest[a], self.rest[b])))

    def opened(self):
        """The triangles, when every fan of them between edges of the path has a vertex of its own."""
        number = {}
        for v in sorted({v for edge in self.path for v in edge}):
            star, mine = sorted(t for t in self.triangles if v in t), v
            while star:
                fan = [star.pop()]
                for t in fan:  # which grows
                    number[t, v] = mine
                    for a, b in zip(t, t[1:] + t[:1]):
                        if (a, b) not in self.path and (other := self.left_of.get((b, a))) in star:
                            star.remove(other), fan.append(other)
                mine = len(self.rest)
                self.rest += [self.rest[v]] if star else []
        return [[number.get((t, v), v) + 1 for v in t] for t in sorted(self.triangles)]


def main(mesh, path, out):
    sheet = Sheet(*read_obj(mesh))
    edges = [math.dist(sheet.rest[a], sheet.rest[b]) for a, b in sheet.left_of]
    for cut in json.load(open(path))["cuts"]:
        line = flattened(cut, 0.03 * sum(edges) / len(edges))
        for p, q in zip(line, line[1:]):
            if p != q:
                sheet.embed(p, q)
    sheet.divide_lone_edges()
    triangles = sheet.opened()
    with open(out, "w") as file:  # flat: rest positions; where the vertices are in space, cutbench finds out
        file.writelines(f"v {x!r} {y!r} 0\n" for x, y in sheet.rest)
        file.writelines("f %d %d %d\n" % tuple(t) for t in triangles)


if __name__ == "__main__":
    main(*sys.argv[1:])
