#!/usr/bin/env python3
"""VTK: vtkClipPolyData by the signed distance from the path, closed far outside. Its two outputs share no vertex: they
are the opened sheet. usage: vtk_clip.py mesh.obj path.json out.obj [time.json]      needs python3-vtk9"""

import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkClipPolyData, vtkTriangleFilter

import adapter


def odd_side(points, ring):
    """Which points lie within the closed polyline: those whose ray crosses it an odd number of times."""
    odd = np.zeros(len(points), bool)
    for a, b in zip(ring, ring[1:]):
        crosses = (a[1] > points[:, 1]) != (b[1] > points[:, 1])
        odd ^= crosses & ((adapter.area(a, b, points.T) > 0) == (b[1] > a[1]))
    return odd


def closed(line, rest, border):
    """The path, its ends joined by an arc far outside. A level set has no end: a path that has one in the sheet is refused."""
    if line[0] == line[-1]:
        return line
    ways = np.array([(rest[a], rest[b]) for a, b in border])
    inside = [sum(odd_side(np.array([end]), way)[0] for way in ways) % 2 for end in (line[0], line[-1])]
    if any(inside):
        adapter.refuse("a level set has no end in the sheet")
    middle = np.mean(rest, axis=0)
    radius = 3 * max(np.hypot(*(np.array([*rest, *line]) - middle).T))
    start, end = (np.arctan2(*(np.array(p) - middle)[::-1]) for p in (line[-1], line[0]))
    arc = [tuple(middle + radius * np.array([np.cos(a), np.sin(a)])) for a in np.linspace(start, end, 17)]
    return [*line, *arc, line[0]]


def signed_distance(rest, ring):
    points, distance = np.array(rest), np.full(len(rest), np.inf)
    for a, b in zip(np.array(ring), np.array(ring[1:])):
        along = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        distance = np.minimum(distance, np.hypot(*(points - a - along[:, None] * (b - a)).T))
    return np.where(odd_side(points, ring), distance, -distance)


def poly_data(rest, triangles, values):
    points, cells, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(np.array([(x, y, 0.0) for x, y in rest]), deep=True))
    cells.SetCells(len(triangles), numpy_to_vtkIdTypeArray(np.array([(3, *t) for t in triangles]).ravel(), deep=True))
    data.SetPoints(points)
    data.SetPolys(cells)
    data.GetPointData().SetScalars(numpy_to_vtk(values, deep=True))
    return data


def clip(data):
    """Points and triangles of both sides."""
    clipper, points, triangles = vtkClipPolyData(), [], []
    clipper.SetInputData(data)
    clipper.GenerateClippedOutputOn()
    clipper.SetOutputPointsPrecision(1)  # double
    clipper.Update()
    for side in (clipper.GetOutput(), clipper.GetClippedOutput()):
        divided = vtkTriangleFilter()
        divided.SetInputData(side)
        divided.PassLinesOff()
        divided.PassVertsOff()
        divided.Update()
        made = divided.GetOutput()
        if made.GetNumberOfPolys():
            corners = vtk_to_numpy(made.GetPolys().GetConnectivityArray()).reshape(-1, 3)
            triangles += [tuple(t) for t in corners + len(points)]
            points += [tuple(p[:2]) for p in vtk_to_numpy(made.GetPoints().GetData())]
    return points, triangles


def main(mesh, path, out, time=None):
    rest, triangles, line = adapter.read(mesh, path)
    values = signed_distance(rest, closed(line, rest, adapter.border_of(triangles)))
    clock = adapter.Clock()
    points, made = clip(poly_data(rest, triangles, values))
    clock.write(time)
    adapter.write(out, points, made)


main(*sys.argv[1:])
