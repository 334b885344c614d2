"""The meshes of the comparison of 2020, and its numbers obtained again on them.

Source: https://doi.org/10.1371/journal.pcbi.1007962; `published-2020.csv` has means of its stored
tables.
"""

import math
from types import SimpleNamespace

import numpy as np
import pandas as pd

from curvlib.catalogue import peers
from curvlib.errors import InputError
from curvlib.estimation import estimate
from curvlib.meshes.mesh import Mesh

from .quantities import angle
from .voxels import PUBLISHED, sphere

# What their methods are called here; of the others there is no implementation.
VOTING = {"AVV": "area", "RVV": "none"}
# The level of a Gaussian at three standard deviations.
LEVEL = math.exp(-4.5)
MAJOR, MINOR, TURNS = 25.0, 10.0, 49  # of the torus


def _gaussian(r):
    """Marching cubes over a Gaussian of standard deviation r / 3 at voxel centres: radius r."""
    import pyvista

    axis = np.arange(-r - 2, r + 3)
    x, y, z = np.meshgrid(axis, axis, axis, indexing="ij")
    values = np.exp(-4.5 / r**2 * (x * x + y * y + z * z))
    image = pyvista.ImageData(dimensions=values.shape, origin=(-r - 2.0,) * 3)
    image["values"] = values.ravel(order="F")
    surface = image.contour([LEVEL], method="marching_cubes")
    return Mesh(surface.points.astype(float), surface.regular_faces)


def _torus():
    """A grid of 49 x 49 points of equal angles."""
    i, j = np.divmod(np.arange(TURNS**2), TURNS)
    u, v = 2 * np.pi / TURNS * i, 2 * np.pi / TURNS * j
    r = MAJOR + MINOR * np.cos(v)
    a, b, c, d = (
        (i + k) % TURNS * TURNS + (j + m) % TURNS for k, m in ((0, 0), (1, 0), (1, 1), (0, 1))
    )
    faces = np.stack((a, b, c, a, c, d), -1).reshape(-1, 3)
    return Mesh(np.stack((r * np.cos(u), r * np.sin(u), MINOR * np.sin(v)), -1), faces)


MESHES = {
    "voxel-sphere-10": lambda: sphere(10),
    "voxel-sphere-30": lambda: sphere(30),
    "smooth-sphere-10": lambda: _gaussian(10),
    "smooth-sphere-20": lambda: _gaussian(20),
    "torus-25-10": _torus,
}


def exact(name: str, points) -> dict:
    """k1, k2, H and, of the torus, d1 (m, 3) and d2, at points (m, 3) near the surface."""
    if name == "torus-25-10":
        x, y, z = points.T
        around = np.hypot(x, y)
        cosine = np.sign(around - MAJOR) * np.sqrt(np.maximum(1 - (z / MINOR) ** 2, 0))
        k1, k2, zero = np.full(len(x), 1 / MINOR), cosine / around, 0 * x
        d2 = np.column_stack((-y, x, zero)) / around[:, None]
        sine = np.clip(z / MINOR, -1, 1)
        d1 = np.column_stack((-sine * x / around, -sine * y / around, cosine))
        return {"k1": k1, "k2": k2, "H": (k1 + k2) / 2, "d1": d1, "d2": d2}
    k = np.full(len(points), 1 / float(name.rpartition("-")[2]))
    return {"k1": k, "k2": k, "H": k}


def error(quantity: str, truth, found) -> float:
    """The mean error as published: relative to |k|, of directions the angle in radians."""
    if quantity in ("d1", "d2"):
        return float(np.radians(np.nanmean(angle(truth, found))))
    return float(np.nanmean(np.abs(found - truth) / np.abs(truth)))


def obtained(names=tuple(MESHES), threads: int = 1) -> pd.DataFrame:
    """published.csv: every number published on some meshes, and what is obtained.

    Parameters
    ----------
    names : sequence of str
        Of MESHES.
    threads : int

    Returns
    -------
    DataFrame
        The rows of `published-2020.csv`, `mean_error` called `published`; `ours`, the same mean of
        the same method here: `tensor_voting` per triangle, over the same length along the surface,
        with weights by area (AVV) or none (RVV), or VTK's, at the triangles as the mean of their
        corners; NaN for the others. Beside it of other estimators, per vertex: `adaptive_fit`, and
        `ball_regression` with the ball whose chord is the published length. `elements`: how many
        triangles or vertices there are, to compare with `values`.

    Raises
    ------
    InputError
        A name is not of MESHES.
    """
    rows, published = [], pd.read_csv(PUBLISHED)
    for name in names:
        if name not in MESHES:
            raise InputError(f"mesh {name!r} of 2020: there are {', '.join(MESHES)}")
        mesh = MESHES[name]()
        beside, balls = {"adaptive_fit": estimate(mesh, "adaptive_fit", threads)}, {}
        size = 10.0 if name == "torus-25-10" else float(name.rpartition("-")[2])
        per_vertex, centres = exact(name, mesh.vertices), mesh.vertices[mesh.faces].mean(1)
        theirs = published[published.mesh == name]
        runs = theirs.groupby(["method", "radius_hit"], dropna=False, sort=False)
        for (method, hit), own in runs:
            found, elements = _method(mesh, method, hit, threads)
            others = dict(beside)
            if not math.isnan(hit):
                if hit not in balls:
                    chord = 2 * size * math.sin(min(math.pi * hit / 4 / size, math.pi / 2))
                    balls[hit] = estimate(mesh, "ball_regression", threads, radius=chord)
                others["ball_regression"] = balls[hit]
            truth = exact(name, centres)
            for row in own.itertuples():
                quantity, ours = row.quantity, math.nan
                if found is not None and getattr(found, quantity, None) is not None:
                    ours = error(quantity, truth[quantity], getattr(found, quantity))
                line = {"mesh": name, "method": method, "radius_hit": hit, "quantity": quantity}
                line |= {"published": row.mean_error, "ours": ours, "values": row.values}
                line["elements"] = elements
                rows.append(
                    line
                    | {
                        other: error(quantity, per_vertex[quantity], getattr(x, quantity))
                        for other, x in others.items()
                    }
                )
    return pd.DataFrame(rows)


def _method(mesh, method, hit, threads):
    """What a published method gives at the triangles, and how many these are; None without it."""
    if method in VOTING:
        options = {"radius": math.pi * hit / 2, "weights": VOTING[method]}
        return estimate(mesh, "tensor_voting", threads, "face", **options), len(mesh.faces)
    if method == "VTK":
        try:
            K, H = peers.module("vtk_curvatures").returned(mesh.vertices, mesh.faces)
        except ImportError:
            return None, len(mesh.faces)
        return _at_triangles(mesh, K, H), len(mesh.faces)
    return None, len(mesh.vertices if method == "FreeSurfer" else mesh.faces)


def _at_triangles(mesh, K, H):
    gap = np.sqrt(np.maximum(H * H - K, 0))  # as VTK does
    corners = {"k1": H + gap, "k2": H - gap, "H": H}
    return SimpleNamespace(**{name: x[mesh.faces].mean(1) for name, x in corners.items()})
