"""A cut sheet in rest space: triangles by their aspect ratios, the requested path, the incision, and what a method makes of
the triangles: polygons, vertices that go along with others, copies. Needs numpy and matplotlib alone."""

from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from analysis.cut_result import aspect_ratio, outlines

BANDS = {3: "#fbdca4", 10: "#f29d4b", 30: "#c8551b"}  # colours of aspect ratios above these
GONE = "#dddddd"  # seen where triangles are gone
MESH, PATH, INCISION, UNKNOWNS = "#8d8d8d", "#0072b2", "#a50021", "#1b7837"


def draw(ax, points, triangles, curves=(), details=None, scale=1.0):
    """The whole sheet. \\param curves  points of each requested cut  \\param scale  of all lines"""
    corners = points[triangles]
    colours = ListedColormap(["white", *BANDS.values()])
    ax.add_collection(PolyCollection(corners, array=aspect_ratio(corners), cmap=colours, norm=BoundaryNorm([1, *BANDS, 1e300], 4),
                                     edgecolor=MESH, linewidth=0.5 * scale))
    for curve in curves:
        ax.plot(*curve.T, color=PATH, linewidth=5 * max(scale, 0.6), alpha=0.35, zorder=2, solid_capstyle="butt")
    if details:
        draw_unknowns(ax, points, triangles, details, scale)
        ax.add_collection(LineCollection([points[e] for e in details.incision], color=INCISION, linewidth=1.5 * max(scale, 0.6), capstyle="round",
                                         zorder=4))


def draw_unknowns(ax, points, triangles, details, scale):
    members = [t for group in details.polygons for t in group]
    ax.add_collection(PolyCollection(points[triangles[members]].reshape(-1, 3, 2), facecolor="#d9f0d3", edgecolor="#a6dba0",
                                     linewidth=0.4 * scale, zorder=1.2))
    ax.add_collection(LineCollection(points[outlines(triangles, details.polygons)].reshape(-1, 2, 2), color=UNKNOWNS, linewidth=0.9 * scale,
                                     capstyle="round", zorder=3))
    tied = points[[vertex for vertex, _ in details.constraints]].reshape(-1, 2)
    ax.plot(*tied.T, linestyle="", marker="o", markersize=3 * scale, color=UNKNOWNS, markeredgewidth=0, zorder=5)


def draw_copies(ax, old_points, details, scale=1.0):
    """Where the old vertices lie that are there several times."""
    copied = old_points[sorted(set(details.copied))].reshape(-1, 2)
    ax.plot(*copied.T, linestyle="", marker="s", markersize=4.5 * scale, markerfacecolor="none", markeredgecolor=UNKNOWNS,
            markeredgewidth=0.9 * scale, zorder=5)


def frame(ax, window):
    """(x0, x1, y0, y1) is seen, in a box."""
    ax.set(xlim=window[:2], ylim=window[2:], aspect="equal", xticks=[], yticks=[], facecolor=GONE)
    ax.spines[:].set_visible(True)
    ax.spines[:].set_color("#555555")
    ax.grid(False)


def legend_entries(details=()):
    """For everything that is drawn; of what a method makes of the triangles, what these have, counted where they are of one."""
    def entry(artist, many, name):
        number = f"{len(many(details[0]))} " if len(details) == 1 else ""
        artist.set_label(number + name)
        return [artist] if any(many(d) for d in details) else []
    return [Line2D([], [], color=PATH, alpha=0.35, linewidth=5, label="requested path"),
            Line2D([], [], color=INCISION, linewidth=1.5, label="incision"),
            *(Patch(facecolor=colour, edgecolor=MESH, linewidth=0.5, label=f"AR {low} to {high}" if high else f"AR > {low}")
              for (low, colour), high in zip(BANDS.items(), [*list(BANDS)[1:], None])),
            *entry(Patch(facecolor="#d9f0d3", edgecolor=UNKNOWNS, linewidth=0.9), lambda d: d.polygons, "polygons"),
            *entry(Line2D([], [], color=UNKNOWNS, linestyle="", marker="o", markersize=3), lambda d: d.constraints, "tied vertices"),
            *entry(Line2D([], [], color=UNKNOWNS, linestyle="", marker="s", markersize=4.5, markerfacecolor="none"), lambda d: set(d.copied),
                   "copied vertices")]
