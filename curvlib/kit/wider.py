"""Disks that grow: one ring more where an estimator finds that it needs them."""

import numpy as np

from .compiled import kernel
from .disk import MOST, Walk, gather, gather_field
from .parts import part

# In most rows there are no more neighbours.
STEPS = 7


@kernel
def wider(disk):
    """The disk with one ring more, and the field there; as it was where there is none.

    Parameters
    ----------
    disk : Disk
        Its arrays and those of the estimator are overwritten.

    Returns
    -------
    disk : Disk
    field : (c, 1 + n)
        Of the estimator, at the vertex and its neighbours; (0, 1 + n) if it takes none.
    """
    walk, count = disk.walk, _count_wider(disk)
    if count > disk.count:
        for i in range(disk.count, count):
            walk.hops[i] = walk.rings + 1
        own = disk.normal, disk.exact_normal, disk.area, disk.closed
        disk = gather(Walk(*walk[:11], walk.rings + 1), disk.distances, count, own)
    field = part(walk.values, 0, (walk.field.shape[1], 1 + disk.e.shape[1]))
    gather_field(walk.field, walk.v, walk.found, count, field)
    return disk, field


@kernel
def _count_wider(disk):
    """Search the next ring: the number of neighbours with it; that of the disk where it is left
    out."""
    walk, count, begin = disk.walk, disk.count, disk.count
    if walk.rings == 0:
        return count
    while begin > 0 and disk.hops[begin - 1] == walk.rings:
        begin -= 1
    mark = np.int32(walk.v + 1)
    for i in range(begin, disk.count):
        u = np.uint64(walk.found[i])
        count = append_row(walk.offsets, walk.neighbours, u, mark, walk.stamps, walk.found, count)
        if count > MOST:
            return disk.count
    return count


@kernel
def append_row(offsets, neighbours, u, mark, stamps, found, count):
    """Append the neighbours of a vertex that have no mark to those found, and mark them.

    Parameters
    ----------
    offsets, neighbours
        Compressed sparse rows.
    u : uint64
        The vertex.
    mark : int32
    stamps : (V,) int32
        The marks.
    found : (MOST + length of the row + 1 or more,) int32
    count : int
        How many are found, at most MOST.

    Returns
    -------
    int
        The new count, or just more than MOST where the row alone is as long.
    """
    first, last = offsets[u], offsets[u + np.uint64(1)]
    if last - first > MOST:
        return MOST + 1
    if last > first:
        # STEPS in any row, the last neighbour again and again in a shorter one, and found[count]
        # is written in any case: no branches to be predicted.
        for j in range(STEPS):
            w = neighbours[np.uint64(min(first + j, last - 1))]
            found[np.uint64(count)] = w
            count += stamps[np.uint64(w)] != mark
            stamps[np.uint64(w)] = mark
    for j in range(first + STEPS, last):
        w = neighbours[np.uint64(j)]
        found[np.uint64(count)] = w
        count += stamps[np.uint64(w)] != mark
        stamps[np.uint64(w)] = mark
    return count
