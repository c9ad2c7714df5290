#!/usr/bin/env python3
"""A cut whose four control points were picked on the moving sheet, by rays from an eye above it (the paper's 4.1.1)."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from figures.common.close_ups import main
from figures.common.render import Camera
from figures.common.scene_panels import Shot


if __name__ == "__main__":
    main("picked_cut", __doc__,
         [Shot("picked_cut", "", 1.0, Camera(centre=(0.5, 0.5, -0.2), azimuth=25, elevation=42))])
