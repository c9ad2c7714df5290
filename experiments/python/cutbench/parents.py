"""What a cut says beside its sheet: what each vertex was before, and which follow others."""

import numpy as np

from .errors import InputError


class Parents:
    """What the vertices and triangles of a cut sheet were before.

    Attributes:
        first: n + 1 ints; vertex i is a weighted mean of entries first[i] to first[i + 1] - 1 of
        vertices: vertices of the sheet before, with
        weights: floats, of sum 1 for each vertex.
        triangles: m ints: the triangle before in which each triangle's centroid lies.
    """

    def __init__(self, before, first, vertices, weights, triangles):
        self._before = before
        self.first, self.vertices, self.weights, self.triangles = first, vertices, weights, triangles

    def carry(self, values):
        """Data of the vertices before, as weighted means at the vertices after (n x ...).

        Args:
            values: a row for each vertex of the sheet before, or for each row of the arrays that it was made of.
        """
        values = np.asarray(values)
        if values.dtype.kind not in "biufc" or values.ndim == 0:
            raise InputError(f"values: has the type {values.dtype} and the shape {values.shape}; give a row for each vertex")
        vertices, rows = len(self._before.vertices), self._before._rows
        if len(values) == rows:
            values = values[self._before.given]
        elif len(values) != vertices:
            raise InputError(f"values: {len(values)} rows; give one for each of the {vertices} vertices before")
        shape = (-1,) + (1,) * (values.ndim - 1)
        return np.add.reduceat(values[self.vertices] * self.weights.reshape(shape), self.first[:-1], axis=0)


class Constraints:
    """What a method says of a cut sheet beside its triangles: vertices that follow others, and polygons.

    Attributes:
        vertices: t ints: vertices that are no unknowns, but follow
        masters: t x 3 ints, three other vertices each, with
        weights: t x 3 floats, of sum 1. -1 with weight 0: no master.
        phantoms: masters from n to n + phantoms - 1 are phantom nodes: copies of nodes that are no vertices of the sheet
            (phantom_node).
        polygons: a list of arrays: the corners of each element that is made of several triangles, and
        polygon_triangles: these triangles.
    """

    def __init__(self, vertices, masters, weights, phantoms, polygons, polygon_triangles):
        self.vertices, self.masters, self.weights, self.phantoms = vertices, masters, weights, phantoms
        self.polygons, self.polygon_triangles = polygons, polygon_triangles
