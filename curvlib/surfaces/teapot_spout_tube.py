"""The tube of the teapot's spout, u in [0, 1], without the strongly curved lip."""

from . import teapot_spout
from ._shapes import net_of, nurbs

LABEL = "Teapot spout, tube only"
UP = "y"


def build():
    """u in [0, 1] runs from the body to the joint with the lip, v in [0, 2] around."""
    spout = teapot_spout.build()
    # The knot u = 1 has full multiplicity, so the first four rows are the tube's own net.
    return nurbs(spout.degree, ([0, 0, 0, 0, 1, 1, 1, 1], spout.knotvector_v), net_of(spout)[:4])
