"""A function that returns curvature at vertices, under check, and the meshes that it is run on."""

from functools import cached_property

import numpy as np

from curvlib.meshes.torus import torus

from .subject import NotApplicable, icosphere

# Relative to the mean of |value|: a change larger than this is more than the rounding of float64.
CHANGE = 1e-3


class Failed(AssertionError):
    """A property that does not hold: `str` is the evidence, `remedy` what a user has to do."""

    def __init__(self, evidence, remedy):
        super().__init__(evidence)
        self.remedy = remedy


class Function:
    """A function under check: `values(vertices, faces)` returns a dict of K, H, k1, k2, (V,)."""

    def __init__(self, values):
        self.values = values

    def __call__(self, vertices, faces) -> dict:
        """The values of a copy of the mesh. Raises Failed where they are not one a vertex."""
        found = self.values(vertices.copy(), faces.astype(np.int64))
        found = {name: np.asarray(x) for name, x in found.items()}
        for name, x in found.items():
            if x.shape != (len(vertices),):
                shape = "x".join(map(str, x.shape))
                words = f"{shape} values of {name} for {len(vertices)} vertices"
                raise Failed(words, "find out which vertices the values belong to")
        return {name: x.astype(float) for name, x in found.items()}

    @cached_property
    def on_sphere(self):
        """The values on `ball`."""
        return self(*ball())

    @cached_property
    def on_uneven(self):
        """The values on `uneven`."""
        return self(*uneven())

    @cached_property
    def on_saddle(self):
        """The values on `saddle`."""
        return self(*saddle()[:2])


def ball(times=3):
    """Vertices and faces of the unit sphere with outward faces; a copy."""
    mesh = icosphere(times)
    return mesh.vertices.copy(), mesh.faces.copy()


def uneven():
    """An ellipsoid of semi-axes 1, 0.8 and 0.6 whose triangles are of many shapes."""
    vertices, faces = ball()
    x, y, z = vertices.T
    bent = np.stack((x + 0.15 * np.sin(3 * y), y + 0.15 * np.sin(2 * z), z + 0.15 * x * y), 1)
    return bent / np.linalg.norm(bent, axis=1)[:, None] * (1, 0.8, 0.6), faces


def saddle():
    """The inner half of a torus of radii 2 and 1, where K < 0, and which of its vertices are
    inside."""
    vertices, faces = torus(30, "regular")
    around = np.hypot(vertices[:, 0], vertices[:, 1])
    return vertices, faces, around < 1.6


def on_boundary(faces, count):
    """(count,) bool: a vertex of an edge with one face."""
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), 1)
    unique, times = np.unique(edges, axis=0, return_counts=True)
    return np.isin(np.arange(count), unique[times == 1])


def tried(function, vertices, faces, remedy):
    """The values; Failed with the remedy where the function fails."""
    try:
        return function(vertices, faces)
    except (Failed, NotApplicable):
        raise
    except Exception as error:
        raise Failed(told(error), remedy) from error


def told(error):
    """An error in one short line."""
    text = " ".join(str(error).split())
    short = text if len(text) <= 90 else text[:87] + "..."
    return f"error, {type(error).__name__}: {short}"


def rest(found, expected, keep, words):
    """Raise Failed where values at the vertices `keep` are not as expected."""
    count = len(keep)
    for name, x in found.items():
        change = _change(x[:count][keep], expected[name][keep])
        if not change < CHANGE:
            evidence = f"{words} changes {name} elsewhere by {change:.2g} of its mean"
            raise Failed(evidence, "mend the mesh first")


def kept(found, expected, words, remedy):
    """The evidence that values are as expected; Failed with the remedy where they are not."""
    changes = {name: _change(x, expected[name]) for name, x in found.items()}
    evidence = f"{words}: " + ", ".join(f"{k} off by {x:.1g}" for k, x in changes.items())
    if not all(x < CHANGE for x in changes.values()):
        raise Failed(evidence + " of its mean", remedy)
    return evidence + " of its mean"


def _change(found, expected):
    """The largest difference over the mean of |expected|; infinite where one alone is NaN."""
    if (np.isnan(found) != np.isnan(expected)).any():
        return np.inf
    # To two digits less than rounding the difference depends on the machine.
    change = np.nanmax(np.abs(found - expected)) / np.nanmean(np.abs(expected))
    return max(change, 1e-15)
