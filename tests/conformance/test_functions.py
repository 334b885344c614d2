"""The checks of library functions find planted faults, and only these; the page says what to do."""

import numpy as np
import pandas as pd
import pytest

from curvlib.catalogue import libraries
from curvlib.conformance import cells
from curvlib.conformance.cell import verdict
from curvlib.conformance.function import Function, ball, on_boundary, saddle, uneven
from curvlib.conformance.functions import CHECKS
from curvlib.conformance.page import page
from curvlib.estimation import estimate
from curvlib.figures.conformance import conformance_plot


def right(vertices, faces):
    """K, H, k1 and k2 without faults, by our own fit."""
    found = estimate((vertices, faces), "quadric")
    return {name: getattr(found, name) for name in ("K", "H", "k1", "k2")}


def areas(vertices, faces):
    a, b, c = vertices[faces].swapaxes(0, 1)
    doubled = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return np.bincount(faces.ravel(), np.repeat(doubled / 6, 3), len(vertices))


def integrated(vertices, faces):
    return {name: x * areas(vertices, faces) for name, x in right(vertices, faces).items()}


def negated(vertices, faces):
    found = right(vertices, faces)
    return {"H": -found["H"], "k1": -found["k2"], "k2": -found["k1"]}


def unsigned(vertices, faces):
    return {"H": np.abs(right(vertices, faces)["H"])}


def swapped(vertices, faces):
    found = right(vertices, faces)
    return {"k1": found["k2"], "k2": found["k1"]}


def zero_at_boundary(vertices, faces):
    edge = on_boundary(faces, len(vertices))
    return {name: np.where(edge, 0, x) for name, x in right(vertices, faces).items()}


def zero_for_undefined(vertices, faces):
    return {name: np.nan_to_num(x) for name, x in right(vertices, faces).items()}


def single(vertices, faces):
    middle = vertices.astype(np.float32).astype(float)
    return {"H": right(middle, faces)["H"]}


def of_the_first_axis(vertices, faces):
    return {"H": right(vertices, faces)["H"] * (1 + 0.1 * np.abs(vertices[:, 0]))}


def of_the_label(vertices, faces):
    return {"H": right(vertices, faces)["H"] * np.linspace(1, 1.1, len(vertices))}


def moving(vertices, faces):
    vertices -= vertices.mean(0) + 1
    return {"H": np.full(len(vertices), 1.0)}


def only_double(vertices, faces):
    if vertices.dtype != np.float64:
        raise TypeError("float64 is needed")
    return {"H": right(vertices, faces)["H"]}


def used_alone(vertices, faces):
    used = np.unique(faces)
    return {"H": right(vertices, faces)["H"][used]}


def blind_to_nan(vertices, faces):
    return {"K": np.where(np.isnan(vertices[:, 0]), 1.0, 1.0)}


FAULTS = [
    (integrated, "scaling", "K times 1", "divide by the area"),
    (integrated, "refinement", "K 0.0", "divide by an area"),
    (negated, "sign", "H > 0 at 0 %", "negate H, k1, k2"),
    (unsigned, "orientation", "H is H times 1", "normals"),
    (swapped, "order of k1 and k2", "k1 < k2 at", "k1"),
    (zero_at_boundary, "boundary", "K 0, inside 1", "leave out"),
    (zero_for_undefined, "isolated vertex", "there K = 0", "set NaN"),
    (used_alone, "isolated vertex", "642 values of H for 643 vertices", "which vertices"),
    (zero_for_undefined, "edge of three faces", "K = 0, 0", "edges of three faces"),
    (blind_to_nan, "nan coordinate", "K = 1 there", "NaN among the coordinates"),
    (single, "far from the origin", "H off by", "subtract the centre"),
    (only_double, "single precision", "TypeError: float64 is needed", "float64"),
    (of_the_first_axis, "rotation", "H off by 0.", "axes"),
    (of_the_label, "renumbering", "H off by 0.", "order"),
    (moving, "input unchanged", "vertices are changed", "copies"),
]


@pytest.mark.parametrize(("fault", "check", "evidence", "remedy"), FAULTS)
def test_a_planted_fault_is_found(fault, check, evidence, remedy):
    found = verdict(Function(fault), check)
    assert found[0] == "fail", found
    assert evidence in found[1]
    assert remedy in found[2]


def test_every_check_has_a_planted_fault():
    assert {check for _, check, *_ in FAULTS} == set(CHECKS)


def test_a_function_without_faults_passes_every_check():
    function = Function(right)
    for check in CHECKS:
        assert verdict(function, check)[0] == "pass", verdict(function, check)


def test_order_says_nothing_of_a_function_of_k():
    assert verdict(Function(blind_to_nan), "order of k1 and k2")[0] == "not applicable"


def test_closed_meshes_with_the_curvature_that_checks_take_for_granted():
    for vertices, faces in (ball(), uneven(), saddle()[:2]):
        assert not on_boundary(faces, len(vertices)).any()
        a, b, c = vertices[faces].swapaxes(0, 1)
        assert (np.cross(b, c) * a).sum() > 0  # six times the volume: outward
    *mesh, inside = saddle()
    assert (right(*mesh)["K"][inside] < 0).all()
    assert (right(*uneven())["K"] > 0).mean() > 0.5


LIBRARY = """
import os, time
import numpy as np

LABEL, SOURCE, REQUIRES = "planted.curvature", "https://example.org", "numpy"
DOCUMENTED = {"scaling": "The integral of K."}
REMEDIES = {"isolated vertex": "ask"}


def values(vertices, faces):
    print("something on standard output")
    if len(vertices) == 643:
        os.abort() if np.isclose(vertices[-1], 3).all() else None
    if np.isnan(vertices).any():
        while True:
            pass
    return {"H": np.ones(len(vertices))}
"""


@pytest.fixture(scope="module")
def planted(tmp_path_factory):
    """The table of a library that ends its process on one mesh and never returns on another, and of
    one that is not installed."""
    folder = tmp_path_factory.mktemp("planted")
    file, missing = folder / "planted.py", folder / "missing.py"
    file.write_text(LIBRARY)
    missing.write_text(LIBRARY.replace('"numpy"', '"numpy no-such-distribution"'))
    return cells.table([str(file), str(missing)], ours=["gauss_bonnet"], limit=10)


def row(table, function, check):
    return table[(table.function.str.contains(function)) & (table.check == check)].iloc[0]


def test_a_crash_and_an_endless_call_fail_and_the_other_checks_go_on(planted):
    crash = row(planted, "planted.py", "isolated vertex")
    assert (crash.verdict, crash.remedy) == ("fail", "ask")
    assert crash.evidence == "ends the process: SIGABRT"
    endless = row(planted, "planted.py", "nan coordinate")
    assert endless.evidence == "no answer within 10 seconds of processor time"
    assert row(planted, "planted.py", "input unchanged").verdict == "pass"
    assert row(planted, "planted.py", "scaling").documented == "The integral of K."
    missing = planted[planted.function.str.contains("missing")]
    assert set(missing.verdict) == {"not installed"}
    assert set(planted[planted.library == "curvlib"].verdict) == {"pass", "not applicable"}
    assert (planted.groupby("function").size() == len(CHECKS)).all()


def test_the_page_and_the_figure_are_made_from_the_table(planted, tmp_path):
    planted.to_csv(tmp_path / "conformance.csv", index=False)
    read = pd.read_csv(tmp_path / "conformance.csv", keep_default_na=False)
    words = page(read)
    assert words == page(planted.fillna(""))
    assert "| isolated vertex | ends the process: SIGABRT | ask |" in words
    assert "scaling: “The integral of K.”" in words
    assert "Nothing: all that is checked holds." in words.split("gauss_bonnet")[-1]
    assert words.count("✗") == 2 + (read.verdict == "fail").sum()
    axes = conformance_plot(read).axes[0]
    assert len(axes.patches) == len(read)
    assert len(axes.get_yticklabels()) == 3


@pytest.mark.parametrize("name", libraries.names())
def test_a_file_documents_and_mends_checks_that_there_are(name):
    file = libraries.module(name)
    for field in ("DOCUMENTED", "REMEDIES"):
        assert set(getattr(file, field, {})) <= set(CHECKS)
    assert file.SOURCE.startswith("https://")


def test_libraries_of_the_environment_are_judged_as_they_document():
    """VTK is pointwise, and as for a closed ring at a boundary; trimesh returns angle defects."""
    vtk, trimesh = (
        Function(libraries.module(name).values) for name in ("vtk_gaussian", "trimesh_defects")
    )
    assert verdict(vtk, "scaling")[0] == "pass"
    assert verdict(vtk, "boundary")[0] == "fail"
    found = verdict(trimesh, "scaling")
    assert found == (
        "fail",
        "lengths doubled: K times 1",
        "divide by the area of the vertex's cell, a third of its triangles'",
    )
    vertices, faces = ball()
    np.testing.assert_allclose(trimesh.on_sphere["K"].sum(), 4 * np.pi)
    mended = trimesh.on_sphere["K"] / areas(vertices, faces)
    off = np.sort(np.abs(mended - 1))
    assert off[-13] < 0.02  # but for the twelve vertices of valence five
