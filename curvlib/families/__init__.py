"""Families of meshes with exact curvature, one file each: `make(surface, n, seed)` returns a Mesh.

A file holds LABEL, in tables and figures; SURFACES, the names that `make` takes; and `make`, whose
mesh has exact values at all vertices that are `smooth`: at its vertices where these lie on the
surface, else at the nearest points of it. Meshes have about n^2 vertices, or n cells along the
longest side. The same n and seed make the same mesh. `_charts.py` has what files share: points of a
surface by two parameters, and triangles of points.
"""
