"""The measurement of speed: its meshes, its rows and its figure; never a time."""

import importlib

import numpy as np
import pandas as pd
import pytest

import curvlib
from curvlib.catalogue import estimators
from curvlib.comparison import throughput
from curvlib.comparison.exact_throughput import exact_rows
from curvlib.figures.style import save
from curvlib.figures.throughput import throughput_plot
from curvlib.meshes.torus import torus


@pytest.mark.parametrize("kind", ["regular", "irregular"])
def test_torus_is_closed_and_turned_outward(kind):
    vertices, faces = torus(20, kind)
    m = curvlib.Mesh(vertices, faces)
    assert len(faces) == 2 * len(vertices) == 800
    assert sum(len(batch) for batch, _ in m.rings) == len(vertices)
    assert ({len(ring) for _, ring in m.rings} == {6}) == (kind == "regular")
    outer = vertices[:, 0] ** 2 + vertices[:, 1] ** 2 > 6
    r = curvlib.estimate(m, "gauss_bonnet")
    assert np.median(r.H[outer]) == pytest.approx((1 + 1 / 3) / 2, rel=0.1)
    assert np.median(r.K[outer]) == pytest.approx(1 / 3, rel=0.2)


class Clock:
    """Time that passes only while a method runs: `seconds` of each per call."""

    now = 0.0

    def spend(self, seconds):
        self.now += seconds


def test_a_row_has_the_median_time_and_its_ratio_to_the_reference(monkeypatch):
    clock, spent = Clock(), iter([0, 0, 2.0, 4.0, 3.0])  # the first two are not measured
    monkeypatch.setattr(throughput.time, "perf_counter", lambda: clock.now)
    monkeypatch.setattr(throughput, "RUNS", 3)
    monkeypatch.setattr(throughput, "SECONDS", 1e9)
    peers = {
        throughput.REFERENCE: lambda: lambda v, f, threads: clock.spend(0.5),
        "slow": lambda: lambda v, f, threads: clock.spend(next(spent)),
    }
    monkeypatch.setattr(throughput, "PEERS", peers)
    row = throughput.measure("slow", 1, *torus(10, "irregular"))
    assert (row["vertices"], row["note"]) == (100, "")
    assert row["seconds"] == 3.0
    assert row["vertices_per_second"] == 100 / 3.0
    assert row["ratio"] == 6.0


OURS = [name for name in throughput.methods() if name not in throughput.PEERS]


@pytest.mark.parametrize("method", OURS)
def test_what_needs_no_peer_is_measured(method, monkeypatch):
    monkeypatch.setattr(throughput, "RUNS", 2)
    row = throughput.measure(method, 1, *torus(10, "irregular"))
    assert row["note"] == ""
    assert row["seconds"] > 0


@pytest.mark.parametrize("method", throughput.PEERS)
def test_a_peer_is_measured_or_said_to_be_missing(method, monkeypatch):
    """Whether its package can be imported is asked apart from what makes it."""
    package = dict(zip(throughput.PEERS, ("igl", "igl", "pyvista", "pymeshlab", "trimesh")))[method]
    try:
        importlib.import_module(package)
        installed = True
    except ImportError:
        installed = False
    monkeypatch.setattr(throughput, "RUNS", 2)
    row = throughput.measure(method, 1, *torus(10, "irregular"))
    assert ("seconds" in row) == installed
    assert row["note"].startswith("not installed: ") != installed


def test_a_missing_peer_is_a_row_that_says_so(monkeypatch):
    def missing():
        raise ImportError("no module named peer")

    monkeypatch.setitem(throughput.PEERS, "peer", missing)
    row = throughput.measure("peer", 1, *torus(5, "regular"))
    assert row["note"] == "not installed: no module named peer"
    assert "seconds" not in row


def test_rows_of_processes_of_their_own_make_a_figure(monkeypatch, tmp_path):
    peers = dict.fromkeys(["libigl gaussian_curvature"], throughput.PEERS[throughput.REFERENCE])
    monkeypatch.setattr(throughput, "PEERS", peers)
    monkeypatch.setattr(throughput.estimators, "names", lambda: ["watanabe_b"])
    table = pd.DataFrame(throughput.rows([10], kinds=["regular"]))
    ours, theirs = table[table.method == "watanabe_b"], table[table.method.isin(peers)]
    assert list(ours.threads) == [1, 2]
    assert list(theirs.threads) == [1]
    modules = {"watanabe_b": estimators.module("watanabe_b")}
    save(throughput_plot(table, modules), tmp_path / "figure.svg")
    assert "Watanabe B" in (tmp_path / "figure.svg").read_text()


def test_a_method_that_would_take_too_long_has_a_row_that_says_so(monkeypatch):
    monkeypatch.setattr(throughput, "PEERS", {})
    monkeypatch.setattr(throughput.estimators, "names", lambda: ["watanabe_b"])
    monkeypatch.setattr(throughput, "LONGEST", 0.0)
    table = pd.DataFrame(throughput.rows([5, 6], kinds=["regular"]))
    small, large = (table[table.vertices == size**2] for size in (5, 6))
    assert (small.note == "").all()
    assert large.note.str.fullmatch(r"not run: \d+ s").all()
    assert large.seconds.isna().all()
    assert list(small.method) == list(large.method) == ["watanabe_b", *throughput.LIMITS]


def test_calls_of_one_estimator_share_colour_and_marker():
    methods = ["jet", "jet(degree=3)", "quadric", "a peer", "copy"]
    table = pd.DataFrame(
        {"method": m, "mesh": "regular", "threads": 1, "vertices": v, "seconds": 1.0}
        | {"vertices_per_second": 1.0 * v}
        for m in methods
        for v in (100, 1000)
    )
    modules = {name: estimators.module(name) for name in ("jet", "quadric")}
    lines = throughput_plot(table, modules).axes[0].lines
    jet, cubic, quadric, *_ = lines
    shown = ["Jet", "Jet (degree=3)", "Quadric", "a peer", "copy"]
    assert [line.get_label() for line in lines] == shown
    assert jet.get_color() == cubic.get_color() == modules["jet"].STYLE["color"]
    assert jet.get_marker() == cubic.get_marker()
    assert jet.get_linestyle() != cubic.get_linestyle()
    assert (quadric.get_color(), quadric.get_marker()) == ("#332288", "+")


def test_exact_evaluation_has_its_rows():
    table = pd.DataFrame(exact_rows("sphere", scattered=20, side=6))
    assert list(table.arrangement) == ["scattered"] * 4 + ["grid"] * 2
    assert list(table.points) == [20, 20, 36, 36, 36, 36]
    assert (table.points_per_second > 0).all()
    assert (table.ratio > 0).all()
