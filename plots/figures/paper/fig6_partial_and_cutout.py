#!/usr/bin/env python3
"""Figure 6 of the paper: a cut from a side, and a part cut out, which falls."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from analysis import fall
from analysis.scenes.scene_frames import folders
from figures.common.close_ups import main
from figures.common.render import Camera
from figures.common.scene_panels import Shot


if __name__ == "__main__":
    main("fig6_partial_and_cutout", __doc__,
         [Shot("fig6_partial_and_cutout_partial", "from a side", 1.5,
               Camera(centre=(0.5, 0.5, -0.2), azimuth=25, elevation=42)),
          Shot("fig6_partial_and_cutout_cutout", "cut out", 0.8,
               Camera(centre=(0.5, 0.5, -0.3), azimuth=25, elevation=24), ground=-0.75)],
         notes=lambda results: [fall.sentence(folders(results, "fig6_partial_and_cutout_cutout"))])
