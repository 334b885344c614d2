"""What may be given to `estimate`: meshes, files of estimators, options and threads."""

import time

import numpy as np
import pytest
import pyvista

import curvlib
from curvlib.claims.cell import NINE as PAPER
from curvlib.meshes.torus import torus
from curvlib.parallel import for_each
from curvlib.signatures import readings


def test_exact_normals_have_to_be_there(sphere):
    r = curvlib.estimate(sphere, "watanabe_b", normal="exact")
    np.testing.assert_allclose(r.K, 1, rtol=1e-12)
    with pytest.raises(curvlib.InputError, match="normal='exact' needs a mesh with normals"):
        curvlib.estimate((sphere.vertices, sphere.faces), "watanabe_b", normal="exact")


def test_a_file_from_elsewhere_joins(tmp_path, sphere):
    """By its path; one that takes the mesh, and one that estimates H alone."""
    (tmp_path / "from_mesh.py").write_text(
        "LABEL = 'x'\nSTYLE = {}\n\n\ndef estimate(mesh):\n    return mesh.vertices[:, 0], None\n"
    )
    r = curvlib.estimate(sphere, str(tmp_path / "from_mesh.py"))
    np.testing.assert_array_equal(r.K, sphere.vertices[:, 0])
    assert np.isnan(r.H).all()
    (tmp_path / "gauss_bonnet.py").write_text("")
    with pytest.raises(curvlib.InputError, match="has the name of one in the package"):
        curvlib.estimate(sphere, str(tmp_path / "gauss_bonnet.py"))
    with pytest.raises(curvlib.InputError, match=r"nowhere\.py' does not exist"):
        curvlib.estimate(sphere, "nowhere.py")


def test_plain_numpy_on_rings_from_elsewhere(tmp_path, sphere):
    """It gets the same rings as compiled ones, and a wrong shape is told."""
    (tmp_path / "plain.py").write_text(
        "import math\n\nfrom curvlib.kit.ring import alpha\n\nLABEL = 'x'\nSTYLE = {}\n\n\n"
        "def estimate(ring):\n"
        "    deficit = 2 * math.pi - alpha(ring).sum(0)\n"
        "    return deficit * 3 / ring.areas.sum(0), None\n"
    )
    r = curvlib.estimate(sphere, str(tmp_path / "plain.py"))
    np.testing.assert_allclose(r.K, curvlib.estimate(sphere, "gauss_bonnet").K, rtol=1e-12)
    assert np.isnan(r.H).all()


@pytest.mark.parametrize(
    ("parameters", "returned", "message"),
    [
        ("ring", "ring.areas, None", "returned an array of shape"),
        ("ring", "0.0, None", r"returned an array of shape \(\)"),
        ("ring", "ring.areas[0]", "has to return K and H, not ndarray"),
        ("ring", "ring.areas[0] * 1j, None", "returned an array .* of complex128 as K"),
        ("ring", "None, ['a'] * ring.areas.shape[1]", "returned an array .* of <U1 as H"),
        ("ring", "[1, [2]], None", "K: setting an array element with a sequence"),
        ("", "None", "its first parameter has to be ring, disk, ball, mesh or passes"),
        ("*, ring=0", "None", "its first parameter has to be ring, disk, ball, mesh or passes"),
        ("ring", "None", "has to return K and H, not NoneType"),
        ("ring, area", "ring.areas[0], None", "option 'area' has no default"),
        ("ring, **options", "ring.areas[0], None", "option 'options' has no default"),
    ],
)
def test_a_file_that_is_no_estimator(tmp_path, sphere, parameters, returned, message):
    path = tmp_path / "wrong.py"
    path.write_text(f"def estimate({parameters}):\n    return {returned}\n")
    with pytest.raises(curvlib.InputError, match=message):
        curvlib.estimate(sphere, str(path))


def test_files_of_the_same_relative_path(tmp_path, sphere, monkeypatch):
    """Each folder's own, with its own options."""
    for number, option in ((1, "red"), (2, "blue")):
        folder = tmp_path / option
        folder.mkdir()
        (folder / "mine.py").write_text(
            f"def estimate(ring, {option}='x'):\n    return {number} + 0 * ring.areas[0], None\n"
        )
        monkeypatch.chdir(folder)
        assert list(readings("mine.py")) == [option]
        assert (curvlib.estimate(sphere, "mine.py").K == number).all()


def test_options_of_several_have_to_be_known_to_each(sphere):
    both = curvlib.estimate(sphere, ["taubin", "paraboloid"], normal="area")
    alone = curvlib.estimate(sphere, "taubin", normal="area")
    np.testing.assert_array_equal([*both["taubin"]], [*alone])
    with pytest.raises(curvlib.InputError, match="unknown option of gauss_bonnet 'normal'"):
        curvlib.estimate(sphere, ["taubin", "gauss_bonnet"], normal="area")


class TestInput:
    def test_pyvista_objects(self, sphere):
        data = pyvista.Sphere(theta_resolution=12, phi_resolution=12)
        r = curvlib.estimate(data, "gauss_bonnet")
        assert r.K.shape == (data.n_points,)
        with pytest.raises(curvlib.InputError, match="no triangle mesh"):
            curvlib.estimate(pyvista.Plane(), "gauss_bonnet")

    @pytest.mark.parametrize(
        ("mesh", "message"),
        [
            ((np.zeros((4, 2)), [[0, 1, 2]]), r"vertices: shape \(4, 2\)"),
            ((np.zeros((4, 3)), [[0, 1, 2, 3]]), r"faces: shape \(1, 4\)"),
            ((np.zeros((4, 3)), [[0, 1, 4]]), r"face 0 is \[0, 1, 4\].*from 0 to 3"),
            ((np.zeros((4, 3)), [[0.5, 1, 2]]), "integers is expected, not float64"),
            ((np.full((4, 3), np.nan), [[0, 1, 2]]), "vertex 0 has a coordinate"),
            ((np.zeros((4, 3)),), "pair"),
            (object(), "cannot wrap object"),
        ],
    )
    def test_no_mesh(self, mesh, message):
        with pytest.raises(curvlib.InputError, match=message):
            curvlib.estimate(mesh, "gauss_bonnet")

    def test_unknown_names(self, sphere):
        with pytest.raises(curvlib.InputError, match="'gaus_bonnet'; did you mean 'gauss_bonnet'"):
            curvlib.estimate(sphere, "gaus_bonnet")
        with pytest.raises(curvlib.InputError, match="'are'; did you mean 'area'"):
            curvlib.estimate(sphere, "gauss_bonnet", are="half")
        with pytest.raises(curvlib.InputError, match="'halv'; did you mean 'half'"):
            curvlib.estimate(sphere, "gauss_bonnet", area="halv")

    @pytest.mark.parametrize("threads", [0, 1.5, "2", None])
    def test_no_threads(self, sphere, threads):
        with pytest.raises(curvlib.InputError, match="is not a number of at least 1"):
            curvlib.estimate(sphere, "gauss_bonnet", threads=threads)

    def test_arrays_that_change_after_the_mesh_was_made(self):
        """Compiled code does not look where it reads: the mesh does."""
        vertices, faces = torus(5, "regular")
        mesh = curvlib.Mesh(vertices, faces, copy=False)
        faces[3, 1] = 1 << 40
        with pytest.raises(curvlib.InputError, match="faces: changed since the mesh was made"):
            curvlib.estimate(mesh, "gauss_bonnet")
        with pytest.raises(AttributeError):
            mesh.vertices = mesh.vertices[:3]

    def test_empty_mesh(self):
        r = curvlib.estimate((np.zeros((0, 3)), np.zeros((0, 3), int)), "paraboloid")
        assert r.K.shape == (0,)


def test_several_at_once_on_any_number_of_threads_are_the_same(monkeypatch):
    """Bit by bit, whether alone or together, in one block and bucket or several."""
    m = curvlib.tessellate(curvlib.surface("ellipsoid"), 16, "random", seed=7)
    alone = {name: curvlib.estimate(m, name) for name in PAPER}
    monkeypatch.setattr("curvlib.passes.BLOCK", 200)
    monkeypatch.setattr("curvlib.meshes.corners.SHIFT", 5)
    monkeypatch.setattr("curvlib.meshes.corners.PART", 37)
    for threads in (1, 2, 5):
        again = curvlib.Mesh(m.vertices, m.faces, normals=m.normals)
        together = curvlib.estimate(again, PAPER, threads=threads)
        assert len(again.rings) > len(m.rings)
        assert list(together) == PAPER
        for name in PAPER:
            np.testing.assert_array_equal([*together[name]], [*alone[name]])


@pytest.mark.parametrize("threads", [1, 2, 4])
def test_an_error_ends_the_work(threads):
    begun = []

    def work(item):
        begun.append(item)
        time.sleep(0.002)
        raise KeyError(item)

    with pytest.raises(KeyError):
        for_each(work, range(100), threads)
    assert len(begun) <= threads
    assert for_each(lambda item: 2 * item, range(7), threads) == [*range(0, 14, 2)]


# Bodies of files whose fields or options cannot be what they are, and what is said of them.
WRONG = {
    "two fields of each other": (
        "def a(disk, b):\n    return (1.0,)\n\n\ndef b(disk, a):\n    return (1.0,)\n\n\n"
        "def estimate(disk, a):\n    return 1.0, 1.0\n",
        "field 'a' would need itself",
    ),
    "a field of the estimator": (
        "def a(disk, estimate):\n    return (1.0,)\n\n\n"
        "def estimate(disk, a):\n    return 1.0, 1.0\n",
        "field 'estimate' would need itself",
    ),
    "a field of meshes": (
        "def f(mesh):\n    return (mesh.vertices[:, 0],)\n\n\n"
        "def estimate(disk, f):\n    return 1.0, 1.0\n",
        "unknown first parameter 'mesh'",
    ),
    "rings of triangles": (
        "PER = ('vertex', 'face')\n\n\ndef estimate(ring):\n    return ring.areas[0], None\n",
        "is given a ring; around a triangle's centre there are disks alone",
    ),
    "a field of rings at triangles": (
        "PER = ('vertex', 'face')\n\n\ndef f(ring):\n    return (ring.areas[0],)\n\n\n"
        "def estimate(disk, f):\n    return f[0, 0], f[0, 1]\n",
        "'f of .*' is given a ring; around a triangle's",
    ),
    "more components than memory": (
        "def f(ring):\n    return (ring.areas[0],) * 4000\n\n\n"
        "def estimate(disk, f):\n    return f[0, 0], f[39, 1]\n",
        "'f of .*' has more than 32 components",
    ),
    "as many components as neighbours": (
        "def f(ring):\n    return tuple(ring.areas)\n\n\n"
        "def estimate(disk, f):\n    return f[0, 0], f[0, 1]\n",
        "'f of .*' returns different numbers of components",
    ),
    "components of no length": (
        "def f(ring):\n    return 1.0, 2.0\n\n\ndef estimate(disk, f):\n    return f[0, 0], 1.0\n",
        r"has to return a tuple of arrays \(\d+,\) of float64",
    ),
    "no components": (
        "def f(ring):\n    return None\n\n\ndef estimate(disk, f):\n    return 1.0, 1.0\n",
        "has to return a tuple of arrays",
    ),
    "one number as a field": (
        "def f(disk):\n    return 1.0\n\n\ndef estimate(disk, f):\n    return f[0, 0], 1.0\n",
        "'f' has to return a tuple of numbers, compiled by Numba",
    ),
    "one number": ("def estimate(disk):\n    return 1.0\n", "has to return K and H, or curvlib"),
    "a default that is no length": (
        "from curvlib.kit.options import Length\n\n\n"
        "def estimate(disk, radius: Length = '5 edge s'):\n    return 1.0, 1.0\n",
        "radius='5 edge s' is no length",
    ),
    "a radius without a unit": (
        "def estimate(disk, radius=1.5):\n    return 1.0, 1.0\n",
        "'radius' has to be annotated as curvlib.kit.options.Length",
    ),
    "rings in words": (
        "def estimate(disk, rings='two'):\n    return 1.0, 1.0\n",
        "rings='two' is no number of at least 1",
    ),
    "an annotation of nothing": (
        "def estimate(disk, x: 'Nothing' = 1):\n    return 1.0, 1.0\n",
        "name 'Nothing' is not defined",
    ),
}


@pytest.mark.parametrize("wrong", WRONG)
def test_fields_and_options_that_cannot_be(tmp_path, wrong):
    """Each ends in one message; memory beyond that of a field is never read or written."""
    body, message = WRONG[wrong]
    path = tmp_path / "wrong.py"
    path.write_text(f"LABEL = 'x'\n\n\n{body}")
    per = "face" if "PER" in body else "vertex"
    vertices, faces = torus(8, "irregular")
    with pytest.raises(curvlib.InputError, match=message):
        curvlib.estimate((vertices, faces), str(path), per=per)


def test_annotations_as_text(tmp_path):
    path = tmp_path / "text.py"
    path.write_text(
        "from __future__ import annotations\n\nfrom typing import Literal\n\n"
        "from curvlib.kit.options import Length\n\nLABEL = 'x'\n\n\n"
        "def estimate(disk, radius: Length = '2 edges', a: Literal['p', 'q'] = 'p'):\n"
        "    return radius, 1.0 * disk.count\n"
    )
    mesh = curvlib.Mesh(*torus(8, "regular"))
    found = curvlib.estimate(mesh, str(path), a="q")
    np.testing.assert_allclose(found.K / mesh.unit**2, 2 * mesh.mean_edge * mesh.unit, rtol=1e-12)


def test_options_of_another_kind_than_the_valid_ones(sphere):
    with pytest.raises(curvlib.InputError, match="unknown rings of quadric '2'; valid: 2, 1, 3"):
        curvlib.estimate(sphere, "quadric", rings="2")
    with pytest.raises(curvlib.InputError, match="unknown option of meyer 'radius'; valid: none"):
        curvlib.estimate(sphere, "meyer", radius=1)
