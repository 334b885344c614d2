"""
The meshes as a dataset
=======================

The library has meshes of NURBS surfaces with exact values, for your own code to be measured by.
``snakemake dataset`` makes all of it, ``curvlib fetch`` gets it; here two surfaces are written.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvlib
from curvlib.dataset.write import write_library

for name in ("teapot_spout", "ellipsoid"):
    meshes = [("same", n) for n in (8, 16, 32, 64)] + [("jittered-1", n) for n in (8, 16, 32, 64)]
    write_library(curvlib.surface(name), meshes, "library")
library = curvlib.load_library("library")
print(library)

# %%
# A mesh is read when it is asked for, and has K, H, k1, k2, d1, d2, normals and more. Any other
# program reads the same files: .vtkhdf by ParaView and pyvista, .ply by MeshLab and Blender, .txt
# by anything.
mesh = library.mesh("teapot_spout", 16)
print(mesh, "K from", np.nanmin(mesh.K).round(2), "to", np.nanmax(mesh.K).round(2))

# %%
# What converges on a regular grid may stand still on a jittered one.
_, axes = plt.subplots(figsize=(7, 4.5))
for diagonal, line in (("same", "-"), ("jittered-1", "--")):
    for name, colour in (("gauss_bonnet", "#0072B2"), ("jet", "#332288")):
        sizes, errors = [8, 16, 32, 64], []
        for n in sizes:
            mesh = library["ellipsoid", diagonal, n]
            errors.append(np.nanmedian(abs(curvlib.estimate(mesh, name).K - mesh.K)))
        axes.loglog(sizes, errors, line, color=colour, marker="o", label=f"{name}, {diagonal}")
axes.set(xlabel="n", ylabel="median error of K, 1/length^2")
axes.set_title("Error against resolution on a regular and on a jittered grid")
axes.legend()
axes.figure.tight_layout()

# %%
# ``snakemake dataset`` packs all meshes with their description into one archive, and ``snakemake
# dataset_parquet`` into one Parquet file, a row per mesh with its PLY in the column ``mesh``.
