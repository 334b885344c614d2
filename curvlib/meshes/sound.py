"""What of a mesh is left out: triangles at positions that are not finite, and repeated ones.

A triangle that is left out names one vertex three times, as what has no area: the others keep their
numbers.
"""

import numpy as np

from curvlib.errors import InputError


def placed(vertices, faces):
    """Vertices (V, 3) and faces (F, 3), without the triangles at positions that are not finite.

    Returns
    -------
    vertices : (V, 3)
        NaN where a coordinate is not finite.
    faces : (F, 3)
    concerned : (V,) bool
        The position is not finite, or a triangle at the vertex is left out.
    left_out : (F,) bool

    Raises
    ------
    InputError
        No triangle is left.
    """
    nowhere = ~np.isfinite(vertices).all(1)
    left_out = nowhere[faces].any(1)
    if left_out.all():
        every = ", and so has one of each triangle" if len(faces) else ""
        raise InputError(
            f"vertices: vertex {np.argmax(nowhere)} has a coordinate that is not finite{every}"
        )
    concerned = nowhere.copy()
    concerned[faces[left_out]] = True
    faces = np.where(left_out[:, None], faces[np.argmin(left_out), 0], faces)
    return np.where(nowhere[:, None], np.nan, vertices), faces, concerned, left_out


def repeated(vertices, faces, loose):
    """Which triangles are there again, whichever side they face, the first one being kept.

    Triangles are the same if they name the same vertices; and if they share no vertex with others,
    as those of a soup, and their corners stand at the same places.

    Parameters
    ----------
    vertices : (V, 3)
    faces : (F, 3)
    loose : (V,) bool
        Where triangles do not close to one ring; at others there is none twice.

    Returns
    -------
    again : (F,) bool
    index : (V,)
        Of a soup, the vertex of the first triangle at the place of each vertex of another; else the
        vertex itself.
    """
    again, index = np.zeros(len(faces), dtype=bool), np.arange(len(vertices))
    among = np.flatnonzero(loose[faces[:, 0]])
    among = among[loose[faces[among]].all(1)]
    a, b, c = faces[among].T
    among = among[(a != b) & (b != c) & (c != a)]
    if not len(among):
        return again, index
    uses = np.bincount(faces.reshape(-1), minlength=len(vertices))[faces[among]]
    several, alone = among[(uses > 1).all(1)], among[(uses == 1).all(1)]
    again[several], _ = _later(np.sort(faces[several], axis=1))
    corners = faces[alone]
    _, place = np.unique(vertices[corners].reshape(-1, 3), axis=0, return_inverse=True)
    place = place.reshape(-1, 3)
    order = np.argsort(place, axis=1)
    place, corners = np.take_along_axis(place, order, 1), np.take_along_axis(corners, order, 1)
    later, first = _later(place)
    later &= (np.diff(place, axis=1) > 0).all(1)
    again[alone[later]] = True
    index[corners[later]] = corners[first[later]]
    return again, index


def _later(rows):
    """Of rows (n, 3) whether an earlier one is the same, and the first that is."""
    order = np.lexsort(rows.T)  # stable: equal rows keep their order
    new = np.ones(len(rows), dtype=bool)
    new[1:] = (rows[order[1:]] != rows[order[:-1]]).any(1)
    first = np.empty(len(rows), dtype=np.intp)
    first[order] = order[new][np.cumsum(new) - 1]
    return first != np.arange(len(rows)), first
