"""
NumPy alone
===========

Arrays in, arrays out: an estimate needs neither pandas nor pyvista, and runs in a few lines of
any pipeline.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvlib

# A mesh as arrays: a torus on a grid of angles, vertices (V, 3) and triangles (F, 3).
n = 60
i, j = np.divmod(np.arange(n * n), n)
a, b = 2 * np.pi * i / n, 2 * np.pi * j / n
r = 2 + np.cos(b)
vertices = np.stack((r * np.cos(a), r * np.sin(a), np.sin(b)), axis=1)
corner = np.stack([(i + p) % n * n + (j + q) % n for p, q in ((0, 0), (1, 0), (1, 1), (0, 1))], 1)
faces = np.concatenate((corner[:, [0, 1, 2]], corner[:, [0, 2, 3]]))

# %%
estimates = curvlib.estimate((vertices, faces), "jet", degree=4)
K, H = estimates.K, estimates.H
print("error of K", abs(K - np.cos(b) / r).max().round(6))
print("error of H", abs(H - (1 + np.cos(b) / r) / 2).max().round(6))

# %%
# Means have to be weighted by area, since vertices are dense where triangles are small. A third
# of each triangle goes to each of its vertices.
corners = vertices[faces]
areas = np.linalg.norm(
    np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
)
weight = np.bincount(faces.ravel(), np.repeat(areas / 6, 3), minlength=len(vertices))
outer = np.cos(b) > 0
print("mean H outside", np.average(H[outer], weights=weight[outer]).round(4))
print("mean H inside ", np.average(H[~outer], weights=weight[~outer]).round(4))
print("the integral of K, 0 on a torus:", (K * weight).sum().round(6))

# %%
_, axes = plt.subplots(figsize=(6, 4.5))
shown = axes.tripcolor(*vertices[:, [0, 1]].T, faces[vertices[faces][..., 2].mean(1) > 0], K,
                       cmap="RdYlBu_r", clim=(-1, 1), shading="gouraud")  # fmt: skip
axes.set(aspect="equal", xlabel="x", ylabel="y")
axes.set_title("Gaussian curvature of a torus, seen from above")
axes.figure.colorbar(shown, label="K, 1/length^2")
axes.figure.tight_layout()
