#!/usr/bin/env python3
"""The energy budget of each scene. Stacked areas: kinetic energy, elastic energy (membrane and bending), and the losses by
damping and by backward Euler. Line: work of gravity and of the pinned vertices. The gap between the line and the areas is
the remainder, which is the error of the linearisation, and the jumps at cuts. Dotted: time of a cut, or start of a blade's
cut. The title of each panel states remainder and jumps, and the largest ones by any method."""

import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

import contact_sheet
from common import load, render, scene_panels, style

PARTS = {"kinetic": "#56b4e9", "elastic": "#009e73", "damping": "#d9b38c", "numerical loss": "#b9b9b9"}


def read_budget(folder):
    try:
        return pd.read_csv(folder / "energy.csv")
    except (OSError, ValueError) as error:
        load.stop(f"{folder / 'energy.csv'} can't be read: {error}; `cutbench simulate --frames` makes it")


def panel(ax, folder, description):
    b = read_budget(folder)
    parts = [b["kinetic_j"], b["membrane_j"] + b["bending_j"], b["damping_j"], b["numerical_loss_j"]]
    parts = [p - p.iloc[0] for p in parts]
    ax.stackplot(b["time_s"], parts, colors=PARTS.values(), linewidth=0)
    ax.plot(b["time_s"], b["potential_j"].iloc[0] - b["potential_j"] + b["pin_work_j"], color="black", linewidth=0.8)
    for cut in description["cuts"]:
        ax.axvline(cut["time_s"], color="#b0001e", linewidth=0.7, linestyle=":")
    ax.set_xlim(0, b["time_s"].iloc[-1])
    ax.set_ylim(0)
    others = [read_budget(d.parent).iloc[-1] for d in sorted(folder.parent.glob("*/simulation.json"))]
    verdicts = sorted({render.read_description(d.parent)["verdict"] for d in folder.parent.glob("*/simulation.json")} - {"ok"})
    end = b.iloc[-1]
    worst = {c: max((o[c] for o in others), key=abs) for c in ("remainder_j", "jumps_j")}
    ax.set_title(f"{description['scene'].replace('_', ' ')}{': ' if verdicts else ''}{', '.join(verdicts)}\nremainder "
                 f"{end['remainder_j']:.2g} J, largest {worst['remainder_j']:.2g}\njumps {end['jumps_j']:.2g} J, "
                 f"largest {worst['jumps_j']:.2g}", fontsize=4.8, pad=2, color="#b0001e" if verdicts else "black")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results",
                        help="holds STEM/SCENE/METHOD with frames, receives energy_budget (default: results)")
    results = parser.parse_args().results
    folders = contact_sheet.folders_of(results)
    descriptions = [render.read_description(d) for d in folders]
    n = scene_panels.same((d["triangles_before"] for d in descriptions), "the number of triangles")
    rows = (len(folders) + 1) // 2
    figure, axes = plt.subplots(rows, 2, figsize=(style.WIDTH, 1.12 * rows), squeeze=False, layout="constrained")
    for ax in axes.flat[len(folders):]:
        ax.axis("off")
    for ax, folder, description in zip(axes.flat, folders, descriptions):
        panel(ax, folder, description)
    for ax in axes[:, 0]:
        ax.set_ylabel("energy, J")
    for i, ax in enumerate(axes.flat[:len(folders)]):
        if i + 2 >= len(folders):
            ax.set_xlabel("time, s")
    style.finish(figure, [], f"{' '.join(__doc__.split())} By {contact_sheet.METHOD}; n = {n} triangles before the cuts, "
                 f"{' or '.join(sorted({d['solver'] for d in descriptions}))}, as the scene files state. No seed: the cuts are in experiments/scenes; {scene_panels.commits(descriptions)}. "
                 "Command: plots/energy_budget.py",
                 [Patch(color=c, label=name) for name, c in PARTS.items()]
                 + [Line2D([], [], color="black", linewidth=0.8, label="work of gravity and pins")])
    style.save(figure, results, "energy_budget")


if __name__ == "__main__":
    main()
