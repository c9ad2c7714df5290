"""Figures of scenes: a row for each, its whole sheet at the left and, by several methods, the piece of it with the worst
triangle of all, where the methods differ. The close-ups look along the sheet's normal, rest x to the right, and show the
triangles by their aspect ratios. The frames are in results/<stem>/<scene>/<method>."""

from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from analysis import families, load
from analysis.scenes import scene_frames
from figures.common import render, scene_panels, style

METHODS = ["warp_and_refine", "bowyer_watson rounds=1", "conventional_split", "cgal_cdt"]  # a parameter only where several are there
HALF = 0.075  # m, of the width of a close-up: 3 edges of 800 triangles across
GAP, TITLE, ROW = 0.06, 0.33, 1.28  # inches: between panels, over them, and the height of a close-up


@dataclass(frozen=True)
class Facing(render.Camera):
    """Looks along a normal, with `right` to the right; both are unit vectors, (3,)."""
    right: tuple = (1, 0, 0)
    normal: tuple = (0, 0, 1)

    def axes(self):
        return np.array(self.right), np.cross(self.normal, self.right), np.array(self.normal)


def worst_triangle(frames):
    """Centre, in rest space and deformed, of the triangle with the largest aspect ratio in any of the frames."""
    frame = max(frames, key=lambda f: f.cell["aspect_ratio"].max())
    worst = frame.triangles[frame.cell["aspect_ratio"].argmax()]
    return frame.rest[worst].mean(axis=0), frame.deformed[worst].mean(axis=0)


def one_side(frame, near, target):
    """Of the triangles `near`, (n,), those of one side of the incision: they hang together, and one is nearest to `target`."""
    corners = frame.triangles[near]
    size = len(near) + len(frame.rest)
    links = coo_matrix((np.ones(corners.size), (np.repeat(np.arange(len(near)), 3), len(near) + corners.ravel())), (size, size))
    sides = connected_components(links, directed=False)[1][:len(near)]
    nearest = np.linalg.norm(frame.deformed[corners].mean(axis=1) - target, axis=1).argmin()
    return near[sides == sides[nearest]]


def facing(frame, place, target):
    """The camera over a place in rest space, on the side of the incision whose triangles are near `target`: an affine map from
    rest space, fitted to these triangles' centres, says where it looks, and along which normal."""
    distances = np.linalg.norm(frame.rest[frame.triangles].mean(axis=1) - place, axis=1)
    near = one_side(frame, np.flatnonzero(distances <= HALF), target)
    corners = frame.triangles[near]
    rest = frame.rest[corners].reshape(-1, 2) - place
    fit, *_ = np.linalg.lstsq(np.hstack([rest, np.ones((len(rest), 1))]), frame.deformed[corners].reshape(-1, 3), rcond=None)
    normal = np.cross(fit[0], fit[1])
    return Facing(centre=tuple(fit[2]), right=tuple(fit[0] / np.linalg.norm(fit[0])),
                  normal=tuple(normal / np.linalg.norm(normal)))


def outline(camera, view):
    """The square of a close-up's camera as another one sees it, closed."""
    right, up, _ = camera.axes()
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]]) * HALF
    return view.project(np.array(camera.centre) + corners @ np.array([right, up]))[0]


def axes_at(figure, left, bottom, width, height):
    """In inches."""
    w, h = figure.get_size_inches()
    return figure.add_axes([left / w, bottom / h, width / w, height / h])


def chosen(panels):
    """Those of METHODS that are there, in their order; all, where none is."""
    found = [p for m in METHODS for p in panels if m in (p[0]["method"], p[0]["method"].partition(" ")[0])]
    return found or panels


def draw_row(figure, bottom, shot, panels):
    """The whole sheet of the first panel, and a close-up of each. \\param panels  [(description, frame)]"""
    worst = worst_triangle([frame for _, frame in panels])
    cameras = [facing(frame, *worst) for _, frame in panels]
    whole = style.PAGE - len(panels) * (ROW + GAP)
    box = render.extent([panels[0][1]], shot.camera)
    ax = axes_at(figure, 0, bottom, whole - GAP, ROW)
    render.draw(ax, panels[0][1], shot.camera)
    render.blank(ax, box)
    ax.plot(*outline(cameras[0], shot.camera).T, color="black", linewidth=1, zorder=5)
    description, frame = panels[0]
    figure.text(0.05 / style.PAGE, (bottom + ROW + 0.03) / figure.get_size_inches()[1],
                f"{shot.title}\n{frame.time - description['cuts'][0]['time_s']:.2g} s after the cut began".strip(), fontsize=7, va="bottom",
                linespacing=1.25)
    for i, ((description, frame), camera) in enumerate(zip(panels, cameras)):
        ax = axes_at(figure, whole + i * (ROW + GAP), bottom, ROW, ROW)
        render.draw(ax, frame, camera, wireframe=True, colour="aspect_ratio", line=0.4)
        render.blank(ax, (-HALF, HALF, -HALF, HALF))
        ax.axis("on")
        ax.set(xticks=[], yticks=[])
        ax.grid(False)
        ax.spines[:].set_visible(True)
        method = description["method"].partition(" ")[0]
        ax.set_title(families.name(method), fontsize=7, fontweight="bold", loc="left", pad=11, color=families.family(method).colour)
        if description["verdict"] != "ok":
            ax.text(0.03, 0.03, description["verdict"].replace("_", " "), transform=ax.transAxes, fontsize=7, color=render.LIP,
                    bbox=dict(facecolor="white", edgecolor="none", pad=1), zorder=6)
        ax.annotate(f"AR {load.number(frame.cell['aspect_ratio'].max(), 2)}, {len(frame.triangles)} triangles", (0, 1), xytext=(0, 2),
                    xycoords="axes fraction", textcoords="offset points", fontsize=7)


def legend(figure, bottom):
    _, norm, colours = render.SCALARS["aspect_ratio"]
    limits = [*map(int, norm.boundaries), None]
    entries = [Patch(facecolor=colours(i), edgecolor=render.WIRE, linewidth=0.4, label=f"AR {low} to {high}" if high else f"AR > {low}")
               for i, (low, high) in enumerate(zip(limits, limits[1:]))]
    entries += [Line2D([], [], color=render.LIP, linewidth=1, label="lips"),
                Line2D([], [], color="black", marker="s", markersize=5, markerfacecolor="none", linestyle="", label="close-up")]
    figure.legend(handles=entries, loc="upper center", ncol=len(entries), handlelength=1.4, columnspacing=1.4,
                  bbox_to_anchor=(0.5, bottom / figure.get_size_inches()[1]), borderaxespad=0)


def main(stem, description, shots, notes=lambda results: []):
    """\\param notes  sentences that the caption has, too, of the folder of results"""
    options = scene_panels.arguments(stem, description)
    results = options.results
    if options.colour:
        scene_panels.main(stem, description, shots, notes=notes)
        return
    panels = [chosen(scene_frames.read_shot(results, shot.scene, shot.time)) for shot in shots]
    text = scene_panels.caption(stem, shots, panels, [
        f"{' '.join(description.split())} Whole sheet: {families.name(panels[0][0][0]['method'].partition(' ')[0])}. Close-ups: the piece "
        f"({200 * HALF:g} cm wide) of the sheet with the worst triangle of all these methods, seen along its normal. Over each: the largest aspect "
        "ratio AR in the whole sheet, and its triangles.", *notes(results)])
    figure = plt.figure(figsize=(style.PAGE, 1))
    lines = style.two_lines(figure, text, style.PAGE - 0.1)
    below = 0.125 * len(lines) + 0.1
    total = below + len(shots) * (ROW + TITLE + GAP) + 0.1
    figure.set_size_inches(style.PAGE, total)
    figure.text(0.05 / style.PAGE, 0.04 / total, "\n".join(lines), fontsize=style.CAPTION_SIZE, va="bottom", linespacing=1.2,
                parse_math=False)
    for row, (shot, column) in enumerate(zip(shots, panels)):
        draw_row(figure, below + (len(shots) - 1 - row) * (ROW + TITLE + GAP), shot, column)
    legend(figure, total - 0.03)
    style.save(figure, results, stem)
