"""`curvlib fetch`: from a server or a path; what is wrong is one line and leaves nothing."""

import socket
import zipfile

import numpy as np
import pytest

import curvlib
from curvlib.commands.main import main
from curvlib.dataset.archive import file_hash, sums_text
from curvlib.dataset.fetch import fetch

NAME = "curvature-library-1.2.3"
MEMBER = f"{NAME}/sphere/sphere.same.008.vtkhdf"


def fails(source, here, capsys):
    """The one line that the command ends with."""
    assert main(["fetch", str(source)]) == 1
    assert list(here.iterdir()) == []
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("error: ")
    return line


def change(published, edit):
    """Rewrite the archive by `edit`, from its members to its members, with the right hash."""
    path = published / f"{NAME}.zip"
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in edit(members).items():
            archive.writestr(name, data)
    list_hash(published, path)
    return path


def list_hash(published, path):
    sums = sums_text({path.name: file_hash(path)})
    (published / "SHA256SUMS").write_text(sums, encoding="utf-8")


@pytest.mark.parametrize("query", ["", "?download=1"])
def test_from_a_server(url, here, query, capsys):
    assert main(["fetch", f"{url}/{NAME}.zip{query}"]) == 0
    assert NAME in capsys.readouterr().out
    assert [p.name for p in here.iterdir()] == [NAME]
    made = curvlib.tessellate(curvlib.surface("sphere"), 8)
    np.testing.assert_array_equal(curvlib.load_library(NAME).mesh("sphere", 8).K, made.K)


def test_from_a_path(published, here):
    there = here / "there"
    there.mkdir()
    assert fetch(f"../published/{NAME}.zip", there) == there / NAME
    assert len(curvlib.load_library(there / NAME)) == 1


def test_wrong_hash(url, published, here, capsys):
    listed = file_hash(published / f"{NAME}.zip")
    with (published / f"{NAME}.zip").open("ab") as file:
        file.write(b"more")
    for source in (f"{url}/{NAME}.zip", published / f"{NAME}.zip"):
        line = fails(source, here, capsys)
        assert line.startswith(f"error: {source}: cut off or changed, its SHA-256 is not {listed} ")


def test_cut_off_on_the_server(url, published, here, capsys):
    path = published / f"{NAME}.zip"
    path.write_bytes(path.read_bytes()[:9000])
    assert "cut off or changed" in fails(f"{url}/{NAME}.zip", here, capsys)


def test_cut_off_on_the_way(url, published, here, capsys):
    path = (published / f"{NAME}.zip").rename(published / "cut-1.zip")
    list_hash(published, path)
    assert "cannot be downloaded" in fails(f"{url}/cut-1.zip", here, capsys)


@pytest.mark.parametrize("name", ["../evil", "/evil", f"{NAME}/../evil", "evil", "..\\evil"])
def test_path_that_escapes(url, published, here, capsys, name):
    path = change(published, lambda members: members | {name: b"evil"})
    for source in (f"{url}/{NAME}.zip", path):
        assert f"lies outside the folder {NAME}/" in fails(source, here, capsys)
    assert not list(here.parent.rglob("evil"))


def test_missing_member(url, published, here, capsys):
    change(published, lambda members: {k: v for k, v in members.items() if k != MEMBER})
    assert f"member {MEMBER} is missing" in fails(f"{url}/{NAME}.zip", here, capsys)


def test_missing_list_of_members(url, published, here, capsys):
    change(published, lambda members: {MEMBER: members[MEMBER]})
    assert f"member {NAME}/SHA256SUMS is missing" in fails(f"{url}/{NAME}.zip", here, capsys)


def test_no_zip_file_though_the_hash_is_right(published, here, capsys):
    path = published / f"{NAME}.zip"
    path.write_text("not a zip file")
    list_hash(published, path)
    assert "cut off or no zip file" in fails(path, here, capsys)


def test_member_that_is_damaged(published, here, capsys):
    path = published / f"{NAME}.zip"
    data = bytearray(path.read_bytes())
    data[data.index(b"\x89HDF") + 20000] ^= 1
    path.write_bytes(data)
    list_hash(published, path)
    assert "cannot be unpacked" in fails(path, here, capsys)


def test_nothing_there(url, published, here, capsys):
    line = fails(f"{url}/none/{NAME}.zip", here, capsys)
    assert line == f"error: {url}/none/SHA256SUMS: cannot be downloaded (404 File not found)"
    (published / "SHA256SUMS").write_text("")
    for source in (f"{url}/{NAME}.zip", published / f"{NAME}.zip"):
        line = fails(source, here, capsys)
        assert line == f"error: {source}: SHA256SUMS beside it does not list {NAME}.zip"
    (published / "SHA256SUMS").unlink()
    assert "SHA256SUMS: no such file" in fails(published / f"{NAME}.zip", here, capsys)
    assert "not an archive" in fails(f"{url}/", here, capsys)


def test_a_misspelt_path_is_what_the_message_is_about(published, here, capsys):
    path = published / "curvature-libary-1.2.3.zip"
    assert f"error: {path}: no such file; did you mean" in fails(path, here, capsys)
    line = fails(f"none/{NAME}.zip", here, capsys)
    assert line.startswith(f"error: none/{NAME}.zip: no such file; `snakemake dataset` makes")


def test_a_server_that_cannot_be_reached(here, capsys):
    """Host and reason, in a line that fits the terminal."""
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        nobody = f"http://127.0.0.1:{listener.getsockname()[1]}"
        line = fails(f"{nobody}/{NAME}.zip", here, capsys)
    reason = "cannot be downloaded (Connection refused)"
    assert line == f"error: {nobody}/SHA256SUMS: {reason}"
    line = fails(f"http://host.invalid/{NAME}.zip", here, capsys)
    assert line.startswith("error: http://host.invalid/SHA256SUMS: cannot be downloaded (")
    assert len(line) < 140
    line = fails(f"nonsense://host/{NAME}.zip?download=1", here, capsys)
    assert line.startswith("error: nonsense://host/SHA256SUMS: cannot be downloaded (")


def test_the_archive_of_this_version_is_fetched_by_default(here, capsys):
    """`snakemake dataset` leaves it in results, if it has been run."""
    assert main(["fetch"]) == 1
    archive = f"results/dataset/curvature-library-{curvlib.__version__}.zip"
    assert f"error: {archive}: no such file; `snakemake dataset`" in capsys.readouterr().err


@pytest.mark.parametrize(
    "listed",
    [
        "{upper}  {name}\n",
        "{lower} *{name}\n",
        "{lower}  ./{name}\n",
        "\N{BYTE ORDER MARK}{upper}  {name}\r\n",
        "# by hand\n\n{lower}  other.zip\n{lower}  {name}",
    ],
)
def test_however_a_hash_is_written(url, published, here, listed):
    """PowerShell and certutil write upper case."""
    digest = file_hash(published / f"{NAME}.zip")
    text = listed.format(upper=digest.upper(), lower=digest, name=f"{NAME}.zip")
    (published / "SHA256SUMS").write_bytes(text.encode("utf-8"))
    for folder, source in (("a", published / f"{NAME}.zip"), ("b", f"{url}/{NAME}.zip")):
        assert len(curvlib.load_library(fetch(source, folder))) == 1
