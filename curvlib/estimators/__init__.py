"""The estimators: one file each, found by listing this folder.

A file holds LABEL and STYLE (for legends) and

    @compiled
    def estimate(ring, option: Literal["default", "other"] = "default"):
        return K, H

with arrays (m,) for a batch of m one-rings (see curvlib.kit.ring), or None for a quantity it does
not estimate. The keyword options are its readings, their Literal the valid values. Compiled
code runs fast and on several threads; without the decorator it is NumPy on the same arrays.
A first parameter called `mesh` instead of `ring` asks for the whole curvlib.Mesh, and arrays
(V,).
Imports are absolute, so that a copy of a file works outside the package too.
An estimator whose value depends on which way round the ring is walked says so in ONE_SIDED.
"""
