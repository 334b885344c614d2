"""Offscreen rendering of triangles and lines, by VTK or, where it has no OpenGL, by matplotlib."""

import os
import signal
import subprocess
import sys
from typing import NamedTuple

import numpy as np

from curvlib.errors import check_name

CHOICE = "CURVLIB_RENDERER"  # in the environment: vtk or matplotlib, instead of a probe
TIMEOUT = 120  # seconds for the probe, enough on a busy machine
FINER = 3  # supersampling: pixels of the raster per pixel of the image, each way
SMALL = 4000  # triangles are subdivided to at least so many before the painter's algorithm

PROBE = """
import numpy as np
from curvlib.figures.render import Scene, by_vtk
corners = np.array([[[0, 0, 0], [32, 0, 0], [0, 32, 0.0]]])
image = by_vtk(Scene((32, 32), corners, np.zeros((1, 3, 3)), np.zeros((0, 2, 3))))
assert image[-4, 4].max() == 0 and image[4, -4].min() == 255, "its pixels are wrong"
"""


class Scene(NamedTuple):
    """A scene on white in pixels: x to the right, y up from the lower left corner, z to the eye.

    `size` (width, height); `triangles` (F, 3, 3); `colours` (F, 3, 3): RGB from 0 to 1 at their
    corners, shading included; `lines` (S, 2, 3), drawn in `ink`, `width` pixels wide.
    """

    size: tuple
    triangles: np.ndarray
    colours: np.ndarray
    lines: np.ndarray
    ink: tuple = (0.0, 0.0, 0.0)
    width: float = 1.0


def renderer():
    """The function that draws a Scene, (height, width, 3) uint8; its name is printed to stderr
    where it is not VTK by itself.

    Without OpenGL, VTK ends the process, so that a child process probes it first. Raises InputError
    for an unknown name in the environment variable.
    """
    if chosen := os.environ.get(CHOICE):
        check_name("renderer", chosen, RENDERERS, CHOICE)
        name, reason = chosen, f"{CHOICE} says so"
    else:
        reason = _trouble()
        if not reason:
            return RENDERERS["vtk"]
        name = "matplotlib"
    print(f"renderer: {name}, since {reason}", file=sys.stderr)
    return RENDERERS[name]


def _trouble():
    """The reason why VTK cannot be used, or None."""
    try:
        command = [sys.executable, "-c", PROBE]
        done = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT)
    except subprocess.TimeoutExpired:
        return f"the probe of vtk took more than {TIMEOUT} s"
    except OSError as error:
        return f"the probe of vtk did not start: {error}"
    if done.returncode < 0:
        return f"the probe of vtk was ended by: {signal.strsignal(-done.returncode)}"
    if done.returncode:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        return f"the probe of vtk ended with {last}"
    return None


def by_vtk(scene: Scene) -> np.ndarray:
    """The image of a scene by VTK's depth buffer."""
    if sys.platform == "linux":
        # By default VTK looks for a screen first, and warns.
        os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
    import pyvista

    width, height = scene.size
    plotter = pyvista.Plotter(
        off_screen=True, window_size=(FINER * width, FINER * height), lighting="none"
    )
    plotter.disable_anti_aliasing()
    plotter.background_color = "white"
    corners = np.arange(3 * len(scene.triangles)).reshape(-1, 3)
    faces = pyvista.PolyData.from_regular_faces(scene.triangles.reshape(-1, 3), corners)
    rgb = np.rint(255 * scene.colours.reshape(-1, 3)).astype(np.uint8)
    plotter.add_mesh(faces, scalars=rgb, rgb=True, lighting=False)
    if len(scene.lines):
        ends = np.insert(np.arange(2 * len(scene.lines)).reshape(-1, 2), 0, 2, axis=1)
        lines = pyvista.PolyData(scene.lines.reshape(-1, 3), lines=ends.ravel())
        ink = tuple(map(float, scene.ink))
        plotter.add_mesh(lines, color=ink, line_width=FINER * scene.width, lighting=False)
    camera = plotter.camera
    camera.parallel_projection, camera.parallel_scale = True, height / 2
    camera.focal_point = (width / 2, height / 2, 0)
    camera.position = (width / 2, height / 2, scene.triangles[..., 2].max() + width)
    camera.up = (0, 1, 0)
    plotter.renderer.ResetCameraClippingRange()
    raster = plotter.screenshot(return_img=True)
    plotter.close()
    return _image(raster)


def by_matplotlib(scene: Scene) -> np.ndarray:
    """The image of a scene by the painter's algorithm: farther triangles are drawn first."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.collections import TriMesh
    from matplotlib.figure import Figure
    from matplotlib.tri import Triangulation

    corners, lines = np.concatenate([scene.triangles, scene.colours], axis=-1), scene.lines
    while len(corners) < SMALL:
        corners, lines = _quarters(corners), _halves(lines)
    depth = np.concatenate([corners[..., 2].mean(1), np.repeat(_in_front(lines, corners), 2)])
    # Agg draws triangles wider by half a pixel of the raster on every side.
    inked = np.insert(_ribbons(lines, scene.width - 1 / FINER), [3, 3, 3], scene.ink, axis=-1)
    corners = np.concatenate([corners, inked])[np.argsort(depth, kind="stable")].reshape(-1, 6)
    figure = Figure(figsize=scene.size, dpi=FINER)
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, scene.size[0]), ylim=(0, scene.size[1]))
    axes.axis("off")
    canvas = FigureCanvasAgg(figure)
    painted = TriMesh(Triangulation(*corners[:, :2].T, np.arange(len(corners)).reshape(-1, 3)))
    painted.set_facecolor(corners[:, 3:])
    axes.add_collection(painted, autolim=False)
    canvas.draw()
    return _image(np.asarray(canvas.buffer_rgba())[..., :3])


def _in_front(lines, triangles):
    """Depths that sort lines after the triangles that meet there."""
    lengths = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=-1)
    steepest = np.ptp(triangles[..., 2], axis=1).max()
    return lines[..., 2].mean(1) + np.minimum(lengths, steepest)


def _ribbons(lines, width):
    """Lines (S, 2, 3) as triangles (2 S, 3, 3), two each, `width` wide."""
    a, b = lines.swapaxes(0, 1)
    along = (b - a)[:, :2] / np.maximum(np.linalg.norm((b - a)[:, :2], axis=1), 1e-9)[:, None]
    aside = np.stack([-along[:, 1], along[:, 0], np.zeros(len(a))], axis=1) * width / 2
    halves = [(a - aside, b - aside, b + aside), (a - aside, b + aside, a + aside)]
    return np.stack([np.stack(h, axis=1) for h in halves], axis=1).reshape(-1, 3, 3)


def _quarters(corners):
    """Triangles (F, 3, k) cut into four each, (4 F, 3, k)."""
    a, b, c = corners.swapaxes(0, 1)
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    cut = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.stack([np.stack(corner, axis=1) for corner in cut], axis=1).reshape(
        -1, 3, a.shape[-1]
    )


def _halves(lines):
    """Lines (S, 2, 3) cut into two each, (2 S, 2, 3)."""
    a, b = lines.swapaxes(0, 1)
    middle = (a + b) / 2
    return np.concatenate([np.stack((a, middle), axis=1), np.stack((middle, b), axis=1)])


def _image(raster):
    """Means over the FINER x FINER pixels of a raster."""
    height, width, _ = raster.shape
    blocks = raster.reshape(height // FINER, FINER, width // FINER, FINER, 3)
    return np.rint(blocks.mean((1, 3))).astype(np.uint8)


RENDERERS = {"vtk": by_vtk, "matplotlib": by_matplotlib}
