"""The one-ring of a vertex in the paper's letters: named quantities, computed once when asked for.

A Ring is a batch of m one-rings of equal valence n, component first, so that every operation
runs over contiguous memory. The ring of v is v_0 ... v_{n-1}, counter-clockwise seen from the
side the normal points to; indices are taken mod n.
"""

from functools import cached_property
from typing import Literal

import numpy as np

from .errors import InputError
from .vectors import cross, dot, norm

Normal = Literal["uniform", "area", "exact"]


def following(x):
    """The quantity of i + 1 at i, for (..., n, m)."""
    return np.roll(x, -1, axis=-2)


def preceding(x):
    """The quantity of i - 1 at i, for (..., n, m)."""
    return np.roll(x, 1, axis=-2)


class Ring:
    """m one-rings of valence n: `e` (3, n, m) are the edge vectors e_i = v_i - v.

    `exact_normals`: (3, m) unit normals of the surface or None where the mesh has none.
    Lengths are in the unit of the mesh, angles in radians. A degenerate triangle gives NaN.
    """

    def __init__(self, e, exact_normals=None):
        self.e = e
        self.exact_normals = exact_normals
        self._canonical = {}

    @cached_property
    def lengths(self):
        """|e_i|, (n, m)."""
        return norm(self.e)

    @cached_property
    def _facet(self):
        """e_i x e_{i+1}, (3, n, m): along the normal of T_i, twice its area long."""
        return cross(self.e, following(self.e))

    @cached_property
    def _twice_areas(self):
        return norm(self._facet)

    @property
    def areas(self):
        """Area of the triangle T_i = (v_i, v, v_{i+1}) (3.1), (n, m)."""
        return self._twice_areas / 2

    @cached_property
    def A(self):
        """Area of all triangles around v, (m,): A of (3.11)."""
        return self.areas.sum(0)

    @cached_property
    def facet_normals(self):
        """N_i, the unit normal of T_i (3.2), (3, n, m)."""
        return self._facet / self._twice_areas

    @cached_property
    def alpha(self):
        """alpha_i = angle(v_i, v, v_{i+1}) in [0, pi], (n, m)."""
        return np.arctan2(self._twice_areas, dot(self.e, following(self.e)))

    @cached_property
    def beta(self):
        """Signed dihedral angle at e_i, between N_{i-1} and N_i, (n, m): convex positive."""
        before, after = preceding(self.facet_normals), self.facet_normals
        across = dot(cross(after, before), self.e)
        return np.arctan2(across / self.lengths, dot(before, after))

    @cached_property
    def mixed_area(self):
        """Mixed Voronoi cell of v (Meyer, Desbrun, Schroeder, Barr 2003, section 3.3), (m,)."""
        at_v = dot(self.e, following(self.e))
        at_i = self.lengths**2 - at_v
        at_next = following(self.lengths) ** 2 - at_v
        # |e_i|^2 cot(angle at v_{i+1}) + |e_{i+1}|^2 cot(angle at v_i), over 8.
        voronoi = self.lengths**2 * at_next + following(self.lengths) ** 2 * at_i
        voronoi = voronoi / (8 * self._twice_areas)
        obtuse = np.where(at_v < 0, self.areas / 2, self.areas / 4)
        acute = (at_v >= 0) & (at_i >= 0) & (at_next >= 0)
        return np.where(acute, voronoi, obtuse).sum(0)

    def normal(self, kind: Normal):
        """N_v, (3, m) unit: mean of the facet normals (3.3), plain or by area, or the exact one.

        InputError for "exact" where the mesh has no normals.
        """
        if kind == "exact":
            if self.exact_normals is None:
                raise InputError("normal='exact' needs a mesh with normals; this one has none")
            return self.exact_normals
        total = (self.facet_normals if kind == "uniform" else self._facet).sum(1)
        return total / norm(total)

    def canonical(self, normal: Normal):
        """(x, y, z), each (n, m): the neighbours with v at the origin and -N_v along the z axis.

        The paper's canonical form, turned over: z is the depth below the tangent plane, so that
        a surface which bends away from its normal has positive curvature.
        """
        if normal not in self._canonical:
            N = self.normal(normal)
            X, Y = _tangents(N)
            frame = (X[:, None], Y[:, None], -N[:, None])
            self._canonical[normal] = tuple(dot(self.e, axis) for axis in frame)
        return self._canonical[normal]

    def kn(self, normal: Normal):
        """Normal curvature towards each v_i (3.16), (n, m); positive where the surface bends
        away from its normal."""
        return 2 * self.canonical(normal)[2] / self.lengths**2

    def directions(self, normal: Normal):
        """T_i of (3.23) as (cos, sin) in the tangent plane, (2, n, m)."""
        x, y, _ = self.canonical(normal)
        return np.stack((x, y)) / np.sqrt(x * x + y * y)


def _tangents(N):
    """Two unit vectors that with N (3, m) make a right-handed frame.

    Duff et al. 2017, Building an orthonormal basis, revisited (JCGT 6, 1).
    """
    sign = np.copysign(1.0, N[2])
    a = -1 / (sign + N[2])
    b = N[0] * N[1] * a
    X = np.stack((1 + sign * N[0] * N[0] * a, sign * b, -sign * N[0]))
    Y = np.stack((b, sign + N[1] * N[1] * a, -N[1]))
    return X, Y
