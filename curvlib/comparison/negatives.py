"""What good normals do not mend: corrected measures over one ring, whatever the normals."""

import numpy as np
import pandas as pd

from curvlib.estimation import estimate
from curvlib.meshes.mesh import Mesh

from .survey import with_orders


def measures(meshes, threads: int = 1) -> pd.DataFrame:
    """measures.csv: mean errors of `corrected_measures` by the normals that it is given.

    Parameters
    ----------
    meshes : dict
        (surface, kind, n) -> Mesh with exact K, H and normals.
    threads : int

    Returns
    -------
    DataFrame
        Per mesh, `normals` (`area`: of the triangles; `compact_hermite`: its own; `exact`) and
        quantity (K, H) the mean error `value` inside, and the `order` from the next coarser n.
    """
    rows = []
    for key, mesh in meshes.items():
        fine = estimate(mesh, "compact_hermite", threads)
        every = {"compact_hermite": np.cross(fine.d1, fine.d2), "exact": mesh.normals}
        given = {
            name: estimate(
                Mesh(mesh.vertices, mesh.faces, normals=normals),
                "corrected_measures",
                threads,
                normals="given",
            )
            for name, normals in every.items()
        }
        given["area"] = estimate(mesh, "corrected_measures", threads, normals="area")
        for name, found in given.items():
            for quantity in ("K", "H"):
                error = np.abs(getattr(found, quantity) - getattr(mesh, quantity))
                row = {"normals": name, "quantity": quantity}
                row["value"] = np.nanmean(error[~mesh.boundary])
                rows.append(dict(zip(("surface", "kind", "n"), key)) | row)
    return with_orders(pd.DataFrame(rows), ["surface", "kind", "normals", "quantity"])
