"""Checks the fall of a cut-out in the frames of a simulation: by backward Euler with mass damping alpha, the velocity of its
centre of mass must follow v+ = (v - g h) / (1 + alpha h) in every step."""

import tomllib

import numpy as np

from analysis import frame_files, load


def centre_of_smaller_piece(frame):
    a, b, c = (frame.rest[frame.triangles[:, i]] for i in range(3))
    area = np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
    piece = frame.cell["piece"]
    area = area * (piece == min(set(piece), key=lambda p: area[piece == p].sum()))
    return (area[:, None] * frame.deformed[frame.triangles].mean(axis=1)).sum(axis=0) / area.sum()


def deviation(folder):
    """Largest difference of the mean velocity between two frames from what the law makes of the one before, m/s; and
    the number of such spans. The law over k steps, u = -g / alpha being where it leads to: v_k - u = a^k (v_0 - u),
    a = 1 / (1 + alpha h); the same for means over k steps, which is what frames tell."""
    description = frame_files.read_description(folder)
    with open(load.REPOSITORY / "experiments/scenes" / f"{description['scene']}.toml", "rb") as file:
        scene = tomllib.load(file)
    alpha, gravity = scene["material"]["mass_damping"], np.array(scene["physics"]["gravity"])
    cut = description["cuts"][0]["time_s"] + 0.5 * description["step_s"]
    frames = [f for f in frame_files.read_all(folder) if f.time > cut and len(set(f.cell["piece"])) == 2]
    times = np.array([f.time for f in frames])
    steps = np.diff(times)[0] / description["step_s"]
    whole = np.concatenate([[True], np.isclose(np.diff(times), np.diff(times)[0])])  # the last may follow sooner
    place = np.array([centre_of_smaller_piece(f) for f in frames])[whole]
    velocity, end = np.diff(place, axis=0) / np.diff(times[whole])[:, None], gravity / alpha
    law = end + (1 + alpha * description["step_s"]) ** -steps * (velocity[:-1] - end)
    return np.abs(velocity[1:] - law).max(), len(law)


def sentence(column):
    """A sentence for the caption, about all panels of a scene, whose folders are given."""
    found = [deviation(folder) for folder in column]
    return (f"Centre of mass of the cut-out: differs from the law v+ = (v - g h) / (1 + alpha h) by at most "
            f"{max(d for d, _ in found):.0e} m/s in {sum(n for _, n in found)} spans between frames, all methods.")
