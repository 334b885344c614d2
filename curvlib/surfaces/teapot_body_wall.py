"""The upper wall of the teapot's body, u in [1, 2], without the rim and the strip at the bottom.

K and H of the body jump at u = 1 and u = 2; |H| reaches 26 on the rim (u < 1) and 29 at the bottom
(u = 3), but 0.7 on the wall. The wall is one cubic piece in u, and C^2.
"""

from . import teapot_body
from ._shapes import net_of, nurbs

LABEL = "Teapot body, wall only"
UP = "y"


def build():
    """u in [1, 2] runs from the joint with the rim to the widest circle, v in [0, 4] around."""
    body = teapot_body.build()
    # Inner knots have full multiplicity, so rows 3 to 6 are the wall's own net.
    return nurbs(body.degree, ([1, 1, 1, 1, 2, 2, 2, 2], body.knotvector_v), net_of(body)[3:7])
