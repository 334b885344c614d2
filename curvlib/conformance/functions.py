"""What a user of a function that returns curvature relies on, as checks of that function.

Each check is a function of a Function that returns its evidence, or raises Failed or
NotApplicable. `CHECKS` has them by name.
"""

import numpy as np

from .function import CHANGE, Failed, ball, kept, on_boundary, rest, saddle, told, tried, uneven
from .subject import NotApplicable

# Power of 1 / length of a pointwise value, and of one that is integrated over a cell or ball.
POWERS = {"K": -2, "H": -1, "k1": -1, "k2": -1}
INTEGRATED = {"K": 0, "H": 1, "k1": 1, "k2": 1}
FAR = 1e6


def scaling(function):
    """Values are pointwise: with lengths doubled, K is a quarter and H, k1, k2 are half."""
    (vertices, faces), one = ball(), function.on_sphere
    two = function(2 * vertices, faces)
    said, integrated, other = [], [], []
    for name in one:
        factor = np.median(two[name]) / np.median(one[name])
        said.append(f"{name} times {factor:.3g}")
        if not abs(factor / 2.0 ** POWERS[name] - 1) < 0.05:
            whole = abs(factor / 2.0 ** INTEGRATED[name] - 1) < 0.05
            (integrated if whole else other).append(name)
    words = "lengths doubled: " + ", ".join(said)
    if integrated:
        raise Failed(words, "divide by the area of the vertex's cell, a third of its triangles'")
    if other:
        raise Failed(words, "multiply by a power of the mean edge, which it depends on")
    return words


def refinement(function):
    """Values are pointwise: on the unit sphere they are near 1, on a finer mesh, too."""
    one, finer = function.on_sphere, function(*ball(4))
    pairs = {name: (np.median(one[name]), np.median(finer[name])) for name in one}
    words = "unit sphere, 642 and 2,562 vertices: " + ", ".join(
        f"{name} {a:.3g} and {b:.3g}" for name, (a, b) in pairs.items()
    )
    if not all(abs(abs(x) - 1) < 0.2 for pair in pairs.values() for x in pair):
        if all(abs(b / a - 1) < 0.2 for a, b in pairs.values()):
            raise Failed(words, "divide by the value on the unit sphere")
        raise Failed(words, "divide by an area, as for scaling, before meshes are compared")
    return words


def sign(function):
    """H, k1, k2 > 0 on a sphere with outward faces, and K < 0 inside a torus."""
    said, wrong = [], []
    for name in ("H", "k1", "k2"):
        if name in function.on_sphere:
            positive = (function.on_sphere[name] > 0).mean()
            said.append(f"{name} > 0 at {100 * positive:.0f} % of a sphere")
            if positive < 0.99:
                wrong.append(name)
    if "K" in function.on_sphere:
        *_, inside = saddle()
        negative = (function.on_saddle["K"][inside] < 0).mean()
        said.append(f"K < 0 at {100 * negative:.0f} % inside a torus")
        if negative < 0.95:
            raise Failed(", ".join(said), "the sign of K is lost: use another function")
    if wrong:
        raise Failed(", ".join(said), "negate " + ", ".join(wrong))
    return ", ".join(said)


def orientation(function):
    """With all faces turned over, H is negated, k1 is the former -k2, and K is kept."""
    vertices, faces = ball()
    turned, said, same = function(vertices, faces[:, ::-1]), [], []
    others = {"k1": "k2", "k2": "k1"}
    for name in turned:
        other = others.get(name, name)
        ratio = np.median(turned[name]) / np.median(function.on_sphere[other])
        said.append(f"{name} is {other} times {ratio:.3g}")
        if not abs(ratio - (1 if name == "K" else -1)) < 0.05:
            same.append(name)
    words = "faces turned over: " + ", ".join(said)
    if same:
        raise Failed(words, "convex and concave are told apart by your own normals")
    return words


def order_of_k1_and_k2(function):
    """What is called the larger principal curvature is nowhere smaller than the other."""
    if "k1" not in function.on_sphere:
        raise NotApplicable("returns no principal curvatures")
    parts = function.on_saddle, function.on_uneven
    k1, k2 = (np.concatenate([part[name] for part in parts]) for name in ("k1", "k2"))
    behind = (k1 < k2 - CHANGE * np.nanmean(np.abs(k1))).mean()
    words = f"k1 < k2 at {100 * behind:.3g} % of a torus and an ellipsoid"
    if behind > 0:
        swap = "swap k1 and k2" if behind > 0.99 else "take the larger of both as k1"
        raise Failed(words, swap)
    return words


def boundary(function):
    """At the boundary of an open part of the unit sphere a value is NaN, or near those inside."""
    vertices, faces = ball()
    upper = faces[(vertices[faces][:, :, 2] > 0.2).all(1)]
    used, index = np.unique(upper, return_inverse=True)
    faces = index.reshape(-1, 3)
    found, edge = function(vertices[used], faces), on_boundary(faces, len(used))
    said, wrong = [], []
    for name, x in found.items():
        inside, there = np.nanmedian(x[~edge]), x[edge]
        if np.isnan(there).all():
            said.append(f"{name} NaN")
            continue
        middle = np.nanmedian(there)
        said.append(f"{name} {middle:.3g}, inside {inside:.3g}")
        if not abs(middle / inside - 1) < 0.3:
            wrong.append(name)
    words = "median at the boundary: " + ", ".join(said)
    if wrong:
        raise Failed(words, "leave out the vertices on the boundary")
    return words


def isolated_vertex(function):
    """A vertex without faces has NaN, and no other value changes."""
    vertices, faces = ball()
    found = tried(function, np.vstack((vertices, [[3, 3, 3]])), faces, "remove such vertices first")
    rest(found, function.on_sphere, np.ones(len(vertices), bool), "a vertex without faces")
    last = {name: x[-1] for name, x in found.items()}
    words = "there " + ", ".join(f"{name} = {x:.3g}" for name, x in last.items())
    if not all(np.isnan(x) for x in last.values()):
        raise Failed(words, "set NaN where no face is")
    return words


def edge_of_three_faces(function):
    """At an edge of three faces values are NaN, or an error says so; far away none changes."""
    vertices, faces = ball()
    a, b = faces[100, :2]
    more = np.vstack((vertices, 1.5 * (vertices[a] + vertices[b]) / 2))
    try:
        found = function(more, np.vstack((faces, [[a, b, len(vertices)]])))
    except (Failed, NotApplicable):
        raise
    except Exception as error:
        return told(error)
    far = np.linalg.norm(vertices - vertices[a], axis=1) > 1.2
    rest(found, function.on_sphere, far, "an edge of three faces")
    ends = {name: x[[a, b]] for name, x in found.items()}
    words = "at its ends " + ", ".join(f"{k} = {x[0]:.3g}, {x[1]:.3g}" for k, x in ends.items())
    if not all(np.isnan(x).all() for x in ends.values()):
        raise Failed(words, "look for edges of three faces first, and leave their vertices out")
    return words


def nan_coordinate(function):
    """A vertex at NaN is refused with an error, or values are NaN there and few elsewhere."""
    vertices, faces = ball()
    vertices[100] = np.nan
    try:
        found = function(vertices, faces)
    except (Failed, NotApplicable):
        raise
    except Exception as error:
        return told(error)
    at = {name: x[100] for name, x in found.items()}
    lost = max(np.isnan(x).sum() for x in found.values())
    words = ", ".join(f"{name} = {x:.3g} there" for name, x in at.items()) + f", {lost} NaN in all"
    if not all(np.isnan(x) for x in at.values()):
        raise Failed(words, "look for NaN among the coordinates first")
    if lost > len(vertices) / 4:
        raise Failed(words, "remove vertices at NaN first")
    return words


def far_from_the_origin(function):
    """Values of a mesh that is moved by 1,000,000 times its radius are kept."""
    vertices, faces = uneven()
    moved = function(vertices + FAR, faces)
    return kept(moved, function.on_uneven, "moved by 1e6", "subtract the centre first")


def rotation(function):
    """Values do not depend on how a mesh is turned."""
    vertices, faces = uneven()
    axis, angle = np.array([1, 2, 3]) / 14**0.5, np.radians(77)
    cross = np.cross(np.eye(3), axis)
    turn = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    found = function(vertices @ turn.T, faces)
    return kept(found, function.on_uneven, "turned by 77 degrees", "turn it to fixed axes")


def renumbering(function):
    """Values do not depend on the order of vertices and faces."""
    (vertices, faces), rng = uneven(), np.random.default_rng(6)
    new = rng.permutation(len(vertices))
    moved = np.empty_like(vertices)
    moved[new] = vertices
    found = function(moved, np.roll(new[faces], 1, axis=1)[rng.permutation(len(faces))])
    found = {name: x[new] for name, x in found.items()}
    words = "vertices in another order"
    return kept(found, function.on_uneven, words, "bring vertices into one order first")


def single_precision(function):
    """Coordinates of float32 are taken, with the values that they have as float64."""
    vertices, faces = uneven()
    single = vertices.astype(np.float32)
    found = tried(function, single, faces, "convert coordinates to float64 first")
    expected = function(single.astype(float), faces)
    return kept(found, expected, "float32 coordinates", "convert coordinates to float64 first")


def input_unchanged(function):
    """The caller's arrays are as before."""
    vertices, faces = ball()
    given = vertices.copy(), faces.astype(np.int64)
    function.values(*given)
    changed = [
        name
        for name, now, before in zip(("vertices", "faces"), given, (vertices, faces))
        if now.shape != before.shape or not (now == before).all()
    ]
    if changed:
        raise Failed(" and ".join(changed) + " are changed", "pass copies")
    return "vertices and faces are equal before and after"


CHECKS = {
    check.__name__.replace("_", " "): check
    for check in (
        scaling,
        refinement,
        sign,
        orientation,
        order_of_k1_and_k2,
        boundary,
        isolated_vertex,
        edge_of_three_faces,
        nan_coordinate,
        far_from_the_origin,
        single_precision,
        rotation,
        renumbering,
        input_unchanged,
    )
}
