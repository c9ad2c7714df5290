"""Pictures, and meshes for meshio."""

import io
import unittest

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as pyplot
import numpy as np

import cutbench
from cutbench.pictures import aspect_ratio

CURVE = cutbench.bezier([[0.1, 0.1], [0.3, 0.9], [0.6, 0.1], [0.9, 0.9]])


class Pictures(unittest.TestCase):
    def tearDown(self):
        pyplot.close("all")

    def drawn(self, ax):
        file = io.BytesIO()
        ax.figure.savefig(file, format="png")
        self.assertGreater(len(file.getvalue()), 5000)

    def test_cuts(self):
        sheet = cutbench.Sheet.family("grid", 200)
        self.drawn(sheet.plot())
        for method in ("warp_and_refine", "cut_polygons"):
            self.drawn(sheet.cut(CURVE, method).plot())
        self.drawn(sheet.cut(CURVE).plot(ax=pyplot.subplots()[1], colour=False))

    def test_scores(self):
        sheet = cutbench.Sheet.family("grid", 200)
        ax = cutbench.score(sheet, CURVE, sheet).plot()
        self.drawn(ax)
        self.assertEqual(ax.get_title(), "not_opened")
        broken = (np.full((4, 3), np.nan), [[0, 1, 9], [0, 1, 2]], np.full((4, 2), np.nan))
        self.drawn(cutbench.score(sheet, CURVE, broken).plot())
        self.assertIn("<svg", cutbench.score(sheet, CURVE, sheet).svg)

    def test_simulations(self):
        for dimension in (2, 3):
            scene = cutbench.Scene(sheet=cutbench.Sheet.family("grid", 50), physics={"dimension": dimension})
            simulation = cutbench.Simulation(scene)
            self.drawn(simulation.show())
            self.assertIn("<", simulation.animate(frames=3, every=2).to_jshtml())

    def test_meshio(self):
        made = cutbench.Sheet.family("grid", 200).cut([[-0.1, 0.37], [1.1, 0.61]])
        mesh = made.to_meshio()
        self.assertTrue(np.array_equal(mesh.cells_dict["triangle"], made.triangles))
        self.assertEqual(set(mesh.cell_data["piece"][0]), {0, 1})
        self.assertAlmostEqual(mesh.cell_data["aspect_ratio"][0].max(), made.quality["ar_max_all"], places=12)

    def test_aspect_ratio(self):
        self.assertAlmostEqual(aspect_ratio(np.array([[[0, 0], [1, 0], [0, 1]]]))[0], 2)


if __name__ == "__main__":
    unittest.main()
