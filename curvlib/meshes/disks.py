"""Functions of disks, run over the vertices of a mesh in compiled loops."""

import functools
from collections import namedtuple

import numpy as np

from curvlib.errors import InputError
from curvlib.kit.compiled import compiled, kernel
from curvlib.kit.disk import gather, space_for, star_normal
from curvlib.kit.lanes import LANES
from curvlib.kit.parts import part
from curvlib.kit.tensor import Curvatures
from curvlib.parallel import for_each

from .neighbourhoods import BROKEN, CLOSED, MOST, k_rings, within
from .values import NONE, UNDEFINED, gather_field, numbers, returns, scatter

# Vertices that a thread takes at a time.
BLOCK = 2048
# The most components of a field.
WIDEST = 32

Reach = namedtuple("Reach", "vertices offsets neighbours stars unit rings radius")
Reach.__doc__ = """What a disk is gathered from, a mesh's vertices, its Adjacency and unit; and how
far, within `radius` where that is finite, else `rings`."""

Scratch = namedtuple("Scratch", "stamps found hops space beside values")
Scratch.__doc__ = """Memory of a thread.

Attributes
----------
stamps : (V,) int32
    As in `k_rings`.
found, hops : (length,) int32, (length + LANES,) uint8
    As in `k_rings`.
space
    As in `gather`.
beside : (WIDEST (length + LANES),)
    For the field at the vertices of a disk.
values : (BLOCK, 10)
    Of the block.
"""


class Disks:
    """The disks of a mesh within `rings` edges, or within `radius` where that is finite."""

    def __init__(self, mesh, rings: int, radius: float, threads: int = 1):
        adjacency = mesh.find_adjacency(threads)
        self._reach = Reach(mesh.vertices, *adjacency[:3], mesh.unit, rings, radius)
        self._length = MOST + adjacency.widest + 1

    def estimates(self, function, options, field, threads) -> dict:
        """The values of an estimator at all vertices, in the unit of the mesh.

        Parameters
        ----------
        function : callable
            `function(disk, *options)`; or `function(disk, field, *options)`.
        options : tuple
        field : (V, c) or None
            Gathered to (c, 1 + n): first at the vertex, then at its neighbours.
        threads : int

        Returns
        -------
        dict
            Name -> (V,) or (V, 3), NaN where there is no disk, of what the function returns; empty
            where there is no disk at all.
        """
        count = len(self._reach.vertices)
        # Memory of those that the function does not return is never touched.
        out = Curvatures(*(np.empty(count) for _ in range(4)), *np.empty((2, count, 3)))
        given = self._run(_estimates(function, field is None), out, options, field, threads)
        returned = np.any([NONE, *given], axis=0)
        if returned[2] != returned[3]:
            raise InputError("an estimator has to return K and H, or curvlib.kit.tensor.Curvatures")
        found = {name: x for name, x, there in zip(out._fields, out, returned) if there}
        for block in np.flatnonzero(~np.any(given, axis=1)) if found else ():
            for x in found.values():
                x[block * BLOCK : (block + 1) * BLOCK] = np.nan
        return found

    def field(self, function, options, threads):
        """Components (V, c) of `function(disk, *options)` at all vertices, NaN where there is no
        disk; (V, 0) where there is none at all."""
        out = np.full((len(self._reach.vertices), WIDEST), np.nan)
        return out[:, : max(self._run(_field(function), out, options, None, threads), default=0)]

    def _run(self, loop, out, options, field, threads):
        count, idle = len(self._reach.vertices), []

        def work(start):
            try:
                scratch = idle.pop()
            except IndexError:
                scratch = self._scratch()
            end, returned = min(start + BLOCK, count), None
            while returned is None:
                returned = loop(self._reach, start, end, scratch, field, options, out)
                if returned is None:
                    self._length = 2 * len(scratch.found)
                    scratch = self._scratch()
            idle.append(scratch)
            return returned

        return for_each(work, range(0, count, BLOCK), threads)

    def _scratch(self):
        count, length = len(self._reach.vertices), self._length
        return Scratch(
            np.zeros(count, np.int32),
            np.empty(length, np.int32),
            np.empty(length + LANES, np.uint8),
            space_for(length),
            np.empty(WIDEST * (length + LANES)),
            np.empty((BLOCK, 10)),
        )


@kernel
def _find(reach, scratch, v):
    """The number of neighbours of a vertex, found; -1 where the Scratch does not suffice."""
    vertices, offsets, neighbours, _, _, rings, radius = reach
    stamps, found, hops, _, _, _ = scratch
    if radius < np.inf:
        return within(offsets, neighbours, vertices, v, radius, stamps, found, hops)
    return k_rings(offsets, neighbours, v, rings, stamps, found, hops)


@kernel
def _disk(reach, scratch, v, count):
    """The Disk of a vertex and the `count` neighbours that were found."""
    vertices, offsets, neighbours, stars, unit, _, _ = reach
    _, found, hops, space, _, _ = scratch
    first, last, closed = offsets[v], offsets[v + 1], stars[v] == CLOSED
    normal = star_normal(vertices, v, neighbours, first, last, closed, unit)
    return gather(vertices, v, found, hops, count, normal, unit, space)


def _compiled(function):
    """A function of a disk, compiled in any case: one vertex takes less than a call from Python."""
    return function if hasattr(function, "py_func") else compiled(function)


@functools.cache
def _estimates(function, alone):
    """The loop of an estimator over vertices, `alone` if it takes no field. Returns which of K, H,
    k1, k2, d1 and d2 it returns, all false where there is no disk; None where the Scratch does not
    suffice."""

    function = _compiled(function)

    def loop(reach, start, end, scratch, field, options, out):
        given = NONE
        for v in range(start, end):
            if reach.stars[v] != BROKEN:
                count = _find(reach, scratch, v)
                if count < 0:
                    return None
                disk = _disk(reach, scratch, v, count)
                if alone:
                    returned = function(disk, *options)
                else:
                    beside = part(scratch.beside, 0, (field.shape[1], 1 + len(disk.weights)))
                    gather_field(field, v, scratch.found, count, beside)
                    returned = function(disk, beside, *options)
                given, values = returns(*returned), numbers(*returned)
            else:
                values = UNDEFINED
            for k in range(10):
                scratch.values[v - start, k] = values[k]
        scatter(scratch.values, start, end, reach.unit, given, out)
        return given

    return kernel(loop)


@functools.cache
def _field(function):
    """The loop of a field over vertices. Returns the number of components, 0 where there is no
    disk; None where the Scratch does not suffice."""

    function = _compiled(function)

    def loop(reach, start, end, scratch, field, options, out):
        components = 0
        for v in range(start, end):
            if reach.stars[v] != BROKEN:
                count = _find(reach, scratch, v)
                if count < 0:
                    return None
                disk = _disk(reach, scratch, v, count)
                returned = function(disk, *options)
                components = len(returned)
                if components > WIDEST:
                    raise InputError("a field has more than 32 components")
                for k in range(components):
                    out[v, k] = returned[k]
        return components

    return kernel(loop)
