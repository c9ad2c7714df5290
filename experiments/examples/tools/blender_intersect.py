"""Blender: Edit mode, Face > Intersect (Knife), of the sheet with a ribbon through the path; the sides are parted.
usage: blender --background --factory-startup --python blender_intersect.py -- mesh.obj path.json out.obj [time.json]"""

import os
import sys

import bmesh
import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import adapter  # noqa: E402
from exact_places import exact_places  # noqa: E402

MERGE = 1e-6  # nearer vertices become one; Blender's coordinates have single precision


def object_of(rest, triangles, line):
    closed = line[0] == line[-1]
    corners = line[:len(line) - closed]
    low = [len(rest) + 2 * i for i in range(len(corners))]
    ribbon = [(a, b, b + 1, a + 1) for a, b in zip(low, low[1:] + low[:1] * closed)]
    mesh = bpy.data.meshes.new("sheet")
    mesh.from_pydata([(x, y, 0) for x, y in rest] + [(x, y, z) for x, y in corners for z in (-1, 1)], [],
                     [*triangles, *ribbon])
    made = bpy.data.objects.new("sheet", mesh)
    bpy.context.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    made.select_set(True)
    return mesh


def intersect(mesh, of_sheet):
    """The edited mesh without the ribbon. \\param of_sheet  how many of its faces are the sheet's, the first"""
    bpy.ops.object.mode_set(mode="EDIT")
    edited = bmesh.from_edit_mesh(mesh)
    layer = edited.faces.layers.int.new("ribbon")
    for number, face in enumerate(edited.faces):
        face[layer] = number >= of_sheet
        face.select_set(number >= of_sheet)
    bmesh.update_edit_mesh(mesh)
    bpy.ops.mesh.intersect(mode="SELECT_UNSELECT", separate_mode="ALL", threshold=MERGE, solver="FAST")
    edited = bmesh.from_edit_mesh(mesh)
    layer = edited.faces.layers.int["ribbon"]
    bmesh.ops.delete(edited, geom=[face for face in edited.faces if face[layer]], context="FACES")
    bmesh.ops.triangulate(edited, faces=edited.faces[:])
    edited.verts.index_update()
    return edited


def main(mesh, path, out, time=None):
    rest, triangles, line = adapter.read(mesh, path)
    clock = adapter.Clock()
    edited = intersect(object_of(rest, triangles, line), len(triangles))
    clock.write(time)
    found = [tuple(vertex.co)[:2] for vertex in edited.verts]
    made = [tuple(vertex.index for vertex in face.verts) for face in edited.faces]
    adapter.write(out, exact_places(found, rest, triangles, line), made)


status = 0
try:
    main(*sys.argv[sys.argv.index("--") + 1:])
except SystemExit as refused:
    status = refused.code
except BaseException as error:
    print(f"{type(error).__name__}: {error}", file=sys.stderr)
    status = 1
sys.stderr.flush()
os._exit(status)  # Blender would end with 0
