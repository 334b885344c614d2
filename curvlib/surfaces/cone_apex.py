"""The cone of `cone` up to its apex, where curvature is undefined."""

from ._shapes import revolve

LABEL = "Cone (to the apex)"


def build():
    """u runs around, v upwards to the apex."""
    return revolve(1, [0, 0, 1, 1], [(1, 0), (0, 2.5)])
