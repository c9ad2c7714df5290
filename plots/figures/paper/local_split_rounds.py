#!/usr/bin/env python3
"""The local split, taken literally, round by round: prints how many triangles keep an aspect ratio above 3. Reads
results/local_split_rounds."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load

STEM = "local_split_rounds"
MEASURES = ["over_3_cut", "vertices_added", "ar_max_cut"]


def main():
    run = load.read(load.results_folder(STEM, __doc__), MEASURES).first_repetition()
    rows = []
    for parameter, cuts in run.rows.groupby("parameter"):
        largest = cuts["ar_max_cut"]
        rows.append([parameter.removeprefix("rounds="), *(cuts[c].median() for c in ("over_3_cut", "vertices_added")),
                     *(largest.quantile(q) for q in (0.25, 0.5, 0.75)), f"{(largest < 3).sum()} of {len(cuts)}"])
    load.print_table("The local split, round by round: medians over the cuts, of the largest aspect ratio the quartiles, too",
                     ["rounds", "triangles > 3", "vertices added", "AR q1", "median", "q3", "cuts with AR < 3"], rows)


if __name__ == "__main__":
    main()
