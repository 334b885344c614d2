"""LaPy: smoothed normal-cycle tensors."""

import numpy as np

from curvlib.peers._turned import over_used, six

LABEL = "LaPy"
SOURCE = "https://deep-mi.org/LaPy/dev/api/generated/lapy.TriaMesh.html"
REQUIRES = "lapy"
RETURNS = "relative"
SIGN = "opposite"
BOUNDARY = "estimated"
ORDER = "as named"


def returned(vertices, faces):
    """Principal curvatures and directions of the mean, over the edges at a vertex, of their tensors
    (Alliez et al. 2003), with lengths in mean edges, smoothed three times."""
    import lapy

    smaller, larger, k2, k1, *_ = lapy.TriaMesh(vertices, faces).curvature()
    return k1, k2, larger, smaller


def _scale(vertices, faces):
    """Mean edge times number of edges over twice the cell, by which a tensor is multiplied to be
    the one per area: smoothed as the tensors are, since their weights are its inverse."""
    import lapy

    mesh = lapy.TriaMesh(vertices, faces)
    ends, _ = mesh.edges()
    lengths = np.linalg.norm(mesh.v[ends[:, 1]] - mesh.v[ends[:, 0]], axis=1)
    degrees = np.bincount(ends.ravel(), minlength=len(vertices))
    # The tensor of a vertex without inner edges is 0, and has no weight.
    weights = np.where(degrees, 2 * mesh.vertex_areas() / np.maximum(degrees, 1), 0)
    weights /= lengths.mean()
    return (1 / mesh.smooth_laplace(weights, n=3, lambda_=1.0),)


def estimate(mesh):
    """All six, a mean over the neighbourhood that three steps of smoothing reach."""
    larger, smaller, d_larger, d_smaller = over_used(returned, mesh)
    (scale,) = over_used(_scale, mesh)
    return six(mesh, -smaller * scale, -larger * scale, d_smaller, d_larger)
