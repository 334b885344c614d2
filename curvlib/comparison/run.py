"""What one estimator comes to on the library, on disk: its errors, and its values."""

import csv
from pathlib import Path
from types import SimpleNamespace

from curvlib.estimation import estimate
from curvlib.files import open_hdf5, whole_file, write_hdf5

from .norms import counted_vertices, error_rows, largest_curvature
from .quantities import QUANTITIES


def run_estimator(
    estimator: str, variants: dict, more, meshes, surfaces: dict, full, output, **attributes
):
    """Run an estimator on meshes; write `output.values` and `output.errors`, whole or not at all.

    `variants`: options by key, the default's first. `meshes`: (surface, diagonal, n) -> Mesh.
    `surfaces`: Surface by name. `full`: the (diagonal, n) on which every variant is run; on
    others it is those in `more`. The values (HDF5: /<surface>/<diagonal>/<n>/K and H) are those
    of the default on the full ones; the errors (CSV) those of every variant and choice of
    vertices.
    """
    stem, default = Path(estimator).stem, next(iter(variants))

    def rows():
        for (surface, diagonal, n), mesh in meshes.items():
            is_full = (diagonal, n) in full
            chosen = variants if is_full else {key: variants[key] for key in more}
            mesh_labels = {"surface": surface, "diagonal": diagonal, "n": n}
            mesh_labels |= {"triangles": len(mesh.faces), "largest_k": largest_curvature(mesh)}
            choices = counted_vertices(mesh, surfaces[surface])
            for variant, options in chosen.items():
                result = estimate(mesh, estimator, **options)
                if variant == default and is_full:
                    for quantity in QUANTITIES:
                        values = getattr(result, quantity)
                        file[f"{surface}/{diagonal}/{n}/{quantity}"] = values
                for choice, counted in choices.items():
                    labels = {"estimator": stem, "variant": variant, "counted": choice}
                    for row in error_rows(mesh, result, counted):
                        yield mesh_labels | labels | row

    with whole_file(output.values) as part, write_hdf5(part) as file:
        file.attrs.update(attributes, options=default)
        write_rows(output.errors, rows())


def write_rows(path, rows) -> None:
    """Write dicts of the same keys as CSV, whole or not at all; no rows make an empty file."""
    with whole_file(path) as part, part.open("w", newline="", encoding="utf-8") as file:
        writer = None
        for row in rows:
            if writer is None:
                writer = csv.DictWriter(file, row, lineterminator="\n")
                writer.writeheader()
            writer.writerow(row)


def read_values(path, only=None) -> dict:
    """(surface, diagonal, n) -> estimates by quantity in the default reading, of `run_estimator`;
    `only` of these keys, else of all that are there."""
    with open_hdf5(path) as file:
        keys = only or [(s, d, int(n)) for s in file for d in file[s] for n in file[s][d]]
        groups = {key: file["/".join(map(str, key))] for key in keys}
        return {
            key: SimpleNamespace(**{quantity: group[quantity][()] for quantity in QUANTITIES})
            for key, group in groups.items()
        }
