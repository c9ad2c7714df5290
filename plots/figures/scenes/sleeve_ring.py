#!/usr/bin/env python3
"""A sleeve, a tube at rest, is cut round: its end falls."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from figures.common.render import Camera
from figures.common.scene_panels import Shot, main


if __name__ == "__main__":
    main("sleeve_ring", __doc__,
         [Shot("sleeve_ring", "", 0.25, Camera(centre=(0.25, 0, 0), azimuth=30, elevation=20, distance=2), ground=-0.5,
               sheet="0.5 m of a sleeve")])
