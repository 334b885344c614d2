"""Getting an archive of the library: from the web or from a path, checked, unpacked whole."""

import os
from functools import partial
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory
from urllib.parse import urljoin, urlsplit
from zipfile import BadZipFile

from curvlib.errors import InputError
from curvlib.files import open_archive

from .archive import SUMS, file_hash, parse_sums


def fetch(source: str, folder=".") -> Path:
    """Unpack the archive at a URL or path into a new folder of its name, which is returned.

    Its SHA-256 has to stand in a file SHA256SUMS beside it. Raises InputError, and leaves
    nothing behind, where the archive or that file cannot be had, the hash differs, a member is
    missing or would land outside the new folder, or that folder exists already.
    """
    remote = "://" in source
    name = PurePosixPath(urlsplit(source).path if remote else source).name
    target = Path(folder, PurePosixPath(name).stem)
    if not name.endswith(".zip"):
        raise InputError(f"{source}: not an archive; give the URL or path of a .zip file")
    if not os.access(folder, os.W_OK):
        raise InputError(f"{folder}: no folder that can be written to, to unpack into")
    if target.exists():
        raise InputError(f"{target}: exists already; remove it, or unpack into another folder")
    with TemporaryDirectory(prefix=f".{target.name}.", dir=folder) as temporary:
        get = partial(_download, folder=temporary) if remote else _local
        sums = get(urljoin(source, SUMS) if remote else Path(source).with_name(SUMS))
        expected = parse_sums(sums.read_text(errors="replace")).get(name)
        if expected is None:
            raise InputError(f"{source}: {SUMS} beside it does not list {name}")
        archive = get(source)
        found = file_hash(archive)
        if found != expected:
            raise InputError(
                f"{source}: cut off or changed, its SHA-256 is {found}, not {expected} as in {SUMS}"
            )
        _unpack(archive, target.name, temporary)
        Path(temporary, target.name).rename(target)
    return target


def _local(path):
    if not Path(path).is_file():
        raise InputError(f"{path}: no such file; an archive is needed, and {SUMS} beside it")
    return Path(path)


def _download(url, folder):
    try:
        import pooch
        from requests import RequestException
    except ImportError:
        raise InputError(f"{url}: install pooch to download it, or give a path") from None
    pooch.get_logger().setLevel("WARNING")
    name = PurePosixPath(urlsplit(url).path).name
    try:
        return Path(pooch.retrieve(url, known_hash=None, fname=name, path=folder))
    except (RequestException, ValueError, OSError) as error:
        raise InputError(f"{url}: cannot be downloaded ({error})") from None


def _unpack(path, top, folder):
    """Extract an archive whose members all have to lie in the folder `top`."""
    with open_archive(path) as archive:
        names = archive.namelist()
        for name in names:
            parts = name.split("/")
            if parts[0] != top or ".." in parts or "\\" in name:
                raise InputError(f"{path}: member {name!r} lies outside the folder {top}/")
        if f"{top}/{SUMS}" not in names:
            raise InputError(f"{path}: member {top}/{SUMS} is missing")
        try:
            listed = parse_sums(archive.read(f"{top}/{SUMS}").decode(errors="replace"))
            for name in listed:
                if f"{top}/{name}" not in names:
                    raise InputError(f"{path}: member {top}/{name} is missing")
            archive.extractall(folder)
        except (BadZipFile, OSError, RuntimeError) as error:
            raise InputError(f"{path}: cannot be unpacked ({error})") from None
