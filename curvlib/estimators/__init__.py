"""The estimators: one file each, found by listing this folder; the stem is the name.

A file holds LABEL (for legends), SOURCE (DOI or URL of the method), optionally STYLE (how its
curves are drawn), and

    @compiled
    def estimate(ring, option: Literal["default", "other"] = "default"):
        return K, H

The name of the first parameter says what it is given: `ring`, a batch of m closed one-rings of
one valence (curvlib.kit.ring); `disk`, one vertex and its neighbours (curvlib.kit.disk); `ball`, a
vertex and the triangles around it (curvlib.kit.ball); `mesh`, the whole curvlib.Mesh. The keyword
options are its readings, their Literal the valid values; those called `rings` and `radius` say how
far a disk or ball reaches. It returns K and H, or the six fields of
curvlib.kit.tensor.Curvatures: arrays (m,), directions (3, m), pointwise; numbers where it is given
a disk, (V,) and (3, V) where it is given the mesh; None for what it does not estimate. It must not
write to a ring: a file from elsewhere gets its own copy. Two passes: a second parameter without
default has the name of a function beside `estimate`, which is run at all vertices first; `estimate`
is given its values at the vertex and around it. PER = ("vertex", "face") says that a disk may also
be that of a triangle's centre among others, CREASES = "one-sided" or "nan" that a mesh is cut along
its creases first.

Compiled code runs fast and on several threads; without the decorator it is NumPy on the same
arrays. The nine of the paper are Python that calls compiled functions: one that several estimators
call is compiled once, which takes 0.6 of the time for all nine, and one for a rare case when that
occurs. Imports are absolute, so that a copy of a file works outside the package too. An estimator
whose value depends on which way round the ring is walked says so in ONE_SIDED.
"""
