"""From a mesh to a Scene of `render`: camera, light, colours, iso-parameter lines."""

import numpy as np

from .render import Scene

# The eye looks down from 32 degrees, 35 degrees beside the first of the two level axes.
AZIMUTH, ELEVATION = np.radians(35), np.radians(32)
LIGHT = np.array([-0.45, 0.55, 0.70]) / np.linalg.norm([-0.45, 0.55, 0.70])
MARGIN = 0.02  # of the image
LIFT = 0.0015  # of the image: how far lines lie before their surface

CLAY, INSIDE, INK = (0.78, 0.84, 0.90), (0.90, 0.80, 0.62), (0.2, 0.2, 0.2)
LINES = 10  # of constant u, and of constant v


class View:
    """An orthographic view of a mesh that fits an image of `size` (width, height) pixels.

    `up`: the axis that points up; `part` ((u0, u1), (v0, v1)): the part of the domain to fit, None
    for all.
    """

    def __init__(self, mesh, size, up: str = "z", part=None):
        self.mesh, self.size = mesh, size
        first, second, above = np.roll(np.eye(3), -"xyz".index(up) - 1, axis=0)
        level = np.cos(AZIMUTH) * first + np.sin(AZIMUTH) * second
        eye = np.cos(ELEVATION) * level + np.sin(ELEVATION) * above
        right = np.cross(above, level)
        self.axes = np.array([right, np.cross(eye, right), eye])
        points = mesh.vertices @ self.axes.T
        inside = np.ones(len(points), dtype=bool)
        for parameter, (low, high) in zip(mesh.uv.T if part else (), part or ()):
            inside &= (parameter >= low) & (parameter <= high)
        low, high = points[inside].min(0), points[inside].max(0)
        scale = (1 - 2 * MARGIN) * np.min(np.array(size) / (high - low)[:2])
        middle = np.array([size[0] / 2, size[1] / 2, 0])
        self.points = (points - (low + high) / 2) * scale + middle

    def scene(self, colours=None, edges=None, flat=False, ambient=0.25, width=1.0) -> Scene:
        """The Scene: `colours` (V, 3) of the vertices, or None for CLAY outside and INSIDE inside;
        `edges` (S, 2), pairs of vertices joined by lines of `width`; `ambient`, the share of
        ambient light; `flat` shading or smooth."""
        faces = self.mesh.faces
        triangles = self.points[faces]
        a, b, c = triangles.swapaxes(0, 1)
        facets = np.cross(b - a, c - a)[:, None]
        facets /= np.maximum(np.linalg.norm(facets, axis=-1, keepdims=True), 1e-12)
        normals = np.repeat(facets, 3, axis=1)
        if not flat:
            smooth = (self.mesh.normals @ self.axes.T)[faces]
            normals = np.where(np.isfinite(smooth), smooth, normals)
        outside = facets[..., 2:] > 0
        # Half Lambert, from 0 to 1: shading also on the side turned away from the light.
        light = (1 + np.where(outside, normals, -normals) @ LIGHT[:, None]) / 2
        own = np.where(outside, CLAY, INSIDE) if colours is None else colours[faces]
        lines = self.points[np.zeros((0, 2), dtype=int) if edges is None else edges]
        lift = np.array([0, 0, LIFT * max(self.size)])
        lit = np.clip(own * (ambient + (1 - ambient) * light), 0, 1)
        return Scene(self.size, triangles, lit, lines + lift, INK, width)


def edges(mesh):
    """All edges of a mesh, (E, 2)."""
    return np.unique(np.sort(mesh.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)), axis=0)


def iso_lines(mesh, n: int):
    """Edges (S, 2) of the n x n grid along about LINES lines of constant u, and of constant v."""
    step = min((d for d in range(1, n + 1) if n % d == 0), key=lambda d: abs(n / d - LINES))
    pairs, kept = edges(mesh), False
    rows = [np.unique(t, return_inverse=True, return_counts=True)[1:] for t in mesh.uv.T]
    for (row, _), (across, count) in zip(rows, rows[::-1]):
        # At a pole all lines of this parameter meet in one vertex.
        pole = (count[across] == 1)[pairs]
        row = np.where(pole, -1, row[pairs])
        start, end = row.T
        kept |= ((start == end) | pole.any(1)) & (row.max(1) % step == 0)
    return pairs[kept]
