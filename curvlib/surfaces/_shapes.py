"""Small factories that the surfaces are composed of; each returns a geomdl NURBS surface."""

import json
from pathlib import Path

import numpy as np
from geomdl import NURBS

SQRT_HALF = np.sqrt(0.5)

# A full circle as four rational quadratic arcs (The NURBS Book, example 7.3).
CIRCLE = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
CIRCLE_WEIGHTS = np.array([1, SQRT_HALF, 1, SQRT_HALF, 1, SQRT_HALF, 1, SQRT_HALF, 1])
CIRCLE_KNOTS = [0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1]


def nurbs(degrees, knots, net, weights=None):
    """A geomdl surface from degrees and knots (u, v), a net (nu, nv, 3) and weights (nu, nv)."""
    net = np.asarray(net, dtype=float)
    weights = np.ones(net.shape[:2]) if weights is None else np.asarray(weights, dtype=float)
    homogeneous = np.concatenate([net * weights[..., None], weights[..., None]], axis=-1)
    surface = NURBS.Surface(normalize_kv=False)
    surface.degree_u, surface.degree_v = degrees
    surface.set_ctrlpts(homogeneous.reshape(-1, 4).tolist(), *net.shape[:2])
    surface.knotvector_u, surface.knotvector_v = ([float(t) for t in k] for k in knots)
    return surface


def revolve(degree, knots, profile, weights=None):
    """Turn a profile of (r, z) about the z axis: u runs around, v along the profile.

    S_u x S_v points outward where the profile runs upwards.
    """
    profile = np.asarray(profile, dtype=float)
    weights = np.ones(len(profile)) if weights is None else np.asarray(weights, dtype=float)
    net = np.array([[(r * x, r * y, z) for r, z in profile] for x, y in CIRCLE])
    return nurbs((2, degree), (CIRCLE_KNOTS, knots), net, np.outer(CIRCLE_WEIGHTS, weights))


def scale(surface, factors):
    """A surface with x, y and z multiplied by three factors."""
    net = net_of(surface) * factors
    knots = (surface.knotvector_u, surface.knotvector_v)
    return nurbs(surface.degree, knots, net, np.reshape(surface.weights, net.shape[:2]))


def net_of(surface):
    """The control points of a surface, (nu, nv, 3)."""
    return np.reshape(surface.ctrlpts, (surface.ctrlpts_size_u, surface.ctrlpts_size_v, 3))


def teapot(part):
    """One part of Newell's teapot, from teapot.json, which names its source."""
    data = json.loads(Path(__file__).with_name("teapot.json").read_text(encoding="utf-8"))[part]
    # Stored [v][u], with the normal inward: reversing v turns it outward.
    net = np.array(data["control_points"])[::-1].swapaxes(0, 1)
    return nurbs(data["degree"], (data["knots_u"], data["knots_v"]), net)
