"""The cone of `cone` carried on to its apex, where no curvature exists."""

from ._shapes import revolve

LABEL = "Cone (to the apex)"


def build():
    """u runs around, v upwards to the apex."""
    return revolve(1, [0, 0, 1, 1], [(1, 0), (0, 2.5)])
