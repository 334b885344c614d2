"""Files that survive: whole or not at all, and what is wrong with one is one line."""

import errno
import os
import random
import resource
import stat
import subprocess
import sys
import zipfile

import h5py
import numpy as np
import pytest

from curvlib.errors import InputError
from curvlib.files import no_such_file, open_archive, open_hdf5, whole_file, write_hdf5


def error_of(number, *names):
    return OSError(number, os.strerror(number), *names)


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_a_whole_file_has_the_mode_that_the_umask_says(tmp_path):
    before = os.umask(0o027)
    try:
        with whole_file(tmp_path / "made" / "a.csv") as part:
            part.write_text("whole", encoding="utf-8")
    finally:
        os.umask(before)
    path = tmp_path / "made" / "a.csv"
    assert path.read_text(encoding="utf-8") == "whole"
    assert stat.S_IMODE(path.stat().st_mode) == 0o640
    assert names(tmp_path / "made") == ["a.csv"]


def test_a_file_under_way_is_ignored_by_git_and_keeps_its_suffix(tmp_path):
    with whole_file(tmp_path / "a.svg") as part:
        part.write_text("")
        (under_way,) = tmp_path.iterdir()
        assert under_way.suffix == ".part"
        assert part.name == "a.svg"


def test_two_runs_in_one_folder_do_not_meet(tmp_path):
    path = tmp_path / "a.csv"
    with whole_file(path) as first:
        first.write_text("first", encoding="utf-8")
        with whole_file(path) as second:
            second.write_text("second", encoding="utf-8")
            assert first.read_text(encoding="utf-8") == "first"
        assert path.read_text(encoding="utf-8") == "second"
    assert path.read_text(encoding="utf-8") == "first"
    assert names(tmp_path) == ["a.csv"]


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt, SystemExit])
def test_an_interrupted_write_leaves_what_was_there(tmp_path, error):
    for name in ("kept", "new"):
        (tmp_path / "kept").write_text("before", encoding="utf-8")
        with pytest.raises(error), whole_file(tmp_path / name) as part:
            part.write_text("half", encoding="utf-8")
            raise error
        assert names(tmp_path) == ["kept"]
        assert (tmp_path / "kept").read_text(encoding="utf-8") == "before"


@pytest.mark.parametrize("kind", ["ENOSPC", "EDQUOT", "EROFS", "EACCES", "EFBIG"])
def test_a_file_that_the_system_refuses_is_one_line(tmp_path, monkeypatch, kind):
    number = getattr(errno, kind)
    line = f"{tmp_path / 'a.csv'}: {os.strerror(number)}"
    with pytest.raises(InputError) as raised, whole_file(tmp_path / "a.csv"):
        raise error_of(number)
    assert str(raised.value) == line
    with pytest.raises(InputError) as raised, whole_file(tmp_path / "a.csv") as part:
        raise error_of(number, str(part))
    assert str(raised.value) == line
    assert names(tmp_path) == []

    def refuse(path, *rest):
        raise error_of(number, path)

    monkeypatch.setattr("os.mkdir", refuse)
    with pytest.raises(InputError, match=os.strerror(number)), whole_file(tmp_path / "a.csv"):
        pytest.fail("there is nothing to write to")


def test_errors_of_other_files_are_not_blamed_on_the_one_written(tmp_path):
    other = str(tmp_path / "input.csv")
    with pytest.raises(InputError) as raised, whole_file(tmp_path / "a.csv"):
        raise error_of(errno.EACCES, other)
    assert str(raised.value) == f"{other}: {os.strerror(errno.EACCES)}"
    with pytest.raises(FileNotFoundError), whole_file(tmp_path / "a.csv"):
        raise error_of(errno.ENOENT, other)


def test_a_file_where_a_folder_has_to_be(tmp_path):
    (tmp_path / "a").write_text("")
    for path in (tmp_path / "a" / "b.csv", tmp_path / "a" / "b" / "c.csv"):
        with pytest.raises(InputError, match=str(tmp_path / "a")), whole_file(path):
            pytest.fail("there is nothing to write to")
    (tmp_path / "folder").mkdir()
    with pytest.raises(InputError, match="folder: "), whole_file(tmp_path / "folder") as part:
        part.write_text("")
    assert names(tmp_path) == ["a", "folder"]


def test_hdf5_that_outgrows_what_the_system_gives(tmp_path):
    """A limit on the size of files stands for a full disk: both fail inside a write."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, hard))
    try:
        with pytest.raises(InputError, match=r"values\.h5: File too large"):
            with whole_file(tmp_path / "values.h5") as part, write_hdf5(part) as file:
                file["values"] = np.ones(50_000)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert names(tmp_path) == []


def test_hdf5_has_the_bytes_that_hdf5_itself_writes(tmp_path):
    def fill(file):
        file.attrs.update(options="x" * 500)
        for i in range(40):
            file[f"group/{i}/values"] = np.random.default_rng(i).random((i, 300))

    with h5py.File(tmp_path / "direct.h5", "w") as file:
        fill(file)
    with write_hdf5(tmp_path / "memory.h5") as file:
        fill(file)
    assert (tmp_path / "memory.h5").read_bytes() == (tmp_path / "direct.h5").read_bytes()
    with pytest.raises(RuntimeError), write_hdf5(tmp_path / "none.h5"):
        raise RuntimeError
    assert names(tmp_path) == ["direct.h5", "memory.h5"]


@pytest.fixture
def values(tmp_path):
    """An HDF5 file, and an archive that holds it."""
    path = tmp_path / "values.h5"
    with write_hdf5(path) as file:
        file["values"] = np.arange(1000.0)
    with zipfile.ZipFile(tmp_path / "values.zip", "w") as archive:
        archive.write(path, "in/values.h5")
    return path


def read(path, member=None):
    with open_hdf5(path, member) as file:
        return file["values"][()]


def test_a_file_that_another_process_writes_is_read(values):
    """HDF5's lock says nothing about damage; no lock is asked for."""
    code = "import h5py, sys; f = h5py.File(sys.argv[1], 'r+'); print(flush=True); sys.stdin.read()"
    with subprocess.Popen(
        [sys.executable, "-c", code, values], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as other:
        other.stdout.readline()
        np.testing.assert_array_equal(read(values), np.arange(1000.0))
        other.stdin.close()


def test_what_to_do_about_a_damaged_file(values, tmp_path):
    archive = tmp_path / "values.zip"
    data = bytearray(archive.read_bytes())
    data[data.index(np.arange(1000.0).tobytes())] ^= 1
    archive.write_bytes(data)
    with pytest.raises(InputError, match=r"zip: in/values.h5: cut off or changed.*archive again"):
        read(archive, "in/values.h5")
    with pytest.raises(InputError, match=r"zip: in/none.h5: cut off or changed.*archive again"):
        read(archive, "in/none.h5")
    archive.write_bytes(data[:-30])
    with pytest.raises(InputError, match=r"values.zip: cut off or no zip file; get the archive"):
        read(archive, "in/values.h5")
    values.write_bytes(values.read_bytes()[:2000])
    with pytest.raises(InputError, match=r"values.h5: cut off or not HDF5; delete it and run"):
        read(values)
    with write_hdf5(values) as file:
        file["other"] = 1
    with pytest.raises(InputError, match=r"values.h5: not the expected data .*'values'.*delete"):
        read(values)


def test_no_byte_of_a_damaged_file_ends_in_another_error(values, tmp_path):
    """Bytes changed, cleared or cut off: the file is read, or the message names it."""
    rng = random.Random(0)
    for path, member in ((values, None), (tmp_path / "values.zip", "in/values.h5")):
        whole, refused = path.read_bytes(), 0
        for _ in range(150):
            data = bytearray(whole)
            at = rng.randrange(len(data))
            match rng.randrange(3):
                case 0:
                    for at in rng.sample(range(len(data)), rng.choice((1, 5, 50))):
                        data[at] = rng.randrange(256)
                case 1:
                    data[at : at + 512] = bytes(len(data[at : at + 512]))
                case 2:
                    del data[at:]
            path.write_bytes(data)
            try:
                read(path, member)
            except InputError as error:
                refused += str(error).startswith(f"{path}: ")
        assert refused > 50


def test_files_that_cannot_be_opened(tmp_path, monkeypatch):
    for opened in (open_hdf5, open_archive):
        with pytest.raises(InputError, match=r"none: no such file$"), opened(tmp_path / "none"):
            pytest.fail("there is nothing to read")
        with pytest.raises(InputError, match=f"{tmp_path}: Is a directory"), opened(tmp_path):
            pytest.fail("there is nothing to read")

    def refuse(*rest, **options):
        raise error_of(errno.EACCES)

    (tmp_path / "a").write_text("")
    monkeypatch.setattr("builtins.open", refuse)
    for opened in (open_hdf5, open_archive):
        with pytest.raises(InputError, match="a: Permission denied"), opened(tmp_path / "a"):
            pytest.fail("there is nothing to read")


def test_the_nearest_file_of_the_same_kind(tmp_path):
    for name in ("curvature-library-1.zip", "other.csv", "library"):
        (tmp_path / name).write_text("")
    found = no_such_file(tmp_path / "x.zip")
    assert found == (
        f"{tmp_path / 'x.zip'}: no such file; "
        f"did you mean {str(tmp_path / 'curvature-library-1.zip')!r}?"
    )
    assert no_such_file(tmp_path / "libary").endswith("/library'?")
    assert no_such_file(tmp_path / "x.csv").endswith("no such file")
    assert no_such_file(tmp_path / "none" / "x.zip").endswith("no such file")
