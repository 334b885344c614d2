"""`mesh.curvlib.estimate()` on a pyvista.PolyData or UnstructuredGrid.

pyvista 0.48 and later finds it by the entry point in pyproject.toml; before, import this module.
"""

import pyvista

from .estimation import estimate


@pyvista.register_dataset_accessor("curvlib", pyvista.DataSet)
class Curvlib:
    """Curvature of a dataset of triangles.

    Examples
    --------
    >>> import pyvista
    >>> ball = pyvista.Icosphere(radius=2, nsub=3)
    >>> round(float(ball.curvlib.estimate("meyer")["H"].mean()), 2)
    0.5
    """

    def __init__(self, dataset):
        self._dataset = dataset

    def estimate(self, estimator=None, threads: int = 1, per: str = "vertex", **options):
        """The dataset's triangles as a PolyData with curvature as point or cell data.

        Parameters
        ----------
        estimator : str, path or callable
            As for `curvlib.estimate`, of which the options are, too; by default its own.
        threads : int
        per : {"vertex", "face"}
        **options

        Returns
        -------
        pyvista.PolyData
            A new one, with the points in their order; the dataset is as it was.
        """
        return estimate(self._dataset, estimator, threads, per, **options).to_polydata()
