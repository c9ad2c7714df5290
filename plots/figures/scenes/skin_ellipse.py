#!/usr/bin/env python3
"""An ellipse is taken out of a patch of skin that is curved at rest and under tension."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from figures.common.render import Camera
from figures.common.scene_panels import Shot, main


if __name__ == "__main__":
    main("skin_ellipse", __doc__,
         [Shot("skin_ellipse", "", 0.133, Camera(centre=(0, 0, 0), azimuth=15, elevation=40, distance=0.6), ground=None,
               sheet="a curved patch, 0.1 m")])
