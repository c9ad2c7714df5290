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

    def carry(self, values, of=None):
        """Data of the vertices before, as weighted means at the vertices after (n x ...).

        Args:
            values: a row for each vertex of the sheet before, or for each row of the arrays that it was made of.
            of: "sheet" or "arrays", which of the two; only asked for where both have the same number of rows in another order.
        """
        values = np.asarray(values)
        if values.dtype.kind not in "biufc" or values.ndim == 0:
            raise InputError(f"values: has the type {values.dtype} and the shape {values.shape}; give a row for each vertex")
        if of not in (None, "sheet", "arrays"):
            raise InputError(f'of: "{of}" is not known; known are sheet, arrays')
        vertices, rows, given = len(self._before.vertices), self._before._rows, self._before.given
        if of is None:
            of = "arrays" if len(values) == rows else "sheet"
            if rows == vertices and not np.array_equal(given, np.arange(vertices)):
                raise InputError(f'values: are the {len(values)} rows of the sheet before, or of the arrays that it was made of? '
                                 'Say of="sheet" or of="arrays"')
        if of == "arrays" and rows is None:
            raise InputError('of: the sheet before was not made of arrays; say of="sheet"')
        wanted = rows if of == "arrays" else vertices
        if len(values) != wanted:
            raise InputError(f"values: {len(values)} rows; give one for each of the {wanted} vertices before")
        if of == "arrays":
            values = values[given]
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
