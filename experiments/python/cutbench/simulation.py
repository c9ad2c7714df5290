"""Scenes, and simulations that are stepped and cut."""

import csv
import io
import json
import os
from functools import cached_property

import numpy as np

from . import _core, arrays
from .errors import CutError, InputError, StepError
from .method import method_of
from .paths import Curve, curves_of
from .sheet import Sheet, sheet_of, warn
from .tables import table


def _toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))  # reads back bit for bit
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value))
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(str(key))} = {_toml(entry)}" for key, entry in value.items()) + "}"
    if isinstance(value, np.ndarray):
        return _toml(value.tolist())
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_toml, value)) + "]"
    raise InputError(f"scene: {value!r} is a {type(value).__name__}, which a scene file can't hold")


class Scene:
    """A sheet, what it is made of, what holds it and pulls at it, how it is stepped and solved, and its cuts.

    Args:
        scene: a TOML file, or a dict of what one would hold (docs/reference/scenes.md). Left out: all by keywords.
        sheet: a Sheet, in m, instead of a dict with `family`, `size` and `resolution`.
        **keys: the tables and keys of a scene file, which go before those of `scene`: material=dict(density=0.3, ...),
            physics=..., pins=[dict(box=[[x0, y0], [x1, y1]]), ...], tractions=..., integrator=..., solver=..., cuts=...,
            duration=1.0. `effect` and `truth` may be left out. SI units.

    Attributes:
        step: s. duration: s. dimension: 2 or 3.
    """

    def __init__(self, scene=None, sheet=None, **keys):
        mesh = None
        if sheet is not None:
            if isinstance(sheet, dict):
                keys["sheet"] = sheet
            else:
                mesh = sheet_of(sheet)
        if isinstance(scene, (str, os.PathLike)) and not keys:
            core = _core.read_scene(os.fspath(scene))
        else:
            core = _core.scene_of_text(*_text(scene, keys))
        self._core = core.with_sheet(mesh._core) if mesh else core

    step = property(lambda self: self._core.step)
    duration = property(lambda self: self._core.duration)
    dimension = property(lambda self: self._core.dimension)

    @cached_property
    def sheet(self):
        """The Sheet before any cut."""
        return Sheet._of(self._core.sheet())

    def with_resolution(self, triangles):
        """The same scene with a sheet of so many triangles, 2 k^2."""
        scene = Scene.__new__(Scene)
        scene._core = self._core.with_resolution(int(triangles))
        return scene

    def __repr__(self):
        return f"<cutbench.Scene: {self._core.stem}, {self.duration:g} s in steps of {self.step:g} s>"


def _text(scene, keys):
    """The text of a scene file, and its name."""
    name = "scene"
    if isinstance(scene, (str, os.PathLike)):
        import tomllib
        name = os.fspath(scene)
        with open(scene, "rb") as file:
            scene = tomllib.load(file)
    elif not (scene is None or isinstance(scene, dict)):
        raise InputError(f"scene: is a {type(scene).__name__}; give a TOML file, a dict, or keywords")
    whole = {"effect": "given in Python", "truth": "none", **(scene or {}), **keys}
    return "".join(f"{json.dumps(key)} = {_toml(value)}\n" for key, value in whole.items()), name


class Pin:
    """Vertices that Simulation.hold() holds: those whose rest position lies in a box.

    Args:
        box: [[x0, y0], [x1, y1]], m, at rest.
        axes: those that are held.
        velocity: m/s, from where they are now.
    """

    def __init__(self, box, axes="xyz", velocity=(0, 0, 0)):
        if not set(axes) <= set("xyz") or not axes:
            raise InputError(f'axes: "{axes}"; give some of x, y and z')
        box = np.asarray(box, dtype=float)
        if box.shape != (2, 2) or not (box[0] <= box[1]).all():
            raise InputError("box: give [[x0, y0], [x1, y1]] with x0 <= x1 and y0 <= y1")
        velocity = arrays.in_space([velocity], "velocity")[0].tolist()
        self._core = _core.Pin(box.ravel().tolist(), [axis in axes for axis in "xyz"], velocity)


class Simulation:
    """A scene in motion, as `cutbench simulate` runs it, bit for bit.

    Args:
        scene: a Scene, or what makes one.
        method: makes the scene's cuts and those of cut(): a name or a function.
        chord_tolerance: of its cuts, in mean rest edges.
        watch: judge each step by its energies and shapes, outside the step's clock.
        **parameters: of the method.

    Rows of `x`, `v` and `rest`, and the numbers in `triangles`, are slots of vertices: a cut may leave some free, and
    adds rows. `sheet` has none that are free.

    `x` and `v` are views, read-only: asked for once, they show each step. A cut, or a try at one, ends that: an array
    of before stays as it was right before the cut; ask anew. What is to be kept is `simulation.x.copy()`.
    """

    def __init__(self, scene, method="conventional_split", chord_tolerance=0.05, watch=True, **parameters):
        self.scene = scene if isinstance(scene, Scene) else Scene(scene)
        self._core = _core.Simulation(self.scene._core, method_of(method, parameters),
                                      arrays.number(chord_tolerance, "chord_tolerance"), bool(watch))
        for pin in self.scene._core.idle_pins(self._core):
            warn(f"pins {pin}, from 0, hold no vertex of the sheet; is that meant?")

    def step(self, n=1, each=None):
        """Makes n steps, each with the scene's cuts that are due before it.

        Args:
            each: called with this simulation before each step: it may pull(), hold() and cut().

        Raises:
            StepError: a step that ends the simulation.
        """
        for _ in range(arrays.whole(n, "n")):
            if each is not None:
                each(self)
            verdict, reason = self._core.step()
            if verdict != "ok":
                raise StepError(f"{verdict} at {self.time:.4g} s: {reason}", verdict)
        return self

    def run(self, each=None):
        """Makes the steps that are left of the scene's duration (one in equilibrium)."""
        if self.scene._core.at_rest:
            return self.step(1, each)
        return self.step(max(0, int(np.ceil((self.scene.duration - self.time) / self.scene.step - 1e-9))), each)

    def cut(self, path):
        """Cuts now, before the step that is next.

        Args:
            path: in rest space, or picked on the sheet as it is now; see cutbench.cut().

        Returns:
            A dict: status ("ok", "noop", "refused" or "deviated"), verdict, reason, energies before and after (J), and
            microseconds.

        Raises:
            CutError: the method failed, or its incision is wrong; the sheet is as it was, and can be stepped on.
        """
        made = self._core.cut(curves_of(path))
        if made["status"] == "failed":
            raise CutError(f"{made['verdict']}: {made['reason']}", "failed", made["verdict"])
        if made["status"] == "noop":
            warn(f"nothing was cut: {made['reason'] or 'the path misses the sheet'}")
        return made

    def pull(self, force):
        """From now on forces pull at the vertices besides the scene's loads; 0 ends that.

        Args:
            force: N, as many rows and columns as `x`. Vertices of later cuts have none.
        """
        if np.ndim(force) == 0 and force == 0:
            return self._core.pull(np.zeros((0, self.scene.dimension)))
        force = arrays.points(force, "force", (self.scene.dimension,))
        self._core.pull(force)

    def hold(self, pins):
        """From now on these Pins hold the sheet, and none of those before."""
        pins = [pins] if isinstance(pins, Pin) else list(pins)
        for pin in pins:
            if not isinstance(pin, Pin):
                raise InputError(f"pins: {pin!r} is a {type(pin).__name__}; give a list of cutbench.Pin")
            if not self._core.holds_a_vertex(pin._core):
                warn("a pin holds no vertex of the sheet; is that meant?")
        self._core.hold([pin._core for pin in pins])

    x = property(lambda self: self._core.x, doc="slots x dimension floats: positions now, m (a view).")
    v = property(lambda self: self._core.v, doc="slots x dimension floats: velocities now, m/s (a view).")
    rest = property(lambda self: self._core.rest, doc="slots x 2 floats: rest positions, m; NaN where a slot is free.")
    triangles = property(lambda self: self._core.triangles, doc="m x 3 ints: slots of vertices.")
    sheet = property(lambda self: Sheet._of(self._core.sheet), doc="The Sheet as it is now.")
    time = property(lambda self: self._core.time, doc="Simulated, s.")
    energy = property(lambda self: self._core.energy, doc="A dict, J: membrane, bending, kinetic, potential, total.")
    cuts = property(lambda self: self._core.cuts, doc="What came of the cuts so far: a list of dicts, see cut().")
    verdict = property(lambda self: self._core.outcome[0], doc="Of all steps so far (harness/simulation/simulation.h).")
    reason = property(lambda self: self._core.outcome[1],
                      doc="Of a verdict that is not ok; of one that is: which cuts were refused, and why. Else empty.")
    cuts_refused = property(lambda self: self._core.outcome[3], doc="A number, up to a verdict that is not ok.")
    outcome = property(lambda self: self._core.outcome[4],
                       doc='One line, as `cutbench simulate` ends with: "ok", "ok, but 1 of 2 cuts was refused: ..."')

    @property
    def times(self):
        """What each step so far cost: a table with a row for each, as `cutbench simulate --steps` writes it."""
        return _table_of_csv(self._core.steps_csv())

    @property
    def budget(self):
        """Where the energy went: a table with a row for each moment (J), where the simulation is watched."""
        return _table_of_csv(self._core.budget_csv())

    @property
    def cost(self):
        """Milliseconds of each phase over all steps, as `cutbench simulate --report` has it."""
        return json.loads(self._core.summary_json())

    def show(self, ax=None, **how):
        """Draws the sheet as it is now; see cutbench.pictures.show()."""
        from . import pictures
        return pictures.show(self, ax=ax, **how)

    def animate(self, frames=48, every=4, each=None, **how):
        """Steps on, and makes an animation of it; see cutbench.pictures.animate()."""
        from . import pictures
        return pictures.animate(self, frames=frames, every=every, each=each, **how)

    def __repr__(self):
        return f"<cutbench.Simulation: {self.time:.4g} s, {self.outcome}, {len(self.triangles)} triangles>"


def _table_of_csv(text):
    rows = list(csv.DictReader(io.StringIO(text)))
    return table([{key: float(value) if value else None for key, value in row.items()} for row in rows])
