#!/usr/bin/env python3
"""A sleeve, a tube at rest, is cut round: its end falls."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from figures.common.render import Camera
from figures.common.scene_panels import Shot, main


if __name__ == "__main__":
    main("sleeve_ring", __doc__,
         [Shot("sleeve_ring", "", 0.2, Camera(centre=(0, 0, -0.25), azimuth=25, elevation=20, distance=3), ground=None,
               box=(-0.2, 0.2, -0.25, 0.29), sheet="0.4 m of a sleeve")])
