"""Scores are those of the command line, whoever made the result."""

import json
import shutil
import unittest

import numpy as np
from command_line import files, program

import cutbench

SLIT = [[-0.1, 0.3], [0.6, 0.55]]


class Scores(unittest.TestCase):
    def test_right(self):
        sheet = cutbench.Sheet.family()
        for method in ("warp_and_refine", "conventional_split"):
            self.assertTrue(cutbench.score(sheet, SLIT, sheet.cut(SLIT, method)).ok)
        deleted = sheet.cut(SLIT, "element_deletion")
        self.assertFalse(cutbench.score(sheet, SLIT, deleted).ok)
        self.assertTrue(cutbench.score(sheet, SLIT, deleted, deletes=True).ok)

    def test_as_the_program(self):
        sheet = cutbench.Sheet.family("delaunay", 200)
        folder, mesh, path, result = files("mesh.obj", "path.json", "result.obj")
        self.addCleanup(shutil.rmtree, folder)
        sheet.write(mesh)
        cutbench.write_path(np.array(SLIT), path)
        for after in (sheet, sheet.cut(SLIT), sheet.cut([[-0.1, 0.35], [0.6, 0.55]]), sheet.cut(SLIT, "vertex_snap")):
            getattr(after, "sheet", after).write(result)
            _, said, _ = program("score", "--mesh", mesh, "--path", path, "--result", result, "--json")
            self.assertEqual(cutbench.score(sheet, SLIT, after).quality, json.loads(said))

    def test_causes(self):
        sheet = cutbench.Sheet.family()
        made = sheet.cut(SLIT, "conventional_split")
        v, t, r = made.vertices.copy(), made.triangles.copy(), made.rest.copy()
        shifted = sheet.cut([[-0.1, 0.34], [0.6, 0.59]], "conventional_split")
        turned = t.copy()
        turned[7] = turned[7, ::-1]
        moved = r.copy()
        moved[made.incision[2, 0, 0]] += 1e-9
        nan = r.copy()
        nan[0, 0] = np.nan
        beyond = t.copy()
        beyond[0, 0] = 10**6
        for cause, after in {"not_opened": sheet, "shifted": shifted, "flipped": (v, turned, r),
                             "lips_differ": (v, t, moved), "lost_triangle": (v, t[1:], r),
                             "rounded": (v, t, r.astype(np.float32))}.items():
            with self.subTest(cause):
                score = cutbench.score(sheet, SLIT, after)
                self.assertFalse(score.ok)
                self.assertIn(cause, [finding.cause for finding in score.findings])
                self.assertTrue(all(finding.mend for finding in score.findings))
        for verdict, after in {"not_finite": (v, t, nan), "bad_index": (v, beyond, r)}.items():
            self.assertEqual(cutbench.score(sheet, SLIT, after).verdict, verdict)
        self.assertEqual(cutbench.score(sheet, SLIT, sheet).findings[0].place.shape, (2,))


if __name__ == "__main__":
    unittest.main()
