"""Estimates on either side of creases: a mesh cut along them, and values brought back to it."""

import numpy as np

from .errors import check_name

IGNORE, NAN, ONE_SIDED = MODES = ("ignore", "nan", "one-sided")


def mode_of(creases, signature) -> str:
    """What is done at creases: as asked for, or by default as the estimator's file says."""
    if creases is None:
        return signature.creases
    check_name("creases", creases, MODES)
    return creases


class Sides:
    """A mesh and what it is when cut along its creases.

    Attributes
    ----------
    mesh : Mesh
        The cut one, or the same where there is no crease.
    at_vertices : (V,) bool
        On a crease.
    at_faces : (F,) bool
        With an edge on a crease.
    """

    def __init__(self, mesh, threads):
        from .meshes.creases import creases
        from .meshes.cutting import cut, larger_sides, on_edges
        from .meshes.mend import Edges

        edges = creases(mesh, threads)
        self.at_vertices = np.zeros(len(mesh.vertices), bool)
        self.at_vertices[edges] = True
        self.at_faces = np.zeros(len(mesh.faces), bool)
        self.mesh, self._taken = mesh, None
        if len(edges):
            self.at_faces = on_edges(Edges(mesh.faces), edges).reshape(-1, 3).any(1)
            self.mesh, index = cut(mesh, edges)
            self._taken = larger_sides(self.mesh, index)

    def brought_back(self, found, choice, mode):
        """Values at the vertices of the cut mesh, and what was chosen there, at those of the mesh:
        on a crease of the larger side, or NaN."""
        if self._taken is None:
            return found, choice
        found = {name: values[self._taken] for name, values in found.items()}
        if mode == NAN:
            for values in found.values():
                values[self.at_vertices] = np.nan
        return found, choice and choice._replace(index=choice.index[self._taken])
