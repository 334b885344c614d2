"""The meshes as Parquet: a row each, the PLY file in it byte for byte."""

import io

import numpy as np
import pyarrow.parquet
import trimesh

import curvlib
from curvlib.dataset.description import mesh_table
from curvlib.dataset.parquet import write_parquet
from curvlib.dataset.write import write_library


def test_rows_are_meshes_that_others_read(tmp_path):
    write_library(curvlib.surface("ellipsoid"), [("same", 8), ("alternate", 12)], tmp_path / "lib")
    library = curvlib.load_library(tmp_path / "lib")
    table = mesh_table(library, {"ellipsoid": "Ellipsoid"})
    for name in ("a.parquet", "b.parquet"):
        write_parquet(tmp_path / name, table, tmp_path / "lib")
    assert (tmp_path / "a.parquet").read_bytes() == (tmp_path / "b.parquet").read_bytes()
    file = pyarrow.parquet.ParquetFile(tmp_path / "a.parquet")
    assert file.num_row_groups == len(library) == 2
    for row in file.read().to_pylist():
        mesh = library[row["surface"], row["diagonal"], row["n"]]
        assert row["triangles"] == len(mesh.faces)
        assert row["K_max"] == np.nanmax(mesh.K)
        assert row["mesh"]["bytes"] == (tmp_path / "lib" / row["mesh"]["path"]).read_bytes()
        seen = trimesh.load(io.BytesIO(row["mesh"]["bytes"]), file_type="ply", process=False)
        np.testing.assert_array_equal(seen.vertices, mesh.vertices)
        np.testing.assert_array_equal(seen.faces, mesh.faces)
