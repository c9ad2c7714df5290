#!/usr/bin/env python3
"""Carries data of a sheet through a cut: `cutbench cut ... --parents parents.json`. Each file has a line for each vertex or
triangle, in the order of the sheet's file."""
import json
import numpy as np

parents = json.load(open("parents.json"))
temperature = np.loadtxt("vertices.txt")
np.savetxt("new_vertices.txt", [sum(w * temperature[v] for v, w in parts) for parts in parents["vertices"]], "%.17g")
np.savetxt("new_triangles.txt", np.loadtxt("triangles.txt")[parents["triangles"]], "%.17g")
for edge in parents["incision"]:  # on each lip: triangle, from, to; None where a method took the triangles out
    print("cut", edge["cut"], "left", edge["left"], "right", edge["right"])
