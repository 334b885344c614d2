"""The one-ring of a vertex in the paper's letters: named quantities, computed once when asked for.

A Ring is a batch of m one-rings of equal valence n, component first, so that every operation
runs over contiguous memory. The ring of v is v_0 ... v_{n-1}, counter-clockwise seen from the
side the normal points to; indices are taken mod n.
"""

import functools
import math
from functools import cached_property
from typing import Literal

import numpy as np

from .errors import InputError
from .vectors import angle, cross, dot, norm

Normal = Literal["uniform", "area", "exact"]


def following(x):
    """The quantity of i + 1 at i, for (..., n, m)."""
    return np.concatenate((x[..., 1:, :], x[..., :1, :]), axis=-2)


def preceding(x):
    """The quantity of i - 1 at i, for (..., n, m)."""
    return np.concatenate((x[..., -1:, :], x[..., :-1, :]), axis=-2)


def _once_per_normal(quantity):
    """The cached_property of a quantity that depends on the choice of N_v."""

    @functools.wraps(quantity)
    def known(self, normal):
        key = (quantity, normal)
        if key not in self._known:
            self._known[key] = quantity(self, normal)
        return self._known[key]

    return known


class Ring:
    """m one-rings of valence n: `e` (3, n, m) are the edge vectors e_i = v_i - v.

    `exact_normals`: (3, m) unit normals of the surface or None where the mesh has none.
    `following_e`: e_{i+1} where they are known as a view, else copied.
    Lengths are in the unit of the mesh, angles in radians. A degenerate triangle gives NaN.
    """

    def __init__(self, e, exact_normals=None, following_e=None):
        self.e = e
        self._next = following(e) if following_e is None else following_e
        self.exact_normals = exact_normals
        self._known = {}

    @cached_property
    def squares(self):
        """|e_i|^2, (n, m)."""
        return dot(self.e, self.e)

    @cached_property
    def lengths(self):
        """|e_i|, (n, m)."""
        return np.sqrt(self.squares)

    @cached_property
    def _facets(self):
        """Those of i - 1 and i, views (3, n, m): e_i x e_{i+1}, along the normal of T_i and twice
        its area long."""
        n, m = self.e.shape[1:]
        facets = np.empty((3, n + 1, m))
        cross(self.e, self._next, out=facets[:, 1:])
        facets[:, 0] = facets[:, n]
        return facets[:, :n], facets[:, 1:]

    @property
    def _facet(self):
        return self._facets[1]

    @cached_property
    def _twice_areas(self):
        return norm(self._facet)

    @cached_property
    def _scalar(self):
        """e_i . e_{i+1}, (n, m)."""
        return dot(self.e, self._next)

    @cached_property
    def areas(self):
        """Area of the triangle T_i = (v_i, v, v_{i+1}) (3.1), (n, m)."""
        return self._twice_areas / 2

    @cached_property
    def A(self):
        """Area of all triangles around v, (m,): A of (3.11)."""
        return self._twice_areas.sum(0) / 2

    @cached_property
    def facet_normals(self):
        """N_i, the unit normal of T_i (3.2), (3, n, m)."""
        return self._facet / self._twice_areas

    @cached_property
    def alpha(self):
        """alpha_i = angle(v_i, v, v_{i+1}) in [0, pi], (n, m)."""
        # arctan2(area, scalar), in half its time.
        alpha = self._scalar / self._twice_areas
        np.arctan(alpha, out=alpha)
        return np.subtract(math.pi / 2, alpha, out=alpha)

    @cached_property
    def total_angle(self):
        """Sum of all alpha_i, (m,): the argument of a product of complex numbers, from one
        arctangent and the number of times that the product came across the real axis."""
        product = self.lengths * following(self.lengths)
        cosine, sine = self._scalar / product, self._twice_areas / product
        (x, y), half_turns = (cosine[0], sine[0]), 0
        for c, s in zip(cosine[1:], sine[1:]):
            below = np.signbit(y)
            x, y = x * c - y * s, x * s + y * c
            half_turns += np.signbit(y) != below
        return math.pi * half_turns + (math.pi / 2 - np.arctan(x / y))

    @cached_property
    def beta(self):
        """Signed dihedral angle at e_i, between N_{i-1} and N_i, (n, m): convex positive.

        (e_{i-1} x e_i) x (e_i x e_{i+1}) is e_i times the determinant of the three.
        """
        before, facet = self._facets
        return angle(dot(before, facet), -self.lengths * dot(before, self._next))

    @cached_property
    def mixed_area(self):
        """Mixed Voronoi cell of v (Meyer, Desbrun, Schroeder, Barr 2003, section 3.3), (m,)."""
        squares, next_squares = self.squares, following(self.squares)
        at_v, at_i, at_next = self._scalar, squares - self._scalar, next_squares - self._scalar
        # |e_i|^2 cot(angle at v_{i+1}) + |e_{i+1}|^2 cot(angle at v_i), over 8.
        voronoi = (squares * at_next + next_squares * at_i) / (8 * self._twice_areas)
        obtuse = np.where(at_v < 0, self.areas / 2, self.areas / 4)
        acute = (at_v >= 0) & (at_i >= 0) & (at_next >= 0)
        return np.where(acute, voronoi, obtuse).sum(0)

    @_once_per_normal
    def normal(self, kind: Normal):
        """N_v, (3, m) unit: mean of the facet normals (3.3), plain or by area, or the exact one.

        InputError for "exact" where the mesh has no normals.
        """
        if kind == "exact":
            if self.exact_normals is None:
                raise InputError("normal='exact' needs a mesh with normals; this one has none")
            return self.exact_normals
        if kind == "uniform":
            total = np.einsum("cnm,nm->cm", self._facet, 1 / self._twice_areas)
        else:
            total = self._facet.sum(1)
        return total / norm(total)

    @_once_per_normal
    def depth(self, normal: Normal):
        """Distance of v_i below the tangent plane, (n, m): z of the canonical form."""
        return dot(self.e, -self.normal(normal))

    @_once_per_normal
    def projected(self, normal: Normal):
        """(x, y) of the canonical form, (2, n, m): along T_i of (3.23), not of length one."""
        out = np.empty((2, *self.e.shape[1:]))
        return np.einsum("cnm,kcm->knm", self.e, _tangents(self.normal(normal)), out=out)

    def canonical(self, normal: Normal):
        """(x, y, z), each (n, m): the neighbours with v at the origin and -N_v along the z axis.

        The paper's canonical form, turned over: z is the depth below the tangent plane, so that
        a surface which bends away from its normal has positive curvature.
        """
        return *self.projected(normal), self.depth(normal)

    @_once_per_normal
    def kn(self, normal: Normal):
        """Normal curvature towards each v_i (3.16), (n, m); positive where the surface bends
        away from its normal."""
        return 2 * self.depth(normal) / self.squares


def _tangents(N):
    """Two unit vectors (2, 3, m) that with N (3, m) make a right-handed frame.

    Duff et al. 2017, Building an orthonormal basis, revisited (JCGT 6, 1).
    """
    sign = np.copysign(1.0, N[2])
    a = -1 / (sign + N[2])
    b = N[0] * N[1] * a
    X = 1 + sign * N[0] * N[0] * a, sign * b, -sign * N[0]
    Y = b, sign + N[1] * N[1] * a, -N[1]
    return np.array((X, Y))
