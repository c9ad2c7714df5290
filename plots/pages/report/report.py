#!/usr/bin/env python3
"""Writes results/report.html, one file without links to others: a table and a Pareto chart of all methods, the paper's claims
with their verdicts, and every figure with its command. It uses the runs in results/, or else the project's own runs in
results/reference/, and states what has not been run. What the methods are is asked of build/release/cutbench, where that is
there. Its parts are beside this file."""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import load
from pages.report.page import page


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results",
                        help="holds the folders of the runs and reference/, receives report.html (default: results)")
    results = parser.parse_args().results
    load.write_page(results / "report.html", page(results))
    return 0


if __name__ == "__main__":
    sys.exit(main())
