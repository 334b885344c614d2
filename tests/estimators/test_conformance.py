"""Conformance of every estimator found, by the checks of the package; and what the nine of the
paper keep beside them."""

import time

import numpy as np
import pytest
import reference

import curvlib
from curvlib.claims.cell import NINE as PAPER
from curvlib.conformance.checks import CHECKS
from curvlib.conformance.run import verdicts
from curvlib.conformance.subject import NotApplicable, Subject, fan, icosphere
from curvlib.signatures import readings

ESTIMATORS = curvlib.estimators()


def test_the_nine_of_the_paper_are_there():
    assert set(PAPER) <= set(ESTIMATORS)


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.__name__)
@pytest.mark.parametrize("name", ESTIMATORS)
def test_conformance(name, check):
    subject = Subject(name)
    try:
        check(subject)
    except NotApplicable:
        assert subject.spreads


@pytest.mark.parametrize("name", PAPER)
@pytest.mark.parametrize("n", [3, 4, 5, 7, 40, 1000])
def test_any_valence_from_three(name, n):
    """The apex of a pyramid of height h: all circles have curvature 2 h / (1 + h^2), the
    paraboloid's is 2 h; angles in space and areas know the pyramid's edges as well."""
    h = 0.1
    r = curvlib.estimate(fan(n, h), name)
    H = 2 * h if name == "paraboloid" else 2 * h / (1 + h * h)
    if name in ("gauss_bonnet", "watanabe"):
        assert 0.7 * H < r.H[n] < 3 * H
        assert 0.5 * H**2 < r.K[n] < 3 * H**2
    else:
        assert r.H[n] == pytest.approx(H, rel=1e-9)
        assert r.K[n] == pytest.approx(H * H, rel=1e-9)


@pytest.mark.parametrize("name", PAPER)
@pytest.mark.parametrize("n", [1025, 100_000])
def test_a_wide_fan(name, n):
    """circular, in time square of the valence, leaves it out; the others have its values."""
    r = curvlib.estimate(fan(n, 0.1), name)
    if name == "circular":
        assert np.isnan([r.K[n], r.H[n]]).all()
    else:
        assert 0.14 < r.H[n] < 0.4


@pytest.mark.parametrize("name", ESTIMATORS)
def test_time_is_proportional_to_the_valence(name):
    vertices, faces = fan(100_000, 0.1, 100_000)
    options = Subject(name).lengths(icosphere(2))
    curvlib.estimate(fan(1025, 0.1), name, **options)
    start = time.process_time()
    curvlib.estimate((vertices, faces), name, **options)
    assert time.process_time() - start < 1


@pytest.mark.parametrize("normal", ["default", "uniform", "area", "exact"])
@pytest.mark.parametrize("name", PAPER)
def test_degenerate_triangle(name, ellipsoid, normal):
    """NaN at the corners of triangles without area by independent code, with each normal."""
    chosen = {} if normal == "default" else {"normal": normal}
    if chosen and "normal" not in readings(name):
        return
    a, b, c = ellipsoid.faces[100]
    for place in (
        ellipsoid.vertices[b],
        ellipsoid.vertices[b] * (1 + 2e-16),
        (ellipsoid.vertices[b] + ellipsoid.vertices[c]) / 2,
        0.3 * ellipsoid.vertices[b] + 0.7 * ellipsoid.vertices[c] + 1e-15,
    ):
        vertices = ellipsoid.vertices.copy()
        vertices[a] = place
        mesh = curvlib.Mesh(vertices, ellipsoid.faces, normals=ellipsoid.normals)
        area = [reference.degenerate(vertices[f]) for f in ellipsoid.faces]
        expected = np.isin(np.arange(len(vertices)), ellipsoid.faces[area])
        assert expected[[a, b, c]].all()
        for values in curvlib.estimate(mesh, name, **chosen):
            np.testing.assert_array_equal(np.isnan(values), expected)


FAULTS = {
    "unit_sphere": "K, H = 2 * K, H",
    "scale": "K, H = K, H * ring.lengths[0]",
    "rigid_motion": "K, H = K, H + 1e-3 * N[0]",
    "relabelled_vertices": "K, H = K, H * (1 + 1e-6 * ring.lengths[0] / ring.lengths.sum(0))",
    "reversed_orientation": "K, H = K, abs(H)",
    "boundary": "K, H = np.where(N[0] > 0.5, np.nan, K), H",
    "any_valence": "K, H = K, np.where(len(ring.lengths) == 40, -H, H)",
    "one_vertex_at_a_time": "K, H = K, H * (1 + 1e-6 / len(H))",
}


@pytest.mark.parametrize("check", FAULTS)
def test_a_fault_is_found(check, tmp_path):
    """By the check that is about it, maybe among others."""
    path = tmp_path / "mine.py"
    path.write_text(
        """
import numpy as np


def estimate(ring):
    N = ring.facets.sum(1)
    N = N / np.linalg.norm(N, axis=0)
    H = (-2 * (ring.e * N[:, None]).sum(0) / ring.squares).mean(0)
    K = H * H
    """
        + FAULTS[check]
        + """
    return K, H
""",
        encoding="utf-8",
    )
    failed = {v.check.replace(" ", "_"): v for v in verdicts(str(path)) if v.verdict == "fail"}
    assert check in failed
    assert failed[check].line == 5
