"""Paths: where to cut. A path is one curve, or several that are cut one after the other."""

import os

import numpy as np

from . import _core, arrays
from .errors import InputError

Curve, PickedCurve = _core.Curve, _core.PickedCurve


def polyline(points, closed=False):
    """A path of straight pieces.

    Args:
        points: k x 2, rest positions; or k x 3, points in space that lie on the sheet as it is.
        closed: goes on from the last point to the first, which it does not repeat.
    """
    return _curve(False, points, closed)


def bezier(points, closed=False):
    """A chain of m cubic Bezier curves.

    Args:
        points: (3 m + 1) x 2 control points, rest positions; or x 3, points in space that lie on the sheet as it is.
        closed: it ends where it began; the last point is the first.
    """
    return _curve(True, points, closed)


def _curve(is_bezier, points, closed):
    points = arrays.of_points(points, "path", (2, 3))
    try:
        if points.shape[1] == 2:
            return Curve(is_bezier, points, bool(closed))
        return PickedCurve(is_bezier, points, None, bool(closed))
    except InputError:
        arrays.check_finite(points, "path")
        raise


def rays(origins, directions, bezier=False, closed=False):
    """A path through the points where rays first meet the sheet as it is in space.

    Args:
        origins: k x 3 (m); directions: k x 3, of any length but 0.
        bezier: the points are control points of cubic Bezier curves instead of a polyline's.
    """
    origins = arrays.points(origins, "origins", (3,))
    directions = arrays.points(directions, "directions", (3,))
    if len(origins) != len(directions):
        raise InputError(f"directions: {len(directions)} rows; give as many as there are origins, {len(origins)}")
    return PickedCurve(bool(bezier), origins, directions, bool(closed))


def read_path(file):
    """The curves of a path file (docs/reference/sheets_and_paths.md)."""
    return _core.read_path(os.fspath(file))


def write_path(path, file):
    """Writes curves in rest space as a path file, which `cutbench cut --path` reads."""
    _core.write_path(curves_of(path), os.fspath(file))


def _has_rows(one):
    return np.ndim(one) != 1 if isinstance(one, np.ndarray) else (
        isinstance(one, (list, tuple)) and len(one) > 0 and isinstance(one[0], (list, tuple, np.ndarray)))


def curves_of(path):
    """The list of curves of whatever is taken for a path: a curve, an array of points, a path file, or a list of
    curves and arrays."""
    if isinstance(path, (Curve, PickedCurve)):
        return [path]
    if isinstance(path, np.ndarray):
        return [polyline(path)]
    if not isinstance(path, (list, tuple)):
        if isinstance(path, (str, os.PathLike)):
            return read_path(path)
        raise InputError(f"path: is a {type(path).__name__}; give points (k x 2 or k x 3), cutbench.bezier(...), or a list "
                         "of these")
    if len(path) == 0:
        raise InputError("path: is empty; give at least two points")
    if any(isinstance(one, (Curve, PickedCurve)) or _has_rows(one) for one in path):
        return [curve for one in path for curve in curves_of(one)]
    return [polyline(path)]
