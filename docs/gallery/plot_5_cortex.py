"""
A cortex from GIFTI
===================

Cortical surfaces come as GIFTI files. Convolutions that bend outward, gyri, have H > 0 here, and
sulci H < 0; FreeSurfer's ``curv`` has the opposite sign. The folded surface is made up, so that
no brain has to be fetched.
"""

import nibabel
import numpy as np
import pyvista

import curvlib

ball = pyvista.Icosphere(radius=1.0, nsub=6)
points = np.array(ball.points, dtype=float)
x, y, z = points.T
folds = np.sin(9 * x + 2 * np.sin(4 * y)) * np.cos(7 * z + 1.5 * np.sin(5 * x))
brain = 60 * points * (1 + 0.06 * folds)[:, None] * (1.2, 0.95, 0.85)  # mm
faces = ball.regular_faces.astype(np.int32)

parts = [
    nibabel.gifti.GiftiDataArray(brain.astype("f4"), intent="NIFTI_INTENT_POINTSET"),
    nibabel.gifti.GiftiDataArray(faces, intent="NIFTI_INTENT_TRIANGLE"),
]
nibabel.save(nibabel.gifti.GiftiImage(darrays=parts), "cortex.surf.gii")

# %%
# Lengths are in mm, so H is in 1/mm and the radius is in mm.
mesh = curvlib.read("cortex.surf.gii")
estimates = curvlib.estimate(mesh, "quadric", radius=4.0)
print(f"{len(mesh.vertices)} vertices, edges {mesh.mean_edge:.2f} mm")
print(f"gyri (H > 0): {(estimates.H > 0).mean():.0%} of the vertices")

# %%
values = estimates.to_polydata()
plotter = pyvista.Plotter(shape=(1, 2), window_size=(1100, 500))
for column, (name, limit) in enumerate((("H", 0.1), ("shape_index", 1.0))):
    plotter.subplot(0, column)
    plotter.add_mesh(
        values,
        scalars=name,
        cmap="RdYlBu_r",
        clim=(-limit, limit),
        ambient=0.4,
        copy_mesh=True,
        smooth_shading=True,
    )
    plotter.view_xz()
plotter.camera.zoom(1.3)
plotter.show()

# %%
# Values go back into GIFTI, as arrays of float32 that Connectome Workbench and FreeSurfer read
# beside the surface; on the command line ``curvlib estimate cortex.surf.gii --radius 4 -o
# cortex.shape.gii``. The mean over all of the surface, weighted by area:
print(f"mean H {estimates.integral(estimates.H) / curvlib.check(mesh).area:.4f} per mm")
print(f"K over all of it: {estimates.integral(estimates.K) / np.pi:.2f} pi, 4 pi without handles")
