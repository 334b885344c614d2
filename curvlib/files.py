"""Files that are there whole or not at all, and archives and HDF5 opened with one clear error."""

import io
import os
from contextlib import contextmanager
from pathlib import Path
from zipfile import BadZipFile, ZipFile

from curvlib.errors import InputError


def place_of(path, member):
    return path if member is None else f"{path}: {member}"


@contextmanager
def whole_file(path):
    """A path to write to that becomes `path` at the end, or is removed on an error."""
    path = Path(path)
    part = path.with_name(path.name + ".part")
    try:
        yield part
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


@contextmanager
def open_archive(path):
    """A zip file open for reading; InputError, naming it, where it is cut off or no zip file."""
    try:
        archive = ZipFile(path)
    except (BadZipFile, OSError) as error:
        reason = "missing" if isinstance(error, FileNotFoundError) else "cut off or no zip file"
        raise InputError(f"{path}: {reason}; get it again") from None
    with archive:
        yield archive


@contextmanager
def open_hdf5(path, member=None):
    """A file, or a member of an archive, open for reading; InputError, naming it, where it is
    cut off or no HDF5."""
    import h5py

    try:
        if member is None:
            file = h5py.File(path, "r")
        else:
            with open_archive(path) as archive:
                file = h5py.File(io.BytesIO(archive.read(member)), "r")
    except (BadZipFile, OSError) as error:
        reason = "missing" if isinstance(error, FileNotFoundError) else "cut off or not HDF5"
        raise InputError(f"{place_of(path, member)}: {reason}; get or make it again") from None
    with file:
        yield file
