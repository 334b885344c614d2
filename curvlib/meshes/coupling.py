"""Fields that are solutions of linear equations between all vertices of a mesh.

Each vertex has the equations of its own values, with few neighbours. They are stored, and solved by
sweeps: all vertices from the values of the last sweep, so that no order of vertices matters.
"""

import functools
import math
from collections import namedtuple

import numpy as np

from curvlib.kit.compiled import compiled, kernel
from curvlib.kit.disk import gather_field
from curvlib.kit.parts import part
from curvlib.parallel import for_each

from .neighbourhoods import BROKEN
from .values import padded

# A sweep that changes unknowns by less than this part of the change by the first one, in the root
# mean square, is the last; at most SWEEPS are made.
TOLERANCE, SWEEPS = 1e-3, 16
# A pair of unknowns is shortened to this length: no equations, whatever they are, let them grow.
LARGEST = 1.0

Equations = namedtuple("Equations", "start offsets neighbours near far")
Equations.__doc__ = """Those of a block of vertices.

Attributes
----------
start : int
    The first vertex.
offsets : (vertices + 1,) int64
neighbours : (n,) int32
    Row v is neighbours[offsets[v] : offsets[v + 1]].
near : (n, 4) float32
    Derivatives of u by u and v, of v by u and v.
far : (n, 2 k) float32
    Those of k other values. Single precision suffices, since values are added to those where all
    unknowns are zero.
"""


def solve(blocks, own, threads):
    """The values (V, c) of equations; `own` is those where unknowns are zero, and overwritten."""
    # Unknowns at vertices without a disk have no part in any equation.
    now, first = own[:, :2].copy(), None
    after = now.copy()
    for _ in range(SWEEPS):

        def swept(block, now=now, after=after):
            return sweep(block, own, now, after)

        # The sums of blocks do not depend on the threads.
        change = math.sqrt(math.fsum(for_each(swept, blocks, threads)))
        now, after = after, now
        first = change if first is None else first
        if not change > TOLERANCE * first:
            break
    for_each(lambda block: _finish(block, own, now), blocks, threads)
    return own


@compiled
def sweep(block, own, now, after):
    """Set `after` (V, 2), the unknowns that follow from `now` by the Equations of a block; the sum
    of squares of changes."""
    total, last = 0.0, own.shape[1] - 1
    for k in range(len(block.offsets) - 1):
        v = block.start + k
        a, b = own[v, 0], own[v, 1]
        for j in range(block.offsets[k], block.offsets[k + 1]):
            w = block.neighbours[j]
            x, y = now[w, 0], now[w, 1]
            a += block.near[j, 0] * x + block.near[j, 1] * y
            b += block.near[j, 2] * x + block.near[j, 3] * y
        size = math.sqrt(a * a + b * b)
        if size > LARGEST:
            a, b = a * (LARGEST / size), b * (LARGEST / size)
        square = (a - now[v, 0]) ** 2 + (b - now[v, 1]) ** 2
        after[v, 0], after[v, 1], own[v, last] = a, b, math.sqrt(square)
        total += square if square > 0 else 0.0
    return total


@compiled
def _finish(block, own, now):
    others = block.far.shape[1] // 2
    for k in range(len(block.offsets) - 1):
        v = block.start + k
        own[v, 0], own[v, 1] = now[v, 0], now[v, 1]
        for j in range(block.offsets[k], block.offsets[k + 1]):
            w = block.neighbours[j]
            for c in range(others):
                own[v, 2 + c] += block.far[j, 2 * c] * now[w, 0]
                own[v, 2 + c] += block.far[j, 2 * c + 1] * now[w, 1]


def equations(loop, others, reach, start, end, memory, options, own):
    """The Equations of the vertices from start to end, and `own` set; the numbers of others, at
    most `others`, and of constants. None where the memory does not suffice.

    `loop` is one of `stored`.
    """
    offsets, room = np.zeros(end - start + 1, np.int64), 32 * (end - start) + len(memory.found)
    while True:
        arrays = (
            np.empty(room, np.int32),
            np.empty((room, 4), np.float32),
            np.empty((room, 2 * others), np.float32),
        )
        found = loop(reach, start, end, memory, options, own, offsets, *arrays)
        if found is None:
            return None
        count, *sizes = found
        if count >= 0:
            return Equations(start, offsets, *(x[:count].copy() for x in arrays)), sizes
        room *= 2


@functools.cache
def stored(function, alone, find, make):
    """The loop that stores the equations of a function of disks. Returns the number of neighbours
    that were stored, -1 where there is no room; the numbers of others and of constants. None where
    the memory does not suffice."""
    called = calls(function, alone, make)

    def loop(reach, start, end, memory, options, own, offsets, neighbours, near, far):
        at, others, constants = 0, 0, 0
        for place in range(start, end):
            v = reach.at[place]  # of one type with those of other loops: compiled once
            if reach.stars[v] != BROKEN:
                count = find(reach, memory, v)
                if count < 0:
                    return None
                x = called(reach, memory, v, count, options)
                others, constants = len(x.others), len(x.constants)
                own[v, 0], own[v, 1] = x.unknowns
                for c in range(others):
                    own[v, 2 + c] = x.others[c]
                for c in range(constants):
                    own[v, 2 + others + c] = x.constants[c]
                if at + x.count > len(neighbours):
                    return -1, others, constants
                for i in range(x.count):
                    neighbours[at + i] = memory.found[i]
                    for c in range(4):
                        near[at + i, c] = x.derivatives[c, i]
                    for c in range(2 * others):
                        far[at + i, c] = x.derivatives[4 + c, i]
                at += x.count
            else:
                for c in range(own.shape[1]):
                    own[v, c] = np.nan
            offsets[place - start + 1] = at
        return at, others, constants

    return kernel(loop)


@functools.cache
def calls(function, alone, make):
    """A function that makes what is around a vertex and calls `function` with it, and with the
    field there unless `alone`."""

    def call(reach, memory, v, count, options):
        around = make(reach, memory, v, count)
        if alone:
            return function(around, *options)
        values = part(memory.beside, 0, (reach.field.shape[1], padded(count)))
        gather_field(reach.field, v, memory.found, count, values)
        return function(around, values, *options)

    return kernel(call)
