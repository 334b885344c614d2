"""A NURBS surface with its exact curvature: everywhere, at poles, on seams and knot lines."""

from collections import namedtuple

import numpy as np

from .errors import InputError
from .fit import least_squares
from .patches import Patches
from .vectors import cross, dot, norm

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
        (u, v), shape = self._arguments(u, v)
        (span_u, u), (span_v, v) = (self._sides(axis, t)[1] for axis, t in enumerate((u, v)))
        return self._patches.evaluate(u, v, span_u, span_v, order=0)[0].T.reshape(*shape, 3)

    def normal(self, u, v):
        """Unit normal, shape (..., 3); NaN where the one-sided normals differ."""
        return self.curvature(u, v).normal

    def curvature(self, u, v) -> Curvature:
        """Exact curvature from second derivatives; u, v broadcast. InputError outside the domain.

        On knot lines and seams the values of all sides have to agree; at a pole those of all
        meridians.
        """
        (u, v), shape = self._arguments(u, v)
        below_u, above_u = self._sides(0, u)
        below_v, above_v = self._sides(1, v)
        values = self._one_sided(*above_u, *above_v)
        on_joint = np.flatnonzero((below_u[0] != above_u[0]) | (below_v[0] != above_v[0]))
        smooth, one_normal = np.isfinite(values[0]), np.isfinite(values[-1])
        sides = np.array(
            [
                self._one_sided(*(x[on_joint] for x in (*side_u, *side_v)))
                for side_u in (below_u, above_u)
                for side_v in (below_v, above_v)
            ]
        )
        smooth[on_joint], one_normal[on_joint] = self._agree(sides)
        for (axis, end), pole in self._poles.items():
            here = (u, v)[axis] == self.domain[axis][end]
            if here.any():
                values[:, here] = pole[:, None]
                smooth[here], one_normal[here] = np.isfinite(pole[0]), np.isfinite(pole[-1])
        values[:-3, ~smooth] = np.nan
        values[-3:, ~one_normal] = np.nan
        d1, d2, normal = (x.T.reshape(*shape, 3) for x in np.split(values[4:], 3))
        return Curvature(*values[:4].reshape(4, *shape), d1, d2, smooth.reshape(shape), normal)

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

    def _sides(self, axis, t):
        """(span, parameter) below and above every t; across a seam the other end of the domain."""
        breaks = self._patches.breaks[axis]
        last = len(breaks) - 2
        below = np.searchsorted(breaks, t, side="left") - 1
        above = np.searchsorted(breaks, t, side="right") - 1
        if not self.closed[axis]:
            return (np.maximum(below, 0), t), (np.minimum(above, last), t)
        before, after = below < 0, above > last
        return (
            (np.where(before, last, below), np.where(before, breaks[-1], t)),
            (np.where(after, 0, above), np.where(after, breaks[0], t)),
        )

    def _agree(self, sides):
        """Whether curvatures, and whether normals, of all sides (sides, 13, m) are the same."""
        one_normal = np.ptp(sides[:, -3:], axis=0).max(0) <= AGREE_NORMAL
        scale = np.maximum(np.abs(sides[:, 2:4]).max((0, 1)), 1 / self._patches.size)
        same_K = np.ptp(sides[:, 0], axis=0) <= AGREE * scale * scale
        same_H = np.ptp(sides[:, 1], axis=0) <= AGREE * scale
        return same_K & same_H & one_normal, one_normal

    def _one_sided(self, span_u, u, span_v, v):
        """K, H, k1, k2 and the components of d1, d2 and the normal, (13, m); NaN at a singular
        point.

        The second fundamental form is taken in the orthonormal frame of S_u / |S_u| and
        n x S_u / |S_u|: there k1 - k2 is a length, exact also where k1 = k2.
        """
        _, S_u, S_v, S_uu, S_uv, S_vv = self._patches.evaluate(u, v, span_u, span_v)
        with np.errstate(divide="ignore", invalid="ignore"):
            n = cross(S_u, S_v)
            area, p = norm(n), norm(S_u)
            n /= np.where(area > 1e-13 * p * norm(S_v), area, np.nan)
            q, r = dot(S_u, S_v) / p, area / p
            L, M, N = -dot(S_uu, n), -dot(S_uv, n), -dot(S_vv, n)
            a = L / (p * p)
            b = (M / p - q * a) / r
            c = (N - q * q * a - 2 * q * r * b) / (r * r)
            return _principal(a, b, c, S_u / p, n, self._patches.size)

    def _pole(self, axis, end):
        """As `_one_sided`, (13,), at a pole; NaN where the surface is not C^2 (not C^1) there.

        Every meridian passes through the pole, so each gives II(d, d) = S_vv . n in its own
        direction d = S_v; all of them together have to be one quadratic form.
        """
        breaks = self._patches.breaks[1 - axis]
        steps = np.arange(1, POLE_MERIDIANS + 1) / (POLE_MERIDIANS + 1)
        around = (breaks[:-1, None] + np.diff(breaks)[:, None] * steps).ravel()
        span = np.repeat(np.arange(len(breaks) - 1), POLE_MERIDIANS)
        edge = np.full_like(around, self.domain[axis][end])
        edge_span = np.full_like(span, 0 if end == 0 else len(self._patches.breaks[axis]) - 2)
        if axis == 1:
            _, _, along, _, across, second = self._patches.evaluate(around, edge, span, edge_span)
        else:
            _, along, _, second, across, _ = self._patches.evaluate(edge, around, edge_span, span)
            across = -across
        return _from_meridians(along, second, across if end == 0 else -across, self._patches.size)


def _from_meridians(along, second, across, size):
    """Pole values (13,) from the first (3, m) and second derivatives along the meridians through
    it, and the derivative `across` them of the first, signed so that across x along is outward."""
    nothing = np.full(13, np.nan)
    speed = norm(along)
    if not (speed > 1e-12 * size).all():
        return nothing
    d = along / speed
    n = cross(across, along).sum(1)
    n /= norm(n)
    if np.abs(dot(d, n[:, None])).max() > AGREE_NORMAL:
        return nothing
    e1 = d[:, 0] - n * dot(n, d[:, 0])
    e1 /= norm(e1)
    x, y = dot(d, e1[:, None]), dot(d, cross(n, e1)[:, None])
    kn = -dot(second, n[:, None]) / (speed * speed)
    columns = np.array([x * x, 2 * x * y, y * y])
    form = least_squares(columns[..., None], kn[:, None])[:, 0]
    residual = np.abs(dot(columns, form[:, None]) - kn).max()
    smooth = residual <= AGREE * max(np.abs(kn).max(), 1 / size)
    return _principal(*form, e1, n, size) if smooth else np.array([*nothing[:-3], *n])


def _principal(a, b, c, e1, n, size):
    """K, H, k1, k2, d1, d2, n (13, ...) of the form [[a, b], [b, c]] in the frame e1, n x e1."""
    H, half = (a + c) / 2, (a - c) / 2
    gap = np.sqrt(half * half + b * b)
    k1, k2 = H + gap, H - gap
    # (half + gap, b) and (b, gap - half) both point along k1; of two the longer does not cancel.
    steep = half < 0
    x, y = np.where(steep, b, half + gap), np.where(steep, gap - half, b)
    scale = np.maximum(np.maximum(np.abs(k1), np.abs(k2)), 1 / size)
    length = np.where(gap > AGREE * scale, np.sqrt(x * x + y * y), np.nan)
    d1 = (x * e1 + y * cross(n, e1)) / length
    return np.array([a * c - b * b, H, k1, k2, *d1, *cross(n, d1), *n])
