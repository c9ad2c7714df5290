#!/usr/bin/env python3
"""Is the largest explicit step that cutbench predicts after a cut the one that is found by running? One cut by each of three
methods. Prints every disagreement; exit code 1 if there is any. usage: check_explicit_steps.py PROGRAM, that of this tree"""

import csv
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
METHODS = ["conventional_split", "warp_and_refine", "cut_polygons"]

with tempfile.TemporaryDirectory() as folder:
    out = Path(folder) / "records.csv"
    subprocess.run([ROOT / "experiments/explicit_steps", "--methods", ",".join(METHODS), "--cuts", "1", "--triangles", "200", "--out", out],
                   env=os.environ | {"CUTBENCH": sys.argv[1]}, check=True)
    with out.open(newline="", encoding="utf-8") as file:
        rows = {row["method"]: row for row in csv.DictReader(file)}
problems = [f"{method}: found over predicted is {rows[method]['found_over_predicted']}" for method in METHODS
            if not 0.97 < float(rows[method]["found_over_predicted"] or 0) < 1.03]
print("\n".join(problems))
sys.exit(1 if problems else 0)
