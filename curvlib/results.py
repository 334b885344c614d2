"""Estimates on disk, between the jobs of the workflow: one HDF5 file per estimator."""

from .estimation import Estimates
from .library import open_hdf5, whole_file


def write_estimates(path, results, **attributes) -> None:
    """Write estimates, an iterable of (mesh key, variant, Estimates), whole or not at all."""
    import h5py

    with whole_file(path) as part, h5py.File(part, "w") as file:
        file.attrs.update(attributes)
        for (surface, diagonal, n), variant, result in results:
            group = file.create_group(f"{surface}/{diagonal}/{n}/{variant}")
            for quantity, values in result._asdict().items():
                group.create_dataset(quantity, data=values)


def read_estimates(path) -> dict:
    """(mesh key, variant) -> Estimates, from a file of `write_estimates`."""
    results = {}
    with open_hdf5(path) as file:
        for surface, diagonals in file.items():
            for diagonal, resolutions in diagonals.items():
                for n, variants in resolutions.items():
                    for variant, group in variants.items():
                        values = (group[quantity][()] for quantity in Estimates._fields)
                        results[(surface, diagonal, int(n)), variant] = Estimates(*values)
    return results
