"""The verbs for one's own mesh: files in, files out, exit codes."""

import json
import os

import nibabel
import numpy as np
import pandas
import pyvista
import trimesh
from sharp import block

import curvlib
from curvlib.meshes.torus import torus


def test_estimate_of_a_soup_has_values_at_the_files_points(ball, run):
    status, out, err = run("estimate", "ball.stl", "-o", "out.vtp")
    assert status == 0
    assert "estimator adaptive_fit: each region" in out
    assert "% by compact_hermite(degree=6)" in out
    assert "undefined: nowhere" in out
    assert "joined to it" in err
    assert err.count("\n") == 1
    data = pyvista.read("out.vtp")
    assert data.n_points == 3 * data.n_cells == 960
    assert abs(data["H"] - 0.5).max() < 0.06


def test_weld_and_orient_tell_how_many(ball, run):
    turned = ball.faces.reshape(-1, 4)[:, 1:].copy()
    turned[:7] = turned[:7, ::-1]
    # pyvista would turn them back.
    trimesh.Trimesh(ball.points, turned, process=False).export("odd.stl")
    status, out, err = run(
        "estimate", "odd.stl", "--weld", "--orient", "-e", "meyer", "-o", "out.vtp"
    )
    assert (status, err) == (0, "")
    assert "7 triangles turned over" in out
    assert "798 vertices joined to others" in out
    data = pyvista.read("out.vtp")
    assert data.n_points == 162
    assert (data["H"] > 0.4).all()


def test_json_is_one_document(ball, run):
    status, out, _ = run("estimate", "ball.ply", "-e", "meyer", "-e", "jet", "--json")
    document = json.loads(out)
    assert status == 0
    assert set(document["estimators"]) == {"meyer", "jet"}
    assert abs(document["estimators"]["jet"]["quantiles"]["H"]["0.5"] - 0.5) < 0.06
    for arguments in (["info", "ball.stl"], ["list"], ["list", "jet"]):
        json.loads(run(*arguments, "--json")[1])


def test_options_reach_the_estimator(ball, run):
    for arguments, options in (
        (["--rings", 3], {"rings": 3}),
        (["--radius", "2.5 edges", "--set", "degree=3"], {"radius": "2.5 edges", "degree": 3}),
        (["--radius", "1.25"], {"radius": 1.25}),
    ):
        status, *_ = run("estimate", "ball.ply", "-e", "jet", "-o", "a.csv", *arguments)
        assert status == 0
        expected = curvlib.estimate("ball.ply", "jet", **options)
        np.testing.assert_array_equal(pandas.read_csv("a.csv").H, expected.H)


def test_several_estimators_in_one_file(ball, run):
    run("estimate", "ball.ply", "-e", "meyer", "-e", "taubin", "-o", "a.csv")
    table = pandas.read_csv("a.csv")
    np.testing.assert_array_equal(table.H_taubin, curvlib.estimate("ball.ply", "taubin").H)
    assert "K_meyer" in table


def test_several_meshes(ball, run):
    status, _, err = run("estimate", "ball.ply", "ball.stl", "-o", "a.csv")
    assert status == 1
    assert "more than one mesh" in err
    ball.save("other.ply")
    out = "out/{stem}.vtp"
    status, *_ = run("estimate", "ball.ply", "other.ply", "-o", out)
    assert status == 0
    assert {path for path in os.listdir("out")} == {"ball.vtp", "other.vtp"}


def test_pycurv_columns_are_per_face(ball, run):
    status, *_ = run("estimate", "ball.ply", "--columns", "pycurv", "-o", "a.vtp")
    assert status == 0
    assert "kappa_1" in pyvista.read("a.vtp").cell_data


def test_statistics_by_region(ball, run):
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
        assert run(*arguments)[0] == 0
        tables.append(pandas.read_csv("a.csv"))
    assert list(tables[1].name.unique()) == list(tables[2].name.unique()) == ["low", "high"]
    for other in tables[1:3]:
        assert other.drop(columns="name").equals(tables[0])
    for found in tables:
        H = found[found.quantity == "H"]
        assert list(H.region) == [0, 1]
        assert abs(H["mean"] - 0.5).max() < 0.06
        assert abs(H.area.sum() - ball.area) < 1e-6 * ball.area
    out = run("estimate", "ball.vtp", "--by", "a.label.gii", "--quantity", "H")[1]
    assert out.count("0 low") == out.count("1 high") == 1
    status, _, err = run("estimate", "ball.vtp", "--by", "hal")
    assert (status, err.count("\n")) == (1, 1)
    assert "did you mean 'half'" in err


def test_a_picture(ball, run):
    arguments = "estimate", "ball.ply", "-e", "meyer", "--picture", "a.png"
    assert run(*arguments)[0] == 0
    image = pyvista.read("a.png")
    assert image.dimensions[0] > 500
    assert len(np.unique(image.active_scalars, axis=0)) > 10


# The low ends of the two scales.
BLUE, VIOLET = (49, 54, 149), (68, 1, 84)


def test_pictures_of_two_quantities_and_two_sides(ball, run):
    """Other colours where a quantity is never negative; another view where another axis is up."""
    ball.points[:, 2] *= 1.5
    ball.save("egg.ply")
    images = []
    for arguments in (("--up", "z"), ("--up", "x"), ("--quantity", "curvedness")):
        arguments = "estimate", "egg.ply", "-e", "meyer", "--picture", "a.png", *arguments
        assert run(*arguments)[0] == 0
        images.append(pyvista.read("a.png").active_scalars)
    assert (images[0] != images[1]).any()
    assert (images[0] != images[2]).any()
    for image, low, other in ((images[0], BLUE, VIOLET), (images[2], VIOLET, BLUE)):
        assert abs(image[:, :3].astype(int) - low).sum(1).min() < 6
        assert abs(image[:, :3].astype(int) - other).sum(1).min() > 20


def test_info_says_what_to_do(ball, run):
    inside = ball.faces.reshape(-1, 4)[:, :0:-1]
    pyvista.PolyData.from_regular_faces(ball.points, inside).save("inside.ply")
    status, out, _ = run("info", "inside.ply")
    assert status == 0
    assert "162 vertices, 320 triangles" in out
    assert "closed, genus 0" in out
    assert "closed components that face inward: 1 (0)" in out
    assert "curvlib estimate inside.ply --orient -o values.vtp" in out
    assert "nothing found" in run("info", "ball.ply")[1]


def test_a_mesh_with_exact_values(tmp_path, monkeypatch, run):
    monkeypatch.chdir(tmp_path)
    assert run("mesh", "cone", "-n", 8, "-o", "cone.vtp")[0] == 0
    expected = curvlib.tessellate(curvlib.surface("cone"), 8)
    np.testing.assert_array_equal(pyvista.read("cone.vtp")["H"], expected.H)


MINE = "def estimate(ring):\n    return 0 * ring.lengths.sum(0), None\n"


def test_a_file_of_ones_own(tmp_path, monkeypatch, run):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.py").write_text(MINE, encoding="utf-8")
    status, out, _ = run("check", "mine.py")
    assert status == 1
    assert "fail           unit sphere: mine.py:1: K of the unit sphere is off by 1" in out
    assert "2 of 12 checks failed" in out
    status, out, _ = run("check", "meyer", "--json")
    assert (status, json.loads(out)["failed"]) == (0, 0)


def test_compare(tmp_path, monkeypatch, run):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.py").write_text(MINE, encoding="utf-8")
    arguments = ["compare", "mine.py", "--against", "meyer", "-n", 8, "-n", 12, "--seeds", 1]
    status, out, _ = run(*arguments, "-o", "all.csv", "--json")
    assert status == 0
    told = json.loads(out)
    assert {(row["best"], row["rank"], row["of"]) for row in told["rows"]} >= {("meyer", 2, 2)}
    assert told["ratios"]["meyer"]["K"] == 1
    first = pandas.read_csv("all.csv")
    assert set(first.estimator) == {"mine", "meyer"}
    status, out, _ = run(*arguments, "--seed", told["seed"], "-o", "b.csv", "--picture", "b.png")
    assert f"--seed {told['seed']} makes the same" in out
    assert "1. meyer" in out
    assert "2. mine" in out
    pandas.testing.assert_frame_equal(pandas.read_csv("b.csv"), first)
    assert pyvista.read("b.png").dimensions[0] > 500
    run(*arguments, "-o", "c.csv")
    assert not pandas.read_csv("c.csv").value.equals(first.value)


def test_quantities_are_chosen(ball, run):
    arguments = "estimate", "ball.ply", "-e", "meyer", "-o", "a.csv", "--c0", 1
    chosen = "--quantity", "bending_energy", "--quantity", "category"
    status, out, _ = run(*arguments, *chosen)
    assert status == 0
    table = pandas.read_csv("a.csv")
    assert list(table) == ["x", "y", "z", "bending_energy", "category"]
    assert table.bending_energy.max() < 1e-3  # H is 1/2 everywhere
    assert (table.category == 8).all()
    assert "(2 H - 1)^2 / 2" in out
    assert "shape by area: cap 100%" in out
    told = json.loads(run("estimate", "ball.ply", "-e", "meyer", "--json")[1])["estimators"][
        "meyer"
    ]
    assert abs(told["bending_energy"] / (8 * np.pi) - 1) < 0.03
    assert abs(told["integral_of_K"] / (4 * np.pi) - 1) < 0.03
    assert told["categories"]["cap"] == 1
    status, _, err = run(*arguments, "--quantity", "shape-index")
    assert status == 1
    assert "did you mean 'shape_index'" in err
    status, _, err = run("estimate", "ball.ply", "--quantity", "category", "--picture", "a.png")
    assert status == 1
    assert "no quantity is a number" in err


def test_labels_that_do_not_fit(ball, run):
    colours = np.array([[1, 2, 3, 0]])
    nibabel.freesurfer.write_annot("lh.a.annot", np.zeros(7, int), colours, ["low"])
    nibabel.freesurfer.write_geometry("lh.white", ball.points, ball.regular_faces)
    for by, words in (
        ("lh.a.annot", "7 labels, but the mesh has 162 vertices and 320 triangles"),
        ("none.annot", "no such file"),
        ("region", "finds no point or cell data in 'lh.white'; name a label file"),
    ):
        status, _, err = run("estimate", "lh.white", "--by", by)
        assert (status, err.count("\n")) == (1, 1)
        assert words in err


def test_info_tells_noise_and_staircase(ball, run):
    vertices, faces = torus(40, "irregular")
    moves = np.random.default_rng(0).normal(size=vertices.shape)
    pyvista.PolyData.from_regular_faces(vertices + 0.01 * moves, faces).save("noisy.vtp")
    told = json.loads(run("info", "noisy.vtp", "--json")[1])
    assert 0.02 < told["noise"] < 0.2
    assert not told["staircase"]
    assert told["advice"] == "curvlib estimate noisy.vtp -o values.vtp"
    assert "on noise, fits or balls that average it" in run("info", "noisy.vtp")[1]
    grid = pyvista.ImageData(dimensions=(21, 21, 21), origin=(-10, -10, -10))
    inside = (np.linalg.norm(grid.points, axis=1) <= 8).astype(float)
    grid.contour([1.0], inside, method="marching_cubes").save("voxels.vtp")
    _, out, _ = run("info", "voxels.vtp")
    assert "a staircase: the edges are steps of a lattice" in out
    assert "normals averaged over balls that do not see its steps" in out
    assert "curvlib estimate ball.ply -o values.vtp" in run("info", "ball.ply")[1]


def test_creases_are_told_and_written(tmp_path, monkeypatch, run):
    monkeypatch.chdir(tmp_path)
    mesh = block(10)
    pyvista.PolyData.from_regular_faces(mesh.vertices, mesh.faces).save("block.ply")
    status, out, _ = run("estimate", "block.ply", "-o", "out.vtp")
    assert status == 0
    assert "on creases: 116 vertices" in out
    assert pyvista.read("out.vtp")["crease"].sum() == 116
    status, out, _ = run("estimate", "block.ply", "-e", "jet", "--creases", "nan", "--json")
    document = json.loads(out)["estimators"]["jet"]
    assert (status, document["crease"], document["undefined"]["crease"]) == (0, 116, 116)
    status, out, _ = run("estimate", "block.ply", "-e", "jet", "--json")
    assert (status, json.loads(out)["estimators"]["jet"]["crease"]) == (0, None)
