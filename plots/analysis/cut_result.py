"""The files of a cut: the sheet before and after, the path, and what `cutbench cut --parents` says. Needs numpy alone."""

import json

import numpy as np


class Details:
    """What --parents says: edges of the incision; and what a method makes of the triangles."""

    def __init__(self, file):
        told = json.loads(file.read_text(encoding="utf-8"))
        self.incision = [(e["left"] or e["right"])[1:] for e in told["incision"]]
        self.polygons, self.constraints, self.copied = told["polygons"], told["constraints"], told["copies"]


def read_obj(file):
    """Rest points and triangles of an OBJ with `vt`; those are of the opened sheet. At seams a `v` has several `vt`."""
    lines = [line.split() for line in file.read_text(encoding="utf-8").splitlines()]
    rest = np.array([line[1:3] for line in lines if line[:1] == ["vt"]], float)
    triangles = np.array([[int(c.split("/")[1]) - 1 for c in line[1:]] for line in lines if line[:1] == ["f"]])
    return rest, triangles


def aspect_ratio(corners):
    """Longest edge over the height on it."""
    edges = np.roll(corners, -1, axis=1) - corners
    twice = np.abs(edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0])
    return (edges ** 2).sum(axis=2).max(axis=1) / twice


def curve_points(cut):
    """Points of a cut of a path file."""
    points = np.array(cut.get("polyline") or cut["bezier"], float)
    if "polyline" in cut:
        return np.vstack([points, points[:1]]) if cut.get("closed") else points
    t = np.linspace(0, 1, 200)[:, None]
    pieces = [(1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t ** 2 * (1 - t) * c + t ** 3 * d
              for a, b, c, d in zip(points[:-1:3], points[1::3], points[2::3], points[3::3])]
    return np.vstack(pieces)


def outlines(triangles, groups):
    """(edges, 2): those of the groups of triangles that only one triangle of the group has."""
    found = []
    for group in groups:
        edges = {(int(t[k]), int(t[(k + 1) % 3])) for t in triangles[group] for k in range(3)}
        found += [e for e in edges if e[::-1] not in edges]
    return np.array(found, int).reshape(-1, 2)
