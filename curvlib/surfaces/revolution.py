"""Surface of revolution of a smooth cubic arc, a vase: K > 0 on its belly, K < 0 at its neck.

The paper shows the surface but does not define its arc. This arc is non-circular, as the text says,
and has both signs of K.
"""

from ._shapes import revolve

LABEL = "Surface of revolution"


def build():
    """u runs around, v upwards along the arc."""
    arc = [(0.5, 0), (1.8, 0.7), (0.1, 1.4), (0.8, 2)]
    return revolve(3, [0, 0, 0, 0, 1, 1, 1, 1], arc)
