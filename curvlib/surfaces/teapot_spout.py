"""Spout of the Utah teapot: tube (u <= 1) and lip (u >= 1), open at both ends.

The joint u = 1 is G^1 only: K jumps there by up to 17.5.
"""

from ._shapes import teapot

LABEL = "Teapot spout"
UP = "y"
CLOSE_UP = ((1, 2), (0, 2))


def build():
    """u in [0, 2] runs from the body to the lip, v in [0, 2] around."""
    return teapot("spout")
