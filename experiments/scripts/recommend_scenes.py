"""Seeded scenes for experiments/recommend_validation: those that calibrate `cutbench recommend`, and others that test it.
The two sets share no seed, sheet, kind of load or kind of cut, and no range of stiffness or of Poisson's ratio."""

import math
import random

LEFT, RIGHT = "[[-inf, -inf], [0.0, inf]]", "[[1.0, -inf], [inf, inf]]"
BOTTOM, TOP = "[[-inf, -inf], [inf, 0.0]]", "[[-inf, 1.0], [inf, inf]]"


def pin(box, velocity=None):
    return f"[[pins]]\nbox = {box}\n" + (f"velocity = {velocity}\n" if velocity else "")


def vector(x, y, z, dimension):
    return [round(v, 6) for v in (x, y, z)[:dimension]]


def chord(draw, middle, angle, length, bend):
    """A cubic Bezier of that length and direction, its two handles to the same side, bent by up to `bend` of the length."""
    along = (length * math.cos(angle), length * math.sin(angle))
    across = (-along[1], along[0])
    bends = (0, draw.uniform(-bend, bend), draw.uniform(-bend, bend), 0)
    return [[round(middle[i] + (t - 0.5) * along[i] + b * across[i], 4) for i in (0, 1)]
            for t, b in zip((0, 1 / 3, 2 / 3, 1), bends)]


# Kinds of loads: the dimension, gravity, what holds and pulls, and the cuts, for a scene that lasts T seconds.

def pulled(draw, T):
    """In the plane, left and right drawn apart; a tip at both ends of the cut, across."""
    v = draw.uniform(0.05, 0.2) / T / 2
    cut = chord(draw, (draw.uniform(0.4, 0.6), draw.uniform(0.4, 0.6)), math.pi / 2 + draw.uniform(-0.5, 0.5), draw.uniform(0.3, 0.6), 0.2)
    return 2, [0, 0], pin(LEFT, vector(-v, 0, 0, 2)) + pin(RIGHT, vector(v, 0, 0, 2)), [cut]


def sagging(draw, T):
    """In space, left and right drawn apart a little while it sags; as before."""
    v = draw.uniform(0.03, 0.1) / T / 2
    cut = chord(draw, (draw.uniform(0.4, 0.6), draw.uniform(0.4, 0.6)), math.pi / 2 + draw.uniform(-0.5, 0.5), draw.uniform(0.3, 0.6), 0.2)
    return 3, [0, 0, -9.81], pin(LEFT, vector(-v, 0, 0, 3)) + pin(RIGHT, vector(v, 0, 0, 3)), [cut]


def flap(draw, T):
    """In space, held at left and right; cut from the front border inward, and both sides of the cut fall."""
    x = draw.uniform(0.4, 0.6)
    cut = [[x, -0.1], [round(x + draw.uniform(-0.1, 0.1), 4), 0.2], [round(x + draw.uniform(-0.1, 0.1), 4), 0.4],
           [round(x + draw.uniform(-0.1, 0.1), 4), round(draw.uniform(0.5, 0.7), 4)]]
    return 3, [0, 0, -9.81], pin(LEFT) + pin(RIGHT), [cut]


def sheared(draw, T):
    """In the plane, the top slides to the right, and up; a slanted cut."""
    v, w = draw.uniform(0.05, 0.15) / T, draw.uniform(0.05, 0.12) / T
    cut = chord(draw, (draw.uniform(0.4, 0.6), draw.uniform(0.4, 0.6)), draw.uniform(-0.4, 0.4), draw.uniform(0.35, 0.6), 0.25)
    return 2, [0, 0], pin(BOTTOM) + pin(TOP, vector(v, w, 0, 2)), [cut]


def loaded(draw, T):
    """In the plane, the left held, forces at the right; cut from the upper border inward."""
    force = draw.uniform(100, 300)  # N/m: of a stiffness of 2500 to 6000
    x = draw.uniform(0.35, 0.65)
    cut = [[round(x, 4), 1.1], [round(x + draw.uniform(-0.1, 0.1), 4), 0.9], [round(x + draw.uniform(-0.1, 0.1), 4), 0.7],
           [round(x + draw.uniform(-0.1, 0.1), 4), round(draw.uniform(0.45, 0.65), 4)]]
    return 2, [0, 0], pin(LEFT) + f"[[tractions]]\nbox = {RIGHT}\nforce = [{force:.4g}, 0.0]\n", [cut]


def tongue(draw, T):
    """In space, held all round; a U is cut, and the tongue in it falls."""
    x, y, w, l = draw.uniform(0.35, 0.45), draw.uniform(0.25, 0.35), draw.uniform(0.2, 0.3), draw.uniform(0.3, 0.45)
    corners = [(x, y), (x, y + l), (x + w, y + l + draw.uniform(-0.05, 0.05)), (x + w + draw.uniform(-0.05, 0.05), y)]
    return 3, [0, 0, -9.81], pin(LEFT) + pin(RIGHT) + pin(BOTTOM) + pin(TOP), [[[round(c, 4) for c in p] for p in corners]]


SETS = {
    "calibration": dict(seed=1918, kinds=[pulled, sagging, flap], sheets=["grid", "alternating"], stiffness=(500, 2000),
                        poisson=(0.25, 0.35), density=(0.5, 2.0)),
    "validation": dict(seed=2028, kinds=[sheared, loaded, tongue], sheets=["delaunay", "graded"], stiffness=(2500, 6000),
                       poisson=(0.38, 0.47), density=(2.0, 3.0)),
}


def max_error(name, index):
    """What is asked for of a scene."""
    return round(math.exp(random.Random(f"{SETS[name]['seed']} {index} error").uniform(math.log(0.08), math.log(0.3))), 3)


def kind_of(name, index):
    return SETS[name]["kinds"][index % len(SETS[name]["kinds"])]


def scene(name, index, sheet=None):
    """Scene `index` of a set, or the same on a sheet of another kind."""
    s = SETS[name]
    draw = random.Random(f"{s['seed']} {index}")
    kind = kind_of(name, index)
    n, duration, rate = draw.randint(8, 20), round(draw.uniform(0.3, 0.9), 3), draw.choice([120, 240, 400])
    stiffness = draw.uniform(*s["stiffness"])
    material = {"density": draw.uniform(*s["density"]), "stiffness": stiffness, "poisson": draw.uniform(*s["poisson"]),
                "bending": stiffness * draw.uniform(1e-7, 1e-6), "mass_damping": draw.uniform(4, 12), "stiffness_damping": 1e-3}
    own = draw.choice(s["sheets"])
    dimension, gravity, holds, cuts = kind(draw, duration)
    if dimension == 2:
        del material["bending"]
    time = round(draw.uniform(0.1, 0.5) * duration, 4)
    lines = [f'effect = "{name} {index}: {kind.__name__}"', 'truth = "the same with finer meshes and steps"', f"duration = {duration}",
             f'[sheet]\nfamily = "{sheet or own}"\nresolution = {2 * n ** 2}', "[material]",
             *(f"{key} = {value:.6g}" for key, value in material.items()), f"[physics]\ndimension = {dimension}",
             *(['bending = "patches"'] if dimension == 3 else []), f"gravity = {gravity}", holds,
             f'[integrator]\nname = "backward_euler"\nstep = {1 / rate:.9g}', '[solver]\nname = "cg"\ntolerance = 0.01',
             *(f"[[cuts]]\ntime = {time}\n{'polyline' if kind is tongue else 'bezier'} = {cut}" for cut in cuts)]
    return "\n".join(lines) + "\n"
