"""Labels of the regions of a mesh: from its own file, or one of GIFTI or FreeSurfer."""

import warnings
from pathlib import Path

import numpy as np

from curvlib.errors import InputError, check_name


def read_labels(label: str, path, mesh):
    """The labels of a mesh that was read from `path`.

    Parameters
    ----------
    label : str
        The name of point or cell data in that file, as pyvista reads it; or the path of a GIFTI
        label file (.gii) or FreeSurfer annotation (.annot).
    path : str or path
    mesh : Mesh

    Returns
    -------
    labels : ndarray of int, (V,) or (F,)
    per : str
        "vertex" or "face".
    names : dict
        Label -> name of the region, where the file has names.

    Raises
    ------
    InputError
        There is no such data or file, or not one label for each vertex or triangle.
    """
    if Path(label).suffix in (".annot", ".gii"):
        found, names = _from_file(label)
        choices = {"vertex": found}
        where = label
    else:
        choices, names, where = _of_mesh(label, path), {}, f"{label!r} of {str(path)!r}"
    for per, count in (("vertex", len(mesh.vertices)), ("face", len(mesh.faces))):
        labels = choices.get(per)
        if labels is not None and labels.shape == (count,):
            whole = np.where(np.isfinite(labels), labels, -1).astype(np.int64)
            if not (whole == labels).all():
                raise InputError(f"{where}: labels are integers; there are others")
            return whole, per, names
    counts = " and ".join(str(len(labels)) for labels in choices.values())
    raise InputError(
        f"{where}: {counts} labels, but the mesh has {len(mesh.vertices)} vertices and "
        f"{len(mesh.faces)} triangles"
    )


def _from_file(path):
    if not Path(path).is_file():
        raise InputError(f"{path!r}: no such file")
    try:
        import nibabel

        if Path(path).suffix == ".annot":
            labels, _, names = nibabel.freesurfer.read_annot(path)
            told = {k: name.decode("utf-8", "replace") for k, name in enumerate(names)}
            return labels, told | {-1: "unlabelled"}
        image = nibabel.load(path)
        return np.asarray(image.darrays[0].data).reshape(-1), image.labeltable.get_labels_as_dict()
    except ImportError:
        raise InputError(
            f"{path!r}: reading labels needs nibabel: install curvlib[files]"
        ) from None
    except Exception as error:
        words = " ".join(str(error).split()) or type(error).__name__
        raise InputError(f"{path!r}: nibabel cannot read it: {words}") from None


def _of_mesh(label, path):
    """Labels per vertex and per face, those that there are, from a file's own data."""
    try:
        import pyvista

        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            data = pyvista.read(path)
    except ImportError:
        raise InputError("reading labels needs pyvista: install curvlib[files]") from None
    except Exception:
        data = pyvista.PolyData()
    names = [*data.point_data.keys(), *data.cell_data.keys()]
    if not names:
        raise InputError(
            f"{label!r}: pyvista finds no point or cell data in {str(path)!r}; name a label file, "
            ".gii or .annot"
        )
    check_name("point or cell data", label, names, str(path))
    places = {"vertex": data.point_data, "face": data.cell_data}
    return {per: np.asarray(place[label]) for per, place in places.items() if label in place}
