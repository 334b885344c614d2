"""Errors on other shapes than the study's own, in a few readings."""

import numpy as np

from curvlib.estimation import estimate

from .norms import (
    NORMS,
    VERTICES,
    counted_vertices,
    edge_lengths,
    error_rows,
    largest_curvature,
    rounding_level,
)

LABELS = ("family", "shape", "proportions", "surface", "diagonal", "n")
COLUMNS = (*LABELS, "triangles", "elongation", "estimator", "variant", "counted", "quantity")
COLUMNS += (*NORMS, "vertices", "undefined", "rounding")


def elongation(mesh) -> float:
    """The median over the triangles of a Mesh of their longest edge over their shortest."""
    lengths = edge_lengths(mesh)
    return float(np.median(lengths.max(1) / lengths.min(1)))


def shape_rows(shapes, readings, estimators: dict, variants: dict):
    """Yield dicts of COLUMNS: the errors of every variant that `readings` name, on every shape.

    `shapes`: pairs of LABELS with their values and a Mesh; `readings`: rows as in readings.csv;
    by the estimators there, `estimators`: name or path, `variants`: variant -> options. Errors
    below `rounding` are rounding, as in variants.csv.
    """
    counted = readings.groupby(["estimator", "variant"], sort=False).counted.unique()
    for labels, mesh in shapes:
        of_mesh = labels | {"triangles": len(mesh.faces), "elongation": elongation(mesh)}
        vertices, largest = counted_vertices(mesh), largest_curvature(mesh)
        for (stem, variant), choices in counted.items():
            result = estimate(mesh, estimators[stem], **variants[stem][variant])
            for choice in choices:
                of_run = of_mesh | {"estimator": stem, "variant": variant, "counted": choice}
                # On a surface without poles all choices are the same.
                for row in error_rows(mesh, result, vertices.get(choice, vertices[VERTICES[0]])):
                    yield of_run | row | {"rounding": rounding_level(row["quantity"], largest)}
