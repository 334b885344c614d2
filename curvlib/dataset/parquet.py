"""The meshes of a library as one Parquet file, as hosts of datasets show them: a row per mesh."""

from pathlib import Path

from curvlib.files import whole_file

from .library import mesh_files

PLY = 1  # the place of the PLY among the files of a mesh


def write_parquet(path, table, folder) -> None:
    """Write the meshes of a table with their PLY files, byte for byte, in a column `mesh`.

    Parameters
    ----------
    path : str or path
    table : pandas.DataFrame
        A row per mesh with surface, diagonal and n, as `description.mesh_table` makes it.
    folder : str or path
        That of the library.

    Raises
    ------
    InputError
        The system refuses the file.

    Notes
    -----
    `mesh` is a pair of `bytes` and `path`, which is how hosts recognise files in a column. Each row
    is a row group, so that a reader gets one mesh without the others. Nothing is compressed: the
    same bytes on any machine.
    """
    import pyarrow
    from pyarrow.parquet import ParquetWriter

    file_type = pyarrow.struct([("bytes", pyarrow.binary()), ("path", pyarrow.string())])
    described = table.drop(columns="file")
    schema = pyarrow.Schema.from_pandas(described, preserve_index=False).remove_metadata()
    schema = schema.append(pyarrow.field("mesh", file_type))
    with whole_file(path) as part, ParquetWriter(part, schema, compression="none") as writer:
        for row in described.to_dict("records"):
            name = mesh_files(row["surface"], row["diagonal"], row["n"])[PLY]
            row["mesh"] = {"bytes": Path(folder, name).read_bytes(), "path": name}
            writer.write_table(pyarrow.Table.from_pylist([row], schema))
