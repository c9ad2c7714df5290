"""Arrays as the library takes them: 64-bit numbers, 32-bit indices, one row after the other. Others are converted, or
refused in one line that says what was given and what to give."""

import operator

import numpy as np

from .errors import InputError


def _array(values, name, kinds, what):
    try:
        array = np.asarray(values)
    except (ValueError, TypeError) as error:  # rows of different lengths
        raise InputError(f"{name}: no array of {what}: {error}") from None
    if array.dtype.kind not in kinds or array.dtype.itemsize > 8:
        raise InputError(f"{name}: has the type {array.dtype}; give {what}")
    if isinstance(values, np.ma.MaskedArray):
        raise InputError(f"{name}: is a masked array; fill it first")
    return array


def _rows(array, name, widths):
    if array.ndim != 2 or array.shape[1] not in widths:
        wanted = " or ".join(f"n x {width}" for width in widths)
        raise InputError(f"{name}: has the shape {_shape(array)}; give {wanted}")
    return array


def _shape(array):
    return " x ".join(map(str, array.shape)) or "of a single number"


def of_points(values, name, widths):
    """Numbers, n x one of `widths`, which may be NaN."""
    array = _rows(_array(values, name, "fiu", "numbers"), name, widths)
    if len(array) == 0:
        raise InputError(f"{name}: is empty; give at least one row")
    return np.ascontiguousarray(array, dtype=np.float64)


def check_finite(array, name):
    if not np.isfinite(array).all():
        row = int(np.argwhere(~np.isfinite(array))[0][0])
        raise InputError(f"{name}: row {row} has a number that is not finite, {array[row].tolist()}; correct it")


def points(values, name, widths):
    """Numbers, n x one of `widths`; finite."""
    array = of_points(values, name, widths)
    check_finite(array, name)
    return array


def in_space(values, name):
    """Points of two or three finite numbers, as three: z is 0 where it is not given."""
    array = points(values, name, (2, 3))
    return array if array.shape[1] == 3 else np.column_stack([array, np.zeros(len(array))])


def of_indices(values, name):
    """Whole numbers, m x 3, of 32 or 64 bits, which may be out of range."""
    array = _rows(_array(values, name, "iu", "whole numbers"), name, (3,))
    if len(array) == 0:
        raise InputError(f"{name}: is empty; give at least one row")
    if array.dtype == np.uint64 and array.max() > np.iinfo(np.int64).max:
        row, corner = (int(i) for i in np.argwhere(array > np.iinfo(np.int64).max)[0])
        raise InputError(f"{name}: row {row} has the corner {array[row, corner]}, which no sheet has")
    return np.ascontiguousarray(array, dtype=np.int32 if array.dtype == np.int32 else np.int64)


def check_indices(array, name, count):
    if array.min() < 0 or array.max() >= count:
        row, corner = (int(i) for i in np.argwhere((array < 0) | (array >= count))[0])
        raise InputError(f"{name}: row {row} has the corner {array[row, corner]}, but there are {count} vertices, from 0")


def whole(value, name, least=0):
    """A whole number, `least` or more."""
    try:
        number_given = operator.index(value)
    except TypeError:
        raise InputError(f"{name}: {value!r} is not a whole number") from None
    if number_given < least:
        raise InputError(f"{name}: {value} is not {least} or more")
    return number_given


def number(value, name):
    """A finite or infinite float."""
    try:
        value = float(value)
    except (TypeError, ValueError):
        raise InputError(f"{name}: {value!r} is not a number") from None
    if value != value:
        raise InputError(f"{name}: is not a number (NaN)")
    return value
