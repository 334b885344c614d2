"""Statistics of values over the area of a mesh, and over that of its regions."""

import numpy as np

# Of the statistics by region: quantiles, and bars of the histogram.
PROBABILITIES = (0.05, 0.25, 0.5, 0.75, 0.95)
BARS = 10


def quantiles(mesh, values, per: str = "vertex", probabilities=PROBABILITIES) -> np.ndarray:
    """Quantiles over the area of a mesh of values `per` vertex, (V,), or face, (F,); NaN where none
    is finite. A third of a triangle's area counts for each of its corners."""
    return _quantiles(_at_corners(mesh, values, per), _areas(mesh), probabilities)


def integral(mesh, values, per: str = "vertex") -> float:
    """The integral of values `per` vertex, (V,), or face, (F,), over the area of a mesh where they
    are finite; NaN where none is. A third of a triangle's area counts for each of its corners."""
    x, areas = _at_corners(mesh, values, per), _areas(mesh)
    known = np.isfinite(x)
    return float((x[known] * areas[known]).sum()) if known.any() else np.nan


def shares(mesh, codes, count: int, per: str = "vertex") -> np.ndarray:
    """The shares (count,) of the area with each of the codes 0 to count - 1, of the area that has
    one; NaN where none has."""
    x, areas = _at_corners(mesh, codes, per), _areas(mesh)
    known = np.isfinite(x)
    sums = np.bincount(x[known].astype(int), areas[known], count)
    with np.errstate(invalid="ignore"):
        return sums / sums.sum()


def by_region(mesh, labels, labelled: str, named: dict, per: str, names=None) -> list[dict]:
    """Statistics over the area of each region, for each scalar column.

    Parameters
    ----------
    mesh : Mesh
    labels : ndarray of int, (V,) or (F,)
        The region of each vertex or triangle.
    labelled : {"vertex", "face"}
    named : dict
        Column -> values (V,) or (F,); others, of vectors, are left out.
    per : {"vertex", "face"}
        Of the values.
    names : dict, optional
        Label -> name of the region.

    Returns
    -------
    list of dict
        A row for each region and quantity: `area` of the part of the region with a value and
        `undefined`, the area without, in the square of the mesh's unit; `mean`, `deviation`,
        quantiles `p5` to `p95`; `bar_1` to `bar_10`, the shares of the area in ten equal classes
        from `low` to `high`, 5 % and 95 % of the whole mesh, the outer ones with what lies beyond.
    """
    regions, areas = _at_corners(mesh, labels, labelled), _areas(mesh)
    rows = []
    for label in np.unique(regions):
        inside = regions == label
        for name, values in named.items():
            if values.ndim > 1:
                continue
            corners = _at_corners(mesh, values, per)
            low, high = _quantiles(corners, areas, (0.05, 0.95))
            x, a = corners[inside], areas[inside]
            known = np.isfinite(x)
            row = {"region": int(label)} | ({"name": names.get(int(label), "")} if names else {})
            row |= {"quantity": name, "area": a[known].sum(), "undefined": a[~known].sum()}
            x, a = x[known], a[known]
            rows.append(row | _statistics(x, a, low, high))
    return rows


def _statistics(x, areas, low, high):
    """The statistics of finite values over their areas, a row's end."""
    total = areas.sum()
    mean = (x * areas).sum() / total if total else np.nan
    variance = (areas * (x - mean) ** 2).sum() / total if total else np.nan
    row = {"mean": mean, "deviation": np.sqrt(variance)}
    shown = zip(PROBABILITIES, _quantiles(x, areas, PROBABILITIES))
    row |= {f"p{100 * p:.0f}": value for p, value in shown}
    bars = np.full(BARS, np.nan)
    if total:
        step = (high - low) / BARS or 1.0
        number = np.clip((x - low) / step, 0, BARS - 1).astype(int)
        bars = np.bincount(number, areas, BARS) / total
    return row | {"low": low, "high": high} | {f"bar_{k + 1}": bar for k, bar in enumerate(bars)}


def _areas(mesh):
    """(3 F,) a third of the area of its triangle at each corner."""
    a, b, c = mesh.vertices[mesh.faces].swapaxes(0, 1)
    facets = np.cross(b - a, c - a)
    return np.repeat(np.sqrt((facets * facets).sum(1)) / 6, 3)


def _at_corners(mesh, values, per):
    """(3 F,) values of the vertices or triangles at the corners of triangles."""
    return values[mesh.faces.reshape(-1)] if per == "vertex" else np.repeat(values, 3)


def _quantiles(values, weights, probabilities):
    known = np.isfinite(values) & (weights > 0)
    if not known.any():
        return np.full(len(probabilities), np.nan)
    order = np.argsort(values[known], kind="stable")
    x, w = values[known][order], weights[known][order]
    return np.interp(np.asarray(probabilities), (np.cumsum(w) - w / 2) / w.sum(), x)
