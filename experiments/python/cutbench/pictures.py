"""Pictures, by matplotlib; and meshes for meshio."""

import numpy as np

from . import arrays

PATH, INCISION, OLD = "#d62728", "#1f3b73", "#b0b0b0"


def aspect_ratio(corners):
    """m floats: the longest side over the height on it, of m x 3 x 2 corners; 1.15 for equilateral triangles."""
    sides = corners[:, [1, 2, 0]] - corners
    squares = (sides**2).sum(axis=2).max(axis=1)
    areas = np.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0])
    with np.errstate(divide="ignore", invalid="ignore"):
        return squares / areas


def _axes(ax):
    if ax is not None:
        return ax
    import matplotlib.pyplot as pyplot
    return pyplot.subplots(figsize=(5, 5), layout="constrained")[1]


def _lines(ax, segments, **how):
    from matplotlib.collections import LineCollection
    ax.add_collection(LineCollection(segments, **how))


def _finish(ax, title=None):
    ax.set_aspect("equal")
    ax.autoscale_view()
    ax.set_axis_off()
    if title:
        ax.set_title(title)
    return ax


def _draw_path(ax, path, tolerance):
    for curve in path or ():
        points = curve.flattened(tolerance)
        ax.plot(*points.T, "--", color=PATH, lw=1.2, zorder=4)


def plot(sheet, path=None, polygons=(), ax=None, colour=True, largest=6.0, bar=True):
    """Draws a sheet at rest: triangles coloured by aspect ratio, the incision blue, the requested path dashed and red,
    polygons outlined.

    Args:
        sheet: a Sheet. path: curves in rest space. polygons: arrays of corners.
        ax: the matplotlib axes to draw in. colour: by aspect ratio. largest: aspect ratio at the end of the scale.
        bar: with a colour bar.

    Returns:
        The axes.
    """
    ax = _axes(ax)
    rest = sheet.rest
    if colour:
        drawn = ax.tripcolor(*rest.T, sheet.triangles, facecolors=aspect_ratio(rest[sheet.triangles]), cmap="YlOrRd",
                             vmin=1, vmax=largest, edgecolors="#60606060", linewidth=0.3)
        if bar:
            ax.figure.colorbar(drawn, ax=ax, label="aspect ratio", extend="max", shrink=0.7)
    else:
        ax.triplot(*rest.T, sheet.triangles, color=OLD, lw=0.4)
    _lines(ax, rest[sheet.incision[:, 0]], colors=INCISION, linewidths=1.6, zorder=3)
    closed = [np.append(corners, corners[0]) for corners in polygons]
    _lines(ax, [rest[corners] for corners in closed], colors="#2ca02c", linewidths=1.0, zorder=2)
    _draw_path(ax, path, 1e-3 * sheet.mean_edge)
    return _finish(ax)


def plot_score(score, ax=None):
    """Draws what was judged: the sheet before grey, the result's edges black, the path dashed and red, and a ring round
    the first finding, eight mean edges wide; all of it where there is no finding."""
    ax = _axes(ax)
    before = score.before
    vertices, triangles, rest = score.result
    rest = vertices[:, :2] if rest is None else rest
    ax.triplot(*before.rest.T, before.triangles, color=OLD, lw=1.2)
    good = triangles[((triangles >= 0) & (triangles < len(rest))).all(axis=1)]
    edges = rest[good[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)]
    _lines(ax, edges[np.isfinite(edges).all(axis=(1, 2))], colors="black", linewidths=0.5)
    _draw_path(ax, score.path, 1e-3 * before.mean_edge)
    _finish(ax, score.findings[0].cause if score.findings else score.verdict)
    places = [finding.place for finding in score.findings if finding.place is not None]
    if places:
        ax.plot(*places[0], "o", ms=18, mfc="none", mec=PATH, mew=2, zorder=5)
        for limits, at in ((ax.set_xlim, places[0][0]), (ax.set_ylim, places[0][1])):
            limits(at - 4 * before.mean_edge, at + 4 * before.mean_edge)
    return ax


def show(simulation, ax=None, elevation=20, azimuth=-70):
    """Draws a sheet as it is now: in the plane, or in space (y is up), coloured by height.

    Returns:
        The axes.
    """
    import matplotlib.pyplot as pyplot
    x, triangles = simulation.x, simulation.triangles
    if simulation.scene.dimension == 2:
        ax = _axes(ax)
        ax.tripcolor(*x.T, triangles, facecolors=aspect_ratio(x[triangles]), cmap="YlOrRd", vmin=1, vmax=6,
                     edgecolors="#60606060", linewidth=0.3)
        return _finish(ax, f"{simulation.time:.3f} s")
    if ax is None:
        ax = pyplot.figure(figsize=(5, 5)).add_subplot(projection="3d")
    ax.plot_trisurf(x[:, 0], x[:, 2], x[:, 1], triangles=triangles, cmap="viridis", linewidth=0.1, edgecolor="#00000040")
    ax.view_init(elevation, azimuth)
    ax.set_aspect("equal")
    ax.locator_params(nbins=3)
    ax.set_title(f"{simulation.time:.3f} s")
    return ax


def animate(simulation, frames=48, every=4, each=None, elevation=20, azimuth=-70):
    """Makes frames x every steps, and an animation of them that a notebook shows.

    Args:
        each: as of Simulation.step().

    Returns:
        A matplotlib.animation.FuncAnimation, whose frames are all made: to_jshtml(), save("cut.gif", writer="pillow").
    """
    import matplotlib.pyplot as pyplot
    from matplotlib.animation import FuncAnimation
    moments = []
    every = arrays.whole(every, "every", 1)
    for _ in range(arrays.whole(frames, "frames", 1)):
        moments.append((simulation.time, simulation.x.copy(), simulation.triangles))
        simulation.step(every, each)
    flat = simulation.scene.dimension == 2
    figure = pyplot.figure(figsize=(4, 4))
    ax = figure.add_subplot() if flat else figure.add_subplot(projection="3d")
    low = np.min([np.nanmin(x, axis=0) for _, x, _ in moments], axis=0)
    high = np.max([np.nanmax(x, axis=0) for _, x, _ in moments], axis=0)
    flat_axes = high - low < 1e-9 * (high - low).max()
    low, high = low - 0.1 * flat_axes, high + 0.1 * flat_axes

    def draw(frame):
        time, x, triangles = moments[frame]
        ax.clear()
        ax.set_title(f"{time:.3f} s")
        if flat:
            ax.triplot(*x.T, triangles, color=INCISION, lw=0.5)
            ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
            return
        ax.plot_trisurf(x[:, 0], x[:, 2], x[:, 1], triangles=triangles, cmap="viridis", linewidth=0)
        ax.set(xlim=(low[0], high[0]), ylim=(low[2], high[2]), zlim=(low[1], high[1]))
        ax.set_box_aspect((high - low)[[0, 2, 1]])
        ax.view_init(elevation, azimuth)

    animation = FuncAnimation(figure, draw, frames=len(moments), interval=1000 * every * simulation.scene.step)
    pyplot.close(figure)
    return animation


def to_meshio(sheet):
    """A meshio.Mesh of a sheet: positions in space; `rest` with the points (z = 0); `piece` and `aspect_ratio` with the
    triangles."""
    import meshio
    rest = np.column_stack([sheet.rest, np.zeros(len(sheet.rest))])
    ratios = aspect_ratio(sheet.rest[sheet.triangles])
    return meshio.Mesh(sheet.vertices, [("triangle", sheet.triangles)], point_data={"rest": rest},
                       cell_data={"piece": [sheet.pieces], "aspect_ratio": [ratios]})
