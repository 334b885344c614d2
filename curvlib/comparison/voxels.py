"""Spheres of voxels: averaged normals regressed over balls beside what was published in 2020."""

import math
from pathlib import Path

import numpy as np
import pandas as pd

from curvlib.estimation import estimate
from curvlib.kit.tensor import principal_values
from curvlib.meshes.mesh import Mesh

PUBLISHED = Path(__file__).with_name("published-2020.csv")
SPHERES = {"voxel-sphere-10": 10, "voxel-sphere-30": 30}


def sphere(r: int) -> Mesh:
    """Marching cubes of a mask of voxels within r, at the level 1 as published: the vertices are
    the centres of the mask's outer voxels, and lie half a voxel inside on the average."""
    import pyvista

    axis = np.arange(-r - 2, r + 3)
    x, y, z = np.meshgrid(axis, axis, axis, indexing="ij")
    values = (x * x + y * y + z * z <= r * r).astype(float)
    image = pyvista.ImageData(dimensions=values.shape, origin=(-r - 2.0,) * 3)
    image["values"] = values.ravel(order="F")
    surface = image.contour([1], method="marching_cubes")
    return Mesh(surface.points.astype(float), surface.regular_faces)


def voxels(names=tuple(SPHERES), threads: int = 1) -> pd.DataFrame:
    """voxel.csv: mean relative errors on spheres of voxels.

    Parameters
    ----------
    names : sequence of str
        Of SPHERES.
    threads : int

    Returns
    -------
    DataFrame
        Per `mesh`, `method` and quantity (k1, k2, H) the mean `error` relative to the sphere's, and
        the `spread`, relative to the sphere of the vertices' mean distance; `published`: a row of
        2020, per triangle, without spread. `radius_hit` is that of the publication, whose geodesic
        neighbourhoods reach pi / 2 times as far; `ball_regression` has the ball of the same chord,
        in `radius`. `floor`: the error of the exact curvature of the sphere of mean distance.
    """
    rows, published = [], pd.read_csv(PUBLISHED)
    for name in names:
        r, mesh = SPHERES[name], sphere(SPHERES[name])
        mean = np.linalg.norm(mesh.vertices, axis=1).mean()
        labels = {"mesh": name, "floor": abs(r / mean - 1)}
        theirs = published[published.mesh == name]
        for row in theirs.itertuples():
            found = {"method": row.method, "radius_hit": row.radius_hit, "published": True}
            rows.append(labels | found | {"quantity": row.quantity, "error": row.mean_error})
        calls = [("adaptive_fit", {}, math.nan)]
        for hit in sorted(theirs.radius_hit.dropna().unique()):
            radius = 2 * r * math.sin(math.pi * hit / 4 / r)
            calls.append(("ball_regression", {"radius": radius}, hit))
        calls += [("jet", {"degree": 4, "rings": 10, "fit": "approximation"}, math.nan)]
        for method, options, hit in calls:
            found = estimate(mesh, method, threads, **options)
            values = dict(zip(("k1", "k2"), principal_values(found.K, found.H))) | {"H": found.H}
            own = {"method": method, "radius_hit": hit, "published": False}
            own["radius"] = options.get("radius", math.nan)
            for quantity, x in values.items():
                error, spread = (np.nanmean(np.abs(x * size - 1)) for size in (r, mean))
                own_row = {"quantity": quantity, "error": error, "spread": spread}
                rows.append(labels | own | own_row)
    return pd.DataFrame(rows)
