"""Building blocks of estimators: arrays in, arrays out; no mesh, no file.

This room is public: an estimator imports from here and from other estimators, nothing else of
curvlib, and names and meaning here do not change between minor versions.

`compiled`  decorators that have Numba compile a function, and keep the result
`vectors`   triples of numbers: dot, cross, norm
`ring`      batches of closed one-rings in the paper's letters: e_i, alpha_i, beta_i
`batch`     rings gathered from the vertices of a mesh, values scattered to them
`frame`     their normal N_v, coordinates in the tangent plane and normal curvatures kn_i
`fit`       batches of small least-squares problems
`disk`      a vertex and its neighbours over some rings, or within a length
`wider`     a disk with one ring more
`ball`      the triangles within a length of a vertex, cut where they leave it
`cut`       segments and triangles within a ball
`solid`     moments of the solid that the triangles of a ball bound
`measures`  curvature measures of triangles, dihedral angles of edges
`polynomial` a polynomial fitted to a disk, by normal equations
`variance`  variances of the curvatures of such a polynomial
`scales`    polynomials fitted over more and more rings of a disk
`reweighted` a quadric fitted to most points of a disk
`displaced` vertices far off the surface of their neighbours
`hermite`   a polynomial fitted to the heights and the slopes of a disk
`coupled`   values that are solutions of equations between vertices
`lanes`     rows of a matrix as vectors: dot products, projections, elimination
`combinations` linear combinations of rows
`parts`     parts of an array as arrays of another shape
`options`   types of options
`tensor`    from a second fundamental form, a graph or K and H to K, H, k1, k2, d1, d2

Arrays are component first, vector lanes last: (3, n, m) holds n edge vectors of m rings, so that
loops over m run through contiguous memory. Lengths are in the unit of the mesh, angles in
radians; normal curvature is positive where the surface bends away from its normal; undefined is
NaN.
"""
