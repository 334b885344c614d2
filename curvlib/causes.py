"""Why vertices and triangles have no value, and warnings of it."""

import warnings

import numpy as np

from .errors import MeshWarning

# What estimators are given that need a disk or half-disk instead of a ring.
DISKS = ("disk", "ball", "passes")
# A triangle's cause or a vertex's: its position, or that of a corner of its triangles.
NOWHERE = "position that is not finite"


def _stars(mesh, given):
    """(V,) bool: an estimator is given the ring or disk of the vertex; its triangles close to one
    ring."""
    if given not in DISKS:
        return mesh.closed, mesh.closed
    from .meshes.neighbourhoods import BROKEN, CLOSED

    stars = mesh.find_adjacency().stars
    return stars != BROKEN, stars == CLOSED


def causes_at_triangles(mesh, lacking, used):
    """Cause -> number of the triangles `lacking` (F,) bool a value; `used`: the mesh that was
    estimated on, with triangles left out."""
    a, b, c = used.vertices[used.faces].transpose(1, 0, 2)
    flat = ~(np.cross(b - a, c - a) != 0).any(1)
    nowhere = np.zeros_like(lacking) if mesh.left_out is None else mesh.left_out
    again = (nowhere if used.left_out is None else used.left_out) & ~nowhere
    return {
        NOWHERE: (lacking & nowhere).sum(),
        "triangle that is there again": (lacking & again).sum(),
        "triangle without area": (lacking & flat & ~nowhere & ~again).sum(),
        "no finite value": (lacking & ~flat).sum(),
    }


def causes_at_vertices(mesh, lacking, given, index=None, crease=None):
    """Cause -> number of the vertices `lacking` (V,) bool a value; `index` and `crease` as in
    Estimates."""
    used = np.zeros(len(lacking), dtype=bool)
    used[mesh.faces] = True
    usable, boundary = _stars(mesh, given)[0], mesh.boundary
    if index is not None:
        used, usable, boundary = used[index], usable[index], boundary[index]
    causes = {}
    if mesh.concerned is not None:
        beside = mesh.concerned & ~(usable & used)
        causes[NOWHERE] = (lacking & beside).sum()
        lacking = lacking & ~beside
    causes["no triangle"] = (lacking & ~used).sum()
    if crease is not None:
        causes["crease"] = (lacking & crease).sum()
        lacking = lacking & ~crease
    open_ = lacking & used & ~usable
    if given in DISKS:
        causes["triangles that form no disk or half-disk"] = open_.sum()
    else:
        causes["boundary"] = (open_ & boundary).sum()
        causes["triangles that do not close to one ring"] = (open_ & ~boundary).sum()
    return causes | {"no finite value": (lacking & usable).sum()}


def joined(mesh, given):
    """The mesh with points joined that stand at one place, and their index as `curvlib.weld`
    returns it, None where there are none; warns where there are some.

    `given`: what the estimator is given.
    """
    from .meshes.mend import once, weld

    if mesh.concerned is not None:
        nowhere = np.count_nonzero(np.isnan(mesh.vertices[:, 0]))
        _warn(
            f"{nowhere} of {len(mesh.vertices)} vertices have a position that is not finite: left "
            f"out, and {np.count_nonzero(mesh.left_out)} triangles at them"
        )
    loose = ~_stars(mesh, given)[1]
    points = mesh.vertices[loose]
    _, _, again = once(mesh, loose)
    if not again and len(np.unique(points, axis=0)) == len(points):
        return mesh, None
    welded, index = weld(mesh)
    count = np.count_nonzero(index != np.arange(len(index)))
    if again:
        _warn(f"{again} of {len(mesh.faces)} triangles are there again: left out")
    if count:
        _warn(f"{count} of {len(index)} vertices stand where another one does: joined to it")
    return (welded, index) if again or count else (mesh, None)


def warn_of_undefined(mesh, given: str, index=None) -> None:
    """Warn if fewer than half of the vertices have a ring, or disk where that is `given`; `index`
    as in Estimates."""
    if given == "mesh":
        return
    usable = _stars(mesh, given)[0] if index is None else _stars(mesh, given)[0][index]
    lacking = np.count_nonzero(~usable)
    if 2 * lacking > len(usable):
        causes = causes_at_vertices(mesh, ~usable, given, index)
        named = ", ".join(f"{n} {cause}" for cause, n in causes.items() if n)
        _warn(f"{lacking} of {len(usable)} vertices have no value: {named}")


def _warn(words):
    warnings.warn(words, MeshWarning, stacklevel=4)
