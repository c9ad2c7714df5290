#!/usr/bin/env python3
"""Animated WebP of every scene that has frames, cut by the paper's method: results/<stem>/<scene>.webp."""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import frame_files, load
from analysis.scenes import overview
from figures.common import animation_of


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("stems", nargs="*", metavar="STEM", help="folders of results (default: all that have frames)")
    parser.add_argument("--results", type=Path, metavar="DIR", default=load.REPOSITORY / "results",
                        help="holds STEM/SCENE/METHOD with frames, receives STEM/SCENE.webp (default: results)")
    options = parser.parse_args()
    for folder in overview.folders_of(options.results):
        if not options.stems or folder.parent.parent.name in options.stems:
            path = folder.parent.with_suffix(".webp")
            animation_of.animate(frame_files.read_all(folder), path, animation_of.caption(folder))
            print(path)


if __name__ == "__main__":
    main()
