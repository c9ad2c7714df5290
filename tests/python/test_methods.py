"""Functions of Python as methods."""

import tempfile
import unittest

from command_line import METHODS, ROOT

import cutbench


def borrowed(sheet, path):
    return sheet.cut(path, "conventional_split")


def broken(sheet, path):
    raise ZeroDivisionError("one over\nnothing")


def idle(sheet, path):
    return sheet


def unwilling(sheet, path):
    raise cutbench.Refused("not on a Friday")


def wordy(sheet, path):
    return "done"


def tuned(sheet, path, reach=0.1):
    return sheet.cut(path, "warp_and_refine", reach=reach)


def deleting(sheet, path):
    return sheet.cut(path, "element_deletion")


deleting.deletes = True


class Functions(unittest.TestCase):
    def test_is_a_method(self):
        sheet = cutbench.Sheet.family("delaunay", 200)
        for family in ("curved", "cut_out", "recut"):
            path = sheet.random_cut(family)
            mine, theirs = sheet.cut(path, borrowed), sheet.cut(path, "conventional_split")
            self.assertEqual(len(mine.triangles), len(theirs.triangles))
            self.assertEqual(mine.quality["ar_max_cut"], theirs.quality["ar_max_cut"])
            self.assertEqual((mine.verdict, mine.method), ("ok", "borrowed"))

    def test_once_more(self):
        made = cutbench.Sheet.family().cut([[-0.1, 0.3], [0.6, 0.55]], borrowed).cut([[0.3, -0.1], [0.45, 1.1]])
        self.assertEqual((made.method, made.verdict, made.quality["pieces"]), ("borrowed", "ok", 3))

    def test_parameters(self):
        sheet = cutbench.Sheet.family("delaunay", 200)
        one, other = (len(sheet.cut(sheet.random_cut(), tuned, reach=reach).triangles) for reach in (0.0, 0.4))
        self.assertNotEqual(one, other)

    def test_compare(self):
        table = cutbench.compare(["example", borrowed, broken, idle, unwilling, wordy, ("warp_and_refine", {"reach": 0.2})])
        names = ["example", "borrowed", "broken", "idle", "unwilling", "wordy", "warp_and_refine reach=0.2"]
        self.assertEqual(list(table.index), names)
        self.assertEqual(list(table.status), ["ok", "ok", "failed", "failed", "refused", "failed", "ok"])
        self.assertEqual(table.verdict["broken"], "crashed")
        self.assertIn("ZeroDivisionError: one over nothing", table.reason["broken"])
        self.assertIn("not_opened", table.reason["idle"])
        self.assertIn("not on a Friday", table.reason["unwilling"])
        self.assertIn("wordy: returned a str", table.reason["wordy"])

    def test_that_deletes_triangles(self):
        table = cutbench.compare(["element_deletion", deleting])
        self.assertEqual(list(table.verdict), ["ok", "ok"], table.reason["deleting"])
        self.assertEqual(table.triangles_added["deleting"], table.triangles_added["element_deletion"])
        self.assertLess(table.triangles_added["deleting"], 0)
        silent = cutbench.compare([lambda sheet, path: deleting(sheet, path)])
        self.assertEqual(list(silent.status), ["failed"])

    def test_compare_all(self):
        table = cutbench.compare(sheet=cutbench.Sheet.family("grid", 200))
        self.assertEqual(list(table.index), METHODS)
        self.assertEqual(set(table.verdict), {"ok"})

    def test_names(self):
        def example(sheet, path):
            return sheet
        with self.assertRaisesRegex(cutbench.InputError, "rename it"):
            cutbench.compare([example])

    def test_interrupt_goes_through(self):
        def stopped(sheet, path):
            raise KeyboardInterrupt
        with self.assertRaises(KeyboardInterrupt):
            cutbench.Sheet.family().cut([[-1, 0.4], [2, 0.5]], stopped)

    def test_in_a_simulation(self):
        scene = cutbench.Scene(sheet=cutbench.Sheet.family("grid", 200), pins=[{"box": [[0.0, 1.0], [1.0, 1.0]]}])
        one, other = (cutbench.Simulation(scene, method) for method in (borrowed, "conventional_split"))
        for simulation in (one, other):
            self.assertEqual(simulation.cut([[-0.1, 0.31], [0.6, 0.55]])["status"], "ok")
            simulation.step(5)
        self.assertEqual(one.sheet.triangles.shape, other.sheet.triangles.shape)


class Experiments(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = folder.name

    def test_measured(self):
        rows = cutbench.run(ROOT / "experiments/method_comparison.toml", ["conventional_split", borrowed, broken],
                            cases=1, repetitions=1, resolutions=[800], out=self.out, quiet=True)
        self.assertEqual(set(rows.method), {"conventional_split", "borrowed", "broken"})
        self.assertEqual(set(rows.verdict[rows.method != "broken"]), {"ok"})
        self.assertEqual(set(rows.verdict[rows.method == "broken"]), {"crashed"})
        self.assertEqual(rows.attrs["units"]["locate_us"], "us")
        self.assertIn("commit", rows.attrs["context"])
        again = cutbench.records(self.out + "/method_comparison")
        self.assertTrue(again.equals(rows))

    def test_in_processes_of_their_own(self):
        rows = cutbench.run(ROOT / "experiments/robustness.toml", ["conventional_split", borrowed], cases=5,
                            resolutions=[800], out=self.out, quiet=True)
        self.assertEqual(set(rows.method), {"conventional_split", "borrowed"})

    def test_bad(self):
        with self.assertRaisesRegex(cutbench.InputError, "nowhere.toml"):
            cutbench.run("nowhere.toml", out=self.out, quiet=True)
        with self.assertRaisesRegex(cutbench.InputError, "nowhere"):
            cutbench.records("nowhere")
        with self.assertRaisesRegex(cutbench.InputError, "is not in the experiment"):
            cutbench.run(ROOT / "experiments/method_comparison.toml", ["no_such"], out=self.out, quiet=True)

    def test_advice(self):
        scene = ROOT / "experiments/scenes/falling_piece.toml"
        table = cutbench.ablate(scene, resolution=200, quiet=True)
        self.assertIn("bending", set(table.without))
        advice = cutbench.recommend(scene, max_error=0.5, methods=["conventional_split"], solvers=["cg"], time_limit=5,
                                    quiet=True)
        self.assertIn("chosen", advice)

    def test_advice_on_a_sheet_of_arrays(self):
        sheet = cutbench.Sheet.family("grid", 200)
        scene = cutbench.Scene(sheet=(sheet.vertices.copy(), sheet.triangles.copy()), duration=0.1,
                               material={"density": 0.3, "stiffness": 60.0}, physics={"gravity": [0, -9.81, 0.5]},
                               pins=[{"box": [[-1.0, 1.0], [2.0, 1.0]]}],
                               cuts=[{"time": 0.0, "polyline": [[0.2, 0.5], [0.8, 0.5]]}])
        table = cutbench.ablate(scene, borrowed, quiet=True)
        self.assertEqual((table.verdict[0], table.without[0]), ("ok", ""))
        self.assertIn("three of four triangles", set(table.without))
        advice = cutbench.recommend(scene, reference=True, methods=["conventional_split"], time_limit=5, quiet=True)
        self.assertGreater(advice["value_m"], 0)
        with self.assertRaisesRegex(cutbench.InputError, "^give max_error"):
            cutbench.recommend(scene, quiet=True)
        with self.assertRaisesRegex(cutbench.InputError, "^resolution: .*sheet"):
            cutbench.ablate(scene, resolution=200, quiet=True)


if __name__ == "__main__":
    unittest.main()
