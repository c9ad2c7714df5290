"""The same cuts by several methods."""

import time

from . import _core
from .errors import CutError
from .method import function_name
from .paths import curves_of
from .sheet import sheet_of
from .tables import table

SHOWN = ("ar_max_cut", "ar_mean_cut", "angle_min_deg_cut", "triangles_added", "vertices_added", "pieces", "incision_error_h")


def compare(methods=None, sheet=None, path=None, chord_tolerance=0.05):
    """Cuts the same sheet by several methods, and judges each result.

    Args:
        methods: names, functions, and pairs (name or function, {parameter: value}); all of the table where it is None.
        sheet: a Sheet or (vertices, triangles, rest); a grid of 800 triangles where it is None.
        path: see cutbench.cut(); a curve across the sheet where it is None.

    Returns:
        A table (pandas.DataFrame) with a row for each method: status, verdict, reason, total_us, and measures. A method
        that refuses, fails or raises an exception is one row that says so.
    """
    from .sheet import Sheet
    if methods is None:
        methods = [row["method"] for row in _core.method_table()]
    is_pair = isinstance(methods, tuple) and len(methods) == 2 and isinstance(methods[1], dict)
    if is_pair or isinstance(methods, str) or callable(methods):
        methods = [methods]
    sheet = Sheet.family() if sheet is None else sheet_of(sheet)
    path = sheet.random_cut() if path is None else curves_of(path)
    return table([_row(sheet, path, method, chord_tolerance) for method in methods], index="method")


def _row(sheet, path, method, chord_tolerance):
    method, parameters = method if isinstance(method, tuple) else (method, {})
    name = method if isinstance(method, str) else function_name(method)
    row = {"method": " ".join([name, *(f"{key}={value:g}" for key, value in parameters.items())])}
    start = time.perf_counter()
    try:
        made = sheet.cut(path, method, chord_tolerance, **parameters)
    except CutError as error:
        return row | {"status": error.status, "verdict": error.verdict, "reason": str(error).replace("\n", "; "),
                      "total_us": 1e6 * (time.perf_counter() - start)}
    row |= {"status": made.status, "verdict": made.verdict, "reason": made.reason, "total_us": made.times["total"]}
    return row | {key: made.quality[key] for key in SHOWN}
