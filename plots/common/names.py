"""Names written directly beside their markers, where they cover nothing."""

import numpy as np
from matplotlib.patheffects import withStroke


def place(ax, named, points, size):
    """Each of `named`, (x, y, text, colour), near its marker, where it covers none of `points`, (x, y) each, and no name
    before it; a thin line joins the two where the name is further off. The limits of the axes must be set."""
    figure = ax.figure
    figure.draw_without_rendering()
    taken = [ax.transData.transform(p) for p in points]
    boxes, frame, reach = [], ax.get_window_extent(), figure.dpi / 72
    for x, y, written, colour in named:
        text = ax.annotate(written, (x, y), xytext=(0, 0), textcoords="offset points", fontsize=size, color=colour,
                           va="center", zorder=4, path_effects=[withStroke(linewidth=1.5, foreground="white")])
        box = text.get_window_extent()
        width, height = box.width / reach, box.height / reach
        best = None
        for distance in np.arange(5, 90, 3):
            for angle in np.radians([0, 180, -35, -145, 35, 145, -90, 90]):
                dx = distance * np.cos(angle) - width / 2 + np.cos(angle) * width / 2
                dy = distance * np.sin(angle)
                here = box.translated(dx * reach, dy * reach)
                inside = frame.x0 <= here.x0 and here.x1 <= frame.x1 and frame.y0 <= here.y0 and here.y1 <= frame.y1
                faults = sum(here.overlaps(other) for other in boxes) * 10 + (not inside) * 20 + sum(
                    here.x0 - 2 < q[0] < here.x1 + 2 and here.y0 - 2 < q[1] < here.y1 + 2 for q in taken)
                if best is None or faults < best[0]:
                    best = (faults, dx, dy, here, distance)
            if best[0] == 0:
                break
        _, dx, dy, here, distance = best
        text.set_position((dx, dy))
        boxes.append(here.padded(-0.12 * height * reach))
        if distance > 11:
            ax.annotate("", (x, y), xytext=(dx + width / 2, dy), textcoords="offset points",
                        arrowprops=dict(arrowstyle="-", color=colour, linewidth=0.4, alpha=0.6, shrinkB=2, shrinkA=size / 2))
