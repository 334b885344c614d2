"""Surfaces put together of pieces: a sharp edge, and a joint where curvature jumps."""

import numpy as np

from curvlib.meshes.jittered import hull, plane, spiral
from curvlib.meshes.mesh import Mesh

LABEL = "Joints"
SURFACES = ("capsule", "lens")
LENGTH = 2.0  # of the capsule's cylinder; its radius is 1
RIM = 0.8  # radius of the lens, whose sides are caps of unit spheres


def make(surface, n, seed):
    """About n^2 vertices.

    The capsule is a cylinder between two half spheres, smooth but for a jump of curvature where
    they meet; its vertices there, on the two circles, are not `smooth`. Those of the lens on its
    sharp rim are not either.
    """
    return (_capsule if surface == "capsule" else _lens)(n, seed)


def _capsule(n, seed):
    # A sphere and the cylinder around it have the same area between two heights: stretched along z
    # by the same factor everywhere, points of the sphere stay uniform.
    rays = spiral(n, seed)
    stretch = 1 + LENGTH / 2
    h = rays[:, 2] * stretch
    step = np.sqrt(4 * np.pi * stretch) / n
    joint = np.abs(np.abs(h) - LENGTH / 2) < step / 3
    h = np.where(joint, np.sign(h) * LENGTH / 2, h)
    axial = np.sign(h) * np.maximum(np.abs(h) - LENGTH / 2, 0)  # of the normal
    x, y = (rays[:, :2] / np.linalg.norm(rays[:, :2], axis=1)[:, None]).T
    ring, zero = np.sqrt(1 - axial**2), 0 * h
    normals = np.column_stack((x * ring, y * ring, axial))
    cap, lost = np.abs(h) > LENGTH / 2, np.where(joint, np.nan, 0)
    k2 = cap + lost
    d1 = np.column_stack((-y, x, zero)) + np.where(cap | joint, np.nan, 0)[:, None]
    d2 = np.column_stack((zero, zero, zero + 1)) + 0 * d1
    vertices = np.column_stack((x * ring, y * ring, h))
    fields = {"K": k2, "k1": 1 + lost, "k2": k2, "H": (1 + k2) / 2, "d1": d1, "d2": d2}
    return Mesh(vertices, hull(rays), normals=normals, smooth=~joint, **fields)


def _lens(n, seed):
    # Points of one side, evenly spaced on its cap; the rim is shared.
    height = 1 - np.sqrt(1 - RIM**2)
    count = n * n // 2
    rim = round(2 * np.pi * RIM / np.sqrt(2 * np.pi * height / count))
    rng = np.random.default_rng(seed)
    t = (np.arange(count) + 0.5) / count
    turn = np.pi * (3 - np.sqrt(5)) * np.arange(count)
    depth = height * t * (1 - 1.5 * rim / count / 2)  # the outermost keep half a step to the rim
    radius = np.sqrt(1 - (1 - depth) ** 2)
    step = np.sqrt(2 * np.pi * height / count)
    inner = np.column_stack((radius * np.cos(turn), radius * np.sin(turn)))
    inner += 0.35 * step * rng.uniform(-1, 1, inner.shape)
    inner = inner[np.hypot(*inner.T) < RIM - step / 3]
    angles = 2 * np.pi * np.arange(rim) / rim
    edge = RIM * np.column_stack((np.cos(angles), np.sin(angles)))
    flat, m = np.concatenate([edge, inner]), len(inner)
    top = plane(*flat.T)
    bottom = np.where(top >= rim, top + m, top)[:, ::-1]
    z = np.sqrt(1 - (flat**2).sum(1)) - np.sqrt(1 - RIM**2)
    z[:rim] = 0
    below = np.column_stack((inner, -z[rim:]))
    vertices = np.concatenate([np.column_stack((flat, z)), below])
    sides = np.concatenate([np.zeros(rim), np.ones(m), -np.ones(m)])
    centre = np.outer(sides, (0, 0, -np.sqrt(1 - RIM**2)))
    normals, smooth = vertices - centre, sides != 0
    one = np.where(smooth, 1, np.nan)
    fields = dict.fromkeys(("K", "H", "k1", "k2"), one)
    nowhere = np.full(vertices.shape, np.nan)
    return Mesh(
        vertices,
        np.concatenate([top, bottom]),
        normals=normals,
        smooth=smooth,
        d1=nowhere,
        d2=nowhere,
        **fields,
    )
