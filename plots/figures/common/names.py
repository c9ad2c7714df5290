"""Names written directly beside their markers, where they cover nothing."""

import numpy as np
from matplotlib.patheffects import withStroke

LEADER = 8  # points: a name further off has one
DISTANCES = np.arange(5, 110, 3)  # points, from a marker to its name
ANGLES = np.radians([0, 180, -35, -145, 35, 145, -90, 90, -60, 60, -120, 120])
OUTSIDE, ON_A_NAME, ON_A_POINT, BY_ANOTHER, FAR = 1000, 100, 8, 4, 0.2  # how bad: once, for each, ..., for each point of the distance


def place(ax, named, points, size, clear_lines=True):
    """Each of `named`, (x, y, text, colour), near its marker, where it covers none of `points`, (x, y) each, and no name
    before it; a thin line joins the two where the name is further off. The limits of the axes must be set. `clear_lines`: no line crosses
    a name; in a crowd that takes names too far away, and there each keeps nearer to its own marker than to another one's."""
    figure = ax.figure
    figure.draw_without_rendering()
    taken = ax.transData.transform(np.asarray(points, float).reshape(-1, 2))
    markers = ax.transData.transform(np.array([q[:2] for q in named], float).reshape(-1, 2))
    boxes, frame, reach = [], ax.get_window_extent().padded(-3), figure.dpi / 72
    for x, y, written, colour in named:
        text = ax.annotate(written, (x, y), xytext=(0, 0), textcoords="offset points", fontsize=size, color=colour,
                           va="center", zorder=4, path_effects=[withStroke(linewidth=1.5, foreground="white")])
        box = text.get_window_extent()
        width = box.width / reach
        best = None
        for distance in DISTANCES:
            if best and best[0] <= FAR * distance:
                break
            for angle in ANGLES:
                dx = distance * np.cos(angle) - width / 2 + np.cos(angle) * width / 2
                dy = distance * np.sin(angle)
                here = box.translated(dx * reach, dy * reach)
                line = leader(ax.transData.transform((x, y)), here) if distance > LEADER else []
                inside = frame.x0 <= here.x0 and here.x1 <= frame.x1 and frame.y0 <= here.y0 and here.y1 <= frame.y1
                covered = ((here.x0 - 2 < taken[:, 0]) & (taken[:, 0] < here.x1 + 2) & (here.y0 - 2 < taken[:, 1])
                           & (taken[:, 1] < here.y1 + 2)).sum()
                judged = line if clear_lines else []
                hidden = sum(hides(other, here, judged) for other in boxes)
                others = 0 if clear_lines else (gaps(here, markers) < gaps(here, ax.transData.transform([(x, y)]))).sum()
                bad = OUTSIDE * (not inside) + ON_A_NAME * hidden + ON_A_POINT * covered + BY_ANOTHER * others + FAR * distance
                if best is None or bad < best[0]:
                    best = (bad, dx, dy, here, line)
        _, dx, dy, here, line = best
        text.set_position((dx, dy))
        boxes.append(here.padded(-0.12 * box.height))
        if len(line):
            ax.annotate("", (x, y), xytext=(line[0] - line[-1]) / reach, textcoords="offset points",
                        arrowprops=dict(arrowstyle="-", color=colour, linewidth=0.4, alpha=0.6, shrinkB=2, shrinkA=0))
            taken = np.vstack([taken, line])


def leader(marker, box):
    """Points from the edge of a name's box to its marker, in pixels."""
    low, high = np.array([[box.x0, box.y0], [box.x1, box.y1]])
    free = 0.15 * (high[1] - low[1])  # what a line of text leaves free above and below
    return np.linspace(np.clip(marker, low + [0, free], high - [0, free]), marker, 12)


def gaps(box, markers):
    """How far each marker is from a box, in pixels."""
    return np.hypot(*(markers - np.clip(markers, [box.x0, box.y0], [box.x1, box.y1])).T)


def hides(name, box, line):
    """Whether a new box or its line covers a name."""
    return box.overlaps(name) or any(name.padded(-0.15 * box.height).contains(*q) for q in line)
