"""Checksums beside the meshes of a surface, by which a changed mesh is found."""

import hashlib
from pathlib import Path

from curvlib.errors import InputError
from curvlib.files import open_archive, whole_file

from .archive import SUMS, file_hash, parse_sums, sums_text


def write_sums(folder, names) -> None:
    """Write SHA256SUMS of these files in a folder, after them: see `check_unchanged`."""
    hashes = {name: file_hash(Path(folder, name)) for name in names}
    with whole_file(Path(folder, SUMS)) as part:
        part.write_text(sums_text(hashes), encoding="utf-8", newline="\n")


def check_unchanged(path) -> None:
    """Raise InputError unless a file has the hash in SHA256SUMS beside it.

    A file older than SHA256SUMS is not hashed: each job loads all meshes, and hashing them takes
    0.4 s.
    """
    path = Path(path)
    sums = path.with_name(SUMS)
    if not sums.exists() or path.stat().st_mtime_ns < sums.stat().st_mtime_ns:
        return
    listed = parse_sums(sums.read_text(encoding="utf-8")).get(path.name)
    if listed and listed != file_hash(path):
        raise InputError(
            f"{path}: changed since it was made, or open for writing in another process; close it "
            "there, or delete it and run again to make it"
        )


def library_digest(path, files) -> str:
    """SHA-256 of the listed hashes of these files of a library, a folder or an archive of it: the
    same for both, and without reading the files."""
    path = Path(path)
    if path.is_dir():
        folders = sorted({Path(file).parent for file in files})
        listed = {
            f"{folder}/{name}": digest
            for folder in folders
            for name, digest in parse_sums(
                (path / folder / SUMS).read_text(encoding="utf-8")
            ).items()
        }
    else:
        with open_archive(path) as archive:
            listed = parse_sums(archive.read(f"{path.stem}/{SUMS}").decode())
    text = sums_text({file: listed[file] for file in sorted(map(str, files))})
    return hashlib.sha256(text.encode()).hexdigest()
