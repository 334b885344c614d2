"""Other libraries as estimators: one file each, found by listing this folder; the stem is the name.

`curvlib.peers()` lists them, `curvlib.estimate(mesh, name)` takes them like an estimator, and
`make peers` installs the libraries. A file holds LABEL and SOURCE (the library's documentation),

    def returned(vertices, faces):  # what the library returns, as it is, and nothing else
        import library
        return K, H  # or larger, smaller principal curvature, their directions (V, 3); None

    def estimate(mesh):  # as an estimator: pointwise, H > 0 on a sphere, undefined is NaN
        return K, H

and declares what the library does by itself, which tests assert where it is installed:

`REQUIRES`  the distributions that it is imported from, separated by blanks
`INSTALL`   how they are installed, where it is not by `make peers`
`RETURNS`   "pointwise"; "integrated" over a cell: K without unit, H a length; "relative": free of
            scale, neither of the two
`SIGN`      of H on a sphere with outward normals: "ours", positive, or "opposite"; None without H
`BOUNDARY`  "zero"; "as closed": the formula of a closed ring, which is no curvature there;
            "estimated" from the triangles or vertices that there are. `estimate` returns NaN but
            for the last
`ORDER`     "as named"; "swapped": what it calls the larger principal curvature is the smaller one;
            None without principal curvatures
`PRECISION` "single", where values have the digits of float32
`DEPENDS`   where values depend on what curvature does not: "labels", the order of the vertices;
            "unit", the unit of length

`_turned.py` has the conversions that files share. Vertices without triangles are not shown to a
library, as some drop them and others fail.
"""
