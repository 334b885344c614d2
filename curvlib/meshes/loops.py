"""Functions of disks and balls, run over vertices of a mesh in compiled loops."""

import functools

import numpy as np
from numba.core.errors import NumbaError

from curvlib.errors import InputError
from curvlib.kit.compiled import compiled, kernel
from curvlib.kit.disk import MOST
from curvlib.kit.tensor import Curvatures
from curvlib.parallel import for_each

from .around import WIDEST, scratch
from .coupling import calls, equations, solve, stored
from .neighbourhoods import BROKEN
from .values import NONE, UNDEFINED, numbers, returns, scatter

# Vertices that a thread takes at a time.
BLOCK = 2048
RETURNS = "has to return K and H, or curvlib.kit.tensor.Curvatures"


class Neighbourhoods:
    """The disks or balls of vertices of a mesh, or of the centres of its triangles.

    Parameters
    ----------
    kind : tuple
        DISK, GEODESIC or BALL of `curvlib.meshes.around`.
    reach : Reach
    """

    def __init__(self, kind, reach):
        self._kind, self._reach = kind, reach
        self._length = MOST + int(np.diff(reach.offsets).max(initial=0)) + 1

    def estimates(self, function, options, field, threads) -> dict:
        """The values of an estimator at the m vertices, in the unit of the mesh.

        Parameters
        ----------
        function : callable
            `function(disk, *options)`; or `function(disk, field, *options)`; with a ball likewise.
        options : tuple
        field : (V, c) or None
            Gathered to (c, 1 + n): first at the vertex, then at its neighbours.
        threads : int

        Returns
        -------
        dict
            Name -> (m,) or (m, 3), NaN where there is no disk, of what the function returns; empty
            where there is no disk at all.
        """
        count = len(self._reach.at)
        self._take(field)
        # Memory of those that the function does not return is never touched.
        out = Curvatures(*(np.empty(count) for _ in range(4)), *np.empty((2, count, 3)))
        loop = _estimates(function, field is None, *self._kind)
        given = self._run(loop, f"an estimator {RETURNS}", self._blocks(), out, options, threads)
        returned = np.any([NONE, *given], axis=0)
        if returned[2] != returned[3]:
            raise InputError(f"an estimator {RETURNS}")
        found = {name: x for name, x, there in zip(out._fields, out, returned) if there}
        for block in np.flatnonzero(~np.any(given, axis=1)) if found else ():
            for x in found.values():
                x[block * BLOCK : (block + 1) * BLOCK] = np.nan
        return found

    def field(self, function, options, field, threads):
        """The components (m, c) that a function returns at the m vertices, NaN where there is no
        disk; (m, 0) where there is none at all. Parameters as those of `estimates`."""
        self._take(field)
        loop = _field(function, field is None, *self._kind)
        rule = f"{function.__name__!r} has to return a tuple of numbers"
        out = np.empty((len(self._reach.at), self._probe(loop, rule, options) or 0))
        self._run(loop, rule, self._blocks(), out, options, threads)
        return out

    def solution(self, function, options, field, threads):
        """The values (V, c) of a function that returns Coupled, as `curvlib.kit.coupled` says; NaN
        where there is no disk. Parameters as those of `estimates`; the m vertices are all."""
        blocks, own = self.equations(function, options, field, threads)
        return solve(blocks, own, threads) if blocks else own

    def equations(self, function, options, field, threads):
        """Those of such a function, a list of Equations, and the values (V, c) where all unknowns
        are zero. Parameters as those of `solution`."""
        self._take(field)
        loop = stored(_compiled(function), field is None, *self._kind)
        rule = f"{function.__name__!r} has to return Coupled"
        one = self._probe(functools.partial(equations, loop, WIDEST), rule, options)
        if one is None:
            return [], np.empty((len(self._reach.vertices), 0))
        others, constants = one[1]
        own = np.empty((len(self._reach.vertices), 3 + others + constants))
        stored_by = functools.partial(equations, loop, others)
        found = self._run(stored_by, rule, self._blocks(), own, options, threads)
        return [block for block, _ in found], own

    def reached(self, threads) -> np.ndarray:
        """The vertices in the disks, or corners of the balls, of the m vertices, and these."""
        self._take(None)
        found = np.zeros(len(self._reach.vertices), bool)
        self._run(_reached(*self._kind), "a search", self._blocks(), found, (), threads)
        return np.flatnonzero(found).astype(np.int32)

    def _take(self, field):
        """Where there is no field, an array that is not used."""
        nothing = np.empty((len(self._reach.vertices), 0))
        self._reach = self._reach._replace(field=nothing if field is None else field)

    def _blocks(self):
        count = len(self._reach.at)
        return [(start, min(start + BLOCK, count)) for start in range(0, count, BLOCK)]

    def _probe(self, loop, rule, options):
        """What a loop returns for the first vertex that has a disk; None where none has. Memory of
        others is never touched."""
        places = np.flatnonzero(self._reach.stars[self._reach.at] != BROKEN)[:1]
        wide = np.empty((len(self._reach.at), WIDEST))
        found = self._run(loop, rule, [(k, k + 1) for k in places.tolist()], wide, options, 1)
        return found[0] if found else None

    def _run(self, loop, rule, blocks, out, options, threads):
        """What the loop returns for each block; InputError with the `rule` where the function
        cannot be compiled in it."""
        idle = []

        def work(block):
            try:
                memory = idle.pop()
            except IndexError:
                memory = scratch(self._reach, self._length, BLOCK)
            returned = None
            while returned is None:
                try:
                    returned = loop(self._reach, *block, memory, options, out)
                except NumbaError as error:
                    lines = [line for line in str(error).splitlines() if "nopython" not in line]
                    raise InputError(f"{rule}, compiled by Numba: {lines[0]}") from error
                if returned is None:
                    self._length = 2 * len(memory.found)
                    memory = scratch(self._reach, self._length, BLOCK)
            idle.append(memory)
            return returned

        return for_each(work, blocks, threads)


def _compiled(function):
    """A function of a disk, compiled in any case: one vertex takes less than a call from Python."""
    return function if hasattr(function, "py_func") else compiled(function)


@functools.cache
def _estimates(function, alone, find, make):
    """The loop of an estimator over vertices, `alone` if it takes no field. Returns which of K, H,
    k1, k2, d1 and d2 it returns, all false where there is no disk; None where the memory does not
    suffice."""
    called = calls(_compiled(function), alone, make)

    def loop(reach, start, end, memory, options, out):
        given = NONE
        for place in range(start, end):
            v = reach.at[place]
            if reach.stars[v] != BROKEN:
                count = find(reach, memory, v)
                if count < 0:
                    return None
                returned = called(reach, memory, v, count, options)
                given, values = returns(*returned), numbers(*returned)
            else:
                values = UNDEFINED
            for k in range(10):
                memory.values[place - start, k] = values[k]
        scatter(memory.values, start, end, reach.unit, given, out)
        return given

    return kernel(loop)


@functools.cache
def _field(function, alone, find, make):
    """The loop of a field over vertices, as `_estimates`. Returns the number of components, 0 where
    there is no disk; None where the memory does not suffice."""
    called = calls(_compiled(function), alone, make)

    def loop(reach, start, end, memory, options, out):
        components = 0
        for place in range(start, end):
            v = reach.at[place]
            if reach.stars[v] != BROKEN:
                count = find(reach, memory, v)
                if count < 0:
                    return None
                returned = called(reach, memory, v, count, options)
                components = len(returned)
                width = out.shape[1]
                if components > width or (components < width and width < WIDEST):
                    raise InputError("a field has more than 32 components, or not always as many")
                for k in range(components):
                    out[place, k] = returned[k]
            else:
                for k in range(out.shape[1]):
                    out[place, k] = np.nan
        return components

    return kernel(loop)


@functools.cache
def _reached(find, make):
    """The loop that marks who is found around vertices. Returns their number; None where the memory
    does not suffice."""

    def loop(reach, start, end, memory, options, out):
        total = 0
        for place in range(start, end):
            v = reach.at[place]
            if reach.stars[v] != BROKEN:
                count = find(reach, memory, v)
                if count < 0:
                    return None
                out[v] = True
                for i in range(count):
                    out[memory.found[i]] = True
                total += count
        return total

    return kernel(loop)
