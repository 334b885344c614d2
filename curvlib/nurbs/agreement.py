"""Whether the one-sided values at a point of a surface agree: only then is the surface C^2."""

import numpy as np

# Tolerance relative to the largest curvature, plus AGREE_ROUNDED times the rounding of coordinates
# (measured: up to 2.5 times, on spheres and the teapot at distances of 1e3 to 1e8).
AGREE = 1e-9
AGREE_ROUNDED = 10
# The net of Newell's teapot is rounded, so that normals across its seams agree to about 1e-8.
AGREE_NORMAL = 1e-6


def tolerance(net) -> float:
    """The relative tolerance of curvatures."""
    return AGREE + AGREE_ROUNDED * net.rounding


def flat(net) -> float:
    """The curvature below which a surface is flat: 1/size, more where coordinates are rounded."""
    return tolerance(net) / AGREE / net.size


def same(numbers, frame, net):
    """Whether all values of the sides agree, and whether their normals do, (m,) bool each.

    `numbers` (sides, 4, m) are K, H, k1, k2, `frame` (sides, 4, m, 3) is d1, d2, normal, point.

    Along a joint of tangent t with a common normal n, the sides share II(t, .) = -dn(t), and with
    it and the trace 2 H all of II. Where they share the normal at this point alone, K and H may
    agree for different forms: the forms k1 d1 d1^T + k2 d2 d2^T are compared, too.
    """
    K, H, k1, k2 = numbers.swapaxes(0, 1)
    d1, _, n, _ = frame.swapaxes(0, 1)[..., None]
    same_normal = np.ptp(n, axis=0).max((1, 2)) <= AGREE_NORMAL
    scale = np.maximum(np.abs((k1, k2)).max((0, 1)), 1 / net.size)
    same_K = np.ptp(K, axis=0) <= tolerance(net) * scale * scale
    same_H = np.ptp(H, axis=0) <= tolerance(net) * scale
    # At umbilics d1 is NaN, and k1 - k2 is zero.
    d1 = np.nan_to_num(d1)
    gap, k2 = (k1 - k2)[..., None, None], k2[..., None, None]
    form = gap * d1 * d1.mT + k2 * (np.eye(3) - n * n.mT)
    same_form = np.ptp(form, axis=0).max((1, 2)) <= AGREE_NORMAL * scale
    return same_K & same_H & same_form & same_normal, same_normal
