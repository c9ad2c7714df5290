"""What can't be used is one exception with one clear line; never a crash, and never a silent guess."""

import math
import unittest

import numpy as np

import cutbench

V = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
T = np.array([[0, 1, 2], [0, 2, 3]])
P = np.array([[-0.1, 0.4], [1.1, 0.6]])
NAN, INF = math.nan, math.inf


def changed(array, index, value, dtype=None):
    array = np.array(array, dtype=dtype)
    array[index] = value
    return array


BAD = {  # what: (arguments of cut(), a part of the message)
    "vertices of one number": ((1.0, T, P), "vertices: has the shape of a single number"),
    "vertices in a row": ((V.ravel(), T, P), "vertices: has the shape 12"),
    "vertices n x 4": ((np.ones((4, 4)), T, P), "vertices: has the shape 4 x 4"),
    "vertices n x 1": ((np.ones((4, 1)), T, P), "vertices: has the shape 4 x 1"),
    "vertices n x 3 x 1": ((V[:, :, None], T, P), "vertices: has the shape 4 x 3 x 1"),
    "no vertices": ((np.zeros((0, 3)), T, P), "vertices: is empty"),
    "an empty list": (([], T, P), "vertices: has the shape 0"),
    "ragged vertices": (([[0, 0], [1, 0, 0], [1, 1]], T, P), "vertices: no array"),
    "vertices as words": (([["a", "b"], ["c", "d"]], T, P), "vertices: has the type"),
    "vertices as objects": ((np.array([[None, 1]] * 4, dtype=object), T, P), "vertices: has the type object"),
    "complex vertices": ((V.astype(complex), T, P), "vertices: has the type complex128"),
    "vertices of truth values": ((V.astype(bool), T, P), "vertices: has the type bool"),
    "vertices as dates": ((np.array([["2020-01-01"] * 2] * 4, dtype="datetime64[D]"), T, P), "vertices: has the type datetime64"),
    "long doubles": ((V.astype(np.longdouble), T, P), "vertices: has the type float128"),
    "masked vertices": ((np.ma.masked_equal(V, 1.0), T, P), "vertices: is a masked array"),
    "a NaN": ((changed(V, (2, 1), NAN), T, P), "vertices: row 2 has a number that is not finite"),
    "an infinity": ((changed(V, (3, 0), -INF), T, P), "vertices: row 3 has a number that is not finite"),
    "beyond 1e60": ((changed(V, (3, 0), 1e61), T, P), "beyond 1e60"),
    "None": ((None, T, P), "vertices: has the type object"),
    "a dict": (({"v": V}, T, P), "vertices: has the type object"),
    "triangles m x 4": ((V, np.zeros((2, 4), int), P), "triangles: has the shape 2 x 4"),
    "triangles in a row": ((V, T.ravel(), P), "triangles: has the shape 6"),
    "no triangles": ((V, np.zeros((0, 3), int), P), "triangles: is empty"),
    "triangles of floats": ((V, T.astype(float), P), "triangles: has the type float64"),
    "triangles of truth values": ((V, T.astype(bool), P), "triangles: has the type bool"),
    "triangles as words": ((V, T.astype(str), P), "triangles: has the type"),
    "an index beyond the vertices": ((V, changed(T, (1, 2), 4), P), "triangles: row 1 has the corner 4"),
    "an index counted from 1": ((V, T + 1, P), "triangles: row 1 has the corner 4"),
    "a negative index": ((V, changed(T, (0, 0), -1), P), "triangles: row 0 has the corner -1"),
    "an index beyond 32 bits": ((V, changed(T, (0, 0), 2**40, np.int64), P), "triangles: row 0 has the corner 1099511627776"),
    "an index beyond 63 bits": ((V, changed(T, (0, 0), 2**63 + 2, np.uint64), P), "triangles: row 0 has the corner"),
    "ragged triangles": ((V, [[0, 1, 2], [0, 2]], P), "triangles: no array"),
    "a corner twice": ((V, changed(T, (0, 1), 0), P), "the same corner twice"),
    "a triangle twice": ((V, np.array([T[0], T[1], T[0]]), P), "the same rest corners"),
    "zero area": ((changed(V, 2, [2, 0, 0]), T, P), "zero area"),
    "a curved sheet without rest": ((changed(V, (2, 2), 0.5), T, P), "rest"),
    "too small": ((V * 1e-61, T, P * 1e-61), "too small"),
    "too far away": ((V + [1e12, 0, 0], T, P), "too far from the origin"),
    "a path of one number": ((V, T, 3), "path: is a int"),
    "no path": ((V, T, None), "path: is not given"),
    "an empty path": ((V, T, []), "path: is empty"),
    "an empty array as a path": ((V, T, np.zeros((0, 2))), "path: is empty"),
    "a path of one point": ((V, T, P[:1]), "path"),
    "a path in a row": ((V, T, P.ravel()), "path: has the shape 4"),
    "a path k x 4": ((V, T, np.ones((2, 4))), "path: has the shape 2 x 4"),
    "a path with a NaN": ((V, T, changed(P, (1, 0), NAN)), "path: row 1 has a number that is not finite"),
    "a path beyond 1e60": ((V, T, changed(P, (1, 0), 1e61)), "path"),
    "a path of words": ((V, T, [["a", "b"], ["c", "d"]]), "path: has the type"),
    "a path that misses": ((V, T, P + 10), "misses the sheet"),
    "a path off the sheet in space": ((V, T, [[0.5, 0.5, 3], [0.6, 0.6, 3]]), "path, cut 0"),
    "a path file that is not there": ((V, T, "nowhere.json"), "nowhere.json"),
    "a path that is no path": ((V, T, {"bezier": P}), "path: is a dict"),
}
BAD_KEYWORDS = {  # what: (keywords of cut(), a part of the message)
    "rest of another length": ({"rest": V[:3, :2]}, "rest: 3 rows; give as many"),
    "rest n x 1": ({"rest": V[:, :1]}, "rest: has the shape 4 x 1"),
    "rest with a NaN": ({"rest": changed(V[:, :2], (0, 0), NAN)}, "rest: row 0"),
    "rest in space, curved": ({"rest": changed(V, (2, 2), 0.5)}, "rest"),
    "rest per corner": ({"rest": np.zeros((7, 3, 2))}, "rest: has the shape 7 x 3 x 2; a position per corner"),
    "rest by an unknown word": ({"rest": "flat"}, 'rest: "flat" is not known'),
    "rest as None": ({"rest": None}, "rest: has the type object"),
    "rest without area": ({"rest": np.zeros((4, 2))}, "zero area"),
    "an unknown method": ({"method": "warp_and_refin"}, 'unknown method "warp_and_refin"'),
    "a method that is a number": ({"method": 3}, "method: is a int"),
    "a function with a method's name": ({"method": type("f", (), {"__call__": None, "__name__": "example"})()}, "method"),
    "a parameter that is another's": ({"rounds": 2}, 'the parameter of "warp_and_refine" is reach'),
    "a parameter of a method without": ({"method": "example", "reach": 2}, "has no parameter"),
    "a parameter out of range": ({"reach": 3}, "reach"),
    "a parameter that is no number": ({"reach": "far"}, "reach: 'far' is not a number"),
    "a tolerance of 0": ({"chord_tolerance": 0}, "chord_tolerance: must be positive"),
    "a tolerance that is NaN": ({"chord_tolerance": NAN}, "chord_tolerance: is not a number"),
    "a tolerance that is a word": ({"chord_tolerance": "small"}, "chord_tolerance: 'small' is not a number"),
}


class BadArguments(unittest.TestCase):
    def refuse(self, call, part):
        with self.assertRaises(cutbench.InputError) as caught:
            call()
        text = str(caught.exception)
        self.assertIn(part, text)
        self.assertNotIn("\n", text)

    def test_at_least_forty_kinds(self):
        self.assertGreaterEqual(len(BAD) + len(BAD_KEYWORDS), 40)

    def test_arrays(self):
        for what, (arguments, part) in BAD.items():
            with self.subTest(what):
                self.refuse(lambda: cutbench.cut(*arguments), part)

    def test_keywords(self):
        for what, (keywords, part) in BAD_KEYWORDS.items():
            with self.subTest(what):
                self.refuse(lambda: cutbench.cut(V, T, P, **keywords), part)

    def test_mends_are_keywords(self):
        """What to do is said in Python's words, not those of the command line."""
        with self.assertRaisesRegex(cutbench.InputError, r"misses the sheet.*allow_miss=True"):
            cutbench.cut(V, T, [[5, 5], [6, 6]])
        with self.assertRaisesRegex(cutbench.InputError, r'give rest="space"'):
            cutbench.Sheet(changed(V, (2, 2), 0.5), T, "plane")

    def test_broken_beziers_and_rays(self):
        self.refuse(lambda: cutbench.bezier(P), "path")
        self.refuse(lambda: cutbench.bezier([[0, 0], [0.2, 1], [0.5, 1], [1, 0.5]], closed=True), "path")
        self.refuse(lambda: cutbench.rays(V, V[:2]), "directions: 2 rows")
        self.refuse(lambda: cutbench.rays(V[:2], np.zeros((2, 3))), "path")
        self.refuse(lambda: cutbench.rays(V[:2, :2], V[:2]), "origins: has the shape 2 x 2")

    def test_scenes(self):
        sheet = cutbench.Sheet(V, T)
        for what, (keywords, part) in {
            "an unknown key": ({"materials": {}}, 'unknown key "materials"'),
            "an unknown key of a table": ({"material": {"densty": 1}}, "densty"),
            "a value of the wrong kind": ({"material": {"density": "light"}}, "density"),
            "a value out of range": ({"material": {"density": -1.0}}, "density"),
            "what no file holds": ({"material": {"density": object()}}, "scene file can't hold"),
            "a sheet that is none": ({"sheet": 3}, "sheet: is a int"),
            "a step that is too long": ({"integrator": {"step": 3.0}}, "step"),
        }.items():
            with self.subTest(what):
                self.refuse(lambda: cutbench.Scene(**{"sheet": sheet, **keywords}), part)
        self.refuse(lambda: cutbench.Scene(3), "scene: is a int")
        self.refuse(lambda: cutbench.Scene("nowhere.toml"), "nowhere.toml")

    def test_forces_and_pins(self):
        simulation = cutbench.Simulation(cutbench.Scene(sheet=cutbench.Sheet(V, T)))
        self.refuse(lambda: simulation.pull(np.zeros((2, 3))), "forces")
        self.refuse(lambda: simulation.pull(np.zeros((4, 2))), "force: has the shape 4 x 2")
        self.refuse(lambda: simulation.pull(np.full((4, 3), NAN)), "force: row 0")
        self.refuse(lambda: cutbench.Pin([[1, 1], [0, 0]]), "box")
        self.refuse(lambda: cutbench.Pin([[0, 0], [1, 1]], axes="w"), "axes")
        self.refuse(lambda: simulation.cut([[5, 5], [6, 6, ]][:1]), "path")

    def test_results_to_score(self):
        sheet = cutbench.Sheet(V, T)
        self.refuse(lambda: cutbench.score(sheet, P, 3), "after: is a int")
        self.refuse(lambda: cutbench.score(sheet, P, (V[:, :1], T)), "after: its vertices")
        self.refuse(lambda: cutbench.score(sheet, P, (V, T, V)), "after: its rest positions")
        self.refuse(lambda: cutbench.score(3, P, sheet), "sheet: is a int")
        self.refuse(lambda: cutbench.score(sheet, P, (V, T + 0.5)), "after: its triangles are of the type float64")
        self.assertIn("misses the sheet", cutbench.score(sheet, P + 5, sheet.cut(P)).findings[0].text)
        cut = sheet.cut(P, "conventional_split")
        unused = cutbench.score(sheet, P, (np.vstack([cut.vertices, [[9, 9, 9]]]), cut.triangles, np.vstack([cut.rest, [[9, 9]]])))
        self.assertIn(f"no triangle has vertex {len(cut.vertices)}", unused.findings[0].text)
        self.assertIn("leave it out", unused.findings[0].mend)

    def test_sheets_and_triangles_together(self):
        sheet = cutbench.Sheet(V, T)
        self.refuse(lambda: cutbench.cut(V, None, P), "give a Sheet, a Cut, or vertices together with triangles")
        self.refuse(lambda: cutbench.cut(sheet, T, P), "triangles: the sheet has its own")
        self.refuse(lambda: sheet.cut(P, "warp_and"), "cutbench.methods()")
        fin = np.vstack([V[:, :2], [[0.2, 0.9]]]), np.vstack([T, [[0, 2, 4]]])
        self.refuse(lambda: cutbench.cut(*fin, P), "triangle")

    def test_numbers_of_steps_frames_and_cases(self):
        sheet = cutbench.Sheet.family("grid", 200)
        simulation = cutbench.Simulation(cutbench.Scene(sheet=sheet))
        self.refuse(lambda: simulation.step(1.5), "n: 1.5 is not a whole number")
        self.refuse(lambda: simulation.step(-1), "n: -1 is not 0 or more")
        self.refuse(lambda: simulation.animate(frames=0), "frames: 0 is not 1 or more")
        self.refuse(lambda: simulation.hold([(1, 2)]), "give a list of cutbench.Pin")
        self.refuse(lambda: sheet.random_cut(case=-1), "case: -1 is not 0 or more")
        self.refuse(lambda: cutbench.Scene(sheet=sheet, duration="long"), "give a number")
        with self.assertRaisesRegex(cutbench.InputError, "0 is not a number above 0"):
            cutbench.run("x.toml", cases=0)

    def test_carried_values(self):
        parents = cutbench.cut(V, T, P).parents
        self.refuse(lambda: parents.carry(np.ones(5)), "values: 5 rows; give one for each of the 4 vertices before")
        self.refuse(lambda: parents.carry(["a"] * 4), "values: has the type")

    def test_one_exception_without_another_before_it(self):
        for vertices, triangles in ((changed(V, (2, 1), NAN), T), (V, T + 1)):
            with self.assertRaises(cutbench.InputError) as caught:
                cutbench.Sheet(vertices, triangles)
            self.assertTrue(caught.exception.__suppress_context__)

    def test_notes_are_of_the_callers_line(self):
        for turned in (T[:, ::-1], T[:, ::-1].copy()):  # converted, and as the library takes it
            with self.assertWarns(UserWarning) as caught:
                cutbench.cut(V, turned, P)
            self.assertEqual(caught.filename, __file__)
            with self.assertWarnsRegex(UserWarning, "clockwise"), self.assertRaisesRegex(cutbench.InputError, "misses"):
                cutbench.cut(V, turned, P + 5)
        simulation = cutbench.Simulation(cutbench.Scene(sheet=cutbench.Sheet(V, T)))
        with self.assertWarnsRegex(UserWarning, "nothing was cut") as caught:
            simulation.cut(P + 5)
        self.assertEqual(caught.filename, __file__)
        with self.assertWarnsRegex(UserWarning, "a pin holds no vertex"):
            simulation.hold(cutbench.Pin([[7, 7], [8, 8]]))
        with self.assertWarnsRegex(UserWarning, "pins 1, from 0, hold no vertex"):
            cutbench.Simulation(cutbench.Scene(sheet=cutbench.Sheet(V, T), pins=[
                {"box": [[-1, 1], [2, 1]]}, {"box": [[5, 5], [6, 6]]}]))


class GoodArguments(unittest.TestCase):
    """Kinds of arrays that must not matter."""

    def test_all_kinds_of_arrays(self):
        wanted = cutbench.cut(V, T, P)
        locked = V.copy()
        locked.flags.writeable = False
        for what, arguments in {
            "lists": (V.tolist(), T.tolist(), P.tolist()),
            "a list of a list": (V, T, [P.tolist()]),
            "tuples": (tuple(map(tuple, V)), tuple(map(tuple, T)), tuple(map(tuple, P))),
            "two numbers": (V[:, :2], T, P),
            "read-only": (locked, T, P),
            "by columns": (np.asfortranarray(V), np.asfortranarray(T), np.asfortranarray(P)),
            "every second row": (np.repeat(V, 2, axis=0)[::2], np.repeat(T, 2, axis=0)[::2], P),
            "backwards": (V[::-1][::-1], T[::-1][::-1], P),
            "single precision": (V.astype(np.float32), T.astype(np.int32), P),
            "whole numbers": (V.astype(int), T.astype(np.uint8), P),
            "another order of bytes": (V.astype(">f8"), T.astype(">i8"), P),
        }.items():
            with self.subTest(what):
                made = cutbench.cut(*arguments)
                for name in ("vertices", "triangles", "rest"):
                    self.assertTrue(np.array_equal(getattr(made, name), getattr(wanted, name)))

    def test_repairs_are_warnings(self):
        with self.assertWarnsRegex(UserWarning, "clockwise"):
            sheet = cutbench.Sheet(V, T[:, ::-1])
        self.assertEqual(len(sheet.triangles), 2)

    def test_what_is_given_stays(self):
        before = V.copy()
        cutbench.cut(V, T, P)
        self.assertTrue(np.array_equal(V, before))


if __name__ == "__main__":
    unittest.main()
