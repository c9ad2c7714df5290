"""Times and errors of `experiments/frame_budgets`: places against the truth, frames by their steps, the best of a budget."""

import numpy as np
import pandas as pd

from analysis import frame_files


def places(folder):
    """[(time, positions)] of all pictures, without the first, which all share."""
    return [(frame.time, frame.deformed) for frame in frame_files.read_all(folder)][1:]


def error(truth, found):
    """Root mean square of all distances, over that of how far the sheet has moved by the last picture."""
    assert len(truth) == len(found)
    distance = moved = count = 0
    for (_, a), (_, b) in zip(truth, found):
        assert a.shape == b.shape, "one path, one method: the same vertices"
        distance += ((a - b) ** 2).sum()
        moved += ((a - a.mean(axis=0)) ** 2).sum()
        count += len(a)
    return float(np.sqrt(distance / moved))


def frame_ms(steps, frame):
    """Median and largest time of a frame, ms, cuts among them; without the first frame, which warms up."""
    table = pd.read_csv(steps)
    number = np.ceil(table["time_s"] / frame - 1e-6)
    total = table.groupby(number)["total_ms"].sum().iloc[1:]
    return float(total.median()), float(total.max())


def best(points, budget):
    """Per way: the row of least error whose median frame is within the budget (ms); none where none is."""
    within = points[(points["median_ms"] <= budget) & points["error_percent"].notna()]
    return within.loc[within.groupby("way")["error_percent"].idxmin()].set_index("way")


def table(points, budgets):
    """The text of table.txt."""
    lines = []
    ways = list(dict.fromkeys(points["way"]))
    for resolution, of in points.groupby("resolution"):
        lines.append(f"{resolution} triangles: error, % of the sheet's size, of the best setting within a frame's time (median)")
        lines.append(f"{'':28}" + "".join(f"{f'{budget:g} ms':>26}" for budget in budgets))
        for way in ways:
            cells = []
            for budget in budgets:
                rows = best(of, budget)
                if way not in rows.index:
                    cells.append("none")
                    continue
                row = rows.loc[way]
                sweeps = f", {row['sweeps']:.0f} sweeps" if row["sweeps"] else ""
                cells.append(f"{row['error_percent']:.3g} ({row['steps']:.0f} steps{sweeps})")
            lines.append(f"{way:28}" + "".join(f"{cell:>26}" for cell in cells))
        lines.append("")
    return "\n".join(lines)
