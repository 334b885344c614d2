"""Values at a vertex that depend on those at its neighbours, which depend on its own."""

from collections import namedtuple

Coupled = namedtuple("Coupled", "unknowns others constants derivatives count")
Coupled.__doc__ = """Values at a vertex, as linear functions of the unknowns at its neighbours.

A function of a disk that is annotated to return it, `def slopes(disk, ...) -> Coupled`, is a field
whose components are the solution of these equations of all vertices: unknowns, others, constants,
and how much the last sweep changed the unknowns.

Attributes
----------
unknowns : tuple of 2 floats
    Unknowns u and v of the vertex where those of its neighbours are zero.
others : tuple of floats
    Other values there, likewise.
constants : tuple of floats
    Values that do not depend on unknowns.
derivatives : (2 c, n)
    Of all c unknowns and others by the unknowns at the neighbours: of u by u, of u by v, of v by u,
    ...
count : int
    The first neighbours of the disk are those on which the values depend.
"""
