"""
A noisy mesh with error bars
============================

The default estimator says how far its values may be off: ``K_error`` and ``H_error`` are standard
errors, from what the fit leaves over and from how it changes with the scale. On a torus with exact
values and vertices moved at random, they can be held against the errors that were made.
"""

import matplotlib.pyplot as plt
import numpy as np

import curvlib
from curvlib.meshes.jittered import jittered

exact = jittered("torus", 50)
rng = np.random.default_rng(2)
offsets = rng.normal(scale=0.03 * exact.mean_edge, size=len(exact.vertices))
mesh = exact.moved(exact.vertices + offsets[:, None] * exact.normals)
estimates = curvlib.estimate(mesh)

# %%
# The estimate at some vertices along the tube, with its standard error, against the exact value.
around = np.hypot(exact.vertices[:, 0], exact.vertices[:, 1])
some = np.argsort(around)[::40]
_, axes = plt.subplots(figsize=(7, 4.5))
axes.errorbar(around[some], estimates.H[some], estimates.H_error[some], fmt="o", label="estimate")
axes.plot(around[some], exact.H[some], "k-", label="exact")
axes.set(xlabel="distance from the axis of the torus", ylabel="H, 1/length")
axes.set_title("Mean curvature with standard errors on a noisy torus")
axes.legend()
axes.figure.tight_layout()

# %%
# If errors were Gaussian and the standard errors right, 68 % of the exact values would lie within
# one of them and 95 % within two.
for name in ("K", "H"):
    off = abs(getattr(estimates, name) - getattr(exact, name))
    error = getattr(estimates, f"{name}_error")
    one, two = (np.mean((off < times * error)[np.isfinite(error)]) for times in (1, 2))
    print(f"{name}: {one:.0%} within one standard error, {two:.0%} within two")
