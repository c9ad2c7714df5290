#!/usr/bin/env python3
"""A disc is cut out of a sheet that is held at its whole border, and falls freely."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import fall
from analysis.scenes.scene_frames import folders
from figures.common.render import Camera
from figures.common.scene_panels import Shot, main


if __name__ == "__main__":
    main("falling_piece", __doc__,
         [Shot("falling_piece", "", 0.25, Camera(centre=(0.5, 0.5, -0.2), azimuth=25, elevation=24), ground=-0.5)],
         notes=lambda results: [fall.sentence(folders(results, "falling_piece"))])
