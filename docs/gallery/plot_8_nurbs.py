"""
Exact curvature of a NURBS surface
==================================

No mesh, no estimate: derivatives of the surface give K and H at any parameters, also at poles and
on seams; NaN where the surface is not C^2.
"""

import numpy as np
import pyvista
from geomdl import NURBS

import curvlib

model = NURBS.Surface()
model.degree_u, model.degree_v = 3, 2
heights = [[0, 0, 0, 0], [0, 2, 1, 0], [0, -1, 2, 0], [0, 1, 1, 0], [0, 0, 0, 0]]
model.ctrlpts2d = [
    [(i, j, height, 1.0) for j, height in enumerate(row)] for i, row in enumerate(heights)
]
model.knotvector_u = [0, 0, 0, 0, 0.5, 1, 1, 1, 1]
model.knotvector_v = [0, 0, 0, 0.5, 1, 1, 1]
surface = curvlib.Surface(model, "wave")
print(surface)

# %%
# One point or many: u and v broadcast.
found = surface.curvature(0.3, [0.1, 0.2])
print("K", found.K.round(4), "H", found.H.round(4))

# %%
# In v the degree is 2, with a knot in the middle: second derivatives jump there, so K and H have
# no value on that line.
on_knot = surface.curvature(0.3, 0.5)
print("K", on_knot.K, "smooth", on_knot.smooth)

# %%
# A tessellation carries the exact values of its vertices.
mesh = curvlib.tessellate(surface, 64)
shown = pyvista.PolyData.from_regular_faces(np.array(mesh.vertices), np.array(mesh.faces))
shown["exact K"] = mesh.K
limit = np.nanquantile(abs(mesh.K), 0.95)
plotter = pyvista.Plotter(window_size=(900, 500))
plotter.add_mesh(
    shown,
    scalars="exact K",
    cmap="RdYlBu_r",
    clim=(-limit, limit),
    ambient=0.4,
    nan_color="#666666",
)
plotter.view_isometric()
plotter.camera.zoom(1.4)
plotter.show()
