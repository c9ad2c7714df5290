"""Pictures of a moving sheet from the frames that `cutbench simulate --frames` writes, drawn by matplotlib alone:
triangles are projected, sorted back to front and drawn as one collection of polygons. The two sides of the sheet have
different colours, which are darker where less of the sky is visible (ambient occlusion). A shadow on the ground and the
lips of the incision are drawn too."""

from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import BoundaryNorm, ListedColormap, Normalize

FRONT, BACK = np.array([0.93, 0.74, 0.62]), np.array([0.55, 0.66, 0.78])
LIP = "#b0001e"
WIRE = "#2b2b2b"
SKY = 64  # directions that ambient occlusion looks in
LIGHT = np.array([-0.32, -0.22, 0.92])


@dataclass(frozen=True)
class Camera:
    """Looks at `centre` (m) from `distance` (m), turned by `azimuth` from the y axis and raised by `elevation` (degrees)."""
    centre: tuple = (0.5, 0.5, 0.0)
    azimuth: float = 30
    elevation: float = 30
    distance: float = 5

    def axes(self):
        a, e = np.radians([self.azimuth, self.elevation])
        back = np.array([np.sin(a) * np.cos(e), -np.cos(a) * np.cos(e), np.sin(e)])  # towards the eye
        right = np.array([np.cos(a), np.sin(a), 0])
        return right, np.cross(back, right), back

    def project(self, points):
        """Places on the picture in m at the centre's distance, and nearness to the eye."""
        right, up, back = self.axes()
        p = points - np.array(self.centre)
        near = p @ back
        scale = self.distance / (self.distance - near)
        return np.stack([p @ right * scale, p @ up * scale], axis=-1), near

    def eye(self):
        return np.array(self.centre) + self.distance * self.axes()[2]


def triangle_normals(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.cross(b - a, c - a)  # as long as twice the area


def vertex_normals(points, triangles):
    normals = np.zeros_like(points)
    of_triangle = triangle_normals(points, triangles)
    for i in range(3):
        np.add.at(normals, triangles[:, i], of_triangle)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)


def sky_directions():
    """Evenly over the sphere (Fibonacci's spiral)."""
    i = np.arange(SKY) + 0.5
    z, turn = 1 - 2 * i / SKY, np.pi * (1 + 5 ** 0.5) * i
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(turn), r * np.sin(turn), z], axis=-1)


def points_on(points, triangles, spacing):
    """Points all over the triangles, no farther apart than about `spacing`."""
    corners = points[triangles]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    parts = np.ceil(longest / spacing).astype(int).clip(1, 40)
    clouds = []
    for n in np.unique(parts):
        u, v = np.meshgrid(np.arange(n + 1) / n, np.arange(n + 1) / n)
        inside = u + v <= 1 + 1e-9
        weights = np.stack([1 - u[inside] - v[inside], u[inside], v[inside]], axis=-1)
        clouds.append(np.einsum("wk,tkx->twx", weights, corners[parts == n]).reshape(-1, 3))
    return np.concatenate(clouds)


def sky_seen(frame, normals):
    """Per vertex, the share of the sky (weighted by the cosine) seen from its front and from its back. Each direction
    gets a height map of the sheet; what lies below its cell's highest point is hidden."""
    if frame.sky is not None:
        return frame.sky
    points, triangles = frame.deformed, frame.triangles
    low, size = points.min(axis=0), np.ptp(points, axis=0).max()
    cell = size / 72
    cloud = points_on(points, triangles, 0.8 * cell)
    seen, whole = np.zeros((len(points), 2)), np.zeros((len(points), 2))
    for direction in sky_directions():
        right = np.cross(direction, [0.3, 0.5, 0.8])
        right /= np.linalg.norm(right)
        up = np.cross(direction, right)
        plane = np.stack([right, up], axis=-1)

        def cells(p):
            return (np.floor((p - low) @ plane / cell).astype(int) + 256).clip(0, 511) @ np.array([512, 1])

        heights = np.full(512 * 512, -np.inf)
        np.maximum.at(heights, cells(cloud), cloud @ direction)
        cosine = normals @ direction
        for side, sign in enumerate((1, -1)):
            lifted = points + sign * 2.2 * cell * normals
            free = heights[cells(lifted)] < lifted @ direction + 0.8 * cell
            weight = np.maximum(0, sign * cosine)
            seen[:, side] += weight * free
            whole[:, side] += weight
    frame.sky = seen / np.maximum(whole, 1e-12)
    return frame.sky


def finer(points, triangles, values, parts):
    """Divides each triangle into parts^2, for smooth shading of few triangles: positions, vertex values and parents."""
    corner_points, corner_values = points[triangles], values[triangles]
    grid = [(i, j) for i in range(parts + 1) for j in range(parts + 1 - i)]
    number = {ij: n for n, ij in enumerate(grid)}
    weights = np.array([[parts - i - j, i, j] for i, j in grid]) / parts
    small = [[number[i, j], number[i + 1, j], number[i, j + 1]] for i, j in grid if i + j < parts]
    small += [[number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]] for i, j in grid if i + j < parts - 1]
    small = np.array(small)
    p = np.einsum("wk,tkx->twx", weights, corner_points)[:, small]
    v = np.einsum("wk,tkx->twx", weights, corner_values)[:, small]
    return p.reshape(-1, 3, 3), v.reshape(-1, 3, v.shape[-1]), np.repeat(np.arange(len(triangles)), len(small))


def lit(normals, towards_eye, sky, base_front, base_back, contrast=1.0):
    """Colours of points: two-sided, light from a lamp and from the sky. Low contrast keeps colours that mean something."""
    front = np.einsum("...x,...x->...", normals, towards_eye) > 0
    sign = np.where(front, 1, -1)
    lamp = np.maximum(0, sign * (normals @ (LIGHT / np.linalg.norm(LIGHT))))
    seen = np.where(front, sky[..., 0], sky[..., 1])
    base = np.where(front[..., None], base_front, base_back)
    light = 0.16 + 0.62 * lamp * (0.3 + 0.7 * seen) + 0.30 * seen
    return (base * (1 + contrast * (light - 1))[..., None]).clip(0, 1)


SCALARS = {  # name, scale, colours
    "aspect_ratio": ("aspect ratio = longest edge / height on it", BoundaryNorm([1, 3, 10, 30], 4, extend="max"),
                     ListedColormap(["#f7f3ee", "#fbdca4", "#f29d4b", "#c8551b"])),
    "strain": ("strain: largest |principal stretch - 1|", Normalize(0, 0.15), matplotlib.colormaps["viridis"]),
}


def draw(ax, frame, camera, wireframe=False, colour=None, ground=None, lips=True, line=0.15):
    """Draws the sheet into `ax`, whose limits are the caller's. `colour`: "aspect_ratio" or "strain" instead of the
    skin. `ground`: height of the floor (m) that gets the shadow. `line`: width of mesh lines, points."""
    if ground is not None:
        draw_shadow(ax, frame, camera, ground)
    normals = vertex_normals(frame.deformed, frame.triangles)
    sky = sky_seen(frame, normals)
    parts = 1 if wireframe else 2
    points, values, parent = finer(frame.deformed, frame.triangles, np.hstack([normals, sky]), parts)
    middle = points.mean(axis=1)
    mean = values.mean(axis=1)
    # The visible side follows from the normal of the triangle itself; the light may use smooth normals.
    own = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    to_eye = camera.eye() - middle
    smooth = mean[:, :3] / np.maximum(np.linalg.norm(mean[:, :3], axis=1, keepdims=True), 1e-12)
    flipped = np.einsum("tx,tx->t", own, to_eye) * np.einsum("tx,tx->t", smooth, to_eye) < 0
    smooth[flipped] = own[flipped] / np.maximum(np.linalg.norm(own[flipped], axis=1, keepdims=True), 1e-12)
    front, back = FRONT, BACK
    if colour:
        _, norm, colours = SCALARS[colour]
        front = back = colours(norm(frame.cell[colour][parent]))[:, :3]
    shade = lit(smooth, to_eye, mean[:, 3:], front, back, 0.25 if colour else 1.0)

    flat, near = camera.project(points)
    polygons, nearness = list(flat), near.mean(axis=1)
    edge = [WIRE] * len(polygons) if wireframe else list(shade)
    width = [line if wireframe else 0.25] * len(polygons)
    face = [tuple(c) for c in shade]
    if lips:
        edges, owner = frame.lips()
        ends, near = camera.project(frame.deformed[edges])
        lift = np.linalg.norm(frame.deformed[edges[:, 0]] - frame.deformed[edges[:, 1]], axis=1)
        nearest = np.full(len(frame.triangles), -np.inf)  # a lip is drawn in front of all parts of its own triangle
        np.maximum.at(nearest, parent, nearness)
        for pair, depth, up, of in zip(ends, near.mean(axis=1), lift, owner):
            polygons.append(np.array([pair[0], pair[1], pair[0]]))
            face.append((0, 0, 0, 0)), edge.append(LIP), width.append(0.7)
            nearness = np.append(nearness, max(depth, nearest[of]) + 0.3 * up)
    order = np.argsort(nearness, kind="stable")
    ax.add_collection(PolyCollection([polygons[i] for i in order], facecolors=[face[i] for i in order],
                                     edgecolors=[edge[i] for i in order], linewidths=[width[i] for i in order],
                                     joinstyle="round", capstyle="round", zorder=2))


def draw_shadow(ax, frame, camera, ground):
    """A soft shadow: copies of the sheet's outline on the ground, from wide and light to narrow and dark."""
    height = frame.deformed[:, 2:] - ground
    fall = frame.deformed - height * LIGHT / LIGHT[2]
    for spread, grey in ((0.05, 0.955), (0.032, 0.93), (0.016, 0.90), (0.0, 0.865)):
        turns = np.arange(10) * 2 * np.pi / 10 if spread else [0]
        flat = [camera.project(fall + np.array([np.cos(t), np.sin(t), 0]) * spread * (0.4 + height))[0][frame.triangles]
                for t in turns]
        ax.add_collection(PolyCollection(np.concatenate(flat), facecolors=[(grey,) * 3], edgecolors=[(grey,) * 3],
                                         linewidths=0.2, zorder=1))


def extent(frames, camera, ground=None):
    """(x0, x1, y0, y1) that holds all frames, with a margin, and their shadows where there is a ground."""
    corners = [camera.project(f.deformed)[0] for f in frames]
    if ground is not None:
        corners += [camera.project(f.deformed - (f.deformed[:, 2:] - ground) * LIGHT / LIGHT[2])[0] for f in frames]
    all_points = np.concatenate(corners)
    low, high = all_points.min(axis=0), all_points.max(axis=0)
    margin = 0.03 * (high - low).max()
    return low[0] - margin, high[0] + margin, low[1] - margin, high[1] + margin


def blank(ax, box):
    ax.set_xlim(box[0], box[1])
    ax.set_ylim(box[2], box[3])
    ax.set_aspect("equal")
    ax.axis("off")
