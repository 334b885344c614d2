"""Pictures: both renderers show the same, colours mean what the scales say, the same bytes."""

from types import SimpleNamespace

import numpy as np
import pytest

import curvlib
from curvlib.catalogue import estimators, surfaces
from curvlib.figures import pictures, render, views
from curvlib.figures.style import save

RENDERERS = ["vtk", "matplotlib"]
MODULES = {
    name: SimpleNamespace(LABEL=name.title())
    for name in ("cone", "sphere", "good", "bad", "of_K_alone")
}


@pytest.fixture(scope="module", params=RENDERERS)
def draw(request):
    if request.param == "vtk" and (trouble := render._trouble()):
        pytest.skip(trouble)
    return render.RENDERERS[request.param]


@pytest.fixture(scope="module")
def spout():
    return curvlib.tessellate(curvlib.surface("teapot_spout"), 16)


def mesh(name, n=16):
    return curvlib.tessellate(curvlib.surface(name), n)


def square(x, y, z, colour, side=20):
    """Two triangles that make a square, and their colours."""
    a, b, c, d = ((x + i * side, y + j * side, z) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
    return [(a, b, c), (a, c, d)], [[colour] * 3] * 2


def test_what_is_nearer_hides_what_is_farther(draw):
    red, blue, ink = (1, 0, 0), (0, 0, 1), (0, 1, 0)
    near, far = square(10, 10, 5, red), square(20, 10, -5, blue)
    for one, other in ((near, far), (far, near)):
        triangles, colours = (np.array(one[k] + other[k], dtype=float) for k in (0, 1))
        lines = np.array([[[0, 35, 0], [60, 35, 0]], [[5, 15, -20], [60, 15, -20]]], dtype=float)
        image = draw(render.Scene((60, 40), triangles, colours, lines, ink, 2.0))
        assert image.shape == (40, 60, 3)
        seen = {
            (25, 20): red,  # where both are
            (37, 20): blue,
            (50, 20): (1, 1, 1),
            (50, 35): ink,  # a line over nothing
            (15, 15): red,  # a line behind the square
            (55, 15): ink,
        }
        for (x, y), colour in seen.items():
            np.testing.assert_allclose(image[39 - y, x] / 255, colour, atol=0.02)


def test_colours_run_from_corner_to_corner(draw):
    triangles = np.array([[[0, 0, 0], [60, 0, 0], [0, 60, 0.0]]])
    image = draw(render.Scene((60, 60), triangles, np.eye(3)[None], np.zeros((0, 2, 3))))
    for (x, y), corner in (((0, 0), 0), ((57, 1), 1), ((1, 57), 2)):
        assert image[59 - y, x].argmax() == corner
    np.testing.assert_allclose(image[39, 20], 255 / 3, atol=8)


@pytest.mark.parametrize("up", ["y", "z"])
def test_both_renderers_see_the_same(spout, up):
    if trouble := render._trouble():
        pytest.skip(trouble)
    scene = views.View(spout, (200, 160), up).scene(edges=views.iso_lines(spout, 16))
    one, other = (render.RENDERERS[name](scene).astype(float) for name in RENDERERS)
    shown, too = ((image < 250).any(-1) for image in (one, other))
    assert 0.2 < shown.mean() < 0.9
    assert (shown & too).sum() > 0.97 * (shown | too).sum()
    assert np.abs(one - other).mean() < 4
    rows, columns = np.flatnonzero(shown.any(1)), np.flatnonzero(shown.any(0))
    margins = rows[0], 159 - rows[-1], columns[0], 199 - columns[-1]
    assert 2 <= min(margins) <= 5, "as large as fits"


def test_close_up_shows_that_part(spout):
    everything, lip = (
        views.View(spout, (100, 100), "y", part).points for part in (None, ((1, 2), (0, 2)))
    )
    on_lip = spout.uv[:, 0] >= 1
    assert np.ptp(everything[:, :2], axis=0).max() == pytest.approx(96)
    assert np.ptp(lip[on_lip, :2], axis=0).max() == pytest.approx(96)
    assert lip[~on_lip, :2].min() < 0


def test_iso_lines_run_through_poles():
    sphere = mesh("sphere", 20)
    assert len(views.iso_lines(sphere, 20)) == 10 * 20 + 9 * 20
    cone = mesh("cone", 20)
    assert len(views.iso_lines(cone, 20)) == 10 * 20 + 11 * 20


@pytest.mark.parametrize(
    ("probe", "reason"),
    [
        ("import os; os.kill(os.getpid(), 11)", "ended by: Segmentation fault"),
        ("raise ValueError('no\\nscreen')", "ended with screen"),
        ("raise SystemExit(3)", "ended with no message"),
        ("import time; time.sleep(9)", "took more than 0.5 s"),
    ],
)
def test_without_opengl_matplotlib_draws(monkeypatch, capsys, probe, reason):
    monkeypatch.delenv(render.CHOICE, raising=False)
    monkeypatch.setattr(render, "PROBE", probe)
    monkeypatch.setattr(render, "TIMEOUT", 0.5 if "sleep" in probe else 60)
    assert render.renderer() is render.by_matplotlib
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("renderer: matplotlib, since the probe of vtk")
    assert line.endswith(reason)


def test_a_renderer_that_does_not_exist(monkeypatch):
    monkeypatch.setenv(render.CHOICE, "vkt")
    with pytest.raises(curvlib.InputError, match=r"RENDERER: .*'vkt'; .*valid: vtk, matplotlib$"):
        render.renderer()


@pytest.mark.parametrize("name", RENDERERS)
def test_a_renderer_can_be_chosen(monkeypatch, capsys, name):
    monkeypatch.setenv(render.CHOICE, name)
    assert render.renderer() is render.RENDERERS[name]
    assert capsys.readouterr().err == f"renderer: {name}, since CURVLIB_RENDERER says so\n"


def test_the_same_bytes_each_time(draw, tmp_path):
    meshes = {("sphere", "same", 16): mesh("sphere"), ("cone", "same", 16): mesh("cone")}
    made = []
    for name in "ab":
        save(pictures.curvature_map(meshes, "H", MODULES, draw), tmp_path / f"{name}.png")
        made.append((tmp_path / f"{name}.png").read_bytes())
    assert made[0] == made[1]


class Recorder:
    """Draws nothing and keeps the scenes."""

    def __init__(self):
        self.scenes = []

    def __call__(self, scene):
        self.scenes.append(scene)
        return np.full((*scene.size[::-1], 3), 255, dtype=np.uint8)


def texts(figure):
    return [text.get_text() for axes in figure.axes for text in axes.texts if text.get_text()]


def legend(figure):
    return [
        t.get_text() for axes in figure.axes if axes.get_legend() for t in axes.get_legend().texts
    ]


def arrows(figure):
    """At which ends the colour bars have one."""
    return [axes._colorbar.extend for axes in figure.axes if hasattr(axes, "_colorbar")]


def hue(colours):
    """Colours without what light does to them."""
    return colours / colours.max(-1, keepdims=True)


def test_figure_1_is_numbered_as_the_paper():
    drawn = pictures.surface_plate(
        {("sphere", "same", 16): mesh("sphere"), ("cone", "same", 16): mesh("cone")},
        {"cone": 2, "sphere": 3},
        MODULES,
        Recorder(),
    )
    assert texts(drawn) == ["(3) Sphere", "(2) Cone"]


def test_figure_2_counts_its_triangles(spout):
    meshes = {("cone", "same", n): mesh("cone", n) for n in (8, 12)}
    draw = Recorder()
    drawn = pictures.tessellation_plate(meshes, MODULES, draw)
    assert texts(drawn) == ["(1) 128 triangles", "(2) 288 triangles"]
    assert [len(scene.lines) for scene in draw.scenes] == [3 * 64 + 8, 3 * 144 + 12]
    assert np.ptp(draw.scenes[0].colours, axis=1).max() == 0, "one light per facet"


def test_curvature_has_its_colours_and_scales(spout):
    draw = Recorder()
    modules = MODULES | {"teapot_spout": SimpleNamespace(LABEL="Spout", UP="y")}
    meshes = {("sphere", "same", 16): mesh("sphere"), ("cone", "same", 16): mesh("cone")}
    sphere = meshes["sphere", "same", 16]
    sphere.K = sphere.K * np.where(np.arange(len(sphere.K)) == 0, 1 + 1e-12, 1)
    drawn = pictures.curvature_map(meshes, "K", modules, draw)
    ball, cone = draw.scenes
    for scene, place in ((ball, 1.0), (cone, 0.5)):
        colour = hue(np.array(pictures.DIVERGING(place)[:3]))
        assert np.abs(hue(scene.colours) - colour).max() < 1e-6
    assert "1/length²" in texts(drawn)[-1]
    assert not legend(drawn)
    scales = [[t.get_text() for t in a.get_xticklabels()] for a in drawn.axes if a.axison]
    assert scales == [["\N{MINUS SIGN}1", "", "0", "0.5", "1"]]
    assert texts(drawn)[1:3] == ["Cone", "K = 0"]
    assert arrows(drawn) == ["neither"], "rounding is not beyond the scale"
    drawn = pictures.curvature_map({("teapot_spout", "same", 16): spout}, "K", modules, draw)
    assert legend(drawn) == ["no exact value"]
    grey = np.ptp(draw.scenes[-1].colours, axis=-1) == 0
    assert set(spout.faces[grey]) == set(np.flatnonzero(np.isnan(spout.K)))
    assert arrows(drawn) == ["both"]


@pytest.mark.parametrize("quantity", ["K", "H"])
def test_pictures_are_legible_in_print(quantity, printed):
    """Of all surfaces and estimators of the package, which have the longest names."""
    names = curvlib.surfaces()
    draw, modules = Recorder(), surfaces.modules({name: name for name in names})
    meshes = {(name, "same", 12): mesh(name, 12) for name in names}
    printed(pictures.curvature_map(meshes, quantity, modules, draw))
    numbers = {name: number for number, name in enumerate(names, 1)}
    printed(pictures.surface_plate(meshes, numbers, modules, draw))
    printed(pictures.tessellation_plate(meshes, modules, draw))
    spout, nine = (
        meshes["teapot_spout", "same", 12],
        estimators.modules({name: name for name in curvlib.estimators()}),
    )
    estimates = dict.fromkeys(nine, SimpleNamespace(K=spout.K * 1.1, H=spout.H * 1.1))
    surface = modules["teapot_spout"]
    printed(pictures.error_map(spout, estimates, quantity, surface, nine, draw))


@pytest.mark.parametrize("known", [0, 1])
def test_curvature_that_is_hardly_anywhere(known):
    m = mesh("cone")
    m.H = np.where(np.arange(len(m.H)) < known, m.H, np.nan)
    draw = Recorder()
    drawn = pictures.curvature_map({("cone", "same", 16): m}, "H", MODULES, draw)
    assert legend(drawn) == ["no exact value"]
    assert "H = 0" not in texts(drawn)
    coloured = np.ptp(draw.scenes[0].colours, axis=-1) > 0
    assert set(m.faces[coloured]) == set(range(known))


def test_error_map_has_one_scale_and_leaves_out_who_has_no_values():
    cone, draw = mesh("cone"), Recorder()
    nan, inner = np.full(len(cone.H), np.nan), ~cone.boundary
    estimates = {
        "good": SimpleNamespace(K=nan, H=np.where(inner, -cone.H * 1.001, np.nan)),
        "bad": SimpleNamespace(K=nan, H=np.where(inner, cone.H * 2, np.nan)),
        "of_K_alone": SimpleNamespace(K=cone.K, H=nan),
    }
    drawn = pictures.error_map(cone, estimates, "H", MODULES["cone"], MODULES, draw)
    assert texts(drawn) == ["Good", "Bad", f"Cone\n{len(cone.faces)} triangles"]
    assert legend(drawn) == ["undefined"]
    (scale,) = (axes for axes in drawn.axes if axes.axison)
    assert scale.get_xlabel() == r"$||H| - |H_\mathrm{est}||$ (1/length)"
    assert scale.get_xscale() == "log"
    good, bad = draw.scenes
    shown = inner[cone.faces]
    assert (np.ptp(good.colours[~shown], axis=-1) == 0).all(), "no estimate: grey"
    assert good.colours[shown][:, 2].mean() > good.colours[shown][:, 1].mean(), "violet"
    assert bad.colours[shown][:, 1].mean() > 2 * bad.colours[shown][:, 2].mean(), "yellow"
    surface = SimpleNamespace(LABEL="Cone", CLOSE_UP=((0, 1), (0, 0.2)))
    estimates["bad"].H[inner.argmax()] = 1e6
    drawn = pictures.error_map(cone, estimates, "H", surface, MODULES, draw)
    assert len(draw.scenes) == 2 + 4
    assert arrows(drawn) == ["max"]
