"""Pictures of what an estimator looks at: the vertices on which its value at one vertex depends.

Nothing is drawn from a description: each vertex nearby is moved a little, and the value compared.
"""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.tri import Triangulation

from curvlib import estimate
from curvlib.meshes.jittered import jittered

HOPS = 8  # how many rings are tried: "5 edges" reach seven or so
STEP = 1e-4  # of a mean edge
NOTHING = 1e-9  # of the largest change: rounding
SHADES = "viridis_r"


class Place:
    """A vertex of an irregular mesh, the vertices around it, and the plane that it is drawn in."""

    def __init__(self):
        self.mesh = jittered("ellipsoid", 32, seed=3)
        points = self.mesh.vertices
        self.centre = int(np.argmax(points @ (0.6, 0.5, 0.6)))
        near, last = {self.centre}, {self.centre}
        for _ in range(HOPS):
            last = set(self.mesh.faces[np.isin(self.mesh.faces, list(last)).any(1)].ravel())
            near |= last
        self.near = np.array(sorted(near))
        normal = self.mesh.normals[self.centre]
        x = np.cross(normal, (0, 0, 1))
        x /= np.linalg.norm(x)
        self.flat = (points - points[self.centre]) @ np.stack((x, np.cross(normal, x)), 1)

    def changes(self, name) -> np.ndarray:
        """How much the value at the centre changes with each of `near`, over the largest; K where
        the estimator has no H."""
        quantity = "H" if np.isfinite(self._value(name, self.mesh, "H")) else "K"
        before = self._value(name, self.mesh, quantity)
        step = STEP * self.mesh.mean_edge
        found = []
        for vertex in self.near:
            points = self.mesh.vertices.copy()
            points[vertex] += step * self.mesh.normals[vertex]
            found.append(abs(self._value(name, self.mesh.moved(points), quantity) - before))
        return np.array(found) / max(found)

    def _value(self, name, mesh, quantity):
        return getattr(estimate(mesh, name), quantity)[self.centre]

    def draw(self, path, changes) -> int:
        """Save the picture; the number of vertices on which the value depends."""
        faces = self.mesh.faces[np.isin(self.mesh.faces, self.near).all(1)]
        figure = Figure(figsize=(4.2, 4.2), dpi=110)
        axes = figure.add_axes((0, 0, 1, 1), aspect="equal")
        axes.axis("off")
        axes.triplot(Triangulation(*self.flat.T, faces), color="#b8b8b8", linewidth=0.6)
        used = changes > NOTHING
        shown = self.flat[self.near[used]]
        axes.scatter(*shown.T, c=np.log10(changes[used]), cmap=SHADES, vmin=-3, vmax=0, s=34,
                     zorder=3)  # fmt: skip
        axes.scatter(*self.flat[self.centre], s=110, facecolors="none", edgecolors="#d62728",
                     linewidths=2, zorder=4)  # fmt: skip
        figure.savefig(path, metadata={"Software": None})
        return int(used.sum())
