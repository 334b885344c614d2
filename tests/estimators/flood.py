"""The triangles within a ball about a vertex, found vertex by vertex in plain Python."""

from collections import defaultdict

import numpy as np


class Flood:
    """Triangles of a mesh connected to a vertex by edges that meet an open ball about it."""

    def __init__(self, mesh):
        self.vertices, self.faces = mesh.vertices, mesh.faces
        self.beyond, self.at = {}, defaultdict(list)
        for t, face in enumerate(self.faces):
            for k in range(3):
                self.beyond[face[k], face[k - 2]] = t
                self.at[face[k]].append(t)

    def ball(self, v, radius):
        """Triangles (m,), and the part of the area of each inside; without a radius those at v."""
        found = list(self.at[v])
        if radius is None:
            return np.array(found), np.ones(len(found))
        vertices = self.vertices - self.vertices[v]
        for t in found:
            for k in range(3):
                start, end = self.faces[t][k], self.faces[t][k - 2]
                p, q = vertices[start], vertices[end]
                near = p - (q - p) * np.clip(p @ (q - p) / ((q - p) @ (q - p)), -1, 0)
                other = self.beyond.get((end, start))
                if near @ near < radius**2 and other is not None and other not in found:
                    found.append(other)
        parts = [part_inside(vertices[self.faces[t]], radius) for t in found]
        return np.array(found), np.array(parts)


def part_inside(corners, radius):
    """The part of a triangle (3, 3) inside the ball about the origin: the area is half the integral
    of x dy - y dx around, in a plane with the ball's centre above the origin."""
    e = corners[1] - corners[0]
    n = np.cross(e, corners[2] - corners[0])
    n, e = n / np.linalg.norm(n), e / np.linalg.norm(e)
    flat = corners @ np.column_stack((e, np.cross(n, e)))
    square = radius**2 - (corners[0] @ n) ** 2
    if square <= 0:
        return 0.0
    around = inside = 0.0
    for p, q in zip(flat, np.roll(flat, -1, axis=0)):
        d = q - p
        around += p[0] * q[1] - p[1] * q[0]
        # |p + s d|^2 = square
        roots = np.roots([d @ d, 2 * p @ d, p @ p - square])
        cuts = np.sort(roots.real.clip(0, 1)) if np.isreal(roots).all() else np.zeros(2)
        for s, t in zip((0, *cuts), (*cuts, 1)):
            a, b = p + s * d, p + t * d
            middle = p + (s + t) / 2 * d
            cross = a[0] * b[1] - a[1] * b[0]
            inside += cross if middle @ middle < square else square * np.arctan2(cross, a @ b)
    return inside / around


def length_inside(p, q, radius):
    """Of a segment: the part of it between the roots of |p + s (q - p)|^2 = radius^2."""
    d = q - p
    roots = np.roots([d @ d, 2 * p @ d, p @ p - radius**2])
    if not np.isreal(roots).all():
        return 0.0
    return np.ptp(roots.real.clip(0, 1)) * np.linalg.norm(d)
