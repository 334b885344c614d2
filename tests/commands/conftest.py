"""A mesh of one's own, and a verb run on it."""

import pytest
import pyvista

from curvlib.commands.main import main


@pytest.fixture
def ball(tmp_path, monkeypatch):
    """A ball of radius 2 in three formats, in the working folder."""
    monkeypatch.chdir(tmp_path)
    mesh = pyvista.Icosphere(radius=2, nsub=2)
    mesh.point_data["half"] = (mesh.points[:, 2] > 0).astype(int)
    mesh.cell_data["quarter"] = (mesh.cell_centers().points[:, 0] > 0).astype(int)
    for name in ("ball.vtp", "ball.stl", "ball.ply"):
        mesh.save(name)
    return mesh


@pytest.fixture
def run(capsys):
    """A verb run in this process: exit code, stdout and stderr."""

    def status_and_output(*arguments):
        status = main([*map(str, arguments)])
        return status, *capsys.readouterr()

    return status_and_output
