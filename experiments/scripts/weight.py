"""What the tracked files weigh: a clone is to take seconds, and git keeps every version of what is packed."""

import subprocess
from pathlib import Path

MB = 1_000_000
TOTAL = 12 * MB
KINDS = {"results": 5 * MB, "pictures": 3 * MB, "all else": 6.2 * MB}  # results: rows, tables and texts
ENDS = {".png": 0.25 * MB, ".svg": 0.25 * MB, ".webp": 0.4 * MB, ".ipynb": 0.15 * MB}  # of pictures, and what one may weigh
MENDS = {"results": "drop columns that nothing reads (experiments/publish.toml)",
         "pictures": "draw fewer marks, or a smaller figure (write_png in plots/figures/common/style.py)",
         "all else": "what a program can make need not be in git"}


def kind(path):
    return "pictures" if Path(path).suffix in ENDS else "results" if path.startswith("results/") else "all else"


def tracked(root):
    """{path: bytes} of what git tracks and is there; None where there is no git."""
    try:
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=root, check=True, capture_output=True, text=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return None
    files = {path: root / path for path in listed.split("\0") if path}
    return {path: file.lstat().st_size for path, file in files.items() if file.is_symlink() or file.is_file()}


def by_kind(sizes):
    return {name: sum(size for path, size in sizes.items() if kind(path) == name) for name in KINDS}


def text(size):
    return f"{size / MB:.2f} MB"


def largest(sizes, number=5):
    return ", ".join(f"{path} {text(sizes[path])}" for path in sorted(sizes, key=sizes.get, reverse=True)[:number])


def faults(sizes):
    """A line for each budget that is overdrawn."""
    found = [f"{path}: {text(size)}, more than the {text(ENDS[Path(path).suffix])} of a picture; {MENDS['pictures']}"
             for path, size in sizes.items() if kind(path) == "pictures" and size > ENDS[Path(path).suffix]]
    for name, size in by_kind(sizes).items():
        if size > KINDS[name]:
            of_kind = {path: size for path, size in sizes.items() if kind(path) == name}
            found.append(f"{name}: {text(size)}, more than {text(KINDS[name])}; {MENDS[name]}. The largest: {largest(of_kind)}")
    if sum(sizes.values()) > TOTAL:
        found.append(f"all tracked files: {text(sum(sizes.values()))}, more than {text(TOTAL)}. The largest: {largest(sizes)}")
    return found


def summary(sizes):
    parts = ", ".join(f"{name} {text(size)}" for name, size in by_kind(sizes).items())
    return f"tracked files: {text(sum(sizes.values()))} of {text(TOTAL)} ({parts})"
