#!/usr/bin/env python3
"""Figure 6 of the paper: a cut from a side, and a part cut out, which falls."""

from common import fall
from common.close_ups import main
from common.render import Camera
from common.scene_panels import Shot, folders

if __name__ == "__main__":
    main("fig6_partial_and_cutout", __doc__,
         [Shot("fig6_partial_and_cutout_partial", "from a side", 1.5,
               Camera(centre=(0.5, 0.5, -0.2), azimuth=25, elevation=42)),
          Shot("fig6_partial_and_cutout_cutout", "cut out", 0.8,
               Camera(centre=(0.5, 0.5, -0.3), azimuth=25, elevation=24), ground=-0.75)],
         notes=lambda results: [fall.sentence(folders(results, "fig6_partial_and_cutout_cutout"))])
