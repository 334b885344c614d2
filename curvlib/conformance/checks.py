"""The checks: each a function of a Subject that returns, or raises Broken or NotApplicable."""

import numpy as np

from curvlib.kit.ring import FLAT, ROUNDING
from curvlib.meshes.mesh import Mesh
from curvlib.nurbs.tessellation import tessellate
from curvlib.surfaces._named import surface

from .subject import (
    NotApplicable,
    around,
    ellipsoid,
    fan,
    hold,
    icosphere,
    same,
    same_nan,
    sphere,
)

SCALES = (1e-150, 1e-40, 0.01, 0.3, 7, 100, 1e40, 1e150)
VALENCES = (3, 4, 5, 7, 40, 1000)
WIDE = (1025, 100_000)


def unit_sphere(subject):
    """K = H = 1 on nearly equilateral triangles with outward faces: to four per cent, but for the
    twelve vertices of valence five, where methods by area are off by 15 at any n, and K = k1 k2 by
    as much in each."""
    found = subject(icosphere(4))
    hold({"K", "H"} & set(found.returned), "neither K nor H is returned")
    for quantity in sorted({"K", "H"} & set(found.returned)):
        values = getattr(found, quantity)
        same_nan(np.isnan(values), np.zeros(len(values), bool), f"{quantity} of the unit sphere")
        off = np.sort(np.abs(values - 1))
        middle = 0.005 if subject.given == "ring" else 0.02
        most = 1.15**2 - 1 if quantity == "K" else 0.15
        for error, limit in ((np.median(off), middle), (off[-13], 0.04), (off[-1], most)):
            words = f"{quantity} of the unit sphere is off by {error:.3g}, more than {limit:.3g}"
            hold(error < limit, words)


def scale(subject):
    """K goes with 1 / length^2 and H with 1 / length, from 1e-150 to 1e150."""
    one = subject(sphere())
    for radius in SCALES:
        scaled = subject((sphere().vertices * radius, sphere().faces))
        # One factor at a time: the square of 1e-150 is no float64 of full precision.
        found, words = (scaled.K * radius * radius, scaled.H * radius), f"sphere times {radius:g}"
        same(found, one, words, subject.precision)


def values_out_of_range(subject):
    """K of 1e320 or 1e-320 is NaN, and H is right."""
    one = subject(sphere())
    for radius in (1e-160, 1e160):
        scaled = subject((sphere().vertices * radius, sphere().faces))
        hold(np.isnan(scaled.K).all(), f"sphere times {radius:g}: K is no NaN")
        found, words = (scaled.H * radius,), f"H of the sphere times {radius:g}"
        same(found, (one.H,), words, subject.precision)


def rigid_motion(subject):
    """Values do not depend on where a mesh stands and how it is turned."""
    axis, angle = np.array([1, 2, 3]) / 14**0.5, np.radians(77)
    cross = np.cross(np.eye(3), axis)
    turn = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    mesh = ellipsoid()
    moved = subject((mesh.vertices @ turn.T + (3, -1, 2), mesh.faces))
    same(moved, subject(mesh), "ellipsoid turned and moved", subject.precision)


def relabelled_vertices(subject):
    """Values do not depend on the order of vertices, faces and corners."""
    mesh, rng = ellipsoid(), np.random.default_rng(6)
    new = rng.permutation(len(mesh.vertices))
    vertices = np.empty_like(mesh.vertices)
    vertices[new] = mesh.vertices
    faces = np.roll(new[mesh.faces], 1, axis=1)[rng.permutation(len(mesh.faces))]
    found = subject((vertices, faces))
    words = "ellipsoid, its vertices in another order"
    same((found.K[new], found.H[new]), subject(mesh), words, subject.precision)


def reversed_orientation(subject):
    """K is kept and H negated, but by an estimator that looks one way around the ring."""
    one_sided = getattr(subject.module, "ONE_SIDED", None)
    expected = subject(ellipsoid())
    found = subject((ellipsoid().vertices, ellipsoid().faces[:, ::-1]))
    if one_sided is None:
        words = "ellipsoid with reversed faces"
        same((found.K, -found.H), expected, words, subject.precision)
    else:
        hold(
            np.nanmax(np.abs(found.H + expected.H)) > 1e-6,
            f"it says in ONE_SIDED that it is one-sided, but is not: {one_sided}",
        )


def boundary(subject):
    """NaN on the boundary and nowhere else; given disks, not even there; BOUNDED: near it, too."""
    mesh = tessellate(surface("revolution"), 9)
    near = subject.within_reach(mesh, np.flatnonzero(mesh.boundary))
    for values in subject(mesh, **(subject.lengths(mesh) if subject.bounded else {})):
        undefined = np.isnan(values)
        if not undefined.all():
            expected = mesh.boundary & (subject.given == "ring")
            if subject.bounded:
                expected = undefined & near | mesh.boundary
            same_nan(undefined, expected, "an open surface of revolution")


def broken_rings(subject):
    """A third face on an edge, two spheres that share a vertex, a face turned over, a vertex
    without faces: NaN there, finite elsewhere, and out of reach the values of the whole sphere."""
    mesh, expected = sphere(), subject.on_sphere
    options, count = subject.lengths(mesh), len(mesh.vertices)
    a, b = mesh.faces[100, :2]
    extra = np.vstack((mesh.vertices, [[3, 3, 3]], [[4, 4, 4]]))
    r = subject((extra, np.vstack((mesh.faces, [[a, b, count]]))), **options)
    broken = np.isin(np.arange(count), (a, b))
    outside = np.r_[r.K[:count][broken], r.K[count:], r.H[count:]]
    hold(np.isnan(outside).all(), f"an edge of three faces, a vertex without: {outside}, no NaN")
    keep = ~subject.within_reach(mesh, [a, b])
    defined = keep if subject.bounded else ~broken
    finite = np.isfinite(r.K[:count][defined]).all() or np.isnan(expected.K).all()
    hold(finite, "an edge of three faces: NaN elsewhere")
    hold(keep.any() != subject.spreads, "an edge of three faces changes all values of a sphere")
    _same_where(keep, r, expected, "an edge of three faces")

    twin = np.where(mesh.faces == 0, 0, mesh.faces + count - 1)
    both = np.vstack((mesh.vertices, 2 * mesh.vertices[0] - mesh.vertices[1:]))
    r = subject((both, np.vstack((mesh.faces, twin[:, ::-1]))), **options)
    hold(np.isnan(r.K[0]), f"two spheres that touch in a vertex: K = {r.K[0]} there, no NaN")
    ring = subject.given == "ring"
    keep = ~(around(mesh.faces, [0], 0) if ring else subject.within_reach(mesh, [0]))
    _same_where(keep, r, expected, "two spheres that touch in a vertex")

    turned = mesh.faces.copy()
    turned[50] = turned[50, ::-1]
    r = subject((mesh.vertices, turned), **options)
    undefined = np.isin(np.arange(count), turned[50])
    hold(np.isnan(r.K[undefined]).all(), "a face turned over: K at its corners is no NaN")
    if np.isfinite(expected.K).any():
        if subject.bounded:
            undefined |= np.isnan(r.K) & subject.within_reach(mesh, turned[50])
        same_nan(np.isnan(r.K), undefined, "a face turned over")


def _same_where(keep, found, expected, words):
    count = len(keep)
    pairs = (found.K, expected.K), (found.H, expected.H)
    same([a[:count][keep] for a, _ in pairs], [b[keep] for _, b in pairs], f"{words}, far from it")


def degenerate_triangles(subject):
    """Two vertices in one place or but for rounding, three in one line or but for rounding: NaN at
    the vertices of the triangle; elsewhere, and given disks, which do without that triangle, the
    values are finite."""
    mesh = ellipsoid()
    options = subject.lengths(mesh)
    usual = subject(mesh, **options)
    a, b, c = mesh.faces[100]
    for words, place in (
        ("two vertices in one place", mesh.vertices[b]),
        ("two vertices in one place but for rounding", mesh.vertices[b] * (1 + 2e-16)),
        ("three vertices in a line", (mesh.vertices[b] + mesh.vertices[c]) / 2),
        (
            "three vertices in a line but for rounding",
            0.3 * mesh.vertices[b] + 0.7 * mesh.vertices[c] + 1e-15,
        ),
    ):
        vertices = mesh.vertices.copy()
        vertices[a] = place
        flat = _without_area(vertices[mesh.faces])
        expected = np.isin(np.arange(len(vertices)), mesh.faces[flat]) & (subject.given == "ring")
        found = subject(Mesh(vertices, mesh.faces, normals=mesh.normals), **options)
        for values, before in zip(found, usual):
            if np.isfinite(before).any():
                same_nan(np.isnan(values), expected, words)


def _without_area(corners):
    """(F,) bool: rounding decides the shape of a triangle, seen from some corner."""
    flat = np.zeros(len(corners), bool)
    for k in range(3):
        v, p, q = np.roll(corners, k, axis=1).swapaxes(0, 1)
        squares = sum((x * x).sum(1) for x in (p - v, q - v, q - p))
        double = np.linalg.norm(np.cross(p - v, q - v), axis=1)
        height = np.sqrt(FLAT**2 * squares + ROUNDING**2 * (v * v).sum(1))
        flat |= ~(double > np.sqrt(squares) * height)
    return flat


def any_valence(subject):
    """H > 0 at the apex of a pyramid over 3 to 1,000 corners."""
    for n in VALENCES:
        H = subject(fan(n, 0.1)).H[n]
        hold(H > 0 or np.isnan(H), f"the apex of a pyramid over {n} corners has H = {H:g} < 0")


def wide_fans(subject):
    """A vertex of valence 100,000 changes no value elsewhere. Where there is a radius by default,
    the fan is so large that its edges are not within it."""
    ball = icosphere(2)
    options = subject.lengths(ball)
    alone = subject(ball, **options)
    for n in WIDE:
        vertices, faces = fan(n, 0.1, n if options else 1)
        both = np.vstack((vertices, ball.vertices)), np.vstack((faces, ball.faces + n + 1))
        words, r = f"a sphere beside a fan of {n} triangles", subject(both, **options)
        for values, expected in zip(r, alone):
            same_nan(np.isnan(values[n + 1 :]), np.isnan(expected), words)
        if subject.given != "passes":  # which are chosen from all of the mesh
            same((x[n + 1 :] for x in r), alone, words, 1e-13)


def one_vertex_at_a_time(subject):
    """No value depends on the batch that it was computed in."""
    mesh = ellipsoid()
    options = subject.lengths(mesh)
    near = subject.within_reach(mesh, [40])
    if subject.spreads:
        raise NotApplicable(f"each value depends on the whole mesh: {subject.module.GLOBAL}")
    hold(not near.all(), "each value depends on the whole mesh, which no GLOBAL says")
    some = mesh.faces[near[mesh.faces].all(1)]
    part, whole = subject((mesh.vertices, some), **options), subject(mesh, **options)
    same((x[[40]] for x in part), (x[[40]] for x in whole), "one vertex alone", 1e-14)


CHECKS = (
    unit_sphere,
    scale,
    values_out_of_range,
    rigid_motion,
    relabelled_vertices,
    reversed_orientation,
    boundary,
    broken_rings,
    degenerate_triangles,
    any_valence,
    wide_fans,
    one_vertex_at_a_time,
)
