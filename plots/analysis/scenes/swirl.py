"""How far the lips of a cut turn away from those on a fine sheet."""

import numpy as np
import pandas as pd

from analysis import families, frame_files, lips, load

STEM = "swirl"
FINE, COARSER = 3362, 1682
CONVENTIONAL = "conventional_split"


def measured(results):
    """A row per cut, material and method: distance (mm) and angle (degrees) between the lips and those of the fine sheet, and
    the verdict. Method COARSER is a sheet of so many triangles. Also the descriptions."""
    rows, described = [], []
    for scene in sorted(results.glob("*/scene.toml")):
        curve = lips.requested(scene)
        length = lips.distances_along(curve)[-1]
        cut, _, material = scene.parent.name.partition("_")
        found = {}
        for file in sorted(scene.parent.glob("*/simulation.json")):
            description = frame_files.read_description(file.parent)
            described.append(description)
            name = file.parent.name.removeprefix("reference_")
            found[name] = (description, lips.by_side(frame_files.read_frame(file.parent, 1e9), curve))
        truth = found.pop(str(FINE), (None, None))[1]
        if truth is None:
            load.stop(f"{scene.parent} has no frames of a sheet of {FINE} triangles; experiments/swirl makes them")
        for name, (description, both) in found.items():
            off, turn = lips.difference(both, truth, length)
            method = name if name == str(COARSER) else description["method"].partition(" ")[0]
            rows.append({"cut": int(cut), "material": material, "method": method, "mm": 1000 * off, "degrees": turn,
                         "verdict": description["verdict"]})
    if not rows:
        load.stop(f"{results} has no scenes; experiments/swirl makes them")
    return pd.DataFrame(rows), described


def ratios(rows):
    """[method, ratio, lowest, highest, n]: the angle by the conventional split over that by each other method, of the same cut and
    material: geometric mean, and its range by cut: the materials of one cut are no trials of their own."""
    angle = rows.pivot_table(index=["cut", "material"], columns="method", values="degrees")
    found = []
    for method in angle.columns:
        if method not in (CONVENTIONAL, str(COARSER)):
            each = np.exp(np.log(angle[CONVENTIONAL] / angle[method]).groupby("cut").mean())
            found.append([families.name(method), np.exp(np.log(each).mean()), each.min(), each.max(), len(each)])
    return found
