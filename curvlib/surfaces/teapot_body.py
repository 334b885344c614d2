"""Body of the Utah teapot with its rim, open at the top and at the bottom.

Its circles are cubic approximations (radius up to +0.41 %): it is not a surface of revolution.
"""

from ._shapes import teapot

LABEL = "Teapot body"
UP = "y"


def build():
    """u in [0, 3] runs from the rim (u <= 1) down to the bottom, v in [0, 4] around."""
    return teapot("body")
