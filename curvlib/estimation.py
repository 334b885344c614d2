"""Estimates on a mesh, by one estimator or several."""

import functools
from numbers import Integral

import numpy as np

from .causes import joined, warn_of_undefined
from .errors import InputError, check_name
from .estimates import Estimates
from .meshes.exchange import as_mesh
from .passes import run
from .sides import IGNORE, Sides, mode_of
from .signatures import Signature, resolved
from .task import Task

# Estimators that are taken without a name, and why.
BECAUSE = {
    "adaptive_fit": "each region's fit and scale are chosen from the mesh itself",
    "quadric": "a fit of the size that is asked for; adaptive_fit, taken otherwise, has no options",
    "tensor_voting": "the estimator with values at triangles",
}


def recommended(per: str, options) -> str:
    """The estimator that is taken without a name: with options, as a radius, one that has them."""
    check_name("per", per, ("vertex", "face"))
    if per == "face":
        return "tensor_voting"
    return "quadric" if options else "adaptive_fit"


def estimate(mesh, estimator=None, threads: int = 1, per: str = "vertex", creases=None, **options):
    """Estimate curvature at the vertices of a triangle mesh.

    Parameters
    ----------
    mesh : Mesh, (vertices, faces), path, or a mesh of another library
        Arrays (V, 3) and (F, 3), a file that `curvlib.read` reads, a mesh of trimesh or meshio, or
        an object that pyvista wraps into a triangle mesh. Its point normals are the exact normals
        of `normal="exact"`. Points that stand at one place, as readers leave them that split
        corners, are joined for the estimate as `curvlib.weld` does; values are at all of them.
        Triangles at positions that are not finite, and those that are there again, are left out.
    estimator : str, path, callable, or a list of them
        By default `adaptive_fit`, with options `quadric`, and `tensor_voting` per face. A name in
        `curvlib.estimators()` or, for that of another library, in `curvlib.peers()`; the path of a
        .py file like those in `curvlib/estimators`; or a function with the signature of their
        `estimate`. The estimators of a list share the rings or the adjacency.
    threads : int
        Number of threads; values do not depend on it.
    per : {"vertex", "face"}
        Values at the vertices, or at the triangles' centres, of an estimator that names it in PER.
    creases : {"ignore", "one-sided", "nan"}, optional
        "one-sided": where a surface has creases, along which its normal turns out of proportion to
        its curvature, the mesh is cut along them (`curvlib.meshes.creases`), so that no value mixes
        two sides. A vertex on a crease has the value of the larger side, by the area of the
        connected piece, then by that of its triangles; `Estimates.crease` flags it. "nan": it has
        none. By default what the estimator names in CREASES: "one-sided" for `adaptive_fit`,
        "ignore" for the others.
    **options
        Options of the estimator, its readings; of a list, each member has to know them.

    Returns
    -------
    Estimates, or dict
        Pointwise, H = +1 on the unit sphere with outward normals. For a list, a dict from its
        members to Estimates. NaN at vertices whose triangles do not close to one ring (on the
        boundary, non-manifold or inconsistently oriented), and where the estimator has no finite
        value; `Estimates.undefined` counts them by cause. An estimator of disks, as `quadric` and
        `jet`, has values on the boundary, too.

    Raises
    ------
    InputError
        Unknown estimator or option, no triangle mesh, an estimator that does not return curvatures
        or has none per face, or a peer whose library is not installed.

    Warns
    -----
    MeshWarning
        More than half of the vertices have no value, some vertices are joined, triangles are left
        out, or float32 coordinates are coarse beside the edges.

    Examples
    --------
    >>> import curvlib
    >>> tetrahedron = (
    ...     [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]],
    ...     [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]],
    ... )
    >>> curvlib.estimate(tetrahedron, "gauss_bonnet").K.round(4)
    array([0.9069, 0.9069, 0.9069, 0.9069])
    """

    _keep_pages()
    mesh = as_mesh(mesh)
    if estimator is None:
        estimator = recommended(per, options)
    if not isinstance(threads, Integral) or threads < 1:
        raise InputError(f"threads: {threads!r} is not a number of at least 1")
    several = isinstance(estimator, (list, tuple))
    signatures = {
        each: _checked(Signature.of(*resolved(each)), per)
        for each in (estimator if several else [estimator])
    }
    modes = {each: mode_of(creases, signature) for each, signature in signatures.items()}
    for signature in signatures.values():
        signature.chosen(options)  # a wrong one is told before a mesh is cut
    kinds = dict.fromkeys(signature.given for signature in signatures.values())
    welded, index = joined(mesh, next(iter(kinds), "ring"))
    sides = Sides(welded, threads) if {*modes.values()} - {IGNORE} else None
    tasks = {
        each: Task(signature, options, welded if modes[each] == IGNORE else sides.mesh, per)
        for each, signature in signatures.items()
    }
    for cut in (False, True):
        some = [task for each, task in tasks.items() if (modes[each] != IGNORE) == cut]
        if some:
            run(sides.mesh if cut else welded, some, threads)
    for given in kinds:
        warn_of_undefined(welded, given, index)
    results = {}
    for each, task in tasks.items():
        found, choice, crease = task.arrays, task.choice, None
        if modes[each] != IGNORE:
            crease = sides.at_vertices if per == "vertex" else sides.at_faces
            if per == "vertex":
                found, choice = sides.brought_back(found, choice, modes[each])
        results[each] = Estimates(mesh, found, task.given, per, welded, index, choice, crease)
    return results if several else results[estimator]


def _checked(signature, per):
    """The signature of an estimator; InputError where it has no values per vertex or face."""
    check_name("per", per, ("vertex", "face"))
    if per not in signature.per:
        raise InputError(f"per: estimator {signature.name!r} has values at vertices alone")
    below = signature if per == "face" else None
    while below:
        if below.given in ("ring", "ball"):
            raise InputError(
                f"per: {below.name!r} is given a {below.given}; around a triangle's centre there "
                "are disks alone"
            )
        below = below.field
    return signature


@functools.cache
def _keep_pages():
    """Freeing one 31 MiB block raises glibc's mmap threshold. Temporary arrays then come from the
    heap instead of fresh pages that the kernel has to zero."""
    np.empty(31 << 20, dtype=np.uint8)
