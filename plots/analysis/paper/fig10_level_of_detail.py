"""Figure 10 of the paper: the distance at rest between the requested curve and the incision."""

import numpy as np

from analysis import frame_files, lips, load

STEM = "fig10_level_of_detail"


def distances(points, a, b):
    """Of each point to the nearest of the segments a-b."""
    along = b - a
    length2 = np.einsum("sx,sx->s", along, along)

    def nearest(some):
        s = np.einsum("psx,sx->ps", some[:, None] - a, along) / length2
        return np.linalg.norm(some[:, None] - (a + s.clip(0, 1)[..., None] * along), axis=2).min(axis=1)
    return np.concatenate([nearest(points[i:i + 500]) for i in range(0, len(points), 500)])


def incision_error(frame):
    """m"""
    curve, (edges, _) = lips.requested(STEM), frame.lips()
    a, b = frame.rest[edges[:, 0]], frame.rest[edges[:, 1]]
    share = np.linspace(0, 1, 21)[:, None, None]
    on_edges = np.unique(((1 - share) * a + share * b).reshape(-1, 2), axis=0)
    return max(distances(curve, a, b).max(), distances(on_edges, curve[:-1], curve[1:]).max())


def label(description, frame):
    return f"{description['unknowns']} unknowns, error {load.number(1000 * incision_error(frame), 2)} mm"


def read_levels(folder):
    """{(method, parameter): {tolerance: [(unknowns, error in mm)]}} of the same cut at several resolutions."""
    levels, described = {}, []
    for file in sorted(folder.glob("levels/*/*/simulation.json")):
        description = frame_files.read_description(file.parent)
        if description["verdict"] != "ok":
            continue
        method, _, parameter = description["method"].partition(" ")
        error = 1000 * incision_error(frame_files.read_frame(file.parent, 1e9))
        tolerance = str(description.get("chord_tolerance", ""))
        levels.setdefault((method, parameter), {}).setdefault(tolerance, []).append((description["unknowns"], error))
        described.append(description)
    return levels, described
