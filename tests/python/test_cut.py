"""What a cut says of itself."""

import ast
import doctest
import inspect
import pickle
import re
import tempfile
import threading
import unittest
import warnings
from pathlib import Path

import numpy as np
from command_line import METHODS, ROOT

import cutbench
from cutbench import _core

SLIT = [[-0.1, 0.3], [0.6, 0.55]]
MOVING = ("vertex_snap", "active_node", "warp_and_refine", "adaptive_remesh", "global_remesh")  # they move vertices
ACROSS = [[-0.1, 0.37], [1.1, 0.61]]


def bent(family="delaunay", triangles=200):
    """A sheet that is bent in space."""
    flat = cutbench.Sheet.family(family, triangles)
    space = flat.vertices.copy()
    space[:, 2] = 0.2 * np.sin(3 * space[:, 0])
    return cutbench.Sheet(space, flat.triangles, flat.rest)


class Files(unittest.TestCase):
    def test_what_rest_is(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "texture.obj"
            file.write_text("v 0 0 0\nv 3 0 0\nv 3 5 0\nv 0 5 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n")
            with self.assertRaisesRegex(cutbench.InputError, "4 corners"):
                cutbench.Sheet.read(file)
            for rest, corner in (("auto", [3, 5]), ("vt", [1, 1]), ("plane", [3, 5])):
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    sheet = cutbench.Sheet.read(file, rest, triangulate=True)
                self.assertEqual(sheet.rest[2].tolist(), corner)
            with self.assertRaisesRegex(cutbench.InputError, 'rest: "world" is not known'):
                cutbench.Sheet.read(file, "world", triangulate=True)


class Results(unittest.TestCase):
    def test_arrays_share_memory_and_are_locked(self):
        made = bent().cut(SLIT)
        for name in ("vertices", "triangles", "rest"):
            array = getattr(made, name)
            self.assertFalse(array.flags.writeable)
            self.assertFalse(array.flags.owndata)
            self.assertTrue(np.shares_memory(array, getattr(made.sheet, name)))
        kept = made.vertices
        wanted = kept.copy()
        del made
        self.assertTrue(np.array_equal(kept, wanted))  # the sheet lives as long as its arrays

    def test_incision(self):
        for method in METHODS:
            sheet = cutbench.Sheet.family("grid", 200)
            made = sheet.cut(SLIT, method)
            lips = made.incision
            self.assertTrue(np.array_equal(made.rest[lips[:, 0]], made.rest[lips[:, 1]]), method)
            self.assertTrue((lips[:, 0] != lips[:, 1]).any(axis=1).all(), method)
            edges = {tuple(edge) for corners in made.triangles for edge in zip(corners, np.roll(corners, -1))}
            for a, b in lips.reshape(-1, 2):
                self.assertTrue((a, b) in edges or (b, a) in edges)
            self.assertEqual(len(lips) == 0, method == "element_deletion")

    def test_pieces(self):
        made = cutbench.Sheet.family().cut(ACROSS)
        self.assertEqual(set(made.pieces), {0, 1})
        self.assertEqual(made.quality["pieces"], 2)
        self.assertEqual(len(made.pieces), len(made.triangles))

    def test_parents(self):
        """Data are interpolated in the triangles before all cuts: rest positions come out as they are."""
        sheet = bent()
        old_triangles = {frozenset(corners) for corners in sheet.triangles.tolist()}
        for method in METHODS:
            if method in ("cisamr",):  # takes structured grids alone
                continue
            for path in (SLIT, [cutbench.polyline(ACROSS), cutbench.polyline([[0.4, -0.1], [0.6, 1.1]])]):
                made = sheet.cut(path, method)
                with self.subTest(method=method):
                    parents = made.parents
                    self.assertEqual(len(parents.first), len(made.vertices) + 1)
                    self.assertTrue(np.allclose(parents.carry(sheet.rest), made.rest, rtol=0, atol=1e-12))
                    parts = [frozenset(part.tolist()) for part in np.split(parents.vertices, parents.first[1:-1])]
                    self.assertTrue(all(len(part) < 3 or part in old_triangles for part in parts))
                    self.assertTrue(np.allclose(parents.carry(np.ones(len(sheet.vertices))), 1))
                    self.assertEqual(len(parents.triangles), len(made.triangles))
                    corners = sheet.rest[sheet.triangles[parents.triangles]]
                    centres = made.rest[made.triangles].mean(axis=1)
                    sides = np.roll(corners, -1, axis=1) - corners
                    to = centres[:, None] - corners
                    inside = (sides[..., 0] * to[..., 1] - sides[..., 1] * to[..., 0]).min(axis=1)
                    if path is SLIT and method not in MOVING:
                        self.assertGreater(inside.min(), -1e-12)

    def test_constraints(self):
        sheet = cutbench.Sheet.family("grid", 800)
        curve = cutbench.bezier([[0.1, 0.1], [0.3, 0.9], [0.6, 0.1], [0.9, 0.9]])
        tied = sheet.cut(curve, "split_and_tie")
        self.assertGreater(len(tied.constraints.vertices), 0)
        self.assertTrue(np.allclose(tied.constraints.weights.sum(axis=1), 1))
        follow = (tied.rest[tied.constraints.masters] * tied.constraints.weights[..., None]).sum(axis=1)
        self.assertTrue(np.allclose(follow, tied.rest[tied.constraints.vertices], atol=1e-12))
        doubled = sheet.cut(curve, "phantom_node").constraints
        self.assertGreater(doubled.phantoms, 0)
        self.assertLess(doubled.masters.max(), len(sheet.cut(curve, "phantom_node").vertices) + doubled.phantoms)
        merged = sheet.cut(curve, "cut_polygons")
        for corners, parts in zip(merged.polygons, merged.constraints.polygon_triangles):
            self.assertTrue(set(corners) <= set(merged.triangles[parts].ravel()))

    def test_failures(self):
        with self.assertRaises(cutbench.CutError) as caught:
            cutbench.Sheet.family("delaunay", 200).cut(SLIT, "cisamr")
        self.assertEqual(caught.exception.status, "refused")
        nothing = cutbench.Sheet.family().cut([[3, 3], [4, 4]], allow_miss=True)
        self.assertEqual((nothing.status, len(nothing.incision)), ("noop", 0))

    def test_picks(self):
        """A path picked in space is that of the rest positions under it."""
        sheet = cutbench.Sheet.family("grid", 200)
        moved = cutbench.Sheet(sheet.vertices + [0, 0, 5], sheet.triangles, sheet.rest)
        wanted = sheet.cut([[0.21, 0.3], [0.7, 0.62]])
        for path in (np.array([[0.21, 0.3, 5], [0.7, 0.62, 5]]),
                     cutbench.rays([[0.21, 0.3, 9], [0.7, 0.62, 9]], [[0, 0, -1]] * 2)):
            made = moved.cut(path)
            self.assertEqual(made.triangles.shape, wanted.triangles.shape)
            self.assertTrue(np.allclose(made.rest, wanted.rest, atol=1e-12))

    def test_times(self):
        times = cutbench.Sheet.family().cut(SLIT).times
        self.assertGreater(times["total"], 0)
        self.assertAlmostEqual(sum(value for key, value in times.items() if key not in ("total", "pick")), times["total"])

    def test_sheets_can_be_sent(self):
        made = bent().cut(SLIT).sheet
        sent = pickle.loads(pickle.dumps(made))
        for name in ("vertices", "triangles", "rest"):
            self.assertTrue(np.array_equal(getattr(sent, name), getattr(made, name)))
        self.assertEqual(len(sent.incision), len(made.incision))

    def test_errors_can_be_sent(self):
        for error in (cutbench.InputError("x"), cutbench.CutError("x", "refused", "refused")):
            self.assertEqual(str(pickle.loads(pickle.dumps(error))), "x")

    def test_help(self):
        """Everything that is there to call says what it takes."""
        for name in cutbench.__all__:
            thing = getattr(cutbench, name)
            if not isinstance(thing, list):
                self.assertTrue(inspect.getdoc(thing), name)
        text = inspect.getdoc(cutbench.cut)
        for argument in inspect.signature(cutbench.cut).parameters:
            self.assertIn(argument, text)

    def test_examples_in_docstrings(self):
        for module in (cutbench, cutbench.sheet):
            result = doctest.testmod(module)
            self.assertEqual((result.failed, result.attempted > 0), (0, True))

    def test_version(self):
        written = (re.search(pattern, (ROOT / name).read_text())[1] for name, pattern in (
            ("pyproject.toml", r'version = "(.*)"'), ("CMakeLists.txt", r"project\(cutbench VERSION (\S+)")))
        self.assertEqual(*written)

    def test_stubs(self):
        """The stubs name what the module has."""
        stub = Path(_core.__file__).parent.joinpath("_core.pyi").read_text()
        there = {name for name in dir(_core) if not name.startswith("__")}
        self.assertEqual(set(re.findall(r"^(?:class |def )?(\w+)(?=[:(])", stub, re.M)), there)
        for name, body in re.findall(r"^class (\w+):\n((?:    .*\n)+)", stub, re.M):
            has = {n for n in vars(getattr(_core, name)) if not n.startswith("_")}
            self.assertEqual(set(re.findall(r"    def ([a-z]\w*)", body)), has, name)

    def test_stubs_of_the_package(self):
        """They name what there is to call, with the same arguments and defaults."""
        tree = ast.parse(Path(cutbench.__file__).with_suffix(".pyi").read_text())
        for node in tree.body:
            if isinstance(node, ast.FunctionDef):
                self.same_arguments(node, getattr(cutbench, node.name))
            elif isinstance(node, ast.ClassDef) and node.name != "_Mesh":
                self.same_members(node, getattr(cutbench, node.name))
        named = {node.name for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        self.assertEqual(named - {"_Mesh"} | {"cut_families", "sheet_families"}, set(cutbench.__all__))

    def same_members(self, node, real):
        methods = [each for each in node.body if isinstance(each, ast.FunctionDef)]
        for each in methods:
            self.same_arguments(each, getattr(real, each.name))
        named = {each.name for each in methods} | {each.target.id for each in node.body if isinstance(each, ast.AnnAssign)}
        mesh = {"vertices", "rest", "triangles", "texture", "pieces", "incision", "plot", "to_meshio"}
        own = {name for name in vars(real) if not name.startswith("_")}
        self.assertLessEqual(own - mesh, named, node.name)

    def same_arguments(self, node, real):
        there = inspect.signature(real).parameters.values()
        given = [each.arg for each in node.args.args] + ([node.args.kwarg.arg] if node.args.kwarg else [])
        self.assertEqual([each for each in given if each != "cls"], [each.name for each in there], node.name)
        defaults = [ast.literal_eval(each) for each in node.args.defaults]
        self.assertEqual(defaults, [each.default for each in there if each.default is not each.empty], node.name)


class Threads(unittest.TestCase):
    def test_side_by_side(self):
        """Threads share sheets and methods, and make the same cuts."""
        sheet = cutbench.Sheet.family("delaunay", 200)
        cases = [(family, method) for family in ("curved", "cut_out", "recut") for method in METHODS if method != "cisamr"]
        wanted = [sheet.cut(sheet.random_cut(family), method).vertices for family, method in cases]
        made = [None] * len(cases)

        def work(start):
            for i in range(start, len(cases), 4):
                made[i] = sheet.cut(sheet.random_cut(cases[i][0]), cases[i][1])
                made[i].quality

        threads = [threading.Thread(target=work, args=(start,)) for start in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for one, other in zip(made, wanted):
            self.assertTrue(np.array_equal(one.vertices, other))


    def test_others_go_on(self):
        """While one call cuts, judges or steps, another thread of Python runs."""
        ticks, done = [], threading.Event()

        def tick():
            while not done.wait(1e-3):
                ticks.append(None)

        sheet = cutbench.Sheet.family("delaunay", 12800)
        made = sheet.cut(SLIT)
        simulation = cutbench.Simulation(cutbench.Scene(sheet=sheet))
        thread = threading.Thread(target=tick)
        thread.start()
        try:
            for work in (lambda: sheet.cut(SLIT, "global_remesh"), made._core.report, simulation._core.step):
                before = len(ticks)
                work()
                self.assertGreater(len(ticks), before + 2)
        finally:
            done.set()
            thread.join()


class CarriedValues(unittest.TestCase):
    def test_arrays_of_which_a_part_is_used(self):
        """The row of a vertex that no triangle has counts, for whoever gives values has it."""
        vertices = np.array([[9.0, 9], [0, 0], [1, 0], [1, 1], [7, 7], [0, 1]])
        with self.assertWarns(UserWarning):
            cut = cutbench.cut(vertices, [[1, 2, 3], [1, 3, 5]], [[-0.1, 0.4], [1.1, 0.6]], "conventional_split")
        np.testing.assert_array_equal(cut.before.given, [1, 2, 3, 5])
        for axis in (0, 1):
            np.testing.assert_allclose(cut.parents.carry(vertices[:, axis]), cut.rest[:, axis], atol=1e-15)
            np.testing.assert_allclose(cut.parents.carry(cut.before.rest[:, axis]), cut.rest[:, axis], atol=1e-15)

    def test_sheets_with_seams(self):
        """A vertex with two positions at rest has one row in the arrays, and two in the sheet."""
        vertices = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
        triangles = np.array([[0, 1, 2], [0, 2, 3]])
        rest = vertices[triangles][:, :, :2].copy()
        rest[1] += [0, 3]
        cut = cutbench.cut(vertices, triangles, [[0.5, -0.1], [0.6, 0.9]], "conventional_split", rest=rest)
        self.assertEqual(len(cut.before.vertices), 6)
        np.testing.assert_allclose(cut.parents.carry(vertices), cut.vertices, atol=1e-15)
        with self.assertRaisesRegex(cutbench.InputError, "was not made of arrays"):
            cut.cut([[0.8, 0.1], [0.9, 0.5]]).parents.carry(cut.vertices, of="arrays")

    def test_as_many_rows_left_out_as_divided(self):
        vertices = np.array([[8.0, 8, 0], [0, 0, 0], [1, 0, 0], [9, 9, 0], [1, 1, 0], [0, 1, 0]])
        triangles = np.array([[1, 2, 4], [1, 4, 5]])
        rest = vertices[triangles][:, :, :2].copy()
        rest[1] += [0, 3]
        with self.assertWarns(UserWarning):
            cut = cutbench.cut(vertices, triangles, [[0.5, -0.1], [0.6, 0.9]], "conventional_split", rest=rest)
        self.assertEqual(len(cut.before.vertices), len(vertices))
        with self.assertRaisesRegex(cutbench.InputError, "Say of="):
            cut.parents.carry(vertices)
        np.testing.assert_allclose(cut.parents.carry(vertices, of="arrays"), cut.vertices, atol=1e-15)
        np.testing.assert_allclose(cut.parents.carry(cut.before.vertices, of="sheet"), cut.vertices, atol=1e-15)


if __name__ == "__main__":
    unittest.main()
