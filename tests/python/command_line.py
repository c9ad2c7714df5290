"""What the tests of the package share: the command line that results are compared with, and a sheet."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import cutbench

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("CUTBENCH_PROGRAM")  # of the same build; without it the package's own
MANY = int(os.environ.get("CUTBENCH_MANY", "1"))  # times as many random cuts


def program(*arguments, folder=None):
    """The program, as a process: exit code, output, errors."""
    command = [PROGRAM] if PROGRAM else [sys.executable, "-m", "cutbench"]
    done = subprocess.run([*command, *map(str, arguments)], capture_output=True, text=True, cwd=folder)
    return done.returncode, done.stdout, done.stderr


def files(*names):
    """A new folder's files of these names; the first is the folder."""
    folder = Path(tempfile.mkdtemp())
    return [folder, *(folder / name for name in names)]


METHODS = list(cutbench.methods().index)
