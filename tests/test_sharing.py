"""Estimates by threads and processes of other libraries."""

import os
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import cloudpickle
import joblib
import numpy as np
import pytest

import curvlib
from curvlib.meshes.jittered import jittered

NAMES = ["meyer", "quadric", "ball_regression", "paraboloid"]


@pytest.fixture(scope="module")
def mesh():
    return jittered("ellipsoid", 12)


@pytest.fixture
def own():
    """An estimator that cloudpickle sends by its code, as one of a notebook."""

    def mean_of_lengths(ring):
        return ring.lengths.mean(0), None

    return mean_of_lengths


def work(mesh, estimator):
    r = curvlib.estimate(mesh, estimator)
    return r, os.getpid()


@pytest.mark.parametrize("backend", ["loky", "threading"])
def test_joblib(mesh, own, backend):
    """Its processes get the mesh and a function, and send the result back."""
    # Sent by its code: a process of joblib cannot import a module of tests.
    cloudpickle.register_pickle_by_value(__import__(work.__module__, fromlist=["work"]))
    parallel = joblib.Parallel(n_jobs=2, backend=backend)
    found = parallel(joblib.delayed(work)(mesh, each) for each in ("meyer", own))
    for (r, process), each in zip(found, ("meyer", own)):
        assert (process == os.getpid()) == (backend == "threading")
        expected = curvlib.estimate(mesh, each)
        np.testing.assert_array_equal(r.K, expected.K)
        assert r.undefined == expected.undefined
        assert repr(r) == repr(expected)


def test_cloudpickle(mesh, own):
    """As dask sends work: the call with all that it refers to."""
    call = cloudpickle.loads(cloudpickle.dumps(lambda: curvlib.estimate(mesh, own)))
    np.testing.assert_array_equal(call().K, curvlib.estimate(mesh, own).K)


def test_many_threads_at_once(mesh):
    """On one mesh, whose rings and adjacency are found by whoever comes first."""
    expected = {name: curvlib.estimate(mesh, name).K for name in NAMES}
    for _ in range(3):
        fresh = curvlib.Mesh(mesh.vertices, mesh.faces)
        with ThreadPoolExecutor(8) as pool:
            found = list(pool.map(partial(curvlib.estimate, fresh), NAMES * 4))
        for name, r in zip(NAMES * 4, found):
            np.testing.assert_array_equal(r.K, expected[name])
