"""The comparison of 2020: verdicts and sentences from made-up numbers; meshes; one line again."""

import numpy as np
import pandas as pd
import pytest

from curvlib.claims.comparison_2020 import sentences, verdicts
from curvlib.comparison.published import MESHES, error, exact, obtained
from curvlib.comparison.voxels import PUBLISHED
from curvlib.errors import InputError
from curvlib.meshes.mesh import Mesh


def lines(*rows):
    names = ["mesh", "method", "radius_hit", "quantity", "published", "ours"]
    return pd.DataFrame(rows, columns=names).assign(values=10, elements=10)


def test_verdicts_by_the_ratio():
    table = lines(
        ("m", "AVV", 10, "k1", 0.1, 0.104),
        ("m", "AVV", 10, "k2", 0.1, 0.14),
        ("m", "AVV", 10, "H", 0.1, 0.2),
        ("m", "VTK", np.nan, "H", 0.1, 0.01),
        ("m", "SSVV", 8, "H", 0.1, np.nan),
    )
    told = ["same", "near", "larger", "smaller", "not here"]
    assert verdicts(table).verdict.tolist() == told
    assert verdicts(table.assign(elements=11)).verdict.tolist() == ["other mesh"] * 4 + told[4:]


def test_sentences_on_both_numbers():
    voxel = [(f"voxel-sphere-{r}", "AVV", 10, "k1", 0.1, 0.1) for r in (10, 30)]
    voxel += [(f"voxel-sphere-{r}", "RVV", 10, "k1", 0.2, x) for r, x in ((10, 0.05), (30, 0.2))]
    voxel += [("voxel-sphere-10", "VTK", np.nan, "k1", 3.0, 0.3)]
    found = sentences(lines(*voxel)).set_index(["claim", "numbers"])
    assert found.holds[1, "published"] == "true"
    assert found.holds[1, "ours"] == "in part"
    assert (found.least[1, "ours"], found.largest[1, "ours"]) == pytest.approx((0.5, 2))
    assert found.holds[2, "published"] == "true"
    assert found.holds[2, "ours"] == "false"
    assert found.holds[3, "ours"] == "undecided"
    assert found.cases[1, "ours"] == 2


@pytest.mark.parametrize("name", MESHES)
def test_meshes_have_as_many_triangles_as_the_published(name):
    published = pd.read_csv(PUBLISHED)
    values = published[(published.mesh == name) & (published.method == "AVV")]["values"]
    assert set(values) == {len(MESHES[name]().faces)}


def test_exact_values_of_the_torus_are_those_of_its_level_set():
    from curvlib.meshes.jittered import jittered

    mesh = jittered("torus", 20, 1)  # of radii 2 and 0.7
    angle = np.arctan2(mesh.vertices[:, 2], np.hypot(*mesh.vertices[:, :2].T) - 2)
    turn = mesh.vertices[:, :2] / np.hypot(*mesh.vertices[:, :2].T)[:, None]
    r = 25 + 10 * np.cos(angle)
    points = np.column_stack((turn * r[:, None], 10 * np.sin(angle)))
    found = exact("torus-25-10", points)
    np.testing.assert_allclose(found["k2"], np.cos(angle) / r, atol=1e-12)
    for name in ("d1", "d2"):
        assert error(name, getattr(mesh, name), found[name]) < 1e-6
    assert error("k1", found["k1"], np.full(len(r), 0.11)) == pytest.approx(0.1)


def test_vtk_on_the_torus_is_what_was_published_to_its_last_digit(monkeypatch):
    pytest.importorskip("pyvista")
    monkeypatch.setattr("curvlib.comparison.published.VOTING", {})
    found = obtained(["torus-25-10"])
    vtk = found[found.method == "VTK"]
    assert (np.abs(vtk.ours / vtk.published - 1) < 5e-4).all()
    assert isinstance(MESHES["torus-25-10"](), Mesh)


def test_an_unknown_mesh_is_told():
    with pytest.raises(InputError, match="torus-25-10"):
        obtained(["torus"])
