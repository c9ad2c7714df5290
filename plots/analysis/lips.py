"""The lips of an incision along the Bezier that was asked for: where either is, and how the lips of two sheets
differ."""

import tomllib
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from analysis import load

TIPS = 0.02  # of the curve, at either end: left out where lips are compared


def requested(scene):
    """Points close together on the first cut of a scene, one cubic Bezier in rest space, m. \\param scene  a file, or the name of
    one of experiments/scenes"""
    with open(scene if isinstance(scene, Path) else load.REPOSITORY / "experiments/scenes" / f"{scene}.toml", "rb") as file:
        p = np.array(tomllib.load(file)["cuts"][0]["bezier"])
    t = np.linspace(0, 1, 2001)[:, None]
    return (1 - t) ** 3 * p[0] + 3 * (1 - t) ** 2 * t * p[1] + 3 * (1 - t) * t ** 2 * p[2] + t ** 3 * p[3]


def distances_along(curve):
    return np.r_[0, np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))]


def by_side(frame, curve):
    """{+1, -1: (distances along the curve, places in space)} of the lip to the left of the curve, to its right."""
    edges, owner = frame.lips()
    middle = frame.rest[edges].mean(axis=1)
    inwards = frame.rest[frame.triangles[owner]].mean(axis=1) - middle
    nearest = cKDTree(curve)
    at = nearest.query(middle)[1].clip(1, len(curve) - 2)
    along = curve[at + 1] - curve[at - 1]
    left = along[:, 0] * inwards[:, 1] > along[:, 1] * inwards[:, 0]
    travelled = distances_along(curve)
    sides = {}
    for side, chosen in ((1, left), (-1, ~left)):
        vertices = np.unique(edges[chosen])
        place = travelled[nearest.query(frame.rest[vertices])[1]]
        order = np.argsort(place, kind="stable")
        sides[side] = place[order], frame.deformed[vertices[order]]
    return sides


def between(lip, at):
    return np.stack([np.interp(at, lip[0], x) for x in lip[1].T], axis=-1)


def difference(lips, truth, length):
    """How far the lips are from where they should be (root mean square, m), and how far they turn away from where they
    should point, edge by edge (root mean square, degrees): a lip that swirls does, one that is only displaced doesn't."""
    samples = np.linspace(TIPS, 1 - TIPS, 1000) * length
    offsets, turns, weights = [], [], []
    for side, lip in lips.items():
        offsets.append(np.linalg.norm(between(lip, samples) - between(truth[side], samples), axis=1))
        ends = lip[0][(lip[0] >= samples[0]) & (lip[0] <= samples[-1])]
        a, b = ends[:-1], ends[1:]
        a, b = a[b - a > 1e-4 * length], b[b - a > 1e-4 * length]
        here, there = between(lip, b) - between(lip, a), between(truth[side], b) - between(truth[side], a)
        cosine = (here * there).sum(axis=1) / np.linalg.norm(here, axis=1) / np.linalg.norm(there, axis=1)
        turns.append(np.degrees(np.arccos(cosine.clip(-1, 1))))
        weights.append(b - a)
    turns, weights = np.concatenate(turns), np.concatenate(weights)
    return np.sqrt(np.mean(np.concatenate(offsets) ** 2)), np.sqrt((turns ** 2 * weights).sum() / weights.sum())
