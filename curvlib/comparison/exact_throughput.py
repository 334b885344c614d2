"""Throughput of exact curvature of a NURBS surface, beside derivatives alone by other libraries."""

import itertools
import statistics
import time

import numpy as np

from curvlib.surfaces._named import surface as load

from .turns import seconds_of


def exact_rows(name="teapot_spout", scattered=10_000, side=1000):
    """Yield rows for exact K and H at `scattered` points of a surface or on a grid of `side`^2, and
    for the derivatives alone by other libraries. `ratio`: our time for K and H over that of the
    row, the median of alternating runs."""
    from scipy.interpolate import BSpline, NdBSpline

    surface = load(name)
    m, rng = surface.model, np.random.default_rng(0)
    net = np.reshape(m.ctrlptsw, (m.ctrlpts_size_u, m.ctrlpts_size_v, 4))
    knots, degrees = (
        [np.array(k) for k in (m.knotvector_u, m.knotvector_v)],
        (m.degree_u, m.degree_v),
    )
    spline = NdBSpline(tuple(knots), net, degrees)
    bases = [BSpline(k, np.eye(size), d) for k, size, d in zip(knots, net.shape, degrees)]
    orders = list(itertools.product(range(3), repeat=2))

    def geomdl(u, v):
        return [m.derivatives(*at, order=2) for at in zip(u, v)]

    def scipy(u, v):
        return [spline(np.stack((u, v), -1), nu=order) for order in orders]

    def products(u, v):
        along_u, along_v = ([b(t.ravel(), nu=nu) for nu in range(3)] for b, t in zip(bases, (u, v)))
        return [
            np.einsum("ui,ijc,vj->uvc", along_u[i], net, along_v[j], optimize=True)
            for i, j in orders
        ]

    def uniform(count):
        return [low + (high - low) * rng.random(count) for low, high in surface.domain]

    grid = [t.reshape(shape) for t, shape in zip(uniform(side), ((-1, 1), (1, -1)))]
    for arrangement, points, others in (
        ("scattered", uniform(scattered), {"geomdl derivatives": geomdl}),
        ("scattered", uniform(side * side), {"SciPy, nine derivatives": scipy}),
        ("grid", grid, {"nine products of basis matrices": products}),
    ):
        count = np.broadcast(*points).size
        for method, run in ({"K and H": surface.curvature} | others).items():
            seconds, ratios = [], []
            run(*(t.ravel()[:9] for t in points))
            for _ in range(3):
                ours = seconds_of(time.perf_counter, surface.curvature, *points)
                seconds.append(seconds_of(time.perf_counter, run, *points))
                ratios.append(ours / seconds[-1])
            row = {"method": method, "arrangement": arrangement, "points": count}
            row["seconds"] = statistics.median(seconds)
            row["points_per_second"] = count / row["seconds"]
            yield row | {"ratio": statistics.median(ratios)}
