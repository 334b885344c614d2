"""A NURBS surface with its exact curvature: everywhere, at poles, on seams and knot lines."""

import itertools
from collections import namedtuple

import numpy as np

from curvlib.errors import InputError

from .patches import Patches

Curvature = namedtuple("Curvature", "K H k1 k2 d1 d2 smooth normal")
Curvature.__doc__ = """Exact curvature at points of a surface, pointwise.

K, H and k1 >= k2 (...), d1 and d2 (..., 3) unit: the directions of k1 and k2, smooth (...)
bool: the surface is C^2 there, normal (..., 3) unit. H > 0 where the surface bends away from
its normal. d1, d2 and the normal are right-handed; d1 and -d1 are the same direction. Where
k1 = k2 to rounding (umbilics), d1 and d2 are NaN. Where the one-sided values differ, all but
the normal are NaN and smooth is False; the normal is NaN only where the normals differ.
"""

# One-sided values that agree to this, relative to the largest curvature, are one value; the
# normals of Newell's teapot agree across its seams only to the 1e-8 or so of its rounded net.
AGREE = 1e-9
AGREE_NORMAL = 1e-6

POLE_MERIDIANS = 7  # per knot span; three determine the form, the others test it


class Surface:
    """A NURBS surface S(u, v), its normal along S_u x S_v.

    `model` is the geomdl surface, `name` and `label` are its names in files and in legends,
    `domain` is ((u0, u1), (v0, v1)), `closed` tells for u and for v whether the two ends meet
    in a seam.
    """

    def __init__(self, model, name: str = "", label: str = ""):
        self.model, self.name, self.label = model, name, label or name
        self._patches = Patches(model)
        self.closed = self._patches.closed
        self.domain = tuple((float(b[0]), float(b[-1])) for b in self._patches.breaks)
        self._poles = {edge: self._pole(*edge) for edge in self._patches.poles}

    def __repr__(self):
        return f"<Surface {self.name!r}, domain {self.domain}>"

    def has_pole(self, axis: int, end: int) -> bool:
        """Whether the line u = const (axis 0) or v = const (axis 1) at that end, 0 or -1, is
        a single point."""
        return (axis, end) in self._poles

    def point(self, u, v):
        """S(u, v), shape (..., 3); u, v broadcast. InputError outside the domain."""
        from . import exact

        (u, v), shape = self._arguments(u, v)
        return exact.points(self._patches.pieces, self.closed, u, v).reshape(*shape, 3)

    def normal(self, u, v):
        """Unit normal, shape (..., 3); NaN where the one-sided normals differ."""
        return self.curvature(u, v).normal

    def curvature(self, u, v) -> Curvature:
        """Exact curvature from second derivatives; u, v broadcast. InputError outside the domain.

        On knot lines and seams the values of all sides have to agree; at a pole those of all
        meridians.
        """
        (u, v), shape = self._arguments(u, v)
        numbers, vectors = self._one_sided(u, v, True, True)
        smooth, one_normal = np.isfinite(numbers[0]), np.isfinite(vectors[2, :, 0])
        on_joint = np.flatnonzero(self._on_joint(0, u) | self._on_joint(1, v))
        if len(on_joint):
            sides = itertools.product((False, True), repeat=2)
            sides = [self._one_sided(u[on_joint], v[on_joint], *side) for side in sides]
            smooth[on_joint], one_normal[on_joint] = self._agree(*zip(*sides))
        for (axis, end), (pole_numbers, pole_vectors) in self._poles.items():
            here = (u, v)[axis] == self.domain[axis][end]
            if here.any():
                numbers[:, here], vectors[:, here] = pole_numbers[:, None], pole_vectors[:, None]
                smooth[here] = np.isfinite(pole_numbers[0])
                one_normal[here] = np.isfinite(pole_vectors[2, 0])
        numbers[:, ~smooth], vectors[:2, ~smooth] = np.nan, np.nan
        vectors[2, ~one_normal] = np.nan
        d1, d2, normal = vectors.reshape(3, *shape, 3)
        numbers = numbers.reshape(4, *shape)
        return Curvature(*numbers, d1, d2, smooth.reshape(shape), normal)

    def _arguments(self, u, v):
        u, v = np.broadcast_arrays(np.asarray(u, float), np.asarray(v, float))
        for letter, t, (low, high) in zip("uv", (u, v), self.domain):
            outside = ~((t >= low) & (t <= high))
            if outside.any():
                raise InputError(
                    f"{letter} = {t[outside][0]:g} lies outside the domain [{low:g}, {high:g}] "
                    f"of surface {self.name!r}"
                )
        return (u.ravel(), v.ravel()), u.shape

    def _on_joint(self, axis, t):
        """Whether more than one piece meets at every parameter t."""
        breaks = self._patches.breaks[axis]
        joint = np.zeros(t.shape, dtype=bool)
        for line in breaks if self.closed[axis] else breaks[1:-1]:
            joint |= t == line
        return joint

    def _agree(self, numbers, vectors):
        """Whether curvatures, and whether normals, of all sides are the same."""
        K, H, k1, k2 = np.stack(numbers, axis=1)
        one_normal = np.ptp(np.stack(vectors)[:, 2], axis=0).max(1) <= AGREE_NORMAL
        scale = np.maximum(np.abs((k1, k2)).max((0, 1)), 1 / self._patches.size)
        same_K = np.ptp(K, axis=0) <= AGREE * scale * scale
        same_H = np.ptp(H, axis=0) <= AGREE * scale
        return same_K & same_H & one_normal, one_normal

    def _one_sided(self, u, v, above_u, above_v):
        """K, H, k1, k2 (4, m) and d1, d2, the normal (3, m, 3) of one side of every point; NaN
        at a singular one."""
        from . import exact

        pieces, size = self._patches.pieces, self._patches.size
        return exact.curvatures(pieces, self.closed, size, u, v, above_u, above_v)

    def _pole(self, axis, end):
        """As `_one_sided`, (4,) and (3, 3), at a pole; NaN where the surface is not C^2 (not
        C^1) there.

        Every meridian passes through the pole, so each gives II(d, d) = S_vv . n in its own
        direction d = S_v; all of them together have to be one quadratic form.
        """
        from . import exact

        breaks = self._patches.breaks[1 - axis]
        steps = np.arange(1, POLE_MERIDIANS + 1) / (POLE_MERIDIANS + 1)
        around = (breaks[:-1, None] + np.diff(breaks)[:, None] * steps).ravel()
        edge = np.full_like(around, self.domain[axis][end])
        u, v = (edge, around) if axis == 0 else (around, edge)
        # No seam is crossed, not even where a pole lies at both ends of closed meridians.
        sides = [
            [exact.side(b, False, x, True) for x in t] for b, t in zip(self._patches.breaks, (u, v))
        ]
        S = [exact.derivatives(self._patches.pieces, *a, *b) for a, b in zip(*sides)]
        S = np.moveaxis(S, 0, 1)
        along, second = (S[1], S[3]) if axis == 0 else (S[2], S[5])
        # S_uv x S_v is outward where v leaves the pole, S_u x S_uv where u does.
        across = S[4] if (axis == 1) == (end == 0) else -S[4]
        return _from_meridians(along, second, across, self._patches.size)


def _from_meridians(along, second, across, size):
    """Pole values from the first (m, 3) and second derivatives along the meridians through it,
    and the derivative `across` them of the first, signed so that across x along is outward."""
    from curvlib.kit.fit import least_squares

    from . import exact

    numbers, vectors = np.full(4, np.nan), np.full((3, 3), np.nan)
    speed = np.sqrt(_dot(along, along))
    if not (speed > 1e-12 * size).all():
        return numbers, vectors
    d = along / speed[:, None]
    n = np.cross(across, along).sum(0)
    with np.errstate(invalid="ignore"):
        n /= np.sqrt(_dot(n, n))
    if np.abs(_dot(d, n)).max() > AGREE_NORMAL:
        return numbers, vectors
    e1 = d[0] - n * _dot(n, d[0])
    e1 /= np.sqrt(_dot(e1, e1))
    x, y, kn = _dot(d, e1), _dot(d, np.cross(n, e1)), -_dot(second, n) / (speed * speed)
    columns = np.array([x * x, 2 * x * y, y * y, kn])
    form = least_squares(columns[:, :, None].copy())[:, 0]
    residual = np.abs(form @ columns[:3] - kn).max()
    if residual <= AGREE * max(np.abs(kn).max(), 1 / size):
        numbers, vectors = map(np.array, exact.principal(*form, tuple(e1), tuple(n), size))
    vectors[2] = n
    return numbers, vectors


def _dot(a, b):
    return (a * b).sum(-1)
