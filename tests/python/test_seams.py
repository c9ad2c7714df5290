"""Sheets with seams: rest positions per corner, and sheets that are curved at rest."""

import pickle
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np

import cutbench


def panels():
    """A square of 8 x 8 cells, whose right half lies elsewhere at rest, turned by a quarter."""
    whole = cutbench.Sheet.family("grid", 128)
    rest = whole.rest[whole.triangles].copy()
    right = rest[:, :, 0].mean(axis=1) > 0.5
    rest[right] = rest[right][:, :, ::-1] * [-1, 1] + [5, 0]
    return whole, cutbench.Sheet(whole.vertices, whole.triangles, rest)


def tube(around=24, along=8):
    angle = 2 * np.pi * np.arange(around) / around
    vertices = np.array([[x, np.cos(a), np.sin(a)] for x in np.linspace(0, 2, along + 1) for a in angle])
    def at(i, j):
        return j * around + i % around
    cells = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for j in range(along) for i in range(around)]
    return vertices, np.array([t for a, b, c, d in cells for t in ((a, b, c), (a, c, d))])


class Seams(unittest.TestCase):
    def test_rest_positions_per_corner_make_seams(self):
        whole, sewn = panels()
        self.assertEqual(len(sewn.vertices), len(whole.vertices) + 9)
        self.assertTrue((sewn.vertices == sewn.vertices[sewn.sewn]).all())
        self.assertEqual(sewn.pieces.max(), 0)
        cut = sewn.cut(cutbench.polyline([[0.02, 0.31, 0], [0.97, 0.37, 0]]),
                       "conventional_split")
        self.assertEqual(len(cut.path), 2)
        self.assertEqual(cut.sheet.pieces.max(), 0)
        again = pickle.loads(pickle.dumps(sewn))
        self.assertTrue((again.sewn == sewn.sewn).all())
        self.assertEqual(again.pieces.max(), 0)

    def test_a_path_along_a_seam_puts_the_seam_elsewhere(self):
        vertices, triangles = tube()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            sheet = cutbench.Sheet(vertices, triangles)
        elsewhere = 0
        for i in range(24):
            cut = sheet.cut(cutbench.polyline(vertices[[i, 24 * 8 + i]]), "conventional_split")
            elsewhere += cut.before is not sheet
            self.assertEqual((cut.verdict, len(cut.sheet.triangles)), ("ok", len(triangles)))
            self.assertEqual(len(np.unique(cut.sheet.sewn)), len(vertices) + 9)
            carried = cut.parents.carry(vertices)
            self.assertTrue(np.allclose(carried, cut.vertices))
        self.assertGreater(elsewhere, 0)
        self.assertLess(elsewhere, 24)

    def test_a_tube_is_cut_round(self):
        vertices, triangles = tube()
        with self.assertWarnsRegex(UserWarning, "unrolled, sewn along 8 of"):
            sheet = cutbench.Sheet(vertices, triangles)
        self.assertEqual(len(sheet.vertices), len(vertices) + 9)
        at_rest, in_space = (np.linalg.norm(np.diff(corners[sheet.triangles], axis=1), axis=2)
                             for corners in (sheet.rest, sheet.vertices))
        self.assertTrue(np.allclose(at_rest, in_space, rtol=1e-12))
        middle = [(vertices[i] + vertices[i + 1]) / 2 * [1, 1, 1] + [0.71, 0, 0] for i in (0, 6, 12, 18)]
        ring = cutbench.polyline(np.array(middle), closed=True)
        for method in ("conventional_split", "warp_and_refine", "cut_polygons"):
            pieces = sheet.cut(ring, method).sheet.pieces
            self.assertEqual(pieces.max(), 1)
        for same in (sheet, pickle.loads(pickle.dumps(sheet))):
            with self.assertRaisesRegex(cutbench.InputError, "is unrolled, so places at rest mean nothing"):
                same.cut([[0.1, 0.2], [0.5, 0.4]])

    def test_rest_words(self):
        vertices, triangles = tube()
        with self.assertRaisesRegex(cutbench.InputError, "no rest positions"):
            cutbench.Sheet(vertices, triangles, "plane")
        with self.assertRaisesRegex(cutbench.InputError, "known are auto, plane, space"):
            cutbench.Sheet(vertices, triangles, "vt")
        flat = cutbench.Sheet.family("grid", 8)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.assertTrue(np.allclose(cutbench.Sheet(flat.vertices, flat.triangles, "space").rest, flat.rest))

    def test_doubled_vertices_are_sewn_on_request(self):
        whole, sewn = panels()
        lines = [f"v {x} {y} {z}" for x, y, z in sewn.vertices] + [f"vt {x} {y}" for x, y in sewn.rest]
        lines += [f"f {a}/{a} {b}/{b} {c}/{c}" for a, b, c in sewn.triangles + 1]
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        file = Path(folder.name) / "doubled.obj"
        file.write_text("# vt: rest positions\n" + "\n".join(lines) + "\n")
        with self.assertWarnsRegex(UserWarning, "vertices that lie where others do, though apart at rest: 9"):
            self.assertEqual(cutbench.Sheet.read(file).pieces.max(), 1)
        with self.assertWarnsRegex(UserWarning, "vertices sewn to others: 9"):
            self.assertEqual(cutbench.Sheet.read(file, sew=1e-9).pieces.max(), 0)


if __name__ == "__main__":
    unittest.main()
