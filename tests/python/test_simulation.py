"""Simulations that Python steps, cuts, pulls at and holds."""

import threading
import unittest

import numpy as np
from command_line import ROOT

import cutbench

MATERIAL = {"density": 0.3, "stiffness": 60.0, "poisson": 0.3, "bending": 1e-4, "mass_damping": 1.0}
UPPER = [[-1.0, 1.0], [2.0, 1.0]]


def hanging(**keys):
    """A square of 1 m that hangs from its upper side."""
    return cutbench.Scene(sheet=cutbench.Sheet.family("grid", 200), **{
        "material": MATERIAL, "physics": {"gravity": [0, -9.81, 0.5], "bending": "patches"}, "pins": [{"box": UPPER}],
        "duration": 0.25, **keys})


def free():
    """A square of 1 m and 1 kg that nothing holds."""
    return cutbench.Scene(sheet=cutbench.Sheet.family("grid", 200), material={"density": 1.0, "stiffness": 1e4})


class Scenes(unittest.TestCase):
    def test_all_ways(self):
        """A file, what it holds as a dict, and keywords are one scene."""
        import tomllib
        file = ROOT / "experiments/scenes/slit_strip.toml"
        held = tomllib.loads(file.read_text())
        wanted = cutbench.Simulation(file).run().x
        ways = cutbench.Scene(file), cutbench.Scene(held), cutbench.Scene(**held), cutbench.Scene(file, effect="other")
        for scene in ways:
            self.assertTrue(np.array_equal(cutbench.Simulation(scene).run().x, wanted))

    def test_of_arrays(self):
        scene = hanging()
        self.assertEqual((scene.dimension, scene.duration), (3, 0.25))
        self.assertEqual(len(scene.sheet.triangles), 200)
        with self.assertRaisesRegex(cutbench.InputError, "resolution"):
            scene.with_resolution(800)


class Steps(unittest.TestCase):
    def test_one_by_one(self):
        one, other = cutbench.Simulation(hanging()), cutbench.Simulation(hanging())
        one.run()
        for _ in range(60):
            other.step()
        self.assertTrue(np.array_equal(one.x, other.x) and np.array_equal(one.v, other.v))
        self.assertAlmostEqual(one.time, 0.25)
        self.assertEqual(one.verdict, "ok")
        self.assertEqual((len(one.times), len(one.budget)), (60, 61))
        self.assertEqual(one.cost["steps"], 60)

    def test_arrays(self):
        simulation = cutbench.Simulation(hanging(), "warp_and_refine").step(10)
        before = simulation.x
        self.assertEqual(simulation.cut([[0.2, 0.55], [0.83, 0.5]])["status"], "ok")
        self.assertEqual(len(simulation.cuts), 1)
        simulation.step(10)
        self.assertEqual(before.shape, (121, 3))
        x, rest, triangles = simulation.x, simulation.rest, simulation.triangles
        self.assertEqual(len(x), len(rest))
        self.assertEqual(len(simulation.v), len(x))
        self.assertTrue(np.isfinite(rest[triangles]).all())
        sheet = simulation.sheet
        self.assertTrue(np.array_equal(sheet.vertices[sheet.triangles], x[triangles]))
        self.assertTrue(np.array_equal(sheet.rest[sheet.triangles], rest[triangles]))

    def test_views(self):
        """x and v follow the steps, are left behind by a cut, and outlive the simulation."""
        simulation = cutbench.Simulation(hanging(), "warp_and_refine").step(10)
        x, v = simulation.x, simulation.v
        self.assertTrue(np.shares_memory(x, simulation.x) and np.shares_memory(v, simulation.v))
        self.assertFalse(x.flags.writeable or x.flags.owndata)
        start = x.copy()
        simulation.step(5)
        self.assertFalse(np.array_equal(x, start))
        self.assertTrue(np.array_equal(x, simulation.x) and np.array_equal(v, simulation.v))
        last = x.copy()
        simulation.cut([[0.2, 0.55], [0.83, 0.5]])
        now = simulation.x
        self.assertTrue(np.array_equal(x, last) and len(now) > len(x))
        simulation.step(5)
        self.assertTrue(np.array_equal(x, last))
        self.assertTrue(np.array_equal(now, simulation.x))
        now = now[:2]  # a part holds the whole
        last = now.copy()
        del simulation, x
        self.assertTrue(np.array_equal(now, last))

    def test_views_of_scenes_that_cut(self):
        scene = hanging(cuts=[dict(time=0.1, polyline=[[0.2, 0.55], [0.83, 0.5]])])
        simulation = cutbench.Simulation(scene).step(20)
        x = simulation.x
        simulation.step(4)
        last = x.copy()
        self.assertTrue(np.array_equal(last, simulation.x))
        simulation.step(20)
        self.assertTrue(np.array_equal(x, last) and len(simulation.x) > len(x))

    def test_view_before_a_failure(self):
        simulation = cutbench.Simulation(hanging(), "warp_and_refine").step(3)
        x = simulation.x
        with self.assertRaises(cutbench.InputError):
            simulation.cut([[7, 7, 7], [8, 8, 8]])
        self.assertTrue(np.array_equal(x, simulation.x))

    def test_plane(self):
        scene = hanging(physics={"dimension": 2, "gravity": [0, -9.81]})
        simulation = cutbench.Simulation(scene).step(5)
        self.assertEqual(simulation.x.shape[1], 2)
        self.assertTrue((simulation.sheet.vertices[:, 2] == 0).all())

    def test_picked_in_space(self):
        simulation = cutbench.Simulation(hanging()).step(20)
        corners = simulation.x[simulation.triangles[[60, 135]]]
        cut = simulation.cut(corners.mean(axis=1))
        self.assertEqual(cut["status"], "ok")

    def test_threads(self):
        """Only one at a time may step a simulation: the others are told so."""
        simulation = cutbench.Simulation(cutbench.Scene(sheet=cutbench.Sheet.family("delaunay", 3200)))
        told, steps = [], []

        def work():
            for _ in range(30):
                try:
                    simulation.step()
                    steps.append(1)
                    simulation.x, simulation.energy, simulation.sheet
                except cutbench.InputError as error:
                    told.append(str(error))

        threads = [threading.Thread(target=work) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(simulation.times), len(steps))
        self.assertTrue(all("being stepped" in line for line in told))

    def test_looked_at_by_its_own_method(self):
        def curious(sheet, path):
            return simulation.x

        simulation = cutbench.Simulation(hanging(), curious)
        with self.assertRaisesRegex(cutbench.CutError, "being stepped") as caught:
            simulation.cut([[0.2, 0.55], [0.83, 0.5]])
        self.assertEqual(caught.exception.verdict, "crashed")

    def test_failure(self):
        scene = hanging(integrator={"name": "symplectic_euler", "step": 0.05})
        with self.assertRaises(cutbench.StepError) as caught:
            cutbench.Simulation(scene).step(200)
        self.assertEqual(caught.exception.verdict, "not_finite")


class Forces(unittest.TestCase):
    def test_momentum(self):
        """Forces of 1 N on 1 kg make 1 m/s each second, and their work is in the budget."""
        simulation = cutbench.Simulation(free())
        mass = np.full(121, 1 / 121)
        force = np.zeros_like(simulation.x)
        force[:, 0] = mass
        simulation.pull(force)
        simulation.step(60)
        lumped = simulation._core.v[:, 0]
        self.assertAlmostEqual(lumped.mean(), 0.25, delta=0.01)
        simulation.pull(0)
        slow = simulation.v[:, 0].mean()
        simulation.step(20)
        self.assertAlmostEqual(simulation.v[:, 0].mean(), slow, delta=1e-3)
        self.assertEqual(simulation.verdict, "ok", simulation.reason)
        self.assertAlmostEqual(simulation.energy["kinetic"], 0.5 * 0.25**2, delta=2e-3)

    def test_nothing_is_nothing(self):
        """A force of 0 changes no bit."""
        one, other = cutbench.Simulation(hanging()), cutbench.Simulation(hanging())
        one.step(10)
        other.step(10, each=lambda s: s.pull(np.zeros_like(s.x)))
        self.assertTrue(np.array_equal(one.x, other.x))

    def test_as_gravity(self):
        """Weights as forces are as gravity is."""
        with_gravity = cutbench.Simulation(hanging(physics={"gravity": [0, -9.81, 0.0]}))
        pulled = cutbench.Simulation(hanging(physics={}))
        areas = np.zeros(121)
        sheet = pulled.scene.sheet
        for corner in range(3):
            np.add.at(areas, sheet.triangles[:, corner], 1 / 200 / 3)
        pulled.pull(np.outer(0.3 * areas, [0, -9.81, 0]))
        self.assertTrue(np.allclose(with_gravity.step(60).x, pulled.step(60).x, atol=1e-9))
        self.assertEqual(pulled.verdict, "ok", pulled.reason)


class Pins(unittest.TestCase):
    def test_the_same_pins(self):
        """Holding where it is held already changes nothing but rounding."""
        one, other = cutbench.Simulation(hanging()).step(40), cutbench.Simulation(hanging()).step(20)
        self.assertEqual(one.verdict, "ok", one.reason)
        other.hold([cutbench.Pin(UPPER)])
        self.assertTrue(np.allclose(one.x, other.step(20).x, atol=1e-12))

    def test_moved(self):
        simulation = cutbench.Simulation(hanging()).step(10)
        upper = simulation.rest[:, 1] == 1
        start = simulation.x[upper]
        simulation.hold([cutbench.Pin(UPPER, velocity=(0.1, 0, 0))])
        simulation.step(24)
        self.assertTrue(np.allclose(simulation.x[upper] - start, [0.01, 0, 0], atol=1e-12))
        simulation.hold([cutbench.Pin(UPPER)])
        simulation.step(1)
        self.assertTrue(np.allclose(simulation.x[upper] - start, [0.01, 0, 0], atol=1e-12))
        self.assertEqual(simulation.verdict, "ok", simulation.reason)

    def test_let_go(self):
        """Nothing holds it any more: it falls as everything does; and then a corner is caught."""
        simulation = cutbench.Simulation(hanging(material={"density": 0.3, "stiffness": 60.0, "bending": 1e-4})).step(30)
        simulation.hold([])
        before = simulation.v.mean(axis=0)
        simulation.step(12)
        self.assertAlmostEqual(simulation.v.mean(axis=0)[1] - before[1], -9.81 * 0.05, delta=0.05)
        simulation.hold([cutbench.Pin([[0, 0], [0, 0]])])
        corner = (simulation.rest == 0).all(axis=1)
        place = simulation.x[corner]
        simulation.step(12)
        self.assertTrue(np.array_equal(simulation.x[corner], place))

    def test_all_solvers(self):
        """A solver that keeps something of the pins from step to step notices."""
        wanted = None
        for solver in ("cg", "multigrid", "cg_sliver_blocks", "cholmod", "eigen_ldlt"):
            try:
                simulation = cutbench.Simulation(hanging(solver={"name": solver, "tolerance": 1e-12}))
            except cutbench.InputError as error:
                self.assertIn("not known", str(error))
                continue
            simulation.step(5)
            simulation.hold([cutbench.Pin([[0, 0.9], [0.5, 1]], velocity=(0, 0, 0.2))])
            x = simulation.step(10).x
            wanted = x if wanted is None else wanted
            self.assertTrue(np.allclose(x, wanted, atol=1e-7), solver)

    def test_integrators_without_solves(self):
        """Sweeps over triangles and over vertices."""
        for name in ("xpbd", "vbd"):
            simulation = cutbench.Simulation(hanging(integrator={"name": name, "step": 1 / 480, "sweeps": 8},
                                                     physics={"gravity": [0, -9.81, 0.5]}))
            low = simulation.x[:, 1].min()
            simulation.step(48)
            self.assertEqual(simulation.cut([[0.2, 0.55], [0.83, 0.5]])["status"], "ok")
            simulation.step(48)
            self.assertLess(simulation.x[:, 1].min(), low - 0.01)
            self.assertEqual((simulation.verdict, len(simulation.budget)), ("ok", 0))

    def test_threads_share_a_step(self):
        """The same bits."""
        one, other = (cutbench.Simulation(hanging(solver={"name": "multigrid", "threads": threads})).step(10).x for threads in (1, 2))
        self.assertTrue(np.array_equal(one, other))

    def test_each_step(self):
        """A loop of one's own: a gripper that swings."""
        def swing(simulation):
            simulation.hold([cutbench.Pin(UPPER, velocity=(0.5 * np.cos(20 * simulation.time), 0, 0))])
        simulation = cutbench.Simulation(hanging()).step(48, each=swing)
        upper = simulation.rest[:, 1] == 1
        self.assertAlmostEqual(simulation.x[upper, 0].mean() - 0.5, 0.5 * np.sin(20 * 0.2) / 20, delta=2e-3)
        self.assertEqual(simulation.verdict, "ok", simulation.reason)

    def test_a_failed_cut_is_an_error(self):
        """An exception of the method, and an incision that is wrong; the sheet goes on uncut."""
        def breaks_down(sheet, path):
            raise ValueError("boom")

        def does_nothing(sheet, path):
            return sheet

        for method, words in ((breaks_down, "crashed: ValueError: boom"), (does_nothing, "")):
            simulation = cutbench.Simulation(cutbench.Scene(sheet=cutbench.Sheet.family("grid", 200)), method=method)
            with self.assertRaisesRegex(cutbench.CutError, words) as caught:
                simulation.cut([[-0.1, 0.5], [1.1, 0.6]])
            self.assertEqual(caught.exception.status, "failed")
            self.assertEqual((len(simulation.step(3).triangles), simulation.verdict), (200, "ok"))

    def test_a_refused_cut_is_said(self):
        scene = hanging(physics={"gravity": [0, -9.81, 0.5], "bending": "hinges"})
        simulation = cutbench.Simulation(scene, method="cut_polygons").step(2)
        self.assertEqual((simulation.outcome, simulation.cuts_refused), ("ok", 0))
        self.assertEqual(simulation.cut([[0.2, 0.55], [0.83, 0.5]])["status"], "refused")
        simulation.step()
        self.assertEqual((simulation.verdict, simulation.cuts_refused), ("ok", 1))
        self.assertIn("ok, but 1 of 1 cuts was refused: the method's polygons have no hinges", simulation.outcome)
        self.assertIn(simulation.outcome, repr(simulation))


if __name__ == "__main__":
    unittest.main()
