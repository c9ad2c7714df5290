#!/usr/bin/env python3
"""The programs of docs/reference/tools.md on eight problems of 800 triangles: each makes, refuses and gets wrong what it did in November
2026 (gmsh 4.8, Blender 3.4, VTK 9.1, CGAL 5.5), one more or less; and no adapter has 90 lines. Prints every disagreement;
exit code 1 if there is any. usage: tests/check_tools.py      (tests/run --with tools; 20 s)"""

import csv
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
EXPECTED = {  # right, refused, wrong
    "conventional_split": (8, 0, 0), "warp_and_refine": (8, 0, 0), "gmsh_crack": (8, 0, 0), "blender_intersect": (7, 0, 1),
    "vtk_clip": (4, 3, 1), "cgal_split": (8, 0, 0), "constrainautor": (8, 0, 0),
}
problems = []

for adapter in (ROOT / "experiments/examples/tools").iterdir():
    if adapter.suffix in (".py", ".cpp") and len(adapter.read_text(encoding="utf-8").splitlines()) >= 90:
        problems.append(f"{adapter.name} has 90 lines or more")

with tempfile.TemporaryDirectory() as folder:
    out = Path(folder) / "records.csv"
    done = subprocess.run([ROOT / "experiments/tools", "--set", "random", "--only", "grid800_", "--out", out], stdout=subprocess.DEVNULL)
    if done.returncode:
        sys.exit(f"experiments/tools ended with {done.returncode}")
    with out.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
for tool, expected in EXPECTED.items():
    found = Counter(row["outcome"] for row in rows if row["tool"] == tool)
    found = tuple(found[outcome] for outcome in ("right", "refused", "wrong"))
    if sum(found) != sum(expected) or max(abs(a - b) for a, b in zip(found, expected)) > (tool not in ("conventional_split", "warp_and_refine")):
        problems.append(f"{tool}: right, refused, wrong are {found}, not {expected}")

print("\n".join(problems))
sys.exit(1 if problems else 0)
