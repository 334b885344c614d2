"""A picture of values on any mesh."""

import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from curvlib.meshes.mesh import Mesh
from curvlib.regions import quantiles

from .pictures import AMBIENT, NEUTRAL
from .render import renderer
from .style import DPI, in_style, save
from .views import View

SIZE = (1100, 900)  # pixels of the image
BELOW = 130  # pixels for the scale
SHARE = 0.98  # of the area whose values lie within the scale, both ways
COLOURS = matplotlib.colormaps["RdYlBu_r"]
# Quantities that are never negative have a scale from 0, in other colours.
FROM_ZERO = ("curvedness", "bending_energy", "K_error", "H_error", "k1_error", "k2_error")
FROM_ZERO_COLOURS = matplotlib.colormaps["viridis"]


@in_style
def picture(path, mesh, values, per: str, quantity: str, up: str = "z") -> None:
    """Write a picture of a quantity per vertex or face: colours symmetric about 0, or from 0 where
    it is never negative; NaN grey, arrows at the ends of the scale for the values beyond.

    `up`: the axis that points up.
    """
    positive = quantity in FROM_ZERO
    map_ = FROM_ZERO_COLOURS if positive else COLOURS
    limit = quantiles(mesh, np.abs(values), per, (SHARE,))[0]
    limit = limit if limit > 0 else 1.0
    norm = Normalize(0.0 if positive else -limit, limit)
    colours = map_(norm(np.nan_to_num(values)))[:, :3]
    colours = np.where(np.isfinite(values)[:, None], colours, NEUTRAL)
    # The triangles apart, so that each corner has a colour and a normal of its own.
    corners = mesh.vertices[mesh.faces]
    facets = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sums = np.zeros_like(mesh.vertices)
    for k in range(3):
        np.add.at(sums, mesh.faces[:, k], facets)
    parts = Mesh(
        corners.reshape(-1, 3),
        np.arange(3 * len(corners)).reshape(-1, 3),
        copy=False,
        normals=sums[mesh.faces.reshape(-1)],
    )
    own = colours[mesh.faces.reshape(-1)] if per == "vertex" else np.repeat(colours, 3, axis=0)
    image = renderer()(View(parts, SIZE, up).scene(own, ambient=AMBIENT))
    width, height = SIZE[0], SIZE[1] + BELOW
    figure = Figure(figsize=(width / DPI, height / DPI), dpi=DPI)
    axes = figure.add_axes((0, BELOW / height, 1, SIZE[1] / height))
    axes.axis("off")
    axes.imshow(image, interpolation="nearest", aspect="auto")
    bar = figure.colorbar(
        ScalarMappable(norm, map_),
        figure.add_axes((0.25, 95 / height, 0.5, 18 / height)),
        orientation="horizontal",
        extend="max" if positive else "both",
    )
    bar.set_label(quantity)
    if not np.isfinite(values).all():
        figure.text(0.02, 40 / height, "grey: undefined")
    save(figure, path)
