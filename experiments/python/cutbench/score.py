"""Judging a cut that anybody made."""

import json

import numpy as np

from . import _core, arrays
from .errors import InputError
from .paths import Curve, curves_of
from .sheet import Cut, Sheet, sheet_of


class Finding:
    """One thing that is wrong with a result.

    Attributes:
        cause: its name (docs/explanation/measuring.md), such as "shifted" or "t_junction".
        text: what is wrong and where, one line.
        mend: what to do, one line.
        place: rest position (2 floats) or None.
        cut: the number of the cut nearest to it, from 1, or None.
    """

    def __init__(self, cause, text, mend, place_rest, cut):
        self.cause, self.text, self.mend, self.cut = cause, text, mend, cut
        self.place = None if place_rest is None else np.array(place_rest)

    def __repr__(self):
        return f"<{self.cause}: {self.text}>"


class Score:
    """The oracle's judgement.

    Attributes:
        ok: the result is right.
        verdict: "ok", or what is wrong.
        findings: the causes, as Finding objects, the most telling first.
        problems: the oracle's own words.
        quality: all measures, as `cutbench score --json` gives them (results/README.md).
        svg: a drawing of the place, or of the whole sheet, as `cutbench score --svg` writes it.
    """

    def __init__(self, before, path, result, report, svg):
        self.before, self.path, self.result, self.svg = before, path, result, svg
        self.quality = report
        self.verdict, self.problems = report["verdict"], report["problems"]
        self.findings = [Finding(**finding) for finding in report["findings"]]
        self.ok = self.verdict == "ok"

    def plot(self, ax=None, **how):
        """Draws the place of the first finding, eight mean edges wide, or the whole result."""
        from . import pictures
        return pictures.plot_score(self, ax=ax, **how)

    def __repr__(self):
        causes = ", ".join(finding.cause for finding in self.findings)
        return f"<cutbench.Score: {self.verdict}{': ' + causes if causes else ''}>"


def score(before, path, after, chord_tolerance=0.05, keeps_vertices=False, deletes=False):
    """Judges a result that any program made.

    Args:
        before: the Sheet before, or (vertices, triangles, rest).
        path: what was to be cut, in rest space; see cutbench.cut().
        after: a Sheet, a Cut, or (vertices, triangles, rest): n x 3, m x 3, n x 2. A tuple may be broken in any way that
            arrays can hold: that is what is judged.
        chord_tolerance: allowed distance of the incision from the path, in mean rest edges, or inf: the longest edge.
        keeps_vertices: the vertices before must be there with the same numbers and rest positions.
        deletes: the triangles that the path crosses are to be taken out instead of divided.

    Returns:
        Score: verdict, causes with their places, and all measures.
    """
    before = sheet_of(before)
    curves = curves_of(path)
    if not all(isinstance(curve, Curve) for curve in curves):
        raise InputError("path: is picked in space; score() takes paths in rest space, such as Cut.path")
    vertices, triangles, rest = _arrays_of(after)
    report, svg = _core.score(before._core, curves, vertices, triangles, rest,
                              arrays.number(chord_tolerance, "chord_tolerance"), bool(keeps_vertices), bool(deletes))
    return Score(before, curves, (vertices, triangles, rest), json.loads(report), svg)


def _arrays_of(after):
    if isinstance(after, Cut):
        after = after.sheet
    if isinstance(after, Sheet):
        return after.vertices, after.triangles, after.rest
    if not (isinstance(after, tuple) and len(after) in (2, 3)):
        raise InputError(f"after: is a {type(after).__name__}; give a Sheet, a Cut, or (vertices, triangles, rest)")
    vertices = np.array(after[0], dtype=np.float64, order="C")
    if np.asarray(after[1]).dtype.kind not in "iu":
        raise InputError(f"after: its triangles are of the type {np.asarray(after[1]).dtype}; give whole numbers")
    triangles = np.array(after[1], dtype=np.int32, order="C")
    if vertices.ndim != 2 or vertices.shape[1] not in (2, 3):
        raise InputError("after: its vertices are not n x 2 or n x 3")
    if triangles.ndim != 2 or triangles.shape[1] != 3:
        raise InputError("after: its triangles are not m x 3")
    if vertices.shape[1] == 2:
        vertices = np.column_stack([vertices, np.zeros(len(vertices))])
    if len(after) == 2:
        return vertices, triangles, None
    rest = np.array(after[2], dtype=np.float64, order="C")
    if rest.shape != (len(vertices), 2):
        raise InputError(f"after: its rest positions are not n x 2, with n = {len(vertices)}")
    return vertices, triangles, rest
