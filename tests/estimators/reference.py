"""Independent one-vertex-at-a-time implementation of nine curvature estimators, from the paper.

Written from the text of the 2003 paper and the list of its corrections alone, and used only as a
test oracle: literal and slow. Section and equation numbers are the paper's. Normal curvatures are
positive where the surface bends towards its normal, as in the paper; of the results (K, H), H is
positive where the surface bends away from its normal. Undefined is NaN.
"""

from itertools import combinations
from math import atan2, cos, pi, sin, sqrt

import numpy as np

NAN = float("nan")
RANK = 1e-3  # singular values below this part of the largest: the direction is missing
TIE = 2e-6  # angles closer than this (radians) are equal
STRAIGHT = 1e-12  # sine of the angle below which three points count as collinear


def degenerate(corners):
    """Whether rounding decides the shape of a triangle (3, 3) of float64 coordinates, seen from its
    first corner: twice its area is at most s (1e-12 s + 2^-49 |v|), squared term by term, with s
    the root of the sum of its squared sides."""
    v, p, q = np.asarray(corners, dtype=float)
    s = sqrt(sum(np.dot(x, x) for x in (p - v, q - v, q - p)))
    height = sqrt((1e-12 * s) ** 2 + (2.0**-49 * np.linalg.norm(v)) ** 2)
    return not np.linalg.norm(np.cross(p - v, q - v)) > s * height


def unit(x):
    """x scaled to length one; NaN for the zero vector."""
    length = np.linalg.norm(x)
    return np.asarray(x) / length if length > 0 else np.full(3, NAN)


def angle(a, b):
    """Angle in [0, pi] between two vectors; NaN if one of them is zero."""
    defined = np.any(a) and np.any(b)
    return atan2(np.linalg.norm(np.cross(a, b)), np.dot(a, b)) if defined else NAN


def circumcentre(a, b):
    """Centre of the circle through the origin, a and b, as the intersection of three planes."""
    planes = np.array([unit(a), unit(b), unit(np.cross(a, b))])
    return np.linalg.solve(planes, [np.linalg.norm(a) / 2, np.linalg.norm(b) / 2, 0.0])


def least_squares(rows, values):
    """Minimum-norm solution with the relative cut-off; NaN for empty or undefined input."""
    if not values or not (np.isfinite(rows).all() and np.isfinite(values).all()):
        return np.full(3, NAN)
    return np.linalg.lstsq(np.array(rows), np.array(values), rcond=RANK)[0]


def from_principal(k1, k2):
    """Eqs. 2.3 and 2.4, with the mean curvature turned to the final sign."""
    return k1 * k2, -(k1 + k2) / 2


class Ring:
    """What the estimators share: edges e_i = v_i - v, facets, the normal N and its frame."""

    def __init__(self, v, ring, exact_normal=None, normal="uniform"):
        self.e = [np.asarray(p, dtype=float) - np.asarray(v, dtype=float) for p in ring]
        self.n = len(self.e)
        self.e_next = self.e[1:] + self.e[:1]
        crosses = [np.cross(e, f) for e, f in zip(self.e, self.e_next)]
        self.areas = [np.linalg.norm(c) / 2 for c in crosses]  # of T_i, eq. 3.1
        self.edge_areas = [self.areas[i - 1] + self.areas[i] for i in range(self.n)]  # at e_i
        self.normals = [unit(c) for c in crosses]  # N_i, eq. 3.2
        self.angles = [angle(e, f) for e, f in zip(self.e, self.e_next)]  # (v_i, v, v_i+1)
        if normal == "exact" and exact_normal is None:
            raise ValueError("normal='exact' needs normals")
        by_area = sum(a * m for a, m in zip(self.areas, self.normals) if a > 0)
        self.N = unit(
            {
                "uniform": sum(self.normals) / self.n,  # eq. 3.3
                "area": by_area,
                "exact": exact_normal,
            }[normal]
        )
        self.x = unit(np.cross(np.eye(3)[np.argmin(np.abs(self.N))], self.N))
        self.y = np.cross(self.N, self.x)  # section 3.1: arbitrary x, y = z cross x
        self.T = [unit((np.eye(3) - np.outer(self.N, self.N)) @ -e) for e in self.e]  # eq. 3.23
        self.projected_angles = [  # from T_i to T_i+1 about N, in (-pi, pi]; + 0.0 removes -0.0
            atan2(np.dot(self.N, np.cross(t, u)) + 0.0, np.dot(t, u))
            for t, u in zip(self.T, self.T[1:] + self.T[:1])
        ]

    def chord_curvatures(self):
        """Normal curvatures towards the neighbours, eq. 3.16."""
        return [2 * np.dot(self.N, e) / np.dot(e, e) if np.any(e) else NAN for e in self.e]

    def circle_curvatures(self):
        """Section 3.6: circles through v_i, tangent to T_i at v; |v_i - r N| = |r| gives r."""
        tz = [(np.dot(e, T), np.dot(e, self.N)) for e, T in zip(self.e, self.T)]
        return [1 / ((t * t + z * z) / (2 * z)) if z != 0 else 0.0 * t for t, z in tz]

    def mixed_area(self):
        """Area of the mixed Voronoi cell of v, Meyer et al. 2003."""
        total = 0.0
        for e, f, area in zip(self.e, self.e_next, self.areas):
            if np.dot(e, f) < 0:  # obtuse at v
                total += area / 2
            elif np.dot(-e, f - e) < 0 or np.dot(-f, e - f) < 0:  # obtuse elsewhere
                total += area / 4
            elif sin(angle(e, f)) > STRAIGHT:  # right triangles v, middle of edge, circumcentre
                for middle in (e / 2, f / 2):
                    side = np.linalg.norm(circumcentre(e, f) - middle)
                    total += np.linalg.norm(middle) * side / 2
        return total

    def euler_integrals(self, kn, phi):
        """Solve eqs. 3.17 and 3.18 for H and K; kn_i has the weight (phi_i-1 + phi_i) / 2."""
        w = [(phi[i - 1] + phi[i]) / 2 for i in range(self.n)]
        H = sum(w[i] * kn[i] for i in range(self.n)) / (2 * pi)
        mean_square = sum(w[i] * kn[i] ** 2 for i in range(self.n)) / (2 * pi)
        return 2 * (3 / 2 * H**2 - mean_square), -H

    def taubin_matrix(self, kn, weights):
        """Section 3.5: the matrix of eq. 3.22, its eigenvalues, and eq. 3.21 (corrected)."""
        total = sum(weights) if sum(weights) > 0 else NAN
        M = sum(w / total * k * np.outer(T, T) for w, k, T in zip(weights, kn, self.T))
        if not np.isfinite(M).all():
            return NAN, NAN
        eigenvalues, eigenvectors = np.linalg.eigh(M)
        m11, m22 = np.delete(eigenvalues, np.argmax(np.abs(self.N @ eigenvectors)))
        return from_principal(3 * m11 - m22, 3 * m22 - m11)


def paraboloid(v, ring, exact_normal=None, normal="uniform"):
    """Section 3.1: least-squares z = a x^2 + b x y + c y^2; eqs. 3.4, 3.5."""
    r = Ring(v, ring, exact_normal, normal)
    xyz = [(np.dot(e, r.x), np.dot(e, r.y), np.dot(e, r.N)) for e in r.e]
    plane = np.array([p[:2] for p in xyz])
    eigenvalues, axes = np.linalg.eigh(plane.T @ plane)
    if not eigenvalues[0] > 0:
        return NAN, NAN
    # Symmetric square root: coordinates in which the ring is as wide in all directions.
    whiten = axes @ np.diag(eigenvalues**-0.5) @ axes.T
    rows = [(x * x, sqrt(2) * x * y, y * y) for x, y in plane @ whiten]
    a, b_over_root_2, c = least_squares(rows, [p[2] for p in xyz])
    form = whiten @ np.array([[a, b_over_root_2 / sqrt(2)], [b_over_root_2 / sqrt(2), c]]) @ whiten
    return 4 * np.linalg.det(form), -np.trace(form)


def circle_pairs(edges, pairs):
    """Section 3.2: the index pairs (i, j), i < j, whose circles are fitted."""
    n, chosen = len(edges), set()
    angles = {(i, j): angle(edges[i], edges[j]) for i, j in combinations(range(n), 2)}
    if pairs == "opposite":
        for i in range(n):
            mine = {pair: value for pair, value in angles.items() if i in pair}
            chosen |= {pair for pair in mine if mine[pair] >= max(mine.values()) - TIE}
    elif pairs == "ring-opposite":
        chosen = {tuple(sorted((i, (i + h) % n))) for i in range(n) for h in (n // 2, (n + 1) // 2)}
    else:
        limit = {"above-120": 2 * pi / 3, "above-90": pi / 2, "all": -1.0}[pairs]
        chosen = {pair for pair in angles if angles[pair] > limit + TIE}
    while len(chosen) < min(3, len(angles)):  # the next best join, ties together
        best = max(value for pair, value in angles.items() if pair not in chosen)
        chosen |= {pair for pair in angles if angles[pair] >= best - TIE}
    return sorted(chosen)


def circular(v, ring, exact_normal=None, normal="uniform", pairs="opposite"):
    """Section 3.2: circles through v and pairs of neighbours; eqs. 2.1, 3.7 (corrected), 3.8."""
    r = Ring(v, ring, exact_normal, normal)
    rows, normal_curvatures = [], []
    for i, j in circle_pairs(r.e, pairs) if all(np.any(e) for e in r.e) else []:
        a, b = r.e[i], r.e[j]
        if sin(angle(a, b)) > STRAIGHT:
            centre = circumcentre(a, b)
            kappa, circle_normal = 1 / np.linalg.norm(centre), unit(centre)
            tangent = np.cross(unit(np.cross(a, b)), circle_normal)
            kn = kappa * np.dot(circle_normal, r.N)  # Meusnier
        else:  # the circle is a straight line, or undefined if v_i = v_j
            kn, tangent = 0.0 if np.any(a - b) else NAN, unit(a)
        alpha = atan2(np.dot(tangent, r.y), np.dot(tangent, r.x))
        rows.append((1.0, cos(2 * alpha), sin(2 * alpha)))
        normal_curvatures.append(kn)
    A, B, C = least_squares(rows, normal_curvatures)
    return from_principal(A + sqrt(B * B + C * C), A - sqrt(B * B + C * C))


def gauss_bonnet(v, ring, exact_normal=None, area="third", dihedral="signed"):
    """Section 3.3: angle deficit, eq. 3.12 (over A/3), and dihedral angles, eq. 3.13."""
    r = Ring(v, ring)
    A, cell, bending = sum(r.areas), r.mixed_area(), 0.0
    K_cell, H_cell = {"third": (A / 3, A / 3), "half": (A / 2, A / 3), "mixed": (cell, cell)}[area]
    for i in range(r.n):  # edge e_i is shared by the triangles T_i-1 and T_i
        concave = np.dot(r.normals[i - 1], r.e_next[i]) > 0  # v_i+1 above the plane of T_i-1
        sign = {"signed": -1 if concave else 1, "unsigned": 1}[dihedral]
        bending += np.linalg.norm(r.e[i]) * sign * angle(r.normals[i - 1], r.normals[i])
    deficit = 2 * pi - sum(r.angles)
    return (deficit / K_cell, bending / 4 / H_cell) if K_cell > 0 else (NAN, NAN)


def watanabe(v, ring, exact_normal=None, normal="area", angles="spatial"):
    """Section 3.4: eqs. 3.16 to 3.18."""
    r = Ring(v, ring, exact_normal, normal)
    phi = {"spatial": r.angles, "projected": r.projected_angles}[angles]
    return r.euler_integrals(r.chord_curvatures(), phi)


def watanabe_a(v, ring, exact_normal=None, normal="uniform"):
    """Section 3.6: fitted tangent circles, then eqs. 3.17 and 3.18 over the directions T_i."""
    r = Ring(v, ring, exact_normal, normal)
    return r.euler_integrals(r.circle_curvatures(), r.projected_angles)


def watanabe_b(v, ring, exact_normal=None, normal="uniform"):
    """Section 3.6: largest and smallest curvature of the fitted tangent circles."""
    kn = Ring(v, ring, exact_normal, normal).circle_curvatures()
    return from_principal(np.max(kn), np.min(kn))


def taubin(v, ring, exact_normal=None, normal="uniform"):
    """Section 3.5: weights by the areas of the two triangles at the edge."""
    r = Ring(v, ring, exact_normal, normal)
    return r.taubin_matrix(r.chord_curvatures(), r.edge_areas)


def taubin_a(v, ring, exact_normal=None, normal="uniform", angles="one-sided"):
    """Section 3.6: weights proportional to angle(v_i, v, v_i+1), or centred about v_i."""
    r = Ring(v, ring, exact_normal, normal)
    centred = [(r.angles[i - 1] + r.angles[i]) / 2 for i in range(r.n)]
    weights = {"one-sided": r.angles, "centred": centred}[angles]
    return r.taubin_matrix(r.chord_curvatures(), weights)


def taubin_b(v, ring, exact_normal=None, normal="uniform", weights="area"):
    """Section 3.6: mean of the curvatures towards v_i and v_i+1; weights of Taubin or of A."""
    r = Ring(v, ring, exact_normal, normal)
    kn = r.chord_curvatures()
    means = [(k + following) / 2 for k, following in zip(kn, kn[1:] + kn[:1])]
    return r.taubin_matrix(means, {"area": r.edge_areas, "angle": r.angles}[weights])


def ring_of(faces, v):
    """Neighbours v_0 .. v_n-1 of v, triangles (v, v_i, v_i+1); None if they form no one cycle."""
    after = {}
    for corners in ([int(c) for c in face] for face in faces):
        if v in corners:
            p, q = corners[corners.index(v) - 2], corners[corners.index(v) - 1]
            if len({v, p, q}) < 3 or p in after:
                return None
            after[p] = q
    if len(after) < 3 or set(after) != set(after.values()):
        return None
    ring = list(after)[:1]
    while after[ring[-1]] != ring[0]:
        ring.append(after[ring[-1]])
    return ring if len(ring) == len(after) else None


def estimate(vertices, faces, name, normals=None, only=None, **options):
    """Arrays (K, H) over the vertices, or over those in `only`; NaN where the ring is open."""
    estimator = {
        f.__name__: f
        for f in (
            paraboloid,
            circular,
            gauss_bonnet,
            watanabe,
            watanabe_a,
            watanabe_b,
            taubin,
            taubin_a,
            taubin_b,
        )
    }[name]
    K, H = np.full(len(vertices), NAN), np.full(len(vertices), NAN)
    incident = [[] for _ in vertices]
    for face in faces:
        for corner in {int(c) for c in face}:
            incident[corner].append(face)
    for v in range(len(vertices)) if only is None else only:
        ring = ring_of(incident[v], v)
        around = [] if ring is None else list(zip(ring, ring[1:] + ring[:1]))
        if around and not any(degenerate(vertices[[v, *pair]]) for pair in around):
            given = None if normals is None else normals[v]
            K[v], H[v] = estimator(vertices[v], [vertices[i] for i in ring], given, **options)
    return K, H
