#!/usr/bin/env python3
"""Do the tracked files stay within their budgets (experiments/scripts/weight.py)? And would the check say so if not?
usage: tests/check_weight.py      prints the sizes, and a line per fault; exit code 1 if there is any"""

import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "experiments/scripts"))
import weight

HEAVY = {"a picture": {"docs/a.png": 0.3}, "an animation": {"results/reference/a.webp": 0.5},
         "pictures": {f"results/reference/{i}.png": 0.24 for i in range(13)}, "rows": {"results/reference/a.records.csv.xz": 5.1},
         "all else": {"harness/a.cpp": 6.3}, "the sum": {"results/a.csv": 4.9, "docs/a.md": 5.0} | {f"{i}.png": 0.24 for i in range(12)}}
LIGHT = {"results/a.csv": 4.9, "docs/a.md": 3.9, "a.png": 0.2}
problems = []


def faults_of(sizes):
    return weight.faults({path: size * weight.MB for path, size in sizes.items()})


def check_the_check():
    for what, sizes in HEAVY.items():
        found = faults_of(sizes)
        if len(found) != 1 or next(iter(sizes)) not in found[0]:
            problems.append(f"{what} over its budget: said is {found}")
    if found := faults_of(LIGHT):
        problems.append(f"files within their budgets: said is {found}")
    with tempfile.TemporaryDirectory() as folder:
        if weight.tracked(Path(folder)) is not None:
            problems.append(f"{folder} has no git, and yet tracked files")


def main():
    check_the_check()
    sizes = weight.tracked(ROOT)
    if sizes:
        problems.extend(weight.faults(sizes))
        print(weight.summary(sizes))
    else:
        print("this tree has no git, so which files are tracked is not known: their weight is not checked")
    print("\n".join(problems), end="\n" * bool(problems))
    return bool(problems)


if __name__ == "__main__":
    sys.exit(main())
