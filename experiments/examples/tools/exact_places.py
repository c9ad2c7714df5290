"""For tools of single precision: vertices get back the places of the sheet, of the path, and of their crossings."""

from itertools import product

import adapter

NEAR = 2e-6  # rest units, in a sheet of the size 1 and more


def crossing(a, b, p, q):
    """Where the edge ab and the piece pq of the path cross; [] where they do not."""
    s, t = adapter.area(p, q, a), adapter.area(p, q, b)
    if s * t > 0 or s == t or adapter.area(a, b, p) * adapter.area(a, b, q) > 0:
        return []
    return [tuple(x + s / (s - t) * (y - x) for x, y in zip(a, b))]


def overlap(a, b, p, q):
    """Whether their boxes do."""
    return all(min(p[k], q[k]) <= max(a[k], b[k]) and max(p[k], q[k]) >= min(a[k], b[k]) for k in (0, 1))


def places(rest, triangles, line):
    pieces = list(zip(line, line[1:]))
    edges = {tuple(sorted((rest[a], rest[b]))) for a, b in adapter.edges_of(triangles)}
    pairs = [(*edge, *piece) for edge in edges for piece in pieces if overlap(*edge, *piece)]
    pairs += [(*one, *other) for i, one in enumerate(pieces) for other in pieces[i + 2:]]
    return [*rest, *line, *(place for pair in pairs for place in crossing(*pair))]


def exact_places(found, rest, triangles, line):
    """Of each place found the nearest exact one, where one is near."""
    near = NEAR * max(1, *(abs(x) for p in rest for x in p))
    cells = {}
    for p in places(rest, triangles, line):
        cells.setdefault((round(p[0] / near), round(p[1] / near)), []).append(p)

    def exact(p):
        i, j = round(p[0] / near), round(p[1] / near)
        beside = [q for k, m in product((-1, 0, 1), repeat=2) for q in cells.get((i + k, j + m), ())]
        return min(beside, key=lambda q: (q[0] - p[0])**2 + (q[1] - p[1])**2, default=p)

    return [exact(p) for p in found]
