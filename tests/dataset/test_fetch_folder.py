"""Where `curvlib fetch` unpacks: folders made for it go with an error, others stay."""

import re
import sys
import zipfile
from pathlib import Path

import pytest

import curvlib
from curvlib.commands.main import main
from curvlib.dataset.fetch import fetch

NAME = "curvature-library-1.2.3"


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
        # The line that ^C stands in is ended first.
        assert (status, said) == (130, "\ninterrupted\n")
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
