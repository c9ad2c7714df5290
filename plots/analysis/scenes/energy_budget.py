"""Energy budgets of scenes in numbers."""

import pandas as pd

from analysis import frame_files, load


def read_budget(folder):
    try:
        return pd.read_csv(folder / "energy.csv")
    except (OSError, ValueError) as error:
        load.stop(f"{folder / 'energy.csv'} can't be read: {error}; `cutbench simulate --frames` makes it")


def numbers(folder):
    """Scene, method and verdict; who else has another one; remainder and jumps at the end, J, and the largest of any method."""
    description = frame_files.read_description(folder)
    everyone = [frame_files.read_description(d.parent) for d in sorted(folder.parent.glob("*/simulation.json"))]
    others = ", ".join(f"{d['method']}: {d['verdict']}" for d in everyone if d["verdict"] != "ok" and d["method"] != description["method"])
    ends = [read_budget(d.parent).iloc[-1] for d in sorted(folder.parent.glob("*/simulation.json"))]
    own = read_budget(folder).iloc[-1]
    return [description["scene"], description["method"], description["verdict"], others or "-",
            *(cell for c in ("remainder_j", "jumps_j") for cell in (f"{own[c]:.2g}", f"{max((e[c] for e in ends), key=abs):.2g}"))]
