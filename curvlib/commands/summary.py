"""What `curvlib estimate` tells of an estimate: as a document, and as text."""

from .terminal import number, table_text

# Shares of the area below are not told.
LEAST_SHARE = 0.005


def document(estimates, named, options, c0):
    """Quantiles over the area of the columns `named` that are numbers, integrals, the shares of
    the categories, and counts of what is undefined."""
    from curvlib.columns import CATEGORIES, CODES
    from curvlib.regions import PROBABILITIES, quantiles, shares

    mesh, per = estimates.mesh, estimates.per
    spread = {
        name: dict(zip(map(str, PROBABILITIES), quantiles(mesh, values, per)))
        for name, values in named.items()
        if values.ndim == 1 and name not in CODES
    }
    parts = shares(mesh, estimates.category, len(CATEGORIES), per)
    return {
        "options": options,
        "undefined": estimates.undefined,
        "places": "vertices" if per == "vertex" else "triangles",
        "crease": None if estimates.crease is None else int(estimates.crease.sum()),
        "choice": _taken(estimates),
        "relative_errors": _relative_errors(estimates),
        "quantiles": spread,
        "integral_of_K": estimates.integral(estimates.K),
        "bending_energy": estimates.integral(estimates.bending_energy(c0)),
        "spontaneous_curvature": c0,
        "categories": dict(zip(CATEGORIES, parts)),
    }


def text(name, told):
    """A `document` for a terminal."""
    chosen = ", ".join(f"{option}={value}" for option, value in told["options"].items())
    lines = [f"{name}{f'({chosen})' if chosen else ''}, quantiles over the area:"]
    spread = told["quantiles"]
    if spread:
        heads = (f"{100 * float(p):.0f} %" for p in next(iter(spread.values())))
        rows = [(f"  {column}", *map(number, found.values())) for column, found in spread.items()]
        lines.append(table_text(("", *heads), rows))
    if (total := told["integral_of_K"]) == total:
        lines.append(f"  integral of K {number(total)} ({number(total / 6.283185307)} x 2 pi)")
    if (energy := told["bending_energy"]) == energy:
        c0 = told["spontaneous_curvature"]
        less = f" - {number(c0)}" if c0 > 0 else f" + {number(-c0)}" if c0 else ""
        lines.append(f"  bending energy {number(energy)}, the integral of (2 H{less})^2 / 2")
    if told["relative_errors"]:
        parts = ", ".join(f"{q} {number(x)}" for q, x in told["relative_errors"].items())
        lines.append(f"  standard errors over curvedness (of K over its square), median: {parts}")
    shown = sorted(told["categories"].items(), key=lambda item: -item[1])
    parts = ", ".join(f"{words} {part:.0%}" for words, part in shown if part >= LEAST_SHARE)
    if parts:
        lines.append(f"  shape by area: {parts}")
    lines += [f"  {100 * part:.3g} % by {call}" for call, part in told["choice"].items()]
    if told["crease"]:
        lines.append(f"  on creases: {told['crease']} {told['places']}")
    undefined = ", ".join(f"{n} {cause}" for cause, n in told["undefined"].items())
    lines.append(f"  undefined: {undefined or 'nowhere'}")
    return "\n".join(lines)


def _taken(estimates):
    """What an estimator that chooses took: call -> part of the vertices, the most first."""
    import numpy as np

    if estimates.choice is None:
        return {}
    calls, index = estimates.choice
    parts = np.bincount(index, minlength=len(calls)) / len(index)
    return {calls[k]: float(parts[k]) for k in np.argsort(-parts, kind="stable") if parts[k]}


def _relative_errors(estimates):
    """Medians of the standard errors over the curvedness, of that of K over its square; empty for
    an estimator without them."""
    import numpy as np

    from curvlib.columns import ERRORS

    found = {}
    for column in ERRORS:
        errors, name = getattr(estimates, column), column.removesuffix("_error")
        if errors is not None:
            with np.errstate(invalid="ignore", divide="ignore"):
                parts = errors / estimates.curvedness ** (2 if name == "K" else 1)
            known = parts[np.isfinite(parts)]
            found[name] = float(np.median(known)) if len(known) else np.nan
    return found


def regions(rows):
    """Rows of `curvlib.regions.by_region` for a terminal, without histograms."""
    shown = ("area", "mean", "deviation", "p5", "p50", "p95")
    cells = [
        (
            f"  {row['region']} {row.get('name', '')}".rstrip(),
            row["quantity"],
            *(number(row[key]) for key in shown),
        )
        for row in rows
    ]
    heads = ("  by region", "", *(f"{key[1:]} %" if key[0] == "p" else key for key in shown))
    return table_text(heads, cells)
