"""A small library, and an archive of one on a disk and on a server."""

import functools
import threading
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import pytest

import curvlib
from curvlib.dataset.archive import write_archive
from curvlib.dataset.library import mesh_files
from curvlib.dataset.write import WRITERS, write_library

NAME = "curvature-library-1.2.3"
MESHES = [("jittered-1", 8), ("same", 8), ("same", 12)]
SURFACES = ["cone_apex", "ellipsoid", "sphere", "teapot_spout"]


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("library")
    for name in SURFACES:
        write_library(curvlib.surface(name), MESHES, folder)
    return folder


@pytest.fixture
def keys():
    """(surface, diagonal, n) of the meshes in `folder`, sorted."""
    return [(surface, *mesh) for surface in SURFACES for mesh in MESHES]


@pytest.fixture(params=SURFACES)
def written(request, folder):
    """A mesh, and its files by format."""
    files = mesh_files(request.param, "same", 12)
    mesh = curvlib.tessellate(curvlib.surface(request.param), 12)
    return mesh, dict(zip(WRITERS, (folder / file for file in files)))


class Handler(SimpleHTTPRequestHandler):
    """A server without a log; what is called cut-* breaks off in the middle."""

    def log_message(self, *arguments):
        pass

    def copyfile(self, source, outputfile):
        data = source.read()
        outputfile.write(data[: len(data) // 2] if "cut-" in self.path else data)


@pytest.fixture
def published(tmp_path):
    """A folder with an archive and SHA256SUMS."""
    folder = tmp_path / "published"
    write_library(curvlib.surface("sphere"), [("same", 8)], tmp_path / "made")
    members = {file: tmp_path / "made" / file for file in mesh_files("sphere", "same", 8)}
    folder.mkdir()
    write_archive(folder / f"{NAME}.zip", members)
    return folder


@pytest.fixture
def url(published):
    handler = functools.partial(Handler, directory=published)
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, args=(0.01,)).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


@pytest.fixture
def here(tmp_path, monkeypatch):
    """An empty current folder."""
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    return here
