"""The verbs for one's own mesh: files in, files out, exit codes."""

import json
import os
import pty
import subprocess
import sys

import nibabel
import numpy as np
import pandas
import pytest
import pyvista
import trimesh

import curvlib
from curvlib.commands.main import VERBS, main

PROGRAM = "import sys; from curvlib.commands.main import main; sys.exit(main())"


@pytest.fixture
def ball(tmp_path, monkeypatch):
    """A ball of radius 2 in three formats, in the working folder."""
    monkeypatch.chdir(tmp_path)
    mesh = pyvista.Icosphere(radius=2, nsub=2)
    mesh.point_data["half"] = (mesh.points[:, 2] > 0).astype(int)
    mesh.cell_data["quarter"] = (mesh.cell_centers().points[:, 0] > 0).astype(int)
    for name in ("ball.vtp", "ball.stl", "ball.ply"):
        mesh.save(name)
    return mesh


def run(*arguments, capsys):
    status = main([*map(str, arguments)])
    out, err = capsys.readouterr()
    return status, out, err


def test_estimate_of_a_soup_has_values_at_the_files_points(ball, capsys):
    status, out, err = run("estimate", "ball.stl", "-o", "out.vtp", capsys=capsys)
    assert status == 0
    assert "estimator quadric: a fit" in out
    assert "undefined: nowhere" in out
    assert "joined to it" in err
    assert err.count("\n") == 1
    data = pyvista.read("out.vtp")
    assert data.n_points == 3 * data.n_cells == 960
    assert abs(data["H"] - 0.5).max() < 0.06


def test_weld_and_orient_tell_how_many(ball, capsys):
    turned = ball.faces.reshape(-1, 4)[:, 1:].copy()
    turned[:7] = turned[:7, ::-1]
    # pyvista would turn them back.
    trimesh.Trimesh(ball.points, turned, process=False).export("odd.stl")
    status, out, err = run(
        "estimate", "odd.stl", "--weld", "--orient", "-e", "meyer", "-o", "out.vtp", capsys=capsys
    )
    assert (status, err) == (0, "")
    assert "7 triangles turned over" in out
    assert "798 vertices joined to others" in out
    data = pyvista.read("out.vtp")
    assert data.n_points == 162
    assert (data["H"] > 0.4).all()


def test_json_is_one_document(ball, capsys):
    status, out, _ = run(
        "estimate", "ball.ply", "-e", "meyer", "-e", "jet", "--json", capsys=capsys
    )
    document = json.loads(out)
    assert status == 0
    assert set(document["estimators"]) == {"meyer", "jet"}
    assert abs(document["estimators"]["jet"]["quantiles"]["H"]["0.5"] - 0.5) < 0.06
    for arguments in (["info", "ball.stl"], ["list"], ["list", "jet"]):
        json.loads(run(*arguments, "--json", capsys=capsys)[1])


def test_options_reach_the_estimator(ball, capsys):
    for arguments, options in (
        (["--rings", 3], {"rings": 3}),
        (["--radius", "2.5 edges", "--set", "degree=3"], {"radius": "2.5 edges", "degree": 3}),
        (["--radius", "1.25"], {"radius": 1.25}),
    ):
        status, *_ = run(
            "estimate", "ball.ply", "-e", "jet", "-o", "a.csv", *arguments, capsys=capsys
        )
        assert status == 0
        expected = curvlib.estimate("ball.ply", "jet", **options)
        np.testing.assert_array_equal(pandas.read_csv("a.csv").H, expected.H)


def test_several_estimators_in_one_file(ball, capsys):
    run("estimate", "ball.ply", "-e", "meyer", "-e", "taubin", "-o", "a.csv", capsys=capsys)
    table = pandas.read_csv("a.csv")
    np.testing.assert_array_equal(table.H_taubin, curvlib.estimate("ball.ply", "taubin").H)
    assert "K_meyer" in table


def test_several_meshes(ball, capsys):
    status, _, err = run("estimate", "ball.ply", "ball.stl", "-o", "a.csv", capsys=capsys)
    assert status == 1
    assert "more than one mesh" in err
    ball.save("other.ply")
    out = "out/{stem}.vtp"
    status, *_ = run("estimate", "ball.ply", "other.ply", "-o", out, capsys=capsys)
    assert status == 0
    assert {path for path in os.listdir("out")} == {"ball.vtp", "other.vtp"}


def test_pycurv_columns_are_per_face(ball, capsys):
    status, *_ = run("estimate", "ball.ply", "--columns", "pycurv", "-o", "a.vtp", capsys=capsys)
    assert status == 0
    assert "kappa_1" in pyvista.read("a.vtp").cell_data


def test_statistics_by_region(ball, capsys):
    """By point data, cell data, a GIFTI label file and an annotation, of vertices."""
    labels = ball.point_data["half"].astype(np.int32)
    table = nibabel.gifti.GiftiLabelTable()
    for key, name in enumerate(("low", "high")):
        label = nibabel.gifti.GiftiLabel(key)
        label.label = name
        table.labels.append(label)
    array = nibabel.gifti.GiftiDataArray(labels, intent="NIFTI_INTENT_LABEL")
    nibabel.save(nibabel.gifti.GiftiImage(darrays=[array], labeltable=table), "a.label.gii")
    colours = np.array([[1, 2, 3, 0], [4, 5, 6, 0]])
    nibabel.freesurfer.write_annot("lh.a.annot", labels, colours, ["low", "high"])
    tables = []
    for by in ("half", "a.label.gii", "lh.a.annot", "quarter"):
        arguments = "estimate", "ball.vtp", "--by", by, "-o", "a.csv"
        assert run(*arguments, capsys=capsys)[0] == 0
        tables.append(pandas.read_csv("a.csv"))
    assert list(tables[1].name.unique()) == list(tables[2].name.unique()) == ["low", "high"]
    for other in tables[1:3]:
        assert other.drop(columns="name").equals(tables[0])
    for found in tables:
        H = found[found.quantity == "H"]
        assert list(H.region) == [0, 1]
        assert abs(H["mean"] - 0.5).max() < 0.06
        assert abs(H.area.sum() - ball.area) < 1e-6 * ball.area
    status, _, err = run("estimate", "ball.vtp", "--by", "hal", capsys=capsys)
    assert (status, err.count("\n")) == (1, 1)
    assert "did you mean 'half'" in err


def test_a_picture(ball, capsys):
    arguments = "estimate", "ball.ply", "-e", "meyer", "--picture", "a.png"
    assert run(*arguments, capsys=capsys)[0] == 0
    image = pyvista.read("a.png")
    assert image.dimensions[0] > 500
    assert len(np.unique(image.active_scalars, axis=0)) > 10


def test_info_says_what_to_do(ball, capsys):
    inside = ball.faces.reshape(-1, 4)[:, :0:-1]
    pyvista.PolyData.from_regular_faces(ball.points, inside).save("inside.ply")
    status, out, _ = run("info", "inside.ply", capsys=capsys)
    assert status == 0
    assert "162 vertices, 320 triangles" in out
    assert "closed, genus 0" in out
    assert "1 closed components that face inward" in out
    assert "curvlib estimate inside.ply --orient -o values.vtp" in out
    assert "nothing found" in run("info", "ball.ply", capsys=capsys)[1]


def test_a_mesh_with_exact_values(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert run("mesh", "cone", "-n", 8, "-o", "cone.vtp", capsys=capsys)[0] == 0
    expected = curvlib.tessellate(curvlib.surface("cone"), 8)
    np.testing.assert_array_equal(pyvista.read("cone.vtp")["H"], expected.H)


MINE = "def estimate(ring):\n    return 0 * ring.lengths.sum(0), None\n"


def test_a_file_of_ones_own(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.py").write_text(MINE, encoding="utf-8")
    status, out, _ = run("check", "mine.py", capsys=capsys)
    assert status == 1
    assert "fail           unit sphere: mine.py:1: K of the unit sphere is off by 1" in out
    assert "2 of 12 checks failed" in out
    status, out, _ = run("check", "meyer", "--json", capsys=capsys)
    assert (status, json.loads(out)["failed"]) == (0, 0)
    arguments = ["compare", "mine.py", "--against", "meyer", "-n", 8, "-n", 12, "--seeds", 1]
    status, out, _ = run(*arguments, "-o", "all.csv", "--json", capsys=capsys)
    assert status == 0
    rows = json.loads(out)["rows"]
    assert {(row["best"], row["rank"], row["of"]) for row in rows} >= {("meyer", 2, 2)}
    assert set(pandas.read_csv("all.csv").estimator) == {"mine", "meyer"}


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["estimate", "bal.ply"], "did you mean 'ball.ply'"),
        (["info", "bal.ply"], "did you mean 'ball.ply'"),
        (["estimate", "ball.ply", "-e", "mayer"], "did you mean 'meyer'"),
        (["estimate", "ball.ply", "-e", "meyer", "jet"], "write -e jet"),
        (["estimate", "ball.ply", "-e", "jet", "--set", "degre=3"], "did you mean 'degree'"),
        (["estimate", "ball.ply", "-e", "jet", "--rings", "9"], "unknown rings of jet '9'"),
        (["estimate", "ball.ply", "--radius", "wide"], "'wide' is no length"),
        (["estimate", "ball.ply", "-o", "out.docx"], "cannot tell the format"),
        (["estimate", "ball.ply", "-o", "ball.ply/out.vtp"], "ball.ply"),
        (["estimate", "ball.ply", "-o", "."], "is a folder"),
        (["estimate", "ball.ply", "-o", "/proc/out.vtp"], "/proc/out.vtp"),
        (
            ["estimate", "ball.ply", "-e", "meyer", "--rings", "2"],
            "option of meyer 'rings'; valid: none",
        ),
        (["estimate", "ball.ply", "--picture", "a.jpg"], "a picture is a .png file"),
        (["estimate", "ball.ply", "-e", "meyer", "--per", "face"], "at vertices alone"),
        (["estimate", "broken.ply"], "cannot read it"),
        (["estimate", "words.txt"], "cannot tell its format"),
        (["estimate", "ball.ply", "-e", "fails.py"], "fails.py, line 2: KeyError"),
        (["estimate", "ball.ply", "-e", "numba.py"], "numba.py: NameError: name 'nothing'"),
        (["list", "mayer"], "did you mean 'meyer'"),
        (["mesh", "coen", "-n", "8", "-o", "a.vtp"], "did you mean 'cone'"),
        (["check", "none.py"], "does not exist"),
        (["compare", "mayer"], "did you mean 'meyer'"),
    ],
)
def test_an_error_is_one_line_and_leaves_nothing(ball, arguments, words, capsys, tmp_path):
    for name, text in (
        ("broken.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"),
        ("words.txt", "words"),
        ("fails.py", "def estimate(ring):\n    return {}['K'], None\n"),
        (
            "numba.py",
            "from curvlib.kit.compiled import compiled\n\n\n@compiled\ndef estimate(ring):\n"
            "    return nothing(ring), None\n",
        ),
    ):
        (tmp_path / name).write_text(text, encoding="utf-8")
    before = set(os.listdir())
    status, _, err = run(*arguments, capsys=capsys)
    assert status == 1
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert words in err
    assert set(os.listdir()) == before


@pytest.mark.parametrize(
    "arguments",
    [
        ["estimate"],
        ["estimate", "a.ply", "--per", "edge"],
        ["estimate", "a.ply", "--rings", "many"],
        ["mesh", "cone", "-o", "a.vtp"],
        ["info", "a.ply", "b.ply"],
    ],
)
def test_wrong_usage(arguments, capsys):
    status, _, err = run(*arguments, capsys=capsys)
    assert status == 2
    assert "Usage: curvlib" in err


@pytest.mark.parametrize("verb", VERBS)
def test_help_brings_nothing_heavy(verb):
    code = (
        "import sys; from curvlib.commands.main import main; main([sys.argv[1], '-h'])\n"
        "heavy = 'numpy numba scipy pandas matplotlib pyvista trimesh h5py'.split()\n"
        "print([m for m in heavy if m in sys.modules])"
    )
    command = [sys.executable, "-c", code, verb]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.startswith(f"Usage: curvlib {verb}")
    assert done.stdout.endswith("\n[]\n")


def test_a_pipe_that_closes_is_no_error_message(ball):
    code = f"{sys.executable} -c '{PROGRAM}' list jet"
    done = subprocess.run(
        ["bash", "-c", f"{code} | head -n 1"], capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith("jet is given: disk")
    assert done.stderr == ""


def test_progress_is_silent_where_stderr_is_no_terminal(ball):
    command = [sys.executable, "-c", PROGRAM, "estimate", "ball.ply", "ball.vtp", "-e", "meyer"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    assert done.stdout.count("quantiles over the area") == 2


def test_compiling_is_told_once_on_a_terminal(ball, tmp_path):
    """By a pseudo-terminal; code that is kept is not compiled again."""
    leader, follower = pty.openpty()
    command = [sys.executable, "-c", PROGRAM, "estimate", "ball.ply", "-e", "meyer"]
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "kept")}
    told = []
    for _ in range(2):
        subprocess.run(command, env=environment, stderr=follower, check=True)
        os.write(follower, b"end\n")
        told.append(os.read(leader, 1000).replace(b"\r\n", b"\n"))
    assert told == [b"compiling, once per machine and version\nend\n", b"end\n"]
