#!/usr/bin/env python3
"""Animates the frames that `cutbench simulate --frames` wrote into a folder; `cutbench simulate --animation` calls it. Needs
numpy, matplotlib and Pillow alone."""

import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import frame_files
from figures.common import animation_of


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--frames", type=Path, required=True, metavar="DIR", help="with frames.pvd and simulation.json")
    parser.add_argument("--out", type=Path, required=True, help="WebP")
    options = parser.parse_args()
    animation_of.animate(frame_files.read_all(options.frames), options.out, animation_of.caption(options.frames))


if __name__ == "__main__":
    main()
