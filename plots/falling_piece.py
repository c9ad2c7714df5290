#!/usr/bin/env python3
"""A disc is cut out of a sheet that is held at its whole border, and falls freely."""

from common import fall
from common.render import Camera
from common.scene_panels import Shot, folders, main

if __name__ == "__main__":
    main("falling_piece", __doc__,
         [Shot("falling_piece", "", 0.25, Camera(centre=(0.5, 0.5, -0.2), azimuth=25, elevation=24), ground=-0.5)],
         notes=lambda results: [fall.sentence(folders(results, "falling_piece"))])
