"""Methods: those of the table, and functions of one's own."""

import warnings
from functools import lru_cache

import numpy as np

from . import _core, arrays
from .errors import InputError


def methods():
    """The methods as a table: a pandas.DataFrame (a list of dicts without pandas), a row for each, with its parameter
    and what it promises."""
    from .tables import table
    return table(_core.method_table(), index="method")


def _answer(function, result):
    """Vertices, triangles and rest positions of what a function returned; unchecked as a mesh: the oracle judges it."""
    from .sheet import Cut, Sheet
    if isinstance(result, Cut):
        result = result.sheet
    if isinstance(result, Sheet):
        return result.vertices, result.triangles, result.rest
    if isinstance(result, tuple) and len(result) in (2, 3):
        vertices = arrays.in_space(result[0], "vertices")
        rest = vertices[:, :2] if len(result) == 2 else arrays.points(result[2], "rest", (2,))
        if len(rest) != len(vertices):
            raise InputError(f"rest: {len(rest)} rows; give as many as there are vertices, {len(vertices)}")
        triangles = arrays.of_indices(result[1], "triangles")
        arrays.check_indices(triangles, "triangles", len(vertices))
        return vertices, triangles.astype(np.int32), np.ascontiguousarray(rest)
    raise InputError(f"{function_name(function)}: returned a {type(result).__name__}; return a Sheet, a Cut, or "
                     "(vertices, triangles, rest)")


def function_name(function):
    return getattr(function, "__name__", type(function).__name__).strip("<>")


@lru_cache
def _named(name):
    return _core.named_method(name, {})


def method_of(method, parameters):
    """The core's method of a name or a function, with parameters. A function whose attribute `deletes` is true takes the
    triangles that the path crosses out, and is judged so."""
    if isinstance(method, str):
        if not parameters:
            return _named(method)
        return _core.named_method(method, {key: arrays.number(value, key) for key, value in parameters.items()})
    if isinstance(method, _core.Method):
        return method
    from .sheet import Sheet
    if not callable(method):
        raise InputError(f"method: is a {type(method).__name__}; give a name of cutbench.methods(), or a function")
    name = function_name(method)
    if any(row["method"] == name for row in _core.method_table()):
        raise InputError(f'method: the function "{name}" has the name of a method in the table; rename it')

    def ask(core, curve, chord_tolerance):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return _answer(method, method(Sheet._of(core), curve, **parameters))
    return _core.method_of_function(name, ask, bool(getattr(method, "deletes", False)))
