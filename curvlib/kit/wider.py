"""Disks that grow: one ring more where an estimator finds that it needs them."""

import numpy as np

from .compiled import kernel
from .disk import MOST, Walk, gather, gather_field
from .parts import part


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
    for i in range(begin, disk.count):
        u = np.uint64(walk.found[i])
        first, last = walk.offsets[u], walk.offsets[u + np.uint64(1)]
        if last - first > MOST:
            return disk.count
        for j in range(first, last):
            w = walk.neighbours[j]
            walk.found[count] = w
            count += walk.stamps[w] != walk.v + 1
            walk.stamps[w] = walk.v + 1
        if count > MOST:
            return disk.count
    return count
