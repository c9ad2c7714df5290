#!/usr/bin/env python3
"""A blade that advances while the sheet moves: during its advance and after its end."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from figures.common.close_ups import main
from figures.common.render import Camera
from figures.common.scene_panels import Shot

FROM_ABOVE = Camera(centre=(0.5, 0.5, -0.2), azimuth=25, elevation=42)


if __name__ == "__main__":
    main("progressive_cut", __doc__,
         [Shot("progressive_cut", "on its way", 0.8, FROM_ABOVE), Shot("progressive_cut", "through", 1.5, FROM_ABOVE)])
