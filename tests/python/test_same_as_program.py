"""Cuts and simulations are those of the command line, bit for bit."""

import shutil
import subprocess
import sys
import unittest

from command_line import MANY, METHODS, ROOT, files, program

import cutbench


class Cuts(unittest.TestCase):
    def compare(self, sheet, mesh, path, method, folder):
        theirs, mine = folder / "theirs.obj", folder / "mine.obj"
        theirs.unlink(missing_ok=True)
        code, said, errors = program("cut", "--mesh", mesh, "--path", folder / "path.json", "--method", method, "--out",
                                     theirs)
        try:
            made = sheet.cut(path, method)
        except (cutbench.CutError, cutbench.InputError) as error:
            self.assertIn(str(error).split(": misses")[0].split("path, cut")[0], errors)
            self.assertNotEqual(code, 0)
            return
        made.sheet.write(mine)
        self.assertEqual(mine.read_bytes(), theirs.read_bytes(), (method, path))
        self.assertTrue(said.startswith(f"{made.status}: {made.crossed_triangles} triangles crossed"), said)

    def test_random_cuts_by_all_methods(self):
        folder, mesh = files("mesh.obj")
        self.addCleanup(shutil.rmtree, folder)
        for case in range(MANY):
            for number, family in enumerate(cutbench.cut_families):
                name = cutbench.sheet_families[(case + number) % len(cutbench.sheet_families)]
                sheet = cutbench.Sheet.family(name, 200)
                sheet.write(mesh)
                path = sheet.random_cut(family, seed=7, case=case)
                cutbench.write_path(path, folder / "path.json")
                for method in METHODS:
                    with self.subTest(family=family, case=case, sheet=name, method=method):
                        self.compare(sheet, mesh, path, method, folder)

    def test_recut(self):
        """Two cuts, one after the other, are one path file of two."""
        folder, mesh, out = files("mesh.obj", "out.obj")
        self.addCleanup(shutil.rmtree, folder)
        sheet = cutbench.Sheet.family("grid", 200)
        sheet.write(mesh)
        first, second = [[-0.1, 0.4], [1.1, 0.5]], [[0.4, -0.1], [0.6, 1.1]]
        cutbench.write_path([cutbench.polyline(first), cutbench.polyline(second)], folder / "path.json")
        for method in METHODS:
            with self.subTest(method=method):
                code, _, errors = program("cut", "--mesh", mesh, "--path", folder / "path.json", "--method", method,
                                          "--out", out)
                self.assertEqual(code, 0, errors)
                both = folder / "both.obj"
                sheet.cut(first, method).cut(second).sheet.write(both)
                self.assertEqual(both.read_bytes(), out.read_bytes())


class Scenes(unittest.TestCase):
    def test_all_scenes(self):
        subprocess.run([sys.executable, ROOT / "experiments/scenes/meshes/make.py"], check=True)  # what some scenes read
        for file in sorted((ROOT / "experiments/scenes").glob("*.toml")):
            with self.subTest(scene=file.stem):
                self.compare(file)

    def compare(self, file):
        folder, theirs, mine = files("theirs.obj", "mine.obj")
        self.addCleanup(shutil.rmtree, folder)
        scene = cutbench.Scene(file)
        resolution = []
        if "file" not in file.read_text().split("[sheet]")[-1].split("[")[0]:
            scene, resolution = scene.with_resolution(800), ["--resolution", "800"]
        program("simulate", file, *resolution, "--out", theirs, "--frames", folder / "frames", "--every", "100000")
        simulation = cutbench.Simulation(scene)
        try:
            simulation.run()
        except cutbench.StepError:
            pass
        simulation.sheet.write(mine)
        self.assertEqual(mine.read_bytes(), theirs.read_bytes())
        budget = folder / "frames/energy.csv"
        if budget.exists():
            self.assertEqual(simulation._core.budget_csv(), budget.read_text())


if __name__ == "__main__":
    unittest.main()
