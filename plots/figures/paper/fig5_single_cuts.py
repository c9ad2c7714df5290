#!/usr/bin/env python3
"""Figure 5 of the paper: single cuts, straight and curved."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from figures.common.close_ups import main
from figures.common.render import Camera
from figures.common.scene_panels import Shot

FROM_ABOVE = Camera(centre=(0.5, 0.5, -0.2), azimuth=25, elevation=42)


if __name__ == "__main__":
    main("fig5_single_cuts", __doc__,
         [Shot("fig5_single_cuts_straight", "straight", 1.0, FROM_ABOVE),
          Shot("fig5_single_cuts_curved", "curved", 0.7, FROM_ABOVE)])
