#!/usr/bin/env python3
"""Reads what `cutbench simulate --frames DIR --every 1` wrote of a scene in which a cut-out falls, with meshio, and
works out anew what the fields say. Prints every disagreement; exit code 1 if there is any.
usage: check_frames.py DIR step alpha gravity time_of_the_cut"""

import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import meshio
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

problems = []


def expect_near(what, actual, expected, tolerance):
    error = np.abs(np.asarray(actual) - np.asarray(expected)).max()
    if not error <= tolerance:
        problems.append(f"{what}: off by {error}, allowed {tolerance}")


def field(mesh, name):
    return mesh.cell_data[name][0].ravel()


def check_fields(name, mesh):
    """Piece, aspect ratio and strain from points, rest and triangles alone."""
    points, rest = mesh.points, mesh.point_data["rest"]
    triangles = mesh.cells_dict["triangle"]
    ends = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    graph = coo_matrix((np.ones(len(ends)), ends.T), shape=(len(points),) * 2)
    label = connected_components(graph, directed=False)[1][triangles[:, 0]]
    first = {}
    expect_near(f"{name}, piece", field(mesh, "piece"), [first.setdefault(p, len(first)) for p in label], 0)

    corners = rest[triangles]
    lengths = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    area = area_of(rest, triangles)
    ratio = lengths.max(axis=1) ** 2 / (2 * area)
    expect_near(f"{name}, aspect ratio", field(mesh, "aspect_ratio") / ratio, 1, 1e-10)

    sides = (points[triangles[:, 1:]] - points[triangles[:, :1]]).transpose(0, 2, 1)
    rest_sides = (corners[:, 1:, :2] - corners[:, :1, :2]).transpose(0, 2, 1)
    stretches = np.linalg.svd(sides @ np.linalg.inv(rest_sides), compute_uv=False)
    expect_near(f"{name}, strain", field(mesh, "strain"), np.abs(stretches - 1).max(axis=1), 1e-7)


def area_of(rest, triangles):
    a, b, c = (rest[triangles[:, i], :2] for i in range(3))
    return ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2


def centre_of_mass(mesh, piece):
    triangles = mesh.cells_dict["triangle"]
    area = area_of(mesh.point_data["rest"], triangles) * (field(mesh, "piece") == piece)
    return (area[:, None] * mesh.points[triangles].mean(axis=1)).sum(axis=0) / area.sum()


def smaller_piece(mesh):
    piece = field(mesh, "piece")
    area = area_of(mesh.point_data["rest"], mesh.cells_dict["triangle"])
    return min(set(piece), key=lambda p: area[piece == p].sum())


def check_fall(frames, step, alpha, gravity):
    """Frames after the cut: v+ = (v - g h) / (1 + alpha h), v being what backward Euler moved by."""
    path = np.array([centre_of_mass(mesh, smaller_piece(mesh)) for _, mesh in frames])
    velocity = np.diff(path, axis=0) / step
    law = (velocity[:-1] + np.array([0, 0, -gravity * step])) / (1 + alpha * step)
    expect_near("velocity of the falling centre of mass", velocity[1:], law, 1e-9)
    if not velocity[-1, 2] < velocity[0, 2] - 0.5 * gravity * step * len(law):
        problems.append("it does not fall")


def check_last(folder, mesh):
    """meshio keeps the `vt` of an OBJ."""
    last = meshio.read(folder / "last.obj")
    expect_near("last.obj, v", last.points, mesh.points, 0)
    expect_near("last.obj, vt", last.point_data["obj:vt"], mesh.point_data["rest"][:, :2], 0)
    expect_near("last.obj, f", last.cells_dict["triangle"], mesh.cells_dict["triangle"], 0)


def main():
    folder = Path(sys.argv[1])
    step, alpha, gravity, cut = map(float, sys.argv[2:])
    entries = list(xml.parse(folder / "frames.pvd").getroot().iter("DataSet"))
    frames = [(float(e.get("timestep")), meshio.read(folder / e.get("file"))) for e in entries]
    expect_near("times", [t for t, _ in frames], step * np.arange(len(frames)), 1e-9)
    for (_, mesh), entry in zip(frames, entries):
        check_fields(entry.get("file"), mesh)
    after = [(t, mesh) for t, mesh in frames if t > cut + 0.5 * step]
    if len(after) < 20 or any(len(set(field(mesh, "piece"))) != 2 for _, mesh in after):
        problems.append(f"{len(after)} frames after the cut, or not in two pieces")
    else:
        check_fall(after, step, alpha, gravity)
    check_last(folder, frames[-1][1])
    print("\n".join(problems[:20]))
    return bool(problems)


if __name__ == "__main__":
    sys.exit(main())
