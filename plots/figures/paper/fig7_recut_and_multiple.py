#!/usr/bin/env python3
"""Figure 7 of the paper: a cut across an older one, and several cuts in one sheet."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from figures.common.close_ups import main
from figures.common.render import Camera
from figures.common.scene_panels import Shot

FROM_ABOVE = Camera(centre=(0.5, 0.5, -0.2), azimuth=25, elevation=48)


if __name__ == "__main__":
    main("fig7_recut_and_multiple", __doc__,
         [Shot("fig7_recut_and_multiple_recut", "cut again", 1.2, FROM_ABOVE),
          Shot("fig7_recut_and_multiple_multiple", "several cuts", 1.1, FROM_ABOVE)])
