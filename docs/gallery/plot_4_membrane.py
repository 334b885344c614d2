"""
A membrane at 10 nm
===================

A segmented tomogram is a volume of voxels, and its surface is a staircase. Curvature is asked for
at a physical scale, here 10 nm, whatever the size of the voxels. This membrane is a tube of
radius 20 nm with hemispherical ends, so that the exact values are known: H is 1/40 per nm on the
tube, 1/20 per nm on the ends.
"""

import matplotlib.pyplot as plt
import numpy as np
import pyvista

import curvlib

voxel, radius, half = 2.0, 20.0, 30.0  # nm
sides = [np.arange(-limit, limit + voxel / 2, voxel) for limit in (60, 30, 30)]
x, y, z = np.meshgrid(*sides, indexing="ij")
inside = np.sqrt(np.clip(abs(x) - half, 0, None) ** 2 + y**2 + z**2) < radius

# %%
# The surface of the segmentation has its vertices half-way between voxels.
volume = pyvista.ImageData(
    dimensions=inside.shape, spacing=(voxel,) * 3, origin=[side[0] for side in sides]
)
volume["inside"] = inside.ravel(order="F").astype(float)
volume.contour([0.5], scalars="inside").save("membrane.vtp")
mesh = curvlib.read("membrane.vtp")
print(f"{len(mesh.vertices)} vertices, edges of {mesh.mean_edge:.2f} nm")

# %%
# A number as radius is a length in the unit of the mesh. On the command line: ``curvlib estimate
# membrane.vtp -e ball_regression --radius 10 -o membrane.csv``.
exact = np.where(abs(mesh.vertices[:, 0]) < half, 1 / (2 * radius), 1 / radius)
away = abs(abs(mesh.vertices[:, 0]) - half) > 10  # the exact H jumps where tube and end meet
for name in ("ball_regression", "corrected_measures"):
    H = curvlib.estimate(mesh, name, radius=10.0).H
    print(f"{name}: mean relative error {np.nanmean(abs(H / exact - 1)[away]):.1%}")
one_ring = curvlib.estimate(mesh, "gauss_bonnet").H
print(f"gauss_bonnet, one ring: {np.nanmean(abs(one_ring / exact - 1)[away]):.0%}")

# %%
H = curvlib.estimate(mesh, "ball_regression", radius=10.0).H
_, axes = plt.subplots(figsize=(7, 4))
axes.plot(mesh.vertices[:, 0], one_ring, ".", color="0.8", label="one ring")
axes.plot(mesh.vertices[:, 0], H, ".", label="ball_regression, 10 nm")
order = np.argsort(mesh.vertices[:, 0])
axes.plot(mesh.vertices[order, 0], exact[order], "k-", label="exact")
axes.set(xlabel="along the tube, nm", ylabel="H, 1/nm", ylim=(-0.1, 0.2))
axes.set_title("Mean curvature along a voxel tube, at one ring and at 10 nm")
axes.legend()
axes.figure.tight_layout()

# %%
values = curvlib.estimate(mesh, "ball_regression", radius=10.0).to_polydata()
plotter = pyvista.Plotter(window_size=(900, 500))
plotter.add_mesh(values, scalars="H", cmap="RdYlBu_r", clim=(-0.06, 0.06), ambient=0.4)
plotter.view_xz()
plotter.camera.zoom(1.3)
plotter.show()
