#!/usr/bin/env python3
"""Figure 10 of the paper: the detail round an incision. Over each picture: unknowns, and the distance between the
requested curve and the incision (Hausdorff, at rest, in mean edges h of the uncut sheet)."""

import tomllib

import numpy as np

import load
from render import Camera
from scene_panels import Shot, main

STEM = "fig10_level_of_detail"


def requested():
    """Points close together on the scene's Bezier."""
    with open(load.REPOSITORY / "experiments/scenes" / f"{STEM}.toml", "rb") as file:
        p = np.array(tomllib.load(file)["cuts"][0]["bezier"])
    t = np.linspace(0, 1, 2001)[:, None]
    return (1 - t) ** 3 * p[0] + 3 * (1 - t) ** 2 * t * p[1] + 3 * (1 - t) * t ** 2 * p[2] + t ** 3 * p[3]


def distances(points, a, b):
    """Of each point to the nearest of the segments a-b."""
    along = b - a
    s = np.einsum("psx,sx->ps", points[:, None] - a, along) / np.einsum("sx,sx->s", along, along)
    nearest = a + s.clip(0, 1)[..., None] * along
    return np.linalg.norm(points[:, None] - nearest, axis=2).min(axis=1)


def incision_error(frame):
    curve, (edges, _) = requested(), frame.lips()
    a, b = frame.rest[edges[:, 0]], frame.rest[edges[:, 1]]
    share = np.linspace(0, 1, 21)[:, None, None]
    return max(distances(curve, a, b).max(), distances(((1 - share) * a + share * b).reshape(-1, 2), curve[:-1],
                                                       curve[1:]).max())


def label(description, frame):
    n = np.sqrt(description["triangles_before"] / 2)
    h = description["size_m"] * (2 * n * (n + 1) + n * n * np.sqrt(2)) / (n * (3 * n + 2)) / n  # of the grid's edges
    return f"{description['unknowns']} unknowns, error {load.number(incision_error(frame) / h, 2)} h"


if __name__ == "__main__":
    main(STEM, __doc__,
         [Shot(STEM, "", 0.7, Camera(centre=(0.5, 0.5, -0.25), azimuth=20, elevation=62),
               box=(-0.27, 0.27, -0.27, 0.25))], label=label, kinds=("mesh",))
