"""`curvlib fetch`: from a server or a path; what is wrong is one line and leaves nothing."""

import functools
import re
import socket
import sys
import threading
import zipfile
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

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
        threading.Thread(target=server.serve_forever, args=(0.01,)).start()
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
    assert "cannot be downloaded" in fails(f"nonsense://host/{NAME}.zip", here, capsys)


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


def test_a_folder_that_is_there_already(url, published, here):
    (here / NAME).mkdir()
    (here / NAME / "mine").write_text("kept")
    for source in (f"../published/{NAME}.zip", f"{url}/{NAME}.zip"):
        with pytest.raises(curvlib.InputError, match=f"{NAME}: exists already; remove it"):
            fetch(source)
    with (published / f"{NAME}.zip").open("ab") as file:
        file.write(b"more")
    with pytest.raises(curvlib.InputError, match="cut off or changed"):
        fetch(f"../published/{NAME}.zip")
    assert sorted(p.name for p in here.rglob("*")) == [NAME, "mine"]


def test_a_new_folder_is_made_and_goes_with_an_error(url, published, here):
    for folder, source in (("x/y", f"../published/{NAME}.zip"), ("z", f"{url}/{NAME}.zip")):
        made = fetch(source, folder)
        assert made == Path(folder, NAME)
        assert [p.name for p in Path(folder).iterdir()] == [NAME]
        assert len(curvlib.load_library(made)) == 1
    with (published / f"{NAME}.zip").open("ab") as file:
        file.write(b"more")
    before = sorted(here.rglob("*"))
    for source in (f"../published/{NAME}.zip", f"{url}/{NAME}.zip", f"none/{NAME}.zip"):
        for folder in ("x/new", "new/one/two"):
            with pytest.raises(curvlib.InputError):
                fetch(source, folder)
            assert sorted(here.rglob("*")) == before


def test_a_folder_that_cannot_be_written_to(published, here, capsys):
    (here / "file").write_text("kept")
    for folder in ("file", "file/new"):
        assert main(["fetch", f"../published/{NAME}.zip", "-o", folder]) == 1
        (line,) = capsys.readouterr().err.splitlines()
        assert line.startswith(f"error: {folder}: cannot unpack here (")
    assert [p.name for p in here.rglob("*")] == ["file"]


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt])
@pytest.mark.parametrize("remote", [True, False])
def test_an_interruption_leaves_nothing(url, published, here, capsys, monkeypatch, error, remote):
    def extract(archive, folder):
        (here / "half").write_text("")
        (here / "half").rename(Path(folder, "half"))
        raise error

    monkeypatch.setattr(zipfile.ZipFile, "extractall", extract)
    source = f"{url}/{NAME}.zip" if remote else f"../published/{NAME}.zip"
    status = main(["fetch", source, "-o", "new"])
    said = capsys.readouterr().err
    if error is KeyboardInterrupt:
        assert (status, said) == (130, "interrupted\n")
    else:
        reason = "cannot be unpacked (No space left on device)"
        assert (status, said) == (1, f"error: {source}: {reason}\n")
    assert list(here.iterdir()) == []


def test_a_full_disk_while_downloading(url, here, capsys, monkeypatch):
    def move(*paths):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("shutil.move", move)
    assert main(["fetch", f"{url}/{NAME}.zip", "-o", "new"]) == 1
    assert "cannot be downloaded (No space left on device)" in capsys.readouterr().err
    assert list(here.iterdir()) == []


def test_progress_is_shown_on_a_terminal_only(url, here, capsys, monkeypatch):
    fetch(f"{url}/{NAME}.zip", "quiet")
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    fetch(f"{url}/{NAME}.zip", "shown")
    assert len(re.findall("100%", capsys.readouterr().err)) == 1
