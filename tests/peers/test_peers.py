"""What other libraries return is what their files declare; what becomes of it is curvature.

Runs over the files whose libraries are installed: pyvista and trimesh are in any case, `make peers`
installs the others but CGAL.
"""

import importlib.metadata
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

import curvlib
from curvlib.catalogue import peers as catalogue
from curvlib.meshes.torus import torus
from curvlib.peers import cgal_jet
from curvlib.signatures import readings

ROOT = Path(__file__).parents[2]
STORED = np.load(ROOT / "tests/estimators/peers.npz")
FILES = {name: catalogue.module(name) for name in curvlib.peers()}


def cgal_compiles():
    """Whether the compiler finds CGAL's header, and those that it includes."""
    command = [
        "g++",
        "-E",
        "-std=c++17",
        "-DCGAL_EIGEN3_ENABLED",
        "-I/usr/include/eigen3",
        "-xc++",
        "-",
    ]
    code = "#include <CGAL/Monge_via_jet_fitting.h>"
    return (
        shutil.which("g++")
        and not subprocess.run(command, input=code.encode(), capture_output=True).returncode
    )


def is_installed(name):
    if name == "cgal_jet":
        return cgal_compiles()
    try:
        return all(map(importlib.metadata.version, FILES[name].REQUIRES.split()))
    except importlib.metadata.PackageNotFoundError:
        return False


INSTALLED = [name for name in FILES if is_installed(name)]
each = pytest.mark.parametrize("name", INSTALLED)


def options(name):
    """Smaller neighbourhoods than libigl's five rings, which reach around a coarse sphere."""
    return {"rings": 2} if "rings" in readings(name) else {}


def returned(name, mesh):
    """K and H of a library as it returns them, and its larger and smaller principal curvature."""
    given = options(name)
    if name == "trimesh_measures":
        given["radius"] = 3 * mesh.mean_edge
    values = FILES[name].returned(mesh.vertices, mesh.faces, **given)
    if len(values) == 2:
        return *values, None, None
    larger, smaller, *_ = values
    return larger * smaller, (larger + smaller) / 2, larger, smaller


def estimated(name, mesh):
    return curvlib.estimate(mesh, name, **options(name))


@pytest.fixture(scope="module")
def sphere():
    """Radius 1, jittered: no triangle is like another."""
    rng = np.random.default_rng(4)
    points = rng.normal(size=(600, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    for _ in range(30):  # apart from each other
        d = points[:, None] - points[None]
        square = (d * d).sum(-1) + 1e-9
        points += 3e-4 * (d / square[..., None] ** 1.5).sum(1)
        points /= np.linalg.norm(points, axis=1)[:, None]
    faces = ConvexHull(points).simplices
    a, b, c = points[faces].swapaxes(0, 1)
    inward = (np.cross(b - a, c - a) * a).sum(1) < 0
    faces[inward] = faces[inward, ::-1]
    return curvlib.Mesh(points, faces)


@pytest.fixture(scope="module")
def patch():
    """An open mesh with exact values."""
    return curvlib.Mesh(STORED["patch_vertices"], STORED["patch_faces"])


def scaled(mesh, factor):
    return curvlib.Mesh(factor * mesh.vertices, mesh.faces)


def same(found, expected, tolerance=1e-8):
    np.testing.assert_array_equal(np.isnan(found), np.isnan(expected))
    assert apart(found, expected) < tolerance


def apart(found, expected):
    return np.nanmax(np.abs(found - expected)) / np.nanmax(np.abs(expected))


def declares(name, quirk):
    return quirk in (getattr(FILES[name], "DEPENDS", None), getattr(FILES[name], "PRECISION", None))


def tolerance(name):
    return 1e-4 if declares(name, "single") else 1e-8


def test_names_are_those_of_no_estimator():
    assert not set(curvlib.peers()) & set(curvlib.estimators())


def packages(lock):
    return set(re.findall(r"^([\w.-]+)==", lock.read_text(encoding="utf-8"), re.M))


def test_what_a_file_requires_is_in_the_group_of_peers():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    group = {x.partition(">")[0] for x in project["optional-dependencies"]["peers"]}
    needed = {
        x for file in FILES.values() if not hasattr(file, "INSTALL") for x in file.REQUIRES.split()
    }
    assert needed == group
    locked = [packages(ROOT / f"requirements{x}.lock") for x in ("", "-peers")]
    assert group <= locked[1]
    assert locked[0] < locked[1]


@pytest.mark.parametrize("name", FILES)
def test_a_file_declares_what_its_library_does(name):
    file = FILES[name]
    assert file.SOURCE.startswith("https://")
    assert file.RETURNS in ("pointwise", "integrated", "relative")
    assert file.SIGN in ("ours", "opposite", None)
    assert file.BOUNDARY in ("zero", "as closed", "estimated")
    assert file.ORDER in ("as named", "swapped", None)
    assert len({other.LABEL for other in FILES.values()}) == len(FILES)


@each
def test_scale_of_what_it_returns(name, sphere):
    """On a sphere twice as large: K of a quarter and H of half the size; integrated, the same K and
    twice the H; relative, the same."""
    one, two = returned(name, sphere), returned(name, scaled(sphere, 2))
    powers = {"pointwise": (2, 1), "integrated": (0, -1), "relative": (0, 0)}[FILES[name].RETURNS]
    for a, b, power in zip(one, two, powers):
        if a is not None:
            same(b * 2.0**power, a, 0.01 if declares(name, "unit") else tolerance(name))


@each
def test_sign_of_what_it_returns(name, sphere):
    K, H, *_ = returned(name, sphere)
    assert np.median(K) > 0
    assert (H is None) == (FILES[name].SIGN is None)
    if H is not None:
        assert np.sign(np.median(H)) == (1 if FILES[name].SIGN == "ours" else -1)


@each
def test_order_of_what_it_returns(name, patch):
    _, _, larger, smaller = returned(name, patch)
    assert (larger is None) == (FILES[name].ORDER is None)
    if larger is not None:
        there = np.isfinite(larger)
        wrong = (
            (larger < smaller)[there]
            if FILES[name].ORDER == "as named"
            else (larger > smaller)[there]
        )
        assert not wrong.any()


@each
def test_boundary(name, patch):
    """Zero; or the formula of a closed ring, which finds many times the curvature of the patch at
    most boundary vertices; either is undefined. Else values are finite where there are vertices
    enough, and are left."""
    K = returned(name, patch)[0]
    r, declared = estimated(name, patch), FILES[name].BOUNDARY
    if declared == "zero":
        assert (K[patch.boundary] == 0).all()
    if declared == "as closed":
        assert np.median(np.abs(K[patch.boundary])) > 5 * np.abs(K[~np.isnan(r.K)]).max()
    if declared == "estimated":
        assert np.isfinite(r.K).mean() > 0.99
    else:
        assert np.isnan(r.K[patch.boundary]).all()
    if name == "trimesh_measures":
        assert 0.2 < np.isfinite(r.K).mean() < 0.8
    else:
        assert np.isfinite(r.K[~patch.boundary]).all()


@each
def test_unit_sphere_and_its_inside(name, sphere):
    """K = H = 1 in the median: to 2 %, to 12 % where a polynomial or a mean reaches over two rings
    of half an edge in six."""
    r = estimated(name, sphere)
    inside = estimated(name, curvlib.Mesh(sphere.vertices, sphere.faces[:, ::-1]))
    assert np.median(r.K) == pytest.approx(1, abs=0.13)
    same(inside.K, r.K, tolerance(name))
    if FILES[name].SIGN is not None:
        assert np.median(r.H) == pytest.approx(1, abs=0.07)
        same(inside.H, -r.H, tolerance(name))


@each
def test_scale(name, sphere):
    """Rounding shows whether values have the digits of float32 alone."""
    one, three = estimated(name, sphere), estimated(name, scaled(sphere, 3))
    difference = apart(9 * three.K, one.K)
    assert (difference > 1e-4) == declares(name, "unit")
    assert (1e-9 < difference < 1e-4) == declares(name, "single")
    if FILES[name].SIGN is not None and not declares(name, "unit"):
        same(3 * three.H, one.H, tolerance(name))


@each
def test_rigid_motion(name):
    vertices, faces = torus(20, "irregular")
    moved = vertices @ Rotation.from_rotvec([0.4, 1, -0.7]).as_matrix().T + (3, -1, 2)
    r, there = estimated(name, (vertices, faces)), estimated(name, (moved, faces))
    same(there.K, r.K, 10 * tolerance(name))
    if FILES[name].SIGN is not None:
        same(there.H, r.H, 10 * tolerance(name))


@each
def test_other_labels(name):
    vertices, faces = torus(20, "irregular")
    order = np.random.default_rng(0).permutation(len(vertices))
    r = estimated(name, (vertices, faces))
    there = estimated(name, (vertices[order], np.argsort(order)[faces]))
    assert (apart(there.K, r.K[order]) > 1e-3) == declares(name, "labels")
    if FILES[name].SIGN is not None:
        # The trace of a form depends on no frame.
        same(there.H, r.H[order], 10 * tolerance(name))


@each
def test_principal_curvatures_and_directions(name):
    """Of one tensor; on the torus d2 runs along the large circles."""
    vertices, faces = torus(40, "regular")
    r = estimated(name, (vertices, faces))
    if FILES[name].ORDER is not None:
        assert (r.k1 >= r.k2).all()
        np.testing.assert_allclose(r.K, r.k1 * r.k2, atol=1e-12)
        np.testing.assert_allclose(r.H, (r.k1 + r.k2) / 2, atol=1e-12)
    assert (r.d1 is None) == (FILES[name].ORDER != "as named")
    if r.d1 is None:
        return
    np.testing.assert_allclose((r.d1 * r.d1).sum(1), 1)
    np.testing.assert_allclose((r.d1 * r.d2).sum(1), 0, atol=1e-9)
    around = np.stack((-vertices[:, 1], vertices[:, 0], 0 * vertices[:, 0]), 1)
    around /= np.linalg.norm(around, axis=1)[:, None]
    centre = 2 * np.cross(around, (0, 0, 1))
    assert ((np.cross(r.d1, r.d2) * (vertices - centre)).sum(1) > 0.8).all()
    assert np.abs((r.d2 * around).sum(1)).min() > 0.95


@each
def test_a_vertex_without_triangles_is_undefined_and_changes_nothing(name, sphere):
    extra = np.insert(sphere.vertices, 100, (9, 9, 9), axis=0)
    r = estimated(name, (extra, sphere.faces + (sphere.faces >= 100)))
    assert np.isnan(r.K[100])
    assert r.undefined == {"no triangle": 1}
    same(np.delete(r.K, 100), estimated(name, sphere).K)


DEFECTS = {"libigl_defects", "trimesh_defects", "gpytoolbox_defects", "vtk_curvatures"}


@pytest.mark.parametrize("name", [name for name in INSTALLED if name in DEFECTS])
def test_defects_over_barycentric_cells_are_ours(name, patch):
    for mesh in (curvlib.Mesh(*torus(20, "irregular")), patch):
        expected = curvlib.estimate(mesh, "gauss_bonnet", area="third").K
        same(estimated(name, mesh).K, expected, 1e-11)


def test_mean_curvature_of_vtk():
    """Half the mean over the edges of 3 |e| beta / (area of the two triangles)."""
    vertices, faces = torus(12, "irregular")
    normal, area, sides = {}, {}, {}
    for f, (a, b, c) in enumerate(faces):
        cross = np.cross(vertices[b] - vertices[a], vertices[c] - vertices[a])
        area[f], normal[f] = np.linalg.norm(cross) / 2, cross / np.linalg.norm(cross)
        for start, end in ((a, b), (b, c), (c, a)):
            sides[start, end] = f
    found = [[] for _ in vertices]
    for (start, end), f in sides.items():
        g, e = sides[end, start], vertices[end] - vertices[start]
        length = np.linalg.norm(e)
        beta = np.arctan2(np.cross(normal[f], normal[g]) @ e / length, normal[f] @ normal[g])
        found[start].append(3 * length * beta / (area[f] + area[g]))
    expected = [np.mean(values) / 2 for values in found]
    same(curvlib.estimate((vertices, faces), "vtk_curvatures").H, expected, 1e-9)


@each
def test_too_few_vertices_are_undefined_and_never_0(name):
    """On a tetrahedron, where libigl returns 0."""
    tetrahedron = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]
    r = estimated(name, (tetrahedron, [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]))
    assert (np.isnan(r.K) | (r.K > 0.01)).all()
    assert np.isnan(r.K).all() == (name in ("libigl_principal", "cgal_jet"))


KEPT = {
    "cgal_jet": {
        "jet_degree2_rings2": {"degree": 2, "rings": 2},
        "jet_degree4_rings3": {"degree": 4, "rings": 3},
    },
    "libigl_principal": {"libigl": {"rings": 2}},
}


@each
@pytest.mark.parametrize("surface", ["torus", "patch"])
def test_values_that_are_kept_for_tests_of_estimators(name, surface):
    mesh = STORED[f"{surface}_vertices"], STORED[f"{surface}_faces"]
    for kept, given in KEPT.get(name, {}).items():
        r, expected = curvlib.estimate(mesh, name, **given), STORED[f"{surface}_{kept}"]
        same(r.k1, expected[:, 0], 1e-11)
        same(r.k2, expected[:, 1], 1e-11)


def test_code_that_does_not_compile_is_an_import_error(tmp_path, monkeypatch):
    """The message is the compiler's first error, or that there is no compiler."""
    monkeypatch.setattr(cgal_jet, "cache_folder", lambda: tmp_path)
    (tmp_path / "mine.cpp").write_text("#include <no/such/header.h>\n")
    if shutil.which("g++"):
        with pytest.raises(ImportError, match=r"fatal error: no/such/header.h"):
            cgal_jet._library(tmp_path / "mine.cpp")
        assert [p.name for p in tmp_path.iterdir()] == ["mine.cpp"]
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CXX", raising=False)
    with pytest.raises(ImportError, match=r"there is no g\+\+"):
        cgal_jet._library(tmp_path / "other.cpp")
    with pytest.raises(curvlib.InputError) as told:
        monkeypatch.setattr(cgal_jet, "CODE", tmp_path / "other.cpp")
        curvlib.estimate(torus(5, "regular"), "cgal_jet")
    assert str(told.value) == (
        "estimator 'cgal_jet' needs libcgal-dev libeigen3-dev g++: there is no g++; "
        "on Debian: apt install libcgal-dev libeigen3-dev g++"
    )


@pytest.mark.parametrize("name", [name for name in FILES if not hasattr(FILES[name], "INSTALL")])
def test_a_library_that_is_missing_is_named(name, monkeypatch):
    for module in ("gpytoolbox", "igl", "lapy", "mymesh", "pymeshlab", "pyvista", "trimesh"):
        monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(curvlib.InputError) as told:
        curvlib.estimate(torus(5, "regular"), name)
    message = str(told.value)
    assert message.startswith(f"estimator {name!r} needs {FILES[name].REQUIRES}: ")
    assert message.endswith("; `make peers` installs it")
    assert "\n" not in message
