#!/usr/bin/env python3
"""The rooms of plots/: analysis computes and knows no figure, figures draw what it computes, pages put both into documents.
No module of analysis loads matplotlib, and no import goes the other way. Each stem of an experiment has one script.
Scripts that no other test runs draw the published rows.
usage: tests/check_plots.py      exit code 1 and a line per fault"""

import ast
import lzma
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PLOTS = Path(__file__).resolve().parent.parent / "plots"
REFERENCE = PLOTS.parent / "results/reference"
ABOVE = {"analysis": {"figures", "pages", "matplotlib"}, "figures": {"pages"}, "pages": set()}  # not to be imported there
LOADED = """import importlib, sys
for name in sys.argv[1:]:
    importlib.import_module(name)
    if "matplotlib" in sys.modules:
        sys.exit(f"{name} loads matplotlib")
"""
faults = []


def imported(file):
    """(line, first part of the module's name) of each import."""
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, name.name.partition(".")[0]) for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.lineno, (node.module or "").partition(".")[0]


def check_arrows():
    for file in sorted(PLOTS.rglob("*.py")):
        room = file.relative_to(PLOTS).parts[0]
        if room not in ABOVE:
            faults.append(f"plots/{file.relative_to(PLOTS)} is in none of the rooms {', '.join(ABOVE)}")
            continue
        for line, other in imported(file):
            if other in ABOVE[room]:
                faults.append(f"plots/{file.relative_to(PLOTS)}:{line}: {room} must not import {other}")


def check_loaded():
    """Also what is imported on the way."""
    files = sorted((PLOTS / "analysis").rglob("*.py"))
    names = [".".join(file.relative_to(PLOTS).with_suffix("").parts) for file in files]
    done = subprocess.run([sys.executable, "-B", "-c", LOADED, *names], cwd=PLOTS, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        faults.append(done.stderr.strip())


def check_stems():
    stems = [file.stem for file in PLOTS.glob("figures/*/*.py") if file.read_text(encoding="utf-8").startswith("#!")]
    faults.extend(f"two scripts of plots/figures have the stem {stem}" for stem in sorted(set(stems)) if stems.count(stem) > 1)
    faults.extend(f"{file.name} has no script in plots/figures" for file in sorted(PLOTS.glob("../experiments/fig*.toml"))
                  if file.stem not in stems)


def check_drawn():
    """Scripts that no other test runs, of the published rows of their experiment."""
    for stem in ("out_of_plane",):
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary) / stem
            folder.mkdir()
            (folder / "records.csv").write_bytes(lzma.decompress((REFERENCE / f"{stem}.records.csv.xz").read_bytes()))
            shutil.copyfile(REFERENCE / f"{stem}.context.json", folder / "context.json")
            done = subprocess.run([sys.executable, PLOTS / f"figures/accuracy/{stem}.py", "--results", folder], capture_output=True, text=True,
                                  check=False)
            if done.returncode != 0 or not (folder / f"{stem}.png").is_file():
                faults.append(f"plots/figures/accuracy/{stem}.py: {done.stderr.strip()[-400:]}")


check_arrows()
check_loaded()
check_stems()
check_drawn()
print("\n".join(faults))
sys.exit(1 if faults else 0)
