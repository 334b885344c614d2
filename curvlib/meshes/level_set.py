"""Exact curvature of a level set of a function f that grows outward.

In an orthonormal frame of the tangent plane the second fundamental form is the Hessian of f over
|grad f|, positive where the surface bends away from its normal.
"""

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.tensor import batch, from_form, put
from curvlib.kit.vectors import at, divide, dot, norm, tangents


def on_level_set(gradient, hessian) -> dict:
    """The fields of a Mesh that a level set has at points of it.

    Parameters
    ----------
    gradient : ndarray, (3, V)
        Of f.
    hessian : ndarray, (3, 3, V)

    Returns
    -------
    dict
        K, H, k1, k2 (V,), d1, d2 and outward unit normals (V, 3), pointwise; NaN where the gradient
        is zero. Directions are NaN at umbilics.

    Examples
    --------
    >>> import numpy as np
    >>> x = np.array([[0.0], [0.0], [2.0]])  # on the sphere |x|^2 = 4
    >>> float(on_level_set(2 * x, 2 * np.eye(3)[..., None])["K"][0])
    0.25
    """
    values, normals = _curvatures(np.ascontiguousarray(gradient), np.ascontiguousarray(hessian))
    fields = {name: np.ascontiguousarray(x.T) for name, x in values._asdict().items()}
    return fields | {"normals": normals.T}


@compiled
def _curvatures(gradient, hessian):
    """Curvatures and unit normals (3, m) of a level set, from gradients (3, m) and Hessians
    (3, 3, m) of its function."""
    m = gradient.shape[1]
    values, normals = batch(m), np.empty((3, m))
    for k in range(m):
        g = at(gradient, k)
        length = norm(g)
        n = divide(g, length)
        X, Y = tangents(n)
        rows = at(hessian, 0, k), at(hessian, 1, k), at(hessian, 2, k)
        to_x = dot(rows[0], X), dot(rows[1], X), dot(rows[2], X)
        to_y = dot(rows[0], Y), dot(rows[1], Y), dot(rows[2], Y)
        a, b, c = dot(X, to_x), dot(X, to_y), dot(Y, to_y)
        put(values, k, from_form(a / length, b / length, c / length, X, n))
        for i in range(3):
            normals[i, k] = n[i]
    return values, normals
