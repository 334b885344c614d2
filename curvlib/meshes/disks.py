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

from .neighbourhoods import BROKEN, CLOSED, MOST, k_rings, within

# Vertices that a thread takes at a time.
BLOCK = 2048
# The most components of a field.
WIDEST = 32

Reach = namedtuple("Reach", "vertices offsets neighbours stars unit rings radius")
Reach.__doc__ = """What a disk is gathered from, a mesh's vertices, its Adjacency and unit; and how
far, within `radius` where that is finite, else `rings`."""

Scratch = namedtuple("Scratch", "stamps found hops space beside")
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
"""


class Disks:
    """The disks of a mesh within `rings` edges, or within `radius` where that is finite."""

    def __init__(self, mesh, rings: int, radius: float, threads: int = 1):
        adjacency = mesh.find_adjacency(threads)
        self._reach = Reach(mesh.vertices, *adjacency[:3], mesh.unit, rings, radius)
        self._length = MOST + adjacency.widest + 1
        self._idle = []

    def blocks(self):
        """(start, end) of the vertices that a thread takes at a time."""
        count = len(self._reach.vertices)
        return [(start, min(start + BLOCK, count)) for start in range(0, count, BLOCK)]

    def estimates(self, function, options, start, end, field):
        """Values of an estimator at the vertices start ... end - 1.

        Parameters
        ----------
        function : callable
            `function(disk, *options)`; or `function(disk, field, *options)`.
        options : tuple
        start, end : int
        field : (V, c) or None
            Gathered to (c, 1 + n): first at the vertex, then at its neighbours.

        Returns
        -------
        Curvatures
            (m,) and (3, m), NaN where there is no disk; None for what the function does not return,
            and all None where there is no disk at all.
        """
        out = np.full((end - start, 10), np.nan)
        given = self._run(_estimates(function, field is None), start, end, out, options, field)
        if given[2] != given[3]:
            raise InputError("an estimator has to return K and H, or curvlib.kit.tensor.Curvatures")
        rows = (*out.T[:4], out.T[4:7], out.T[7:])
        return Curvatures(*(row if returned else None for row, returned in zip(rows, given)))

    def field(self, function, options, start, end):
        """Components (m, c) of `function(disk, *options)` at the vertices start ... end - 1; NaN
        where there is no disk, (m, 0) where there is none at all."""
        out = np.full((end - start, WIDEST), np.nan)
        return out[:, : self._run(_field(function), start, end, out, options, None)]

    def _run(self, loop, start, end, out, options, field):
        try:
            scratch = self._idle.pop()
        except IndexError:
            scratch = self._scratch()
        if field is None:
            field = np.empty((0, 0))
        returned = loop(self._reach, start, end, scratch, field, options, out)
        while returned is None:
            self._length = 2 * len(scratch.found)
            scratch = self._scratch()
            returned = loop(self._reach, start, end, scratch, field, options, out)
        self._idle.append(scratch)
        return returned

    def _scratch(self):
        count, length = len(self._reach.vertices), self._length
        return Scratch(
            np.zeros(count, np.int32),
            np.empty(length, np.int32),
            np.empty(length + LANES, np.uint8),
            space_for(length),
            np.empty(WIDEST * (length + LANES)),
        )


@kernel
def _find(reach, scratch, v):
    """The number of neighbours of a vertex, found; -1 where the Scratch does not suffice."""
    vertices, offsets, neighbours, _, _, rings, radius = reach
    stamps, found, hops, _, _ = scratch
    if radius < np.inf:
        return within(offsets, neighbours, vertices, v, radius, stamps, found, hops)
    return k_rings(offsets, neighbours, v, rings, stamps, found, hops)


@kernel
def _disk(reach, scratch, v, count):
    """The Disk of a vertex and the `count` neighbours that were found."""
    vertices, offsets, neighbours, stars, unit, _, _ = reach
    _, found, hops, space, _ = scratch
    first, last, closed = offsets[v], offsets[v + 1], stars[v] == CLOSED
    normal = star_normal(vertices, v, neighbours, first, last, closed, unit)
    return gather(vertices, v, found, hops, count, normal, unit, space)


def _compiled(function):
    """A function of a disk, compiled in any case: one vertex takes less than a call from Python."""
    return function if hasattr(function, "py_func") else compiled(function)


@functools.cache
def _estimates(function, alone):
    """The loop of an estimator over vertices. Returns which of K, H, k1, k2, d1 and d2 it returns,
    all false where there is no disk; None where the Scratch does not suffice."""

    function = _compiled(function)

    def loop(reach, start, end, scratch, field, options, out):
        given = (False, False, False, False, False, False)
        for v in range(start, end):
            if reach.stars[v] != BROKEN:
                count = _find(reach, scratch, v)
                if count < 0:
                    return None
                disk = _disk(reach, scratch, v, count)
                returned = function(disk, *options)
                values = _values(*returned)
                for k in range(10):
                    out[v - start, k] = values[k]
                given = _given(*returned)
        return given

    def loop_with_field(reach, start, end, scratch, field, options, out):
        given = (False, False, False, False, False, False)
        for v in range(start, end):
            if reach.stars[v] != BROKEN:
                count = _find(reach, scratch, v)
                if count < 0:
                    return None
                disk = _disk(reach, scratch, v, count)
                beside = part(scratch.beside, 0, (field.shape[1], 1 + len(disk.weights)))
                _gather(field, v, scratch.found, count, beside)
                returned = function(disk, beside, *options)
                values = _values(*returned)
                for k in range(10):
                    out[v - start, k] = values[k]
                given = _given(*returned)
        return given

    return kernel(loop if alone else loop_with_field)


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
                    out[v - start, k] = returned[k]
        return components

    return kernel(loop)


@kernel
def _gather(field, v, found, count, beside):
    """Set `beside` (c, 1 + n) to the field at the vertex and its neighbours, padding to zero."""
    components, width = beside.shape
    for c in range(components):
        beside[c, 0] = field[v, c]
        for i in range(1 + count, width):
            beside[c, i] = 0.0
    for i in range(count):
        u = np.uint64(found[i])
        for c in range(components):
            beside[c, 1 + i] = field[u, c]


@kernel
def _values(K=None, H=None, k1=None, k2=None, d1=None, d2=None):
    """Ten numbers, NaN for None."""
    nan = (np.nan, np.nan, np.nan)
    x = nan if d1 is None else (d1[0], d1[1], d1[2])
    y = nan if d2 is None else (d2[0], d2[1], d2[2])
    return (
        np.nan if K is None else K,
        np.nan if H is None else H,
        np.nan if k1 is None else k1,
        np.nan if k2 is None else k2,
        *x,
        *y,
    )


@kernel
def _given(K=None, H=None, k1=None, k2=None, d1=None, d2=None):
    """Which of the values are not None."""
    return (
        K is not None,
        H is not None,
        k1 is not None,
        k2 is not None,
        d1 is not None,
        d2 is not None,
    )
