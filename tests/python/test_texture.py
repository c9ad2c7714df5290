"""Texture coordinates through cuts: linear ones stay linear, and each side of a seam keeps its own."""

import pickle
import tempfile
import unittest
from pathlib import Path

import numpy as np

import cutbench

MAP, OFF = np.array([[3.0, 1.0], [-2.0, 4.0]]), np.array([0.5, -1.0])


class Texture(unittest.TestCase):
    def test_per_vertex_through_cuts_of_cuts_and_files(self):
        plain = cutbench.Sheet.family("delaunay", 128)
        sheet = cutbench.Sheet(plain.vertices, plain.triangles[:, [0, 2, 1]], texture=plain.rest @ MAP + OFF)
        for i in range(4):
            cut = sheet.cut(sheet.random_cut("partial", 5, i), "warp_and_refine")
            self.assertLess(abs(cut.texture - (cut.rest[cut.triangles] @ MAP + OFF)).max(), 1e-12)
            sheet = cut.sheet
        with tempfile.TemporaryDirectory() as folder:
            sheet.write(Path(folder) / "sheet.obj")
            again = cutbench.Sheet.read(Path(folder) / "sheet.obj")
        for other in (again, pickle.loads(pickle.dumps(sheet))):
            self.assertTrue((other.texture == sheet.texture).all())
            self.assertTrue((other.rest == sheet.rest).all())

    def test_per_corner(self):
        plain = cutbench.Sheet.family("grid", 128)
        texture = plain.rest[plain.triangles] @ MAP
        texture[plain.rest[plain.triangles].mean(axis=1)[:, 0] > 0.5] += 7
        cut = cutbench.Sheet(plain.vertices, plain.triangles, texture=texture).cut([[0.1, 0.33], [0.9, 0.41]], "conventional_split")
        corners = cut.rest[cut.triangles]
        right = corners @ MAP + 7 * (corners.mean(axis=1)[:, 0] > 0.5)[:, None, None]
        self.assertLess(abs(cut.texture - right).max(), 1e-12)
        straight = cutbench.cut(plain.vertices, plain.triangles, [[0.1, 0.33], [0.9, 0.41]], "conventional_split", texture=texture)
        self.assertTrue((straight.texture == cut.texture).all())
        self.assertIsNone(plain.cut([[0.1, 0.33], [0.9, 0.41]]).texture)

    def test_bad_ones_are_refused(self):
        plain = cutbench.Sheet.family("grid", 8)
        for bad, word in ((plain.rest[1:], "rows"), (np.zeros((3, 3, 2)), "shape"), (plain.rest * np.nan, "finite")):
            with self.assertRaisesRegex(cutbench.InputError, word):
                cutbench.Sheet(plain.vertices, plain.triangles, texture=bad)


if __name__ == "__main__":
    unittest.main()
