"""Tensor voting as a plain implementation, from its publications' formulas."""

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra


def joined(pairs, points):
    """The graph (n, n) of pairs of points, weighted by distance."""
    i, j = np.unique(np.vstack((pairs, pairs[:, ::-1])), axis=0).T
    length = np.linalg.norm(points[i] - points[j], axis=1)
    return coo_matrix((length, (i, j)), (len(points),) * 2).tocsr()


def elements(vertices, faces, per):
    """Points, normals, areas and the graph of vertices, or of triangles that share a vertex."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    facets, count = np.cross(b - a, c - a) / 2, len(faces)
    areas = np.linalg.norm(facets, axis=1)
    if per == "face":
        corners = coo_matrix((np.ones(3 * count), (np.repeat(np.arange(count), 3), faces.ravel())))
        near = (corners @ corners.T).tocoo()
        pairs = np.column_stack((near.row, near.col))[near.row != near.col]
        points = (a + b + c) / 3
        return points, facets / areas[:, None], areas, joined(pairs, points)
    normals, thirds = np.zeros_like(vertices), np.zeros(len(vertices))
    for k in range(3):
        np.add.at(normals, faces[:, k], facets)
        np.add.at(thirds, faces[:, k], areas / 3)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    pairs = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    return vertices, normals, thirds, joined(pairs, vertices)


def within(edges, v, radius):
    """Those within a radius along edges, and their distances."""
    g = dijkstra(edges, indices=v, limit=radius)
    found = np.flatnonzero(np.isfinite(g) & (np.arange(len(g)) != v))
    return found, g[found]


def normal_of_votes(points, normals, areas, v, near, radius):
    """Page et al. (2002), equations 2 to 8; Salfer et al. (2020)."""
    i, g = near
    d = points[i] - points[v]
    d /= np.linalg.norm(d, axis=1)[:, None]
    votes = normals[i] - 2 * (normals[i] * d).sum(1)[:, None] * d
    w = areas[i] / areas.max() * np.exp(-3 * g / radius)
    n = np.linalg.eigh((votes * w[:, None]).T @ votes)[1][:, 2]
    return n * np.sign(n @ normals[v])


def curvature_of_votes(points, n, areas, v, near, radius, directions="uniform"):
    """k1, k2, d1: Page et al. (2002), equations 5 and 13 to 17, with Tong and Tang's curvature."""
    i, g = near
    d = points[i] - points[v]
    t = d - (d @ n[v])[:, None] * n[v]
    t /= np.linalg.norm(t, axis=1)[:, None]
    p = np.cross(n[v], t)
    flat = n[i] - (p * n[i]).sum(1)[:, None] * p
    phi = np.arccos(np.clip(flat @ n[v] / np.linalg.norm(flat, axis=1), -1, 1))
    kappa = 2 * np.cos((np.pi - phi) / 2) / np.linalg.norm(d, axis=1) * np.sign((t * flat).sum(1))
    w = np.exp(-3 * g / radius) * areas[i]
    x = np.linalg.svd(n[v][None])[2][1:]
    if directions == "fitted":
        a, b = t @ x.T[:, 0], t @ x.T[:, 1]
        r = np.sqrt(w)
        columns = np.column_stack((a * a, 2 * a * b, b * b)) * r[:, None]
        xx, xy, yy = np.linalg.lstsq(columns, kappa * r, rcond=None)[0]
        (k2, k1), axes = np.linalg.eigh([[xx, xy], [xy, yy]])
        return k1, k2, axes[:, 1] @ x
    b, axes = np.linalg.eigh(x @ ((t * (w * kappa)[:, None]).T @ t) @ x.T / w.sum())
    return 3 * b[1] - b[0], 3 * b[0] - b[1], axes[:, 1] @ x


def estimate(vertices, faces, per, radius, weights, directions="uniform"):
    """k1, k2 (n,) and d1 (n, 3) by the two functions above."""
    points, normals, areas, edges = elements(vertices, faces, per)
    near = [within(edges, v, radius) for v in range(len(points))]
    n = [normal_of_votes(points, normals, areas, v, x, radius) for v, x in enumerate(near)]
    areas = areas if weights == "area" else np.ones(len(areas))
    found = [
        curvature_of_votes(points, np.array(n), areas, v, x, radius, directions)
        for v, x in enumerate(near)
    ]
    return map(np.array, zip(*found))
