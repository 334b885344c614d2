"""CGAL: polynomials fitted over some rings."""

import ctypes
import functools
import hashlib
import os
import shutil
import subprocess
from pathlib import Path
from typing import Literal

import numpy as np

from curvlib.files import whole_file
from curvlib.kit.compiled import cache_folder
from curvlib.peers._turned import normals, over_used, six

LABEL = "CGAL, jet"
SOURCE = "https://doc.cgal.org/latest/Jet_fitting_3/index.html"
REQUIRES = "libcgal-dev libeigen3-dev g++"
INSTALL = "on Debian: apt install libcgal-dev libeigen3-dev g++"
RETURNS = "pointwise"
SIGN = "opposite"
BOUNDARY = "estimated"
ORDER = "as named"

CODE = Path(__file__).with_name("cgal_jet.cpp")
# Debian has Eigen's headers in a folder of their own.
FLAGS = "-std=c++17 -O3 -DNDEBUG -shared -fPIC -DCGAL_EIGEN3_ENABLED -I/usr/include/eigen3"


def returned(vertices, faces, degree=2, rings=2):
    """Principal curvatures and directions of the Monge form, turned to the area-weighted normal;
    NaN with fewer points than coefficients."""
    start, sets = _within(rings, faces, len(vertices))
    found = np.empty((len(vertices), 8))
    arrays = [np.ascontiguousarray(x) for x in (vertices, start, sets, normals(vertices, faces))]
    pointers = [x.ctypes.data_as(ctypes.c_void_p) for x in (*arrays, found)]
    count = ctypes.c_int64(len(vertices))
    _library(CODE).jets(*pointers[:4], count, ctypes.c_int(degree), pointers[4])
    return found[:, 0], found[:, 1], found[:, 2:5], found[:, 5:]


def estimate(mesh, degree: Literal[2, 3, 4, 5, 6] = 2, rings: Literal[2, 1, 3, 4] = 2):
    """All six; NaN where the vertices over `rings` rings are fewer than coefficients."""
    larger, smaller, d_larger, d_smaller = over_used(returned, mesh, degree=degree, rings=rings)
    return six(mesh, -smaller, -larger, d_smaller, d_larger)


def _within(rings, faces, count):
    """The vertices within some rings of each of `count`, itself included, as compressed rows."""
    from scipy.sparse import coo_array, eye_array

    start, end = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    edges = np.concatenate([start, end]), np.concatenate([end, start])
    step = coo_array((np.ones(len(edges[0])), edges), (count, count)).tocsr() + eye_array(count)
    near = step
    for _ in range(rings - 1):
        near = near @ step
    return near.indptr.astype(np.int64), near.indices.astype(np.int64)


@functools.cache
def _library(code):
    """The compiled file, kept beside the compiled code of estimators. Raises ImportError where it
    cannot be compiled."""
    compiler = shutil.which(os.environ.get("CXX") or "g++")
    if compiler is None:
        raise ImportError("there is no g++")
    key = hashlib.sha256(FLAGS.encode() + code.read_bytes()).hexdigest()[:16]
    kept = cache_folder() / f"{code.stem}-{key}.so"
    if not kept.exists():
        with whole_file(kept) as part:
            command = [compiler, *FLAGS.split(), str(code), "-o", str(part)]
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode:
                errors = [line for line in done.stderr.splitlines() if "error:" in line]
                raise ImportError(" ".join(errors[:1]) or f"{compiler} failed")
    return ctypes.CDLL(str(kept))
