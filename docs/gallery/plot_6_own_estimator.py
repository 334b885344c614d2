"""
Your own estimator against all others
=====================================

An estimator is a function; the name of its first parameter says what it is given. This one is
given a disk: the vertices over some rings. It fits the sphere through the vertex that is nearest
to its neighbours.
"""

from typing import Literal

import matplotlib.pyplot as plt
import numpy as np

import curvlib
from curvlib.meshes.jittered import jittered


def sphere_fit(disk, rings: Literal[2, 1, 3] = 2):
    """H of |e|^2 = -2 e . N / H, N being the normal of the vertex's triangles; K = H^2."""
    above, below = 0.0, 0.0
    N = disk.normal
    for k in range(disk.count):
        x, y, z = disk.e[0, k], disk.e[1, k], disk.e[2, k]
        height, square = x * N[0] + y * N[1] + z * N[2], x * x + y * y + z * z
        above, below = above - 2 * height * square, below + square * square
    H = above / below
    return H * H, H


# %%
# An irregular mesh with exact values, and every estimator on it.
mesh = jittered("ellipsoid", 48)
names = [*curvlib.estimators(), sphere_fit]
results = curvlib.estimate(mesh, names)
errors = {
    getattr(name, "__name__", name): np.nanmean(abs(result.H - mesh.H)) / np.mean(abs(mesh.H))
    for name, result in results.items()
    if np.isfinite(result.H).any()
}

# %%
ranked = sorted(errors, key=errors.get)
_, axes = plt.subplots(figsize=(7, 6.5))
axes.barh(
    ranked,
    [errors[name] for name in ranked],
    color=["#d62728" if name == "sphere_fit" else "#8fa8c8" for name in ranked],
)
axes.invert_yaxis()
axes.set(xscale="log", xlabel="mean error of H over mean |H|")
axes.set_title("Errors on an irregular ellipsoid; the estimator of one's own in red")
axes.figure.tight_layout()
print(f"sphere_fit: {ranked.index('sphere_fit') + 1} of {len(ranked)}")

# %%
# A sphere is a poor model where k1 and k2 differ: what would you fit instead?
#
# In a file of its own, ``sphere_fit.py`` with a ``LABEL``, it is checked for what every estimator
# keeps, scale, motion, orientation, broken meshes, by ``curvlib check sphere_fit.py``, and ranked
# on three surfaces and sizes by ``curvlib compare sphere_fit.py``.
