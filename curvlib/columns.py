"""The columns that files and tables of estimates have, by name."""

import numpy as np

from .errors import InputError, check_name

EXACT = ("K", "H", "k1", "k2", "d1", "d2")  # a surface has them, too
DERIVED = ("shape_index", "curvedness", "category", "bending_energy")
ERRORS = ("K_error", "H_error", "k1_error", "k2_error")
CREASE = "crease"  # where creases were looked for
QUANTITIES = (*EXACT, *DERIVED, *ERRORS, CREASE)
CODES = ("category", CREASE)  # numbers without a mean
# The categories of the shape index, code by code, and the last where the surface is flat.
CATEGORIES = (
    "cup",
    "trough",
    "rut",
    "saddle rut",
    "saddle",
    "saddle ridge",
    "ridge",
    "dome",
    "cap",
    "flat",
)
# The names of pycurv's files (Salfer et al. 2020), per triangle.
PYCURV = {
    "kappa_1": "k1",
    "kappa_2": "k2",
    "gauss_curvature_VV": "K",
    "mean_curvature_VV": "H",
    "shape_index_VV": "shape_index",
    "curvedness_VV": "curvedness",
    "t_1": "d1",
    "t_2": "d2",
}
STYLES = ("curvlib", "pycurv")


def columns(estimates, style: str = "curvlib", c0: float = 0.0) -> dict[str, np.ndarray]:
    """Name -> values (n,) or (n, 3) of the quantities that an estimator returns, and of those that
    follow from them.

    `style`: "curvlib", or "pycurv" for its names, with the triangles' areas and unit normals;
    InputError where that is asked of values at vertices. `c0`: of the bending energy.
    """
    check_name("columns", style, STYLES)
    if style == "pycurv":
        if estimates.per != "face":
            raise InputError("columns: pycurv's are per triangle; estimate with per='face'")
        facets = _facets(estimates.mesh)
        length = np.sqrt((facets * facets).sum(1))
        with np.errstate(invalid="ignore", divide="ignore"):
            added = {"area": length / 2, "n_v": facets / length[:, None]}
        known = columns(estimates)
        return {name: known[ours] for name, ours in PYCURV.items() if ours in known} | added
    found = {}
    for name in QUANTITIES:
        bending = name == "bending_energy"
        values = estimates.bending_energy(c0) if bending else getattr(estimates, name)
        if values is not None and (name in estimates.returned or np.isfinite(values).any()):
            found[name] = values
    return found


def scalars(named: dict) -> dict[str, np.ndarray]:
    """Columns of numbers: each vector as three, `d1` as `d1_x`, `d1_y`, `d1_z`."""
    return {
        name if values.ndim == 1 else f"{name}_{axis}": part
        for name, values in named.items()
        for axis, part in zip("xyz", values.T if values.ndim == 2 else (values,))
    }


def _facets(mesh):
    a, b, c = mesh.vertices[mesh.faces].swapaxes(0, 1)
    return np.cross(b - a, c - a)
