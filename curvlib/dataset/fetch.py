"""Fetch an archive of the library: download or copy it, check it, unpack it whole."""

import os
import sys
from contextlib import contextmanager, suppress
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory
from urllib.parse import urlsplit

from curvlib.errors import InputError
from curvlib.files import DAMAGED, expanded, no_such_file, open_archive

from .archive import SUMS, file_hash, parse_sums


def fetch(source: str | os.PathLike, folder: str | os.PathLike = ".") -> Path:
    """Unpack an archive of the library after a check of its SHA-256.

    Parameters
    ----------
    source : str or path
        URL or path of the archive, a .zip file that a file SHA256SUMS beside it lists.
    folder : path
        Where to unpack; made if it does not exist.

    Returns
    -------
    Path
        The new folder in `folder`, with the archive's name without .zip.

    Raises
    ------
    InputError
        The archive or SHA256SUMS cannot be read, the hash differs, a member is missing or would
        lie outside the new folder, or the new folder exists already. No file is left behind.
    """
    source = str(source)
    remote = "://" in source
    name = PurePosixPath(urlsplit(source).path).name if remote else Path(source).name
    if not name.endswith(".zip"):
        raise InputError(f"{source}: not an archive; give the URL or path of a .zip file")
    folder = expanded(folder)
    target = folder / name.removesuffix(".zip")
    with _scratch(folder, target.name) as scratch:
        if remote:
            expected = _listed(_download(_beside(source), scratch), name, source)
            _check_free(target)  # before a download of minutes
            archive = _download(source, scratch, expected)
        else:
            archive = _existing(expanded(source))
            expected = _listed(_existing(archive.with_name(SUMS)), name, source)
            if file_hash(archive) != expected:
                raise _changed(source, expected)
            _check_free(target)  # after the hash, lest a user removes a good folder for a bad file
        _unpack(archive, source, target.name, scratch)
        Path(scratch, target.name).rename(target)
    return target


@contextmanager
def _scratch(folder, name):
    """Yield a temporary folder in `folder`, which is made if needed and removed on an error."""
    made = [path for path in (folder, *folder.parents) if not path.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(prefix=f".{name}.", suffix=".part", dir=folder) as scratch:
            yield scratch
    except BaseException as error:
        for path in made:
            with suppress(OSError):
                path.rmdir()
        if isinstance(error, OSError):
            raise InputError(f"{folder}: cannot unpack here ({error.strerror})") from None
        raise


def _check_free(target):
    if target.exists():
        raise InputError(f"{target}: exists already; remove it, or unpack into another folder")


def _existing(path):
    if not path.is_file():
        raise InputError(
            f"{no_such_file(path)}; `snakemake dataset` makes an archive with {SUMS} beside it, "
            "`curvlib fetch URL` downloads one"
        )
    return path


def _listed(sums, name, source):
    """The SHA-256 of an archive in a SHA256SUMS file."""
    listed = parse_sums(sums.read_text(encoding="utf-8-sig", errors="replace"))
    if name not in listed:
        raise InputError(f"{source}: {SUMS} beside it does not list {name}")
    return listed[name]


def _beside(url):
    """The URL of SHA256SUMS in the folder of another file."""
    parts = urlsplit(url)
    path = str(PurePosixPath(parts.path).with_name(SUMS))
    return parts._replace(path=path, query="", fragment="").geturl()


def _changed(source, sha256):
    return InputError(f"{source}: cut off or changed, its SHA-256 is not {sha256} as in {SUMS}")


def _download(url, folder, sha256=None):
    """Download a file; with a progress bar on a terminal and a check where its hash is known."""
    try:
        import pooch
        from requests import RequestException
    except ImportError:
        raise InputError(f"{url}: install pooch to download it, or give a path") from None
    pooch.get_logger().setLevel("WARNING")
    try:
        path = pooch.retrieve(
            url,
            known_hash=sha256 and f"sha256:{sha256}",
            fname=PurePosixPath(urlsplit(url).path).name,
            path=folder,
            progressbar=sha256 is not None and sys.stderr.isatty(),
        )
    except (RequestException, OSError, ValueError) as error:
        if sha256 and not isinstance(error, OSError):
            raise _changed(url, sha256) from None
        raise InputError(f"{url}: cannot be downloaded ({_reason(error)})") from None
    return Path(path)


def _reason(error):
    """A download's error in a few words: the server's answer, or the first cause in the chain."""
    if getattr(error, "response", None) is not None:
        return f"{error.response.status_code} {error.response.reason}"
    while cause := error.__cause__ or error.__context__:
        error = cause
    return getattr(error, "strerror", None) or str(error)


def _unpack(path, source, top, folder):
    """Extract an archive from `source`; raise InputError for a member outside the folder `top`."""
    with open_archive(path) as archive:
        names = archive.namelist()
        for name in names:
            parts = name.split("/")
            if parts[0] != top or ".." in parts or "\\" in name:
                raise InputError(f"{source}: member {name!r} lies outside the folder {top}/")
        if f"{top}/{SUMS}" not in names:
            raise InputError(f"{source}: member {top}/{SUMS} is missing")
        try:
            listed = parse_sums(archive.read(f"{top}/{SUMS}").decode("utf-8", errors="replace"))
            archive.extractall(folder)
        except (*DAMAGED, OSError) as error:
            raise InputError(f"{source}: cannot be unpacked ({_reason(error)})") from None
        for name in listed:
            if f"{top}/{name}" not in names:
                raise InputError(f"{source}: member {top}/{name} is missing")
