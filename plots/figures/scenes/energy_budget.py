#!/usr/bin/env python3
"""The energy budget of each scene. Stacked areas: kinetic energy, elastic energy (membrane and bending), and the losses by
damping and by backward Euler. Line: the energy at first, and the work of gravity and of the pinned vertices. The gap between
the line and the areas is the remainder, which is the error of the linearisation, and the jumps at cuts; energy_budget.txt has
both in numbers. Dotted: time of a cut, or start of a blade's cut."""

import argparse
import contextlib
import io
import sys
from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import frame_files, load
from analysis.scenes import overview, scene_frames
from analysis.scenes.energy_budget import numbers, read_budget
from figures.common import style

LIGHT = 0.2  # of the largest energy: a sheet that has less
PARTS = {"kinetic": "#56b4e9", "elastic": "#009e73", "damping": "#d9b38c", "numerical loss": "#b9b9b9"}


def panel(ax, folder, description):
    b = read_budget(folder)
    parts = [b["kinetic_j"], b["membrane_j"] + b["bending_j"], b["damping_j"], b["numerical_loss_j"]]
    at_first = sum(p.iloc[0] for p in parts)
    ax.stackplot(b["time_s"], parts, colors=PARTS.values(), linewidth=0)
    ax.plot(b["time_s"], at_first + b["potential_j"].iloc[0] - b["potential_j"] + b["pin_work_j"], color="black", linewidth=0.8)
    for cut in description["cuts"]:
        ax.axvline(cut["time_s"], color="#b0001e", linewidth=0.7, linestyle=":")
    ax.set_xlim(0, b["time_s"].iloc[-1])
    failed = [] if description["verdict"] == "ok" else [description["verdict"].replace("_", " ")]
    ax.set_title(": ".join([overview.title(description["scene"]), *failed]), loc="left", color="#b0001e" if failed else "black")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results",
                        help="holds STEM/SCENE/METHOD with frames, receives energy_budget (default: results)")
    results = parser.parse_args().results
    folders = overview.folders_of(results)
    descriptions = [frame_files.read_description(d) for d in folders]
    n = ", ".join(map(str, sorted({d["triangles_before"] for d in descriptions})))
    columns = min(4, len(folders))
    rows = -(-len(folders) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(style.PAGE, 1.05 * rows), squeeze=False)
    for ax in axes.flat[len(folders):]:
        ax.axis("off")
    for i, (ax, folder, description) in enumerate(zip(axes.flat, folders, descriptions)):
        panel(ax, folder, description)
        ax.set_ylabel("" if i % columns else "energy, J")
        ax.set_xlabel("time, s" if i + columns >= len(folders) else "")
        ax.xaxis.set_major_locator(MaxNLocator(3))
    most = [ax.dataLim.y1 for ax in axes.flat[:len(folders)]]
    for i, (ax, own) in enumerate(zip(axes.flat, most)):
        is_light = own < LIGHT * max(most)  # has an axis of its own
        ax.set_ylim(0, 1.05 * (own if is_light else max(most)))
        ax.tick_params(axis="y", labelleft=is_light or not i % columns)
    by = " or ".join(sorted({d["method"] for d in descriptions}))
    style.finish(figure, [], f"{' '.join(__doc__.split())} By {by}; n = {n} triangles before the cuts, "
                 f"{' or '.join(sorted({d['solver'] for d in descriptions}))}, as the scene files state. No seed: the cuts are in experiments/scenes; {scene_frames.commits(descriptions)}. "
                 "Command: plots/figures/scenes/energy_budget.py",
                 [Patch(color=c, label=name) for name, c in PARTS.items()]
                 + [Line2D([], [], color="black", linewidth=0.8, label="energy at first, work of gravity and pins")])
    style.save(figure, results, "energy_budget")
    text = io.StringIO()
    with contextlib.redirect_stdout(text):
        load.print_table(f"Energy budgets: remainder and jumps at cuts, J, and the largest by any method; {scene_frames.commits(descriptions)}",
                         ["scene", "method", "verdict", "not ok", "remainder", "largest", "jumps", "largest"], [numbers(f) for f in folders])
    load.write_beside(results / "energy_budget.txt", text.getvalue())


if __name__ == "__main__":
    main()
