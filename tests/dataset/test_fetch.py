"""`curvlib fetch`: from a server or a path; what is wrong is one line and leaves nothing."""

import functools
import threading
import zipfile
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import numpy as np
import pytest

import curvlib
from curvlib.commands.main import main
from curvlib.dataset.archive import file_hash, sums_text, write_archive
from curvlib.dataset.fetch import fetch
from curvlib.dataset.library import mesh_files
from curvlib.dataset.write import write_library

NAME = "curvature-library-1.2.3"
MEMBER = f"{NAME}/sphere/sphere.same.008.vtkhdf"


class Handler(SimpleHTTPRequestHandler):
    """A server without a log; what is called cut-* breaks off in the middle."""

    def log_message(self, *arguments):
        pass

    def copyfile(self, source, outputfile):
        data = source.read()
        outputfile.write(data[: len(data) // 2] if "cut-" in self.path else data)


@pytest.fixture
def published(tmp_path):
    """A folder with an archive and SHA256SUMS."""
    folder = tmp_path / "published"
    write_library(curvlib.surface("sphere"), [("same", 8)], tmp_path / "made")
    members = {file: tmp_path / "made" / file for file in mesh_files("sphere", "same", 8)}
    folder.mkdir()
    write_archive(folder / f"{NAME}.zip", members)
    return folder


@pytest.fixture
def url(published):
    handler = functools.partial(Handler, directory=published)
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


@pytest.fixture
def here(tmp_path, monkeypatch):
    """An empty current folder."""
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    return here


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
    (published / "SHA256SUMS").write_text(sums_text({path.name: file_hash(path)}))
    return path


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
    with (published / f"{NAME}.zip").open("ab") as file:
        file.write(b"more")
    for source in (f"{url}/{NAME}.zip", published / f"{NAME}.zip"):
        assert "cut off or changed, its SHA-256 is" in fails(source, here, capsys)


def test_cut_off_on_the_server(url, published, here, capsys):
    path = published / f"{NAME}.zip"
    path.write_bytes(path.read_bytes()[:9000])
    assert "cut off or changed" in fails(f"{url}/{NAME}.zip", here, capsys)


def test_cut_off_on_the_way(url, published, here, capsys):
    path = (published / f"{NAME}.zip").rename(published / "cut-1.zip")
    (published / "SHA256SUMS").write_text(sums_text({path.name: file_hash(path)}))
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
    (published / "SHA256SUMS").write_text(sums_text({path.name: file_hash(path)}))
    assert "cut off or no zip file" in fails(path, here, capsys)


def test_member_that_is_damaged(published, here, capsys):
    path = published / f"{NAME}.zip"
    data = bytearray(path.read_bytes())
    data[data.index(b"\x89HDF") + 20000] ^= 1
    path.write_bytes(data)
    (published / "SHA256SUMS").write_text(sums_text({path.name: file_hash(path)}))
    assert "cannot be unpacked" in fails(path, here, capsys)


def test_nothing_there(url, published, here, capsys):
    assert "404" in fails(f"{url}/none/{NAME}.zip", here, capsys)
    assert "SHA256SUMS: no such file" in fails(f"none/{NAME}.zip", here, capsys)
    (published / "SHA256SUMS").write_text("")
    assert f"does not list {NAME}.zip" in fails(f"{url}/{NAME}.zip", here, capsys)
    assert "not an archive" in fails(f"{url}/", here, capsys)
    assert "cannot be downloaded" in fails(f"http://127.0.0.1:9/{NAME}.zip", here, capsys)


def test_without_an_argument(here, capsys):
    """The archive that `snakemake dataset` leaves, if it has been run."""
    assert main(["fetch"]) == 1
    assert "results/dataset/SHA256SUMS: no such file" in capsys.readouterr().err


def test_a_folder_that_is_there_already(published, here):
    (here / NAME).mkdir()
    (here / NAME / "mine").write_text("kept")
    with pytest.raises(curvlib.InputError, match="exists already"):
        fetch(f"../published/{NAME}.zip")
    assert [p.name for p in here.rglob("*")] == [NAME, "mine"]
    with pytest.raises(curvlib.InputError, match="none: no folder"):
        fetch(f"../published/{NAME}.zip", "none")
