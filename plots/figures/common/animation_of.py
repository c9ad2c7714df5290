"""An animated WebP of frames: the camera keeps to what is held, and the animation runs at the speed of the simulated time."""

import io

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

from analysis import frame_files
from analysis.stop import stop
from figures.common import render

WIDTH, HEADER, DPI = 3.2, 0.24, 200  # inches
HIGHEST = 1.25  # of a picture, in widths
LAST = 1000  # ms that the end is held
STILL = 1.35  # the camera stands still where all frames together are at most so many times larger than the largest of them
SMOOTH = 9  # frames over which the way of a camera that moves is averaged


def shown(frame):
    """The vertices of the pieces that something holds; where nothing does, of the largest piece."""
    piece = frame.cell["piece"].astype(int)
    of_vertex = np.full(len(frame.deformed), -1)
    of_vertex[frame.triangles] = piece[:, None]
    held = frame.held if frame.held is not None and frame.held.any() else of_vertex == np.bincount(piece).argmax()
    return frame.deformed[np.isin(of_vertex, np.unique(of_vertex[held]))]


def camera_for(frames):
    """From above where the sheet stays in its plane, else askew; as far off as suits the sheet's size."""
    points = np.concatenate([shown(f) for f in frames])
    low, high = points.min(axis=0), points.max(axis=0)
    flat = high[2] - low[2] <= 1e-9 * (high - low).max()
    return render.Camera(centre=tuple((low + high) / 2), azimuth=0 if flat else 25, elevation=90 if flat else 42,
                         distance=5 * (high - low).max())


def boxes(frames, camera):
    """(x0, x1, y0, y1) for each frame, all of one size, round what is shown of it."""
    seen = [camera.project(shown(f))[0] for f in frames]
    low, high = np.array([p.min(axis=0) for p in seen]), np.array([p.max(axis=0) for p in seen])
    size, all_of_it = (high - low).max(axis=0), high.max(axis=0) - low.min(axis=0)
    middle = (low + high) / 2
    if (all_of_it <= STILL * size.max()).all():
        middle = np.broadcast_to((low.min(axis=0) + high.max(axis=0)) / 2, middle.shape)
    else:
        padded = np.pad(middle, ((SMOOTH // 2, SMOOTH // 2), (0, 0)), "edge")
        middle = np.stack([np.convolve(padded[:, k], np.full(SMOOTH, 1 / SMOOTH), "valid") for k in range(2)], axis=1)
    half = np.maximum(high - middle, middle - low).max(axis=0)
    half += 0.05 * half.max()
    half = np.array([max(half[0], half[1] / HIGHEST), max(half[1], 0.4 * half[0])])
    return [(*(m[0] + half[0] * np.array([-1, 1])), *(m[1] + half[1] * np.array([-1, 1]))) for m in middle]


def picture(frame, camera, box, caption):
    below = WIDTH * (box[3] - box[2]) / (box[1] - box[0])
    figure = plt.figure(figsize=(WIDTH, below + HEADER))
    ax = figure.add_axes([0, 0, 1, below / (below + HEADER)])
    render.draw(ax, frame, camera)
    render.blank(ax, box)
    figure.text(0.02, 0.98, caption, fontsize=6, va="top")
    figure.text(0.98, 0.98, f"{frame.time:.2f} s", fontsize=6, va="top", ha="right")
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=DPI, format="png")
    plt.close(figure)
    return Image.open(buffer).convert("RGB")


def caption(folder):
    """Of the frames in a folder: the scene, the method, the sheet."""
    description = frame_files.read_description(folder)
    return f"{description['scene'].replace('_', ' ')}\n{description['method']}, {description['triangles_before']:,} triangles"


def animate(frames, path, caption):
    camera = camera_for(frames)
    pictures = [picture(frame, camera, box, caption) for frame, box in zip(frames, boxes(frames, camera))]
    times = [f.time for f in frames]
    durations = [round(1000 * (b - a)) if len(frames) > 2 else LAST for a, b in zip(times, times[1:])] + [LAST]
    try:
        pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=durations, loop=0, quality=70, method=4)
    except OSError as error:
        stop(f"{path} can't be written: {error.strerror or error}")
