"""Sheets, and their cuts."""

import json
import os
import sys
import warnings
from functools import cached_property

import numpy as np

from . import _core, arrays
from .errors import InputError, as_keywords
from .method import method_of
from .parents import Constraints, Parents
from .paths import curves_of

REST_WORDS = ("auto", "plane", "space")  # those of --rest that arrays without texture coordinates have


def warn(text):
    """Of the line that called this package."""
    level, frame = 1, sys._getframe()
    while frame is not None and frame.f_globals.get("__name__", "").partition(".")[0] == __package__:
        level, frame = level + 1, frame.f_back
    warnings.warn(as_keywords(text), stacklevel=level)


def _rest(rest, vertices):
    rest = arrays.points(rest, "rest", (2, 3))
    if len(rest) != len(vertices):
        raise InputError(f"rest: {len(rest)} rows; give as many as there are vertices, {len(vertices)}")
    return rest


def _divided(vertices, triangles, rest):
    """A vertex for each place at rest of each vertex: the first keeps its number, others come after all.

    Returns vertices, triangles, rest (n x 2), and for each vertex the number of the one it is sewn to."""
    rest = np.asarray(rest, dtype=np.float64)
    if rest.shape != (len(triangles), 3, 2):
        raise InputError(f"rest: has the shape {' x '.join(map(str, rest.shape))}; a position per corner is "
                         f"{len(triangles)} x 3 x 2")
    if not np.isfinite(rest).all():
        raise InputError("rest: has a number that is not finite; correct it")
    arrays.check_indices(triangles, "triangles", len(vertices))
    corners = np.column_stack([triangles.reshape(-1), rest.reshape(-1, 2)])
    places, first, which = np.unique(corners, axis=0, return_index=True, return_inverse=True)
    sewn = places[:, 0].astype(np.int32)
    order = np.argsort(first, kind="stable")  # as the triangles meet them
    number = np.empty(len(places), np.int32)
    own = {}
    for i in order:
        number[i] = sewn[i] if own.setdefault(sewn[i], i) == i else -1
    number[order[number[order] < 0]] = len(vertices) + np.arange(np.count_nonzero(number < 0))
    count = len(vertices) + len(places) - len(own)
    all_vertices = np.empty((count, vertices.shape[1]))
    all_rest = np.zeros((count, 2))
    all_sewn = np.arange(count, dtype=np.int32)
    all_vertices[:len(vertices)] = vertices
    all_vertices[number], all_rest[number], all_sewn[number] = vertices[sewn], places[:, 1:], sewn
    return all_vertices, number[which.reshape(-1, 3)], all_rest, all_sewn


def _texture(texture, positions, corners, sheet):
    """Coordinates of each corner, m x 3 x 2, in the order in which `sheet` has the corners of its triangles: reading turns some
    of `corners` round."""
    texture = np.asarray(texture, dtype=np.float64)
    if texture.ndim == 2:
        texture = arrays.points(texture, "texture", (2,))
        if len(texture) != len(positions):
            raise InputError(f"texture: {len(texture)} rows; give as many as there are vertices, {len(positions)}")
        texture = texture[corners]
    if texture.shape != (len(corners), 3, 2):
        raise InputError(f"texture: has the shape {' x '.join(map(str, texture.shape))}; give {len(positions)} x 2, or "
                         f"{len(corners)} x 3 x 2 for each corner")
    if not np.isfinite(texture).all():
        raise InputError("texture: has a number that is not finite; correct it")
    second = sheet.vertices[sheet.triangles[:, 1]][:, :positions.shape[1]]
    off = np.linalg.norm(positions[corners] - second[:, None], axis=2)
    order = np.where((off[:, 2] < off[:, 1])[:, None], [0, 2, 1], [0, 1, 2])
    return np.take_along_axis(texture, order[:, :, None], axis=1)


class Sheet:
    """A triangle sheet, as it is at rest in the plane and as it is in space. It never changes; cut() makes another one.

    Args:
        vertices: n x 3 or n x 2 (then z = 0), positions in space.
        triangles: m x 3, vertices from 0, in either order round the triangle.
        rest: n x 2, positions at rest; or n x 3, in a plane; or m x 3 x 2, one for each corner: where a vertex has
            several, the sheet is sewn along a seam. Or "plane": the plane that `vertices` lie in; "space": the sheet is at
            rest as it lies in space, unrolled; "auto": the first of these that can be. Two borders at equal rest positions
            are an incision.
        texture: texture coordinates that cuts carry over: n x 2, or m x 3 x 2 for each corner where the texture has seams.

    Positions have any unit; what is said in h is in mean rest edges. What had to be repaired (triangles reversed,
    unused vertices dropped, ...) is a warning.

    Attributes (read-only arrays that share the sheet's memory):
        vertices: n x 3 floats, positions in space.
        rest: n x 2 floats, positions at rest; the two lips of an incision have equal ones.
        triangles: m x 3 ints, counter-clockwise at rest.
        sewn: for each vertex the number of one that is the same point of the sheet, though apart at rest; empty without
            seams. A copy.
        texture: m x 3 x 2 floats, texture coordinates at the triangles' corners; None without.
    """

    def __init__(self, vertices, triangles, rest="auto", texture=None):
        given = positions = arrays.of_points(vertices, "vertices", (2, 3))
        if given.shape[1] == 2 and isinstance(rest, str) and rest == "auto":
            rest = "plane"
        given_corners = corners = arrays.of_indices(triangles, "triangles")
        word, flat, sewn = "auto", None, None
        if isinstance(rest, str):
            word = rest
            if word not in REST_WORDS:
                raise InputError(f'rest: "{rest}" is not known; known are {", ".join(REST_WORDS)}, or an array n x 2, '
                                 "n x 3 or m x 3 x 2")
        elif np.ndim(rest) == 3:
            positions, corners, flat, sewn = _divided(positions, corners, rest)
        else:
            flat = _rest(rest, positions)
        try:
            self._core = _core.sheet(positions, corners, flat, sewn, word)
        except InputError as error:
            raise _in_better_words(error, positions, corners) from None
        self._of_row = sewn
        self._rows = len(given)
        if texture is not None:
            own = _texture(texture, given, given_corners, self)
            self._core.take_texture(np.ascontiguousarray(own.reshape(-1, 6)))
        self._warn()

    def _warn(self):
        for note in self._core.notes:
            warn(note)

    @classmethod
    def _of(cls, core, rows=None):
        sheet = cls.__new__(cls)
        sheet._core, sheet._of_row, sheet._rows = core, None, rows
        return sheet

    @classmethod
    def read(cls, file, rest="auto", triangulate=False, sew=None):
        """The sheet of an OBJ, OFF or PLY file.

        Args:
            rest: "auto", "vt", "plane" or "space": what the positions at rest are, as by `cutbench cut --rest`.
            triangulate: faces of more than three corners are read, too, as triangles.
            sew: vertices of the border that are no farther apart in space, in the file's unit, are sewn together.
        """
        distance = None if sew is None else arrays.number(sew, "sew")
        if distance is not None and not distance >= 0:
            raise InputError(f"sew: {sew} is not 0 or more")
        sheet = cls._of(_core.read_sheet(os.fspath(file), rest, bool(triangulate), distance))
        sheet._warn()
        return sheet

    @classmethod
    def family(cls, name="grid", triangles=800, size=1.0):
        """A square sheet of the benchmark.

        Args:
            name: "grid", "alternating", "delaunay" or "graded".
            triangles: 2 k^2 for some k.
            size: length of its sides.
        """
        return cls._of(_core.family_sheet(name, int(triangles), arrays.number(size, "size")))

    def write(self, file):
        """Writes an OBJ, OFF or VTU file, numbers to the last bit."""
        self._core.write(os.fspath(file))

    vertices = property(lambda self: self._core.vertices)  # views: cheaper than the lock of a cached_property
    rest = property(lambda self: self._core.rest)
    triangles = property(lambda self: self._core.triangles)
    sewn = cached_property(lambda self: self._core.sewn)

    @cached_property
    def texture(self):
        flat = self._core.texture
        return flat.reshape(-1, 3, 2) if len(flat) else None

    @cached_property
    def given(self):
        """For each vertex the row of the arrays, or the number in the file, that it was made of: unused vertices were left out,
        and a vertex may have been divided."""
        own = self._core.given if len(self._core.given) else np.arange(len(self.vertices), dtype=np.int32)
        return own if self._of_row is None else self._of_row[own]

    mean_edge = property(lambda self: self._core.mean_edge, doc="h: mean rest edge of the sheet before any cut.")

    @property
    def pieces(self):
        """m ints: the piece that each triangle is of, from 0."""
        return self._core.pieces

    @property
    def incision(self):
        """e x 2 x 2 ints: the edges of all incisions; of each the two vertices on one lip, and the two at the same rest
        positions on the other. At a tip the two lips share a vertex."""
        return _core.lips(self._core).reshape(-1, 2, 2)

    def random_cut(self, family="curved", seed=1, case=0):
        """Curves of a seeded cut of the benchmark. `family`: one of cutbench.cut_families."""
        return self._core.random_cut(family, arrays.whole(seed, "seed"), arrays.whole(case, "case"))

    def cut(self, path, method="warp_and_refine", chord_tolerance=0.05, allow_miss=False, **parameters):
        """Cuts the sheet; see cutbench.cut()."""
        maker = method_of(method, parameters)
        tolerance = arrays.number(chord_tolerance, "chord_tolerance")
        made = _core.cut(self._core, curves_of(path), maker, tolerance, bool(allow_miss))
        return Cut(self if made.before is self._core else self._unrolled_anew(made.before), made, maker)

    def _unrolled_anew(self, core):
        sheet = Sheet._of(core, self._rows)
        sheet._of_row = self._of_row
        return sheet

    def plot(self, ax=None, **how):
        """Draws the sheet at rest; see cutbench.pictures.plot()."""
        from . import pictures
        return pictures.plot(self, ax=ax, **how)

    def to_meshio(self):
        """The sheet as a meshio.Mesh: positions in space, `rest` with the points, `piece` and `aspect_ratio` with the
        triangles."""
        from . import pictures
        return pictures.to_meshio(self)

    def __reduce__(self):  # to be sent to another process
        return _again, (self.vertices, self.triangles, self.rest, self.sewn if len(self.sewn) else None, self.texture,
                        "space" if self._core.unrolled else "auto")

    def __repr__(self):
        return f"<cutbench.Sheet: {len(self.vertices)} vertices, {len(self.triangles)} triangles>"


def _again(vertices, triangles, rest, sewn, texture, rest_from):
    core = _core.sheet(vertices, triangles, rest, sewn, rest_from)
    if texture is not None:
        core.take_texture(np.ascontiguousarray(texture.reshape(-1, 6)))
    return Sheet._of(core)


def _in_better_words(error, positions, corners):
    try:
        arrays.check_finite(positions, "vertices")
        arrays.check_indices(corners, "triangles", len(positions))
    except InputError as better:
        return better
    return error


class Cut:
    """What came of a cut.

    Attributes:
        before, sheet: the Sheet before and after. The sheet's `vertices`, `triangles`, `rest`, `texture`, `incision` and
            `pieces` can be asked of the cut, too. Where the path runs along a seam of a curved sheet that was not cut yet,
            `before` is that sheet with its seams elsewhere, so that other vertices are there twice.
        path: the curves in rest space.
        method: its name.
        status: "ok"; "noop", nothing was there to cut; "deviated", done otherwise than asked by the method's policy.
        reason: of a noop, or a note.
        crossed_triangles: of the sheet before.
        times: microseconds by phase (docs/explanation/measuring.md), and in `total`.
    """

    def __init__(self, before, core, maker):
        self.before, self._core, self._maker = before, core, maker
        self.sheet = Sheet._of(core.after)

    method = property(lambda self: self._core.method)
    status = property(lambda self: self._core.status)
    reason = property(lambda self: self._core.reason)
    crossed_triangles = property(lambda self: self._core.crossed_triangles)
    vertices = property(lambda self: self.sheet.vertices)
    triangles = property(lambda self: self.sheet.triangles)
    rest = property(lambda self: self.sheet.rest)
    texture = property(lambda self: self.sheet.texture)
    pieces = property(lambda self: self.sheet.pieces)
    incision = property(lambda self: self.sheet.incision)
    path = property(lambda self: self._core.curves)
    times = property(lambda self: self._core.times())

    @cached_property
    def parents(self):
        """What each vertex and triangle was before: Parents."""
        return Parents(self.before, *self._core.parents())

    @cached_property
    def constraints(self):
        """Vertices that follow others, and polygons: Constraints."""
        return Constraints(**self._core.constraints())

    polygons = property(lambda self: self.constraints.polygons)

    @cached_property
    def quality(self):
        """A dict of everything that is measured of the cut, under the names of the columns of records
        (results/README.md): the oracle's verdict, shapes, accuracy. Computed when it is first asked for."""
        return json.loads(self._core.report())

    @property
    def verdict(self):
        """The oracle's verdict: "ok", or what is wrong."""
        return self.quality["verdict"]

    def cut(self, path, method=None, chord_tolerance=0.05, allow_miss=False, **parameters):
        """Cuts the result once more, by the same method where no other is named."""
        return self.sheet.cut(path, self._maker if method is None else method, chord_tolerance, allow_miss, **parameters)

    def plot(self, ax=None, **how):
        """Draws the result at rest; see cutbench.pictures.plot()."""
        from . import pictures
        return pictures.plot(self.sheet, path=self.path, polygons=self.polygons, ax=ax, **how)

    def to_meshio(self):
        """The sheet after the cut; see Sheet.to_meshio()."""
        return self.sheet.to_meshio()

    def __repr__(self):
        return (f"<cutbench.Cut: {self.status}, by {self.method}, {self.crossed_triangles} triangles crossed, "
                f"{len(self.triangles)} now>")


def sheet_of(anything):
    """A Sheet of a Sheet, a Cut, or a tuple (vertices, triangles) or (vertices, triangles, rest)."""
    if isinstance(anything, Sheet):
        return anything
    if isinstance(anything, Cut):
        return anything.sheet
    if isinstance(anything, tuple) and len(anything) in (2, 3):
        return Sheet(*anything)
    raise InputError(f"sheet: is a {type(anything).__name__}; give a Sheet, a Cut, or vertices together with triangles")


def cut(vertices, triangles=None, path=None, method="warp_and_refine", rest="auto", chord_tolerance=0.05,
        allow_miss=False, texture=None, **parameters):
    """Cuts a sheet along a path.

    Args:
        vertices: n x 2 or n x 3 floats; or a Sheet or Cut, with `triangles` left out.
        triangles: m x 3 ints, vertices from 0.
        path: a polyline of k x 2 points at rest; cutbench.bezier(...); k x 3 points in space on the sheet;
            cutbench.rays(...); a path file; or a list of these, cut one after the other.
        method: a name (cutbench.methods()), or a function of a Sheet and a curve that returns the sheet after.
        rest: n x 2 or n x 3 rest positions; m x 3 x 2, one for each corner, where the sheet has seams; or "auto", "plane" or
            "space"; see Sheet.
        chord_tolerance: largest distance of the incision from a curved path, in mean rest edges, or inf.
        allow_miss: a path that misses the sheet cuts nothing, instead of being an error.
        texture: n x 2 or m x 3 x 2 coordinates that the cut carries over, to `texture` of the result.
        **parameters: of the method, such as reach=0.3.

    Returns:
        Cut: vertices, triangles, rest, what they were before, and what was measured.

    Raises:
        InputError: an array or path that can't be used.
        CutError: the method refuses the cut, or failed.

    Other threads go on while it cuts.

    >>> import cutbench
    >>> square = cutbench.cut([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]], [[-0.1, 0.4], [1.1, 0.6]])
    >>> square.pieces.max() + 1
    2
    """
    if triangles is not None and isinstance(vertices, (Sheet, Cut)):
        raise InputError("triangles: the sheet has its own; leave them out")
    if triangles is None and texture is not None:
        raise InputError("texture: the sheet has its own; leave it out")
    if path is None:
        raise InputError("path: is not given")
    maker = method_of(method, parameters)
    if triangles is not None and texture is None and isinstance(rest, str) and rest == "auto":  # most calls: no detours
        tolerance = arrays.number(chord_tolerance, "chord_tolerance")
        core = _core.cut_of_arrays(vertices, triangles, path, maker, tolerance, bool(allow_miss))
        if core is not None:
            return Cut(Sheet._of(core.before, len(vertices)), core, maker)
    sheet = sheet_of(vertices) if triangles is None else Sheet(vertices, triangles, rest, texture)
    return sheet.cut(path, maker, chord_tolerance, allow_miss)
