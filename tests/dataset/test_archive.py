"""The archive: the same bytes each time, and what it says of itself holds."""

import hashlib
import io
import json
import re
import zipfile
from pathlib import Path

import frictionless
import mlcroissant
import numpy as np
import pandas as pd
import pytest
import yaml

import curvlib
from curvlib.dataset.archive import parse_sums, write_archive
from curvlib.dataset.description import describe, fill
from curvlib.dataset.library import mesh_files, nurbs_file
from curvlib.dataset.write import write_library, write_nurbs

ROOT = Path(__file__).parents[2]
SURFACES = ["cone_apex", "sphere"]
MESHES = [("same", 8), ("same", 12)]
NAME = "curvature-library-0.0.0"


def make(folder, labels=None, **facts):
    """An archive of two surfaces at two resolutions."""
    for name in SURFACES:
        write_library(curvlib.surface(name), MESHES, folder / "library")
        write_nurbs(curvlib.surface(name), folder / "library")
    files = [file for s in SURFACES for mesh in MESHES for file in mesh_files(s, *mesh)]
    files += [nurbs_file(s) for s in SURFACES]
    members = {file: folder / "library" / file for file in files}
    described = describe(
        sorted((ROOT / "workflow/archive").iterdir()),
        members,
        curvlib.load_library(folder / "library"),
        {s: curvlib.surface(s).label for s in SURFACES} | (labels or {}),
        **({"name": NAME, "version": "0.0.0", "released": "2003-09-14"} | facts),
    )
    write_archive(folder / f"{NAME}.zip", members | described)
    return folder / f"{NAME}.zip"


@pytest.fixture(scope="module")
def archive(tmp_path_factory):
    return make(tmp_path_factory.mktemp("made"))


@pytest.fixture(scope="module")
def unpacked(archive, tmp_path_factory):
    folder = tmp_path_factory.mktemp("unpacked")
    zipfile.ZipFile(archive).extractall(folder)
    return folder / NAME


def test_twice_is_the_same(archive, tmp_path):
    assert make(tmp_path).read_bytes() == archive.read_bytes()


def test_nothing_of_the_machine_is_in_it(archive):
    """No date, no deflate: its bytes depend on the machine's zlib."""
    members = zipfile.ZipFile(archive).infolist()
    assert {m.date_time for m in members} == {(1980, 1, 1, 0, 0, 0)}
    assert {m.compress_type for m in members} == {zipfile.ZIP_STORED}
    names = [m.filename for m in members]
    assert names[:-1] == sorted(names[:-1])
    assert all(name.startswith(f"{NAME}/") for name in names)


def test_hashes_are_those_of_the_files(archive, unpacked):
    def digest(path):
        return hashlib.sha256(path.read_bytes()).hexdigest()

    beside = archive.with_name("SHA256SUMS").read_text(encoding="utf-8")
    assert beside == f"{digest(archive)}  {archive.name}\n"
    sums = parse_sums((unpacked / "SHA256SUMS").read_text(encoding="utf-8"))
    files = {p for p in unpacked.rglob("*") if p.is_file()} - {unpacked / "SHA256SUMS"}
    assert sums == {str(p.relative_to(unpacked)): digest(p) for p in files}


def test_meshes_come_from_the_archive_as_from_the_folder(archive, unpacked, monkeypatch):
    zipped, folder = curvlib.load_library(archive), curvlib.load_library(unpacked)
    assert list(zipped) == list(folder) == [(s, *mesh) for s in SURFACES for mesh in MESHES]
    for key in folder:
        for field in ("vertices", "faces", "K", "H", "d1", "normals", "smooth"):
            a, b = getattr(zipped[key], field), getattr(folder[key], field)
            np.testing.assert_array_equal(a, b)
    monkeypatch.setattr(zipfile.ZipFile, "open", lambda *a: pytest.fail("a member was read"))
    assert len(curvlib.load_library(archive)) == 4


def test_member_with_a_changed_byte(archive, tmp_path):
    """Among the coordinates, where HDF5 does not see it and the zip file does."""
    data = bytearray(archive.read_bytes())
    data[data.index(b"\x89HDF") + 20000] ^= 1
    (tmp_path / archive.name).write_bytes(data)
    lib = curvlib.load_library(tmp_path / archive.name)
    with pytest.raises(curvlib.InputError, match=r"\.zip: .*same\.008\.vtkhdf: cut off"):
        lib.mesh("cone_apex", 8)


def test_table_of_meshes(unpacked):
    table = pd.read_csv(unpacked / "meshes.csv").set_index(["surface", "n"])
    row = table.loc["cone_apex", 8]
    mesh = curvlib.tessellate(curvlib.surface("cone_apex"), 8)
    assert (row.vertices, row.triangles, row.undefined) == (len(mesh.vertices), len(mesh.faces), 1)
    assert (row.H_min, row.H_max) == (np.nanmin(mesh.H), np.nanmax(mesh.H))
    assert (unpacked / row.file).is_file()


def test_readme(unpacked):
    text = (unpacked / "README.md").read_text(encoding="utf-8")
    triangles = pd.read_csv(unpacked / "meshes.csv").triangles.sum()
    assert "2 surfaces" in text
    assert f"4 meshes, {triangles:,} triangles" in text
    assert f'load_library("{NAME}")' in text
    assert not re.search(r"\$\w", text)


def test_croissant_is_valid_and_loads_the_table(unpacked):
    found = mlcroissant.Dataset(unpacked / "croissant.json")
    assert found.metadata.ctx.issues.report() == ""
    assert found.metadata.data_biases
    assert found.metadata.data_collection.startswith("Computed")
    assert found.metadata.personal_sensitive_information == ["None."]
    records = pd.DataFrame(found.records("meshes"))
    table = pd.read_csv(unpacked / "meshes.csv")
    assert list(records.columns) == [f"meshes/{name}" for name in table.columns]
    np.testing.assert_array_equal(records["meshes/K_max"], table.K_max)
    metadata = json.loads((unpacked / "croissant.json").read_text(encoding="utf-8"))
    for files in metadata["distribution"]:
        assert list(unpacked.glob(files.get("includes", files.get("contentUrl")))), files["@id"]


def test_data_package_is_valid(unpacked):
    """Tables, sizes and hashes; a changed number is found."""
    report = frictionless.validate(str(unpacked / "datapackage.json"))
    assert report.valid, report.flatten()
    assert len(report.tasks) == 1 + len(SURFACES) * len(MESHES)
    path = unpacked / "sphere/sphere.same.008.txt"
    kept = path.read_bytes()
    path.write_bytes(kept.replace(b" 1\n", b" 2\n", 1))
    try:
        report = frictionless.validate(str(unpacked / "datapackage.json"))
    finally:
        path.write_bytes(kept)
    assert [error[0] for error in report.flatten(["type"])] == ["hash-count"]


def test_names_with_quotes_are_still_json(tmp_path):
    """And still Markdown and CSV: each format has its own way to quote."""
    odd = 'a "b" \\ c | é'
    archive = zipfile.ZipFile(make(tmp_path, {"sphere": odd}, version=odd))
    text = {
        name: archive.read(f"{NAME}/{name}").decode("utf-8")
        for name in ("croissant.json", "datapackage.json", "README.md", "meshes.csv")
    }
    for name in ("croissant.json", "datapackage.json"):
        assert json.loads(text[name])["version"] == odd
    table = pd.read_csv(io.StringIO(text["meshes.csv"]))
    assert set(table.label[table.surface == "sphere"]) == {odd}
    (row,) = re.findall(r"^\| sphere .*$", text["README.md"], re.M)
    (header,) = re.findall(r"^\| surface .*$", text["README.md"], re.M)
    assert len(re.split(r"(?<!\\)\|", row)) == len(header.split("|"))


def test_facts_in_json():
    """A fact alone keeps its type; a list among a list's items becomes items."""
    template = {"a": "$n", "b": ["$n", "$many", ["$n"]], "c": "$n or ${n}", "d": 5, "e": "$$n"}
    facts = {"n": 7, "many": [{"x": '"'}, 8]}
    assert fill(template, facts) == {
        "a": 7,
        "b": [7, {"x": '"'}, 8, [7]],
        "c": "7 or 7",
        "d": 5,
        "e": "$n",
    }
    with pytest.raises(KeyError):
        fill({"a": ["$unknown"]}, facts)


def test_point_data_are_described(unpacked):
    """Each array in the files has a row in the README and a word in the croissant."""
    import h5py

    with h5py.File(unpacked / mesh_files("sphere", "same", 8)[0]) as file:
        arrays = list(file["VTKHDF/PointData"])
    assert "pole" in arrays
    rows = [
        line
        for line in (unpacked / "README.md").read_text(encoding="utf-8").splitlines()
        if line.startswith("| `")
    ]
    described = {name for row in rows for name in re.findall(r"`(\w+)`", row.split("|")[1])}
    assert set(arrays) <= described
    metadata = json.loads((unpacked / "croissant.json").read_text(encoding="utf-8"))
    (files,) = [f for f in metadata["distribution"] if f["@id"] == "vtkhdf"]
    assert set(arrays) <= set(re.findall(r"\w+", files["description"]))
    ours = (ROOT / "data/README.md").read_text(encoding="utf-8")
    assert set(arrays) <= set(re.findall(r"`(\w+)`", ours))


def test_citation(unpacked):
    """Of the archive: its own version and date. Of the project: that of the package."""
    found = yaml.safe_load((unpacked / "CITATION.cff").read_text(encoding="utf-8"))
    assert (found["type"], found["version"]) == ("dataset", "0.0.0")
    assert str(found["date-released"]) == "2003-09-14"
    project = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert project["version"] == curvlib.__version__
    assert found["references"] == project["references"]


def test_nothing_half_written(tmp_path):
    with pytest.raises(FileNotFoundError):
        write_archive(tmp_path / "a.zip", {"a": "text", "b": tmp_path / "none"})
    assert list(tmp_path.iterdir()) == []


def test_sums_are_what_sha256sum_writes():
    """Hexadecimal digits have no case, and ./ is the folder of the list."""
    found = parse_sums("ab12  a b.zip\ncd34 *c.zip\nEF56  ./d/e.zip\r\n\nnonsense\n")
    assert found == {"a b.zip": "ab12", "c.zip": "cd34", "d/e.zip": "ef56"}
