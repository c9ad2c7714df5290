#!/usr/bin/env python3
"""A shirt of two sewn panels hangs by its shoulders and is cut up the front: one panel is opened."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from figures.common.render import Camera
from figures.common.scene_panels import Shot, main


if __name__ == "__main__":
    main("sewn_shirt", __doc__,
         [Shot("sewn_shirt", "", 0.4, Camera(centre=(0.4, 0, 0.3), azimuth=25, elevation=15, distance=4), ground=None,
               sheet="two panels of cotton with six seams")])
