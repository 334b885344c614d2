"""One estimator on all meshes of the library: error norms and values, written to disk."""

import csv
from pathlib import Path
from types import SimpleNamespace

from curvlib.estimation import estimate
from curvlib.files import open_hdf5, whole_file, write_hdf5
from curvlib.meshes.key import MeshKey

from .norms import NORMS, counted_vertices, error_rows, largest_curvature
from .quantities import QUANTITIES

COLUMNS = (*MeshKey._fields, "triangles", "largest_k", "estimator", "variant", "counted")
COLUMNS += ("quantity", *NORMS, "vertices", "undefined")


def run_estimator(estimator: str, variants: dict, meshes, chosen, keep=None):
    """Run an estimator on meshes and yield rows of COLUMNS: the error norms of every run, in every
    choice of vertices.

    Parameters
    ----------
    estimator : str
        Name or path.
    variants : dict
        Options by key.
    meshes : mapping
        MeshKey -> Mesh.
    chosen : function
        MeshKey -> the keys of the variants to run on that mesh.
    keep : function, optional
        Called with MeshKey, variant and Estimates after each run.
    """
    for key, mesh in meshes.items():
        labels = key._asdict() | {"triangles": len(mesh.faces)}
        labels |= {"largest_k": largest_curvature(mesh), "estimator": Path(estimator).stem}
        choices = counted_vertices(mesh)
        for variant in chosen(key):
            result = estimate(mesh, estimator, **variants[variant])
            if keep:
                keep(key, variant, result)
            for choice, counted in choices.items():
                of_run = labels | {"variant": variant, "counted": choice}
                for row in error_rows(mesh, result, counted):
                    yield of_run | row


def run_and_keep(estimator: str, variants: dict, meshes, errors, values, **attributes) -> None:
    """Run an estimator in all variants; write `errors` and `values`, both whole or neither.

    `errors`: CSV of COLUMNS; without rows it has a header. `values`: HDF5 with `attributes` of its
    root, /<surface>/<diagonal>/<n>/<quantity>: the values of the first variant, the default; those
    of QUANTITIES that the estimator returns.
    """
    default, arrays = next(iter(variants)), {}

    def keep(key, variant, result):
        if variant == default:
            for quantity in filter(QUANTITIES.get, result.returned):
                arrays["/".join(map(str, (*key, quantity)))] = getattr(result, quantity)

    rows = list(run_estimator(estimator, variants, meshes, lambda key: variants, keep))
    with whole_file(values) as part_of_values, whole_file(errors) as part_of_errors:
        with write_hdf5(part_of_values) as file:
            file.attrs.update(attributes, options=default)
            for name, array in arrays.items():
                file[name] = array
        _write_csv(part_of_errors, COLUMNS, rows)


def write_rows(path, columns, rows) -> None:
    """Write dicts with these keys as CSV, whole or not at all; no rows leave the header."""
    with whole_file(path) as part:
        _write_csv(part, columns, rows)


def _write_csv(path, columns, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def read_values(path, only=None) -> dict:
    """MeshKey -> the values of `run_and_keep` by quantity; for the keys `only`, or for all."""
    with open_hdf5(path) as file:
        keys = only or [MeshKey(s, d, int(n)) for s in file for d in file[s] for n in file[s][d]]
        groups = {key: file["/".join(map(str, key))] for key in keys}
        return {
            key: SimpleNamespace(**{name: values[()] for name, values in group.items()})
            for key, group in groups.items()
        }
