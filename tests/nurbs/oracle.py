"""Curvature by the classical formulas, from derivatives that others evaluate."""

import numpy as np
from scipy.interpolate import NdBSpline


def from_derivatives(S_u, S_v, S_uu, S_uv, S_vv):
    """K and H by the classical formulas, arrays (m, 3) in."""
    n = np.cross(S_u, S_v)
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    E, F, G = ((a * b).sum(1) for a, b in ((S_u, S_u), (S_u, S_v), (S_v, S_v)))
    L, M, N = (-(a * n).sum(1) for a in (S_uu, S_uv, S_vv))
    area = E * G - F * F
    return (L * N - M * M) / area, (E * N - 2 * F * M + G * L) / (2 * area), n


def assert_same(found, expected, tolerance):
    """Within a tolerance relative to the principal curvatures, K and H at every point."""
    k = np.abs(expected.H) + np.sqrt(np.maximum(expected.H**2 - expected.K, 0)) + 1e-300
    assert np.all(np.abs(found[0] - expected.K) <= tolerance * k**2)
    assert np.all(np.abs(found[1] - expected.H) <= tolerance * k)


def from_scipy(model, u, v):
    """S, K, H and the normal of a geomdl surface, by SciPy's B-splines."""
    knots = (np.array(model.knotvector_u), np.array(model.knotvector_v))
    net = np.reshape(model.ctrlptsw, (model.ctrlpts_size_u, model.ctrlpts_size_v, 4))
    spline = NdBSpline(knots, net, (model.degree_u, model.degree_v))

    def A(*nu):
        return spline(np.column_stack((u, v)), nu=nu)

    w, w_u, w_v = (A(*nu)[:, 3:] for nu in ((0, 0), (1, 0), (0, 1)))
    S = A(0, 0)[:, :3] / w
    S_u, S_v = (A(1, 0)[:, :3] - w_u * S) / w, (A(0, 1)[:, :3] - w_v * S) / w
    S_uu = (A(2, 0)[:, :3] - 2 * w_u * S_u - A(2, 0)[:, 3:] * S) / w
    S_vv = (A(0, 2)[:, :3] - 2 * w_v * S_v - A(0, 2)[:, 3:] * S) / w
    S_uv = (A(1, 1)[:, :3] - w_u * S_v - w_v * S_u - A(1, 1)[:, 3:] * S) / w
    return S, *from_derivatives(S_u, S_v, S_uu, S_uv, S_vv)
