"""Names written directly beside their markers, where they cover nothing."""

import numpy as np
from matplotlib.patheffects import withStroke


LEADER = 8  # points: a name further off has one


def place(ax, named, points, size):
    """Each of `named`, (x, y, text, colour), near its marker, where it covers none of `points`, (x, y) each, and no name
    before it; a thin line joins the two where the name is further off, and crosses no name. The limits of the axes must be set."""
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
            for angle in np.radians([0, 180, -35, -145, 35, 145, -90, 90, -9, 9]):
                dx = distance * np.cos(angle) - width / 2 + np.cos(angle) * width / 2
                dy = distance * np.sin(angle)
                here = box.translated(dx * reach, dy * reach)
                line = leader(ax.transData.transform((x, y)), here) if distance > LEADER else []
                inside = frame.x0 <= here.x0 and here.x1 <= frame.x1 and frame.y0 <= here.y0 and here.y1 <= frame.y1
                faults = sum(here.overlaps(other) or any(other.padded(-0.15 * box.height).contains(*q) for q in line) for other in boxes) * 100 + (not inside) * 200 + sum(
                    here.x0 - 2 < q[0] < here.x1 + 2 and here.y0 - 2 < q[1] < here.y1 + 2 for q in taken)
                if best is None or faults < best[0]:
                    best = (faults, dx, dy, here, line)
            if best[0] == 0:
                break
        _, dx, dy, here, line = best
        text.set_position((dx, dy))
        boxes.append(here.padded(-0.12 * height * reach))
        if len(line):
            ax.annotate("", (x, y), xytext=(line[0] - line[-1]) / reach, textcoords="offset points",
                        arrowprops=dict(arrowstyle="-", color=colour, linewidth=0.4, alpha=0.6, shrinkB=2, shrinkA=0))
            taken += list(line)


def leader(marker, box):
    """Points from the edge of a name's box to its marker, in pixels."""
    low, high = np.array([[box.x0, box.y0], [box.x1, box.y1]])
    inset = 0.15 * (high[1] - low[1])  # what a line of text leaves free above and below
    return np.linspace(np.clip(marker, low + [0, inset], high - [0, inset]), marker, 12)
