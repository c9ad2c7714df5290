#!/usr/bin/env python3
"""A shirt of two sewn panels hangs by its shoulders and is cut up the front: one panel is opened."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from figures.common.render import Camera
from figures.common.scene_panels import Shot, main


if __name__ == "__main__":
    main("sewn_shirt", __doc__,
         [Shot("sewn_shirt", "", 0.5, Camera(centre=(0.4, 0.3, 0), azimuth=20, elevation=25, distance=3), ground=-0.6,
               sheet="two panels of cotton with six seams")])
