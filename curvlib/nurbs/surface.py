"""A NURBS surface with its exact curvature, also at poles, on seams and on knot lines."""

import itertools
import reprlib

import numpy as np
from numpy.typing import ArrayLike

from curvlib.errors import InputError

from .agreement import flat, same
from .curvature import Curvature
from .net import Net
from .polynomials import expand


class Surface:
    """A NURBS surface S(u, v) with its exact curvature.

    Its normal is along S_u x S_v; H > 0 where the surface bends away from it.

    Parameters
    ----------
    model : geomdl.NURBS.Surface or geomdl.BSpline.Surface
        Control points in three dimensions, positive weights (without any they are one), and
        knots, clamped or not: the domain of degree p and knots U is [U_p, U_-p-1].
    name, label : str, optional
        Its name in files and messages; its name in legends.

    Attributes
    ----------
    domain : tuple
        ((u0, u1), (v0, v1)).
    breaks : tuple of ndarray
        The distinct knots of u and of v inside the domain, ends included.
    closed : tuple of bool
        For u and for v, whether both ends of the domain are the same curve, a seam. It is found
        on the surface, so that weights count and knots need not be clamped.

    Raises
    ------
    InputError
        For a model that is not complete, is trimmed, torn by a knot, has weights that are not
        positive, or lies so far from the origin that rounding leaves no curvature.

    Notes
    -----
    Between knots a surface is a quotient of polynomials, and its derivatives are exact but for
    rounding. The formulas are those of do Carmo, Differential Geometry of Curves and Surfaces
    (1976), section 3.3; the domain is de Boor's, A Practical Guide to Splines (1978).

    Examples
    --------
    >>> from geomdl import BSpline
    >>> import curvlib
    >>> model = BSpline.Surface()
    >>> model.degree_u = model.degree_v = 1
    >>> model.set_ctrlpts([[0, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 1]], 2, 2)
    >>> model.knotvector_u = model.knotvector_v = [0, 0, 1, 1]
    >>> saddle = curvlib.Surface(model, "saddle")
    >>> saddle.domain
    ((0.0, 1.0), (0.0, 1.0))
    >>> float(saddle.curvature(0, 0).K)
    -1.0
    """

    def __init__(self, model, name: str = "", label: str = ""):
        self.model, self.name, self.label = model, name, label or name
        self._net = Net(model, f"surface {name!r}")
        self._polynomials = expand(self._net)
        self.closed = self._net.closed
        self.breaks = self._polynomials[:2]
        self.domain = tuple((float(b[0]), float(b[-1])) for b in self.breaks)
        self._poles = {}
        if self._net.poles:
            from .poles import at_pole

            for edge in self._net.poles:
                self._poles[edge] = at_pole(self._net, self._polynomials, *edge)

    def __repr__(self):
        return f"<Surface {self.name!r}, domain {self.domain}>"

    def has_pole(self, axis: int, end: int) -> bool:
        """Whether an edge of the domain is a single point.

        Parameters
        ----------
        axis : {0, 1}
            The edge u = const (0) or v = const (1).
        end : {0, -1}
            The lower or upper edge.

        Returns
        -------
        bool
        """
        return (axis, end) in self._poles

    def point(self, u: ArrayLike, v: ArrayLike) -> np.ndarray:
        """Points S(u, v).

        Parameters
        ----------
        u, v : array_like
            Parameters inside the domain; they broadcast.

        Returns
        -------
        ndarray, shape (..., 3)
            In the unit of the control points.

        Raises
        ------
        InputError
            A parameter outside the domain by more than rounding; u and v that do not broadcast.

        Examples
        --------
        >>> import curvlib
        >>> curvlib.surface("cylinder").point([0, 0.25], 0.5).round(12)
        array([[1., 0., 0.],
               [0., 1., 0.]])
        """
        from . import exact

        (u, v), shape = self._arguments(u, v)
        return exact.points(self._polynomials, self.closed, u, v).reshape(*shape, 3)

    def normal(self, u: ArrayLike, v: ArrayLike) -> np.ndarray:
        """Unit normals along S_u x S_v.

        Parameters
        ----------
        u, v : array_like
            As for `point`.

        Returns
        -------
        ndarray, shape (..., 3)
            NaN where the sides of a knot line or seam have different normals, and at a pole without
            a tangent plane. Raises as `point` does.

        Examples
        --------
        >>> import curvlib
        >>> curvlib.surface("teapot_body").normal(1, 0.3).shape
        (3,)
        """
        return self.curvature(u, v).normal

    def curvature(self, u: ArrayLike, v: ArrayLike) -> Curvature:
        """Exact curvature, from second derivatives.

        Parameters
        ----------
        u, v : array_like
            Parameters inside the domain; they broadcast.

        Returns
        -------
        Curvature
            K, H, k1, k2, d1, d2, smooth, normal, point, of the broadcast shape. NaN, and `smooth`
            False, on knot lines and seams whose sides disagree and at poles whose meridians do.

        Raises
        ------
        InputError
            As for `point`.

        Examples
        --------
        >>> import curvlib
        >>> sphere = curvlib.surface("sphere").curvature(0.1, [0, 0.3])
        >>> sphere.K.round(12), sphere.H.round(12), sphere.smooth
        (array([1., 1.]), array([1., 1.]), array([ True,  True]))
        >>> bool(curvlib.surface("cone_apex").curvature(0.1, 1).smooth)
        False
        """
        (u, v), shape = self._arguments(u, v)
        numbers, frame = self._one_sided(u, v, True, True)
        d1, d2, normal, point = frame
        smooth = np.isfinite(numbers[0])
        on_joint = np.flatnonzero(self._on_joint(0, u) | self._on_joint(1, v))
        if len(on_joint):
            sides = itertools.product((False, True), repeat=2)
            sides = [self._one_sided(u[on_joint], v[on_joint], *side) for side in sides]
            agree, agree_normal = same(*map(np.array, zip(*sides)), self._net)
            rough = on_joint[~agree]
            numbers[:, rough], d1[rough], d2[rough], smooth[rough] = np.nan, np.nan, np.nan, False
            normal[on_joint[~agree_normal]] = np.nan
        for (axis, end), (pole_numbers, pole_frame) in self._poles.items():
            here = np.flatnonzero((u, v)[axis] == self.domain[axis][end])
            numbers[:, here], smooth[here] = pole_numbers[:, None], np.isfinite(pole_numbers[0])
            d1[here], d2[here], normal[here] = pole_frame
        numbers = numbers.reshape(4, *shape)
        d1, d2, normal, point = (a.reshape(*shape, 3) for a in frame)
        return Curvature(*numbers, d1, d2, smooth.reshape(shape), normal, point)

    def _arguments(self, u, v):
        """u and v as flat arrays inside the domain, and the shape that they broadcast to."""
        u, v = _numbers("u", u), _numbers("v", v)
        try:
            u, v = np.broadcast_arrays(u, v)
        except ValueError:
            raise InputError(
                f"u and v of shapes {u.shape} and {v.shape} do not broadcast"
            ) from None
        arguments = []
        for letter, t, (low, high) in zip("uv", (u.ravel(), v.ravel()), self.domain):
            if not ((t >= low) & (t <= high)).all():
                near = 4 * np.spacing(max(abs(low), abs(high)))
                outside = ~((t >= low - near) & (t <= high + near))
                if outside.any():
                    raise InputError(
                        f"{letter} = {float(t[outside][0])!r} lies outside the domain "
                        f"[{low!r}, {high!r}] of surface {self.name!r}"
                    )
                t = t.clip(low, high)
            arguments.append(t)
        return arguments, u.shape

    def _on_joint(self, axis, t):
        """Whether more than one piece meets at every parameter t."""
        breaks = self.breaks[axis]
        joint = np.zeros(t.shape, dtype=bool)
        for line in breaks if self.closed[axis] else breaks[1:-1]:
            joint |= t == line
        return joint

    def _one_sided(self, u, v, above_u, above_v):
        """K, H, k1, k2 (4, m) and d1, d2, normal, point (m, 3) of one side of every point."""
        from . import exact

        where = self._polynomials, self.closed, flat(self._net)
        return exact.curvatures(*where, u, v, above_u, above_v)


def _numbers(letter, t):
    try:
        array = np.asarray(t)
        if array.dtype.kind in "biufO":
            return array.astype(float, copy=False)
    except (OverflowError, TypeError, ValueError):
        pass
    raise InputError(f"{letter}: {reprlib.repr(t)} is not a number or an array of numbers")
