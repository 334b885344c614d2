"""
Curvature of a scan
===================

A range scanner sees one side of an object along a grid of rays, each answer a little off along
its ray, some missing. The mesh is open, noisy and has holes. This scan is simulated, so that no
file has to be fetched; with a file of your own, begin at ``curvlib.read``.
"""

import numpy as np
import pyvista

import curvlib

rng = np.random.default_rng(1)
x, y = np.meshgrid(np.linspace(-1.5, 1.5, 100), np.linspace(-1.2, 1.2, 80), indexing="ij")
z = 0.35 * np.cos(2.2 * x) * np.cos(1.7 * y) + 0.15 * np.exp(-8 * ((x - 0.4) ** 2 + y**2))
z += rng.normal(scale=0.001, size=x.shape)
seen = (np.hypot(x / 1.45, y / 1.15) < 1) & (rng.random(x.shape) > 0.002)

scan = pyvista.StructuredGrid(x, y, z).extract_surface(algorithm=None).triangulate()
scan = scan.extract_points(seen.ravel(order="F"), adjacent_cells=False).extract_surface(
    algorithm=None
)
scan.save("scan.ply")

# %%
# What is it, and what is wrong with it? The noise is in mean edges. On the command line this is
# ``curvlib info scan.ply``.
mesh = curvlib.read("scan.ply")
report = curvlib.check(mesh)
print(f"{report.triangles} triangles, {report.boundaries} boundaries, noise {report.noise:.3f}")
for fault in report.faults:
    print(fault.count, fault.name)

# %%
# The default estimator chooses fits and scales from the mesh, and says which.
estimates = curvlib.estimate(mesh)
for call, share in zip(
    estimates.choice.calls, np.bincount(estimates.choice.index) / len(estimates.H)
):
    print(f"{share:.0%} of the vertices by {call}")
print("undefined:", estimates.undefined or "nowhere")

# %%
# Colours are symmetric about zero and end at the 98th percentile, so that a few large values at
# the boundary do not decide what the rest looks like.
values = estimates.to_polydata()
limit = np.nanquantile(abs(estimates.H), 0.98)
plotter = pyvista.Plotter(window_size=(900, 600))
plotter.add_mesh(values, scalars="H", cmap="RdYlBu_r", clim=(-limit, limit), ambient=0.4)
plotter.view_isometric()
plotter.camera.zoom(1.4)
plotter.show()

# %%
# The shape index tells the kind of shape apart from its strength: caps are near +1, cups near -1,
# saddles near 0.
plotter = pyvista.Plotter(window_size=(900, 600))
plotter.add_mesh(values, scalars="shape_index", cmap="RdYlBu_r", clim=(-1, 1), ambient=0.4)
plotter.view_isometric()
plotter.camera.zoom(1.4)
plotter.show()
