#!/usr/bin/env python3
"""gmsh: its border fragmented by the path (OpenCASCADE), meshed at the sheet's own sizes, opened by its plugin Crack.
usage: gmsh_crack.py mesh.obj path.json out.obj [time.json]      needs python3-gmsh"""

import math
import sys

import gmsh
from gmsh import model

import adapter

OPTIONS = {"General.Terminal": 0, "General.NumThreads": 1, "Mesh.Algorithm": 6, "Mesh.MeshSizeExtendFromBoundary": 0,
           "Mesh.MeshSizeFromPoints": 0}


def surface(rest, triangles):
    loops = []
    for loop in adapter.loops_of(rest, adapter.border_of(triangles)):
        points = [model.occ.addPoint(*rest[v], 0) for v in loop]
        loops.append(model.occ.addCurveLoop([model.occ.addLine(a, b) for a, b in zip(points, points[1:] + points[:1])]))
    return model.occ.addPlaneSurface(loops)


def fragment(face, line):
    """The parts of the surface, the curves of their border, and those of the path within."""
    closed = line[0] == line[-1]
    points = [model.occ.addPoint(*p, 0) for p in line[:len(line) - closed]]
    pieces = [(1, model.occ.addLine(a, b)) for a, b in zip(points, points[1:] + points[:1] * closed)]
    _, became = model.occ.fragment([(2, face)], pieces)
    model.occ.synchronize()
    faces = [tag for dimension, tag in became[0] if dimension == 2]
    border = {abs(tag) for _, tag in model.getBoundary([(2, f) for f in faces], combined=True, oriented=False)}
    rest = {tag for _, tag in model.getEntities(1)} - border
    embedded = {tag for f in faces for dimension, tag in model.mesh.getEmbedded(2, f) if dimension == 1}
    inner = sorted(c for c in rest if c in embedded or len(model.getAdjacencies(1, c)[0]))
    if not inner:
        adapter.refuse("nothing of the path lies in the sheet")
    model.removeEntities([(1, c) for c in rest - set(inner)])
    return faces, border, inner


def keep_sizes(rest, triangles, border, inner):
    """Elements as large as the sheet's; the border is not divided; a slit of one edge is: it could not open."""
    around = {}
    for a, b in adapter.edges_of(triangles):
        around.setdefault(a, []).append(math.dist(rest[a], rest[b]))
    corners = [[rest[v] for v in t] + [sum(around[v]) / len(around[v]) for v in t] for t in triangles]
    view = gmsh.view.add("size")
    gmsh.view.addListData(view, "ST", len(triangles), [x for a, b, c, *sizes in corners for x in (
        a[0], b[0], c[0], a[1], b[1], c[1], 0, 0, 0, *sizes)])
    field = model.mesh.field.add("PostView")
    model.mesh.field.setNumber(field, "ViewIndex", 0)
    model.mesh.field.setAsBackgroundMesh(field)
    for curve, nodes in [(c, 2) for c in border] + [(c, 3) for c in inner if len(inner) == 1]:
        model.mesh.setTransfiniteCurve(curve, nodes)


def crack(border, inner):
    def ends(curves):
        return {tag for c in curves for _, tag in model.getBoundary([(1, c)], oriented=False)}
    gmsh.plugin.setNumber("Crack", "Dimension", 1)
    gmsh.plugin.setNumber("Crack", "PhysicalGroup", model.addPhysicalGroup(1, inner))
    if open_ends := ends(inner) & ends(border):
        gmsh.plugin.setNumber("Crack", "OpenBoundaryPhysicalGroup", model.addPhysicalGroup(0, sorted(open_ends)))
    gmsh.plugin.run("Crack")


def main(mesh, path, out, time=None):
    rest, triangles, line = adapter.read(mesh, path)
    clock = adapter.Clock()
    gmsh.initialize()
    for name, value in OPTIONS.items():
        gmsh.option.setNumber(name, value)
    faces, border, inner = fragment(surface(rest, triangles), line)
    keep_sizes(rest, triangles, border, inner)
    model.mesh.generate(2)
    model.addPhysicalGroup(2, faces)
    crack(border, inner)
    clock.write(time)
    tags, places, _ = model.mesh.getNodes()
    points = {int(tag): tuple(places[3 * i:3 * i + 2]) for i, tag in enumerate(tags)}
    made = [int(v) for f in faces for v in model.mesh.getElementsByType(2, f)[1]]
    adapter.write(out, points, [tuple(made[i:i + 3]) for i in range(0, len(made), 3)])


main(*sys.argv[1:])
