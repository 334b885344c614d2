"""Writing files whole or not at all; opening archives and HDF5 with one clear error."""

import errno
import io
import os
import struct
import zlib
from contextlib import ExitStack, contextmanager
from difflib import get_close_matches
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import BadZipFile, ZipFile

from curvlib.errors import InputError

# The system refuses a file: disk full, quota or size limit reached, no permission, a file where a
# folder has to be or the reverse.
REFUSED = {
    errno.ENOSPC,
    errno.EDQUOT,
    errno.EFBIG,
    errno.EACCES,
    errno.EPERM,
    errno.EROFS,
    errno.ENOTDIR,
    errno.EISDIR,
    errno.EEXIST,
}

# zipfile and h5py raise these on damaged bytes, beside OSError.
DAMAGED = (
    BadZipFile,
    EOFError,
    KeyError,
    MemoryError,
    RuntimeError,
    TypeError,
    ValueError,
    struct.error,
    zlib.error,
)


def expanded(path) -> Path:
    """A path with ~ for the home folder; InputError for what is no path or names no user."""
    try:
        return Path(path).expanduser()
    except TypeError:
        raise InputError(f"a path is expected, not {path!r}") from None
    except RuntimeError:
        raise InputError(f"{str(path)!r}: there is no such home folder") from None


@contextmanager
def whole_file(path):
    """Yield a temporary path to write to; move it to `path` at the end, remove it on an error.

    The folder of `path` is made if it does not exist. Each temporary file has a folder of its own,
    so that two runs may write the same file. Raises InputError where the system refuses a file:
    disk full, no permission.
    """
    path = Path(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(prefix=f"{path.name}.", suffix=".part", dir=path.parent) as folder:
            part = Path(folder, path.name)
            yield part
            os.replace(part, path)
    except OSError as error:
        if error.errno not in REFUSED:
            raise
        temporary = error.filename is None or ".part" in str(error.filename)
        about = path if temporary else error.filename
        raise InputError(f"{about}: {error.strerror}") from None


@contextmanager
def write_hdf5(path):
    """Yield an HDF5 file in memory, open for writing; at the end Python writes it to `path`.

    On a full disk HDF5 2.0 would end in a segmentation fault; Python raises OSError.
    """
    import h5py

    with h5py.File(path, "w", driver="core", backing_store=False) as file:
        yield file
        file.flush()
        image = file.id.get_file_image()
    Path(path).write_bytes(image)


@contextmanager
def open_archive(path):
    """Yield a zip file open for reading; InputError if it is missing, cut off or no zip file."""
    with _open(path) as raw:
        try:
            archive = ZipFile(raw)
        except (*DAMAGED, OSError):
            raise InputError(f"{path}: cut off or no zip file; get the archive again") from None
        with archive:
            yield archive


@contextmanager
def open_hdf5(path, member=None):
    """Yield an HDF5 file, or one that is a member of an archive, open for reading.

    Raises InputError if it is missing or damaged, or if reading from it fails. HDF5 takes no lock:
    a file that another process has open can be read.
    """
    import h5py

    where = path if member is None else f"{path}: {member}"
    remedy = "delete it and run again" if member is None else "get the archive again"
    with _open(path) if member is None else _open_member(path, member) as raw:
        opened = False
        try:
            with h5py.File(raw, "r") as file:
                opened = True
                yield file
        except (*DAMAGED, OSError) as error:
            detail = " ".join(map(str, error.args))
            reason = f"not the expected data ({detail})" if opened else "cut off or not HDF5"
            raise InputError(f"{where}: {reason}; {remedy}") from error


def no_such_file(path) -> str:
    """The message for a path that does not exist, with the nearest file of the same suffix."""
    path = Path(path)
    beside = sorted(p.name for p in path.parent.glob("*") if p.suffix == path.suffix)
    cutoff = 0.0 if path.suffix == ".zip" else 0.6  # An archive has few neighbours of its kind.
    near = get_close_matches(path.name, beside, n=1, cutoff=cutoff)
    hint = f"; did you mean {str(path.with_name(near[0]))!r}?" if near else ""
    return f"{path}: no such file{hint}"


@contextmanager
def _open(path):
    with ExitStack() as stack:
        try:
            raw = stack.enter_context(open(path, "rb"))
        except FileNotFoundError:
            raise InputError(no_such_file(path)) from None
        except OSError as error:
            raise InputError(f"{path}: {error.strerror}") from None
        yield raw


@contextmanager
def _open_member(path, member):
    """A member of an archive in memory, checked by its CRC."""
    with open_archive(path) as archive:
        try:
            data = archive.read(member)
        except (*DAMAGED, OSError) as error:
            raise InputError(
                f"{path}: {member}: cut off or changed ({error}); get the archive again"
            ) from None
    yield io.BytesIO(data)
