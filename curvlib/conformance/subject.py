"""An estimator under check, the meshes that it is run on, and how its values are compared."""

from functools import cache, cached_property

import numpy as np

from curvlib.catalogue import estimators
from curvlib.estimation import estimate
from curvlib.meshes.mesh import Mesh
from curvlib.nurbs.tessellation import tessellate
from curvlib.signatures import Signature, readings, resolved
from curvlib.surfaces._named import surface


class Broken(AssertionError):
    """A property that does not hold; the message says which and where."""


class NotApplicable(Exception):
    """A check that says nothing about an estimator; the message says why."""


class Subject:
    """An estimator, by its name or the path of its file."""

    def __init__(self, name: str):
        self.name = name
        self.signature = Signature.of(*resolved(name))
        self.given = self.signature.given
        self.module = estimators.module(name)
        # It has no values near the boundary, and says so.
        self.bounded = hasattr(self.module, "BOUNDED")
        # Its values depend on all of the mesh, and it says so.
        self.spreads = hasattr(self.module, "GLOBAL")
        # To which values agree that would be equal but for rounding.
        self.precision = getattr(self.module, "PRECISION", 1e-9)

    def __call__(self, mesh, **options):
        return estimate(mesh, self.name, **options)

    @cached_property
    def on_sphere(self):
        """The estimates on `sphere`, with `lengths`."""
        return self(sphere(), **self.lengths(sphere()))

    def lengths(self, mesh) -> dict:
        """The options with which parts of a mesh have its values: the radius, where there is one by
        default, not in edges of the part."""
        by_default = readings(self.name).get("radius", (None,))[0] is not None
        return {"radius": 2.5 * mesh.mean_edge} if by_default else {}

    def within_reach(self, mesh, vertices):
        """(V,) bool: the vertices with values that others, in one pass or more, can change."""
        from scipy.spatial import cKDTree

        found, signature = np.isin(np.arange(len(mesh.vertices)), vertices), self.signature
        if self.spreads:
            return np.ones(len(found), bool)
        while signature is not None:
            radius = self.lengths(mesh).get("radius") if "radius" in signature.options else None
            if radius is None:
                found = around(mesh.faces, found, signature.options.get("rings", (1,))[0])
            else:
                # A triangle may be cut by a ball that none of its corners lies in.
                reach = radius + longest(mesh) if signature.given == "ball" else radius
                found = cKDTree(mesh.vertices[found]).query(mesh.vertices)[0] <= reach
            signature = signature.field
        return found


def around(faces, vertices, rings):
    """(V,) bool: the vertices within some rings of others."""
    found = np.zeros(faces.max() + 1, bool)
    found[vertices] = True
    for _ in range(rings):
        found[faces[found[faces].any(1)]] = True
    return found


def longest(mesh):
    """The longest edge."""
    a, b = mesh.vertices[mesh.faces], mesh.vertices[np.roll(mesh.faces, 1, axis=1)]
    return np.linalg.norm(a - b, axis=2).max()


def hold(condition, words: str) -> None:
    """Raise Broken unless a condition holds."""
    if not condition:
        raise Broken(words)


def same(found, expected, words: str, tolerance: float = 1e-9) -> None:
    """Raise Broken unless arrays are equal to a part of their largest value, NaN where NaN."""
    for a, b in zip(found, expected):
        same_nan(np.isnan(a), np.isnan(b), words)
        known = np.isfinite(b)
        scale = np.abs(b[known]).max(initial=0) or 1
        off = np.abs(a[known] - b[known]) - tolerance * np.abs(b[known])
        worst = off.max(initial=0)
        hold(
            worst <= tolerance * scale, f"{words}: off by {worst / scale:.2g} of the largest value"
        )


def same_nan(found, expected, words: str) -> None:
    """Raise Broken, with some vertices, unless values are undefined exactly where expected."""
    for what, where in (("NaN", found & ~expected), ("no NaN", expected & ~found)):
        at = np.flatnonzero(where)
        hold(
            not len(at),
            f"{words}: {what} at {len(at)} of {len(found)} vertices, such as {at[:3].tolist()}",
        )


@cache
def sphere() -> Mesh:
    """The unit sphere, its grid cut at random."""
    return tessellate(surface("sphere"), 16, "random", seed=3)


@cache
def ellipsoid() -> Mesh:
    """An ellipsoid, its grid cut at random."""
    return tessellate(surface("ellipsoid"), 12, "random", seed=5)


@cache
def icosphere(times: int) -> Mesh:
    """The unit sphere of nearly equilateral triangles: an icosahedron, each triangle divided into
    four some times, then projected."""
    from scipy.spatial import ConvexHull

    golden = (1 + 5**0.5) / 2
    corners = [(0, a, b * golden) for a in (-1, 1) for b in (-1, 1)]
    points = np.array([np.roll(corner, k) for k in range(3) for corner in corners], float)
    faces = ConvexHull(points).simplices
    inward = np.linalg.det(points[faces]) < 0
    faces[inward] = faces[inward, ::-1]
    for _ in range(times):
        a, b, c = faces.T
        pairs = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]))
        ends, middle = np.unique(pairs, axis=0, return_inverse=True)
        ab, bc, ca = len(points) + middle.reshape(3, -1)
        points = np.vstack((points, points[ends].mean(1)))
        corners = [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = np.concatenate([np.column_stack(three) for three in corners])
    return Mesh(points / np.linalg.norm(points, axis=1)[:, None], faces)


def fan(n: int, height: float, radius: float = 1.0):
    """Vertices and faces of a pyramid over a regular polygon; the apex is vertex n."""
    angle, k = 2 * np.pi * np.arange(n) / n, np.arange(n)
    rim = radius * np.column_stack((np.cos(angle), np.sin(angle), 0 * angle))
    faces = np.column_stack((k, (k + 1) % n, np.full(n, n)))
    return np.vstack((rim, [[0, 0, height]])), faces
