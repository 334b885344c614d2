"""The archive of the library: one zip file, the same bytes wherever it is made."""

import hashlib
from pathlib import Path
from zipfile import ZipFile, ZipInfo

from curvlib.files import whole_file

SUMS = "SHA256SUMS"


def write_archive(path, members: dict) -> None:
    """Write a zip file and, beside it, SHA256SUMS with its hash.

    `members`: name in the archive -> file on disk (Path) or text (str). They lie in one folder with
    the archive's name and a SHA256SUMS of its own. For the same bytes on any machine, members are
    sorted, have a fixed date and are not compressed: the output of deflate depends on zlib.
    """
    path = Path(path)
    hashes = {}
    with whole_file(path) as part:
        with ZipFile(part, "w") as archive:
            for name in sorted(members):
                content = members[name]
                data = content.encode("utf-8") if isinstance(content, str) else content.read_bytes()
                hashes[name] = hashlib.sha256(data).hexdigest()
                _store(archive, f"{path.stem}/{name}", data)
            _store(archive, f"{path.stem}/{SUMS}", sums_text(hashes).encode())
        digest = file_hash(part)
    with whole_file(path.with_name(SUMS)) as part:
        part.write_text(sums_text({path.name: digest}), encoding="utf-8", newline="\n")


def sums_text(hashes: dict) -> str:
    """The text of a SHA256SUMS file, as `sha256sum --check` reads it, from name -> SHA-256."""
    return "".join(f"{digest}  {name}\n" for name, digest in hashes.items())


def parse_sums(text: str) -> dict:
    """File name -> SHA-256 in lower case, from the text of a SHA256SUMS file; other lines are left
    out."""
    rows = (line.split(maxsplit=1) for line in text.splitlines())
    return {
        row[1].removeprefix("*").removeprefix("./"): row[0].lower() for row in rows if len(row) == 2
    }


def file_hash(path) -> str:
    """SHA-256 of a file, in hexadecimal digits."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _store(archive, name, data):
    info = ZipInfo(name, date_time=(1980, 1, 1, 0, 0, 0))
    info.create_system = 3
    info.external_attr = 0o644 << 16
    archive.writestr(info, data)
