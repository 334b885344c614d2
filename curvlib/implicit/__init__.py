"""Surfaces f(x, y, z) = 0 in closed form, one file each; f grows outward.

A file holds LABEL; BOX, the half lengths of a box about the origin that contains the surface, or
cuts it where CLOSED is False; and `level(x, y, z)`: f (m,), its gradient (3, m) and its Hessian
(3, 3, m), derived by hand. `_exact.py` evaluates curvature at the nearest points of a surface,
`_sampled.py` makes meshes as marching cubes and voxels do.
"""
