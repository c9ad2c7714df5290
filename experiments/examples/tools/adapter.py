"""What the adapters in Python share: the sheet and the path from files, the result to a file, the tool's own time."""

import json
import math
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from split import flattened, read_obj  # noqa: E402


def refuse(reason):
    print(reason, file=sys.stderr, flush=True)
    sys.exit(3)


def area(a, b, c):
    """Twice that of the triangle; positive: counter-clockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def edges_of(triangles):
    """Each edge from vertex to vertex, as its triangle turns."""
    return {(t[k - 1], t[k]) for t in triangles for k in range(3)}


def border_of(triangles):
    edges = edges_of(triangles)
    return [(a, b) for a, b in edges if (b, a) not in edges]


def loops_of(rest, border):
    """Closed chains of border vertices, all counter-clockwise (a hole that turns otherwise is filled), the largest first."""
    following, loops = dict(border), []
    while following:
        loop = [next(iter(following))]
        while (v := following.pop(loop[-1])) != loop[0]:
            if v not in following:
                refuse("the border touches itself in a vertex")
            loop.append(v)
        loops.append(loop)
    size = {id(p): sum(area((0, 0), rest[a], rest[b]) for a, b in zip(p, p[1:] + p[:1])) for p in loops}
    return [p if size[id(p)] > 0 else p[::-1] for p in sorted(loops, key=lambda p: -abs(size[id(p)]))]


def read(mesh, path):
    """Rest positions, triangles, and the path as a polyline without repeated points. The tools would close an older
    incision: its lips lie at one place."""
    rest, triangles = read_obj(mesh)
    used = {v for t in triangles for v in t}
    if len({rest[v] for v in used}) < len(used):
        refuse("this adapter takes no sheet with an older incision")
    lengths = [math.dist(rest[a], rest[b]) for a, b in edges_of(triangles)]
    points = flattened(json.load(open(path))["cuts"][0], 0.03 * sum(lengths) / len(lengths))
    return rest, triangles, [p for i, p in enumerate(points) if i == 0 or p != points[i - 1]]


def write(out, points, triangles):
    """Triangles counter-clockwise; without the vertices that no triangle has."""
    turned = [t if area(*(points[v] for v in t)) > 0 else (t[1], t[0], t[2]) for t in triangles]
    number = {v: i + 1 for i, v in enumerate(sorted({v for t in turned for v in t}))}
    with open(out, "w") as file:
        file.writelines(f"v {float(points[v][0])!r} {float(points[v][1])!r} 0\n" for v in number)
        file.writelines("f %d %d %d\n" % tuple(number[v] for v in t) for t in turned)


class Clock:
    """Processor time of this process since then."""

    def __init__(self):
        self.start = time.process_time()

    def write(self, file):
        seconds = time.process_time() - self.start
        if file:
            Path(file).write_text(json.dumps({"us": 1e6 * seconds}))
