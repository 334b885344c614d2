"""Pictures of surfaces, meshes, exact curvature and errors of the estimates.

Each is composed of images from `draw`, Scene -> image, a function of `render`. A surface's module
has LABEL; UP, the axis that points up (default z); and CLOSE_UP, a part of the domain
((u0, u1), (v0, v1)) with large errors, shown enlarged.
"""

import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import AsinhNorm, LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from curvlib.comparison.norms import ROUNDING, largest_curvature, rounding_level
from curvlib.comparison.quantities import QUANTITIES, difference

from .style import DPI, PIXELS, SMALL, WITH_EXPONENTS, in_lines, in_style
from .views import View, edges, iso_lines

GAP = 24  # pixels around an image

# RdYlBu puts zero at pale yellow, which differs from the white page and from NEUTRAL also for
# colour-blind readers.
DIVERGING, SEQUENTIAL = (matplotlib.colormaps[name] for name in ("RdYlBu_r", "viridis"))
NEUTRAL = (0.78, 0.78, 0.78)
AMBIENT = 0.8  # share of ambient light where colours encode values
COVERED = 0.99  # share of the area, or of the errors, within the ends of a scale
FLAT = AsinhNorm(1, -1, 1)  # for values that are zero everywhere


@in_style
def surface_plate(meshes, numbers, modules, draw) -> Figure:
    """The surfaces with iso-parameter lines, named and numbered: the paper's Figure 1.

    `meshes`: (surface, diagonal, n) -> Mesh; `numbers` and `modules`: of every surface, by name.
    """
    plate = _Plate(len(meshes), below=50)
    for ((surface, _, n), mesh), panel in zip(meshes.items(), plate.panels):
        panel.show(draw(_view(mesh, modules[surface], panel).scene(edges=iso_lines(mesh, n))))
        panel.title(f"({numbers[surface]}) {modules[surface].LABEL}")
    return plate.figure


@in_style
def tessellation_plate(meshes, modules, draw) -> Figure:
    """Flat-shaded meshes with edges and triangle counts: the paper's Figure 2."""
    plate = _Plate(len(meshes), below=50, shape=0.8)
    for number, (((surface, *_), mesh), panel) in enumerate(zip(meshes.items(), plate.panels), 1):
        view = _view(mesh, modules[surface], panel)
        # Thinner lines on finer meshes, lest the edges cover them.
        width = float(np.clip(30 / np.sqrt(len(mesh.faces)), 0.35, 1.2))
        panel.show(draw(view.scene(edges=edges(mesh), flat=True, width=width)))
        panel.title(f"({number}) {len(mesh.faces)} triangles")
    return plate.figure


@in_style
def curvature_map(meshes, quantity: str, modules, draw) -> Figure:
    """The surfaces coloured by an exact quantity, each on its own scale with zero in the middle.

    Scales are linear up to the area-weighted median of the absolute values, then logarithmic up to
    their quantile COVERED.
    """
    plate = _Plate(len(meshes), below=120, foot=90, columns=(5, 4))
    for ((surface, *_), mesh), panel in zip(meshes.items(), plate.panels):
        values = getattr(mesh, quantity)
        norm = _around_zero(values, mesh, rounding_level(quantity, largest_curvature(mesh)))
        colours = _colours(values, norm, DIVERGING)
        panel.show(draw(_view(mesh, modules[surface], panel).scene(colours, ambient=AMBIENT)))
        panel.title(modules[surface].LABEL)
        if norm is not FLAT:
            panel.scale(norm, DIVERGING, values)
        elif np.isfinite(values).any():
            panel.text(0.5, -52 / panel.size[1], f"{quantity} = 0", ha="center")
    _, name, unit, *_ = QUANTITIES[quantity]
    words = (
        f"Exact {name} in {unit}. Each scale is linear up to the median of |{quantity}| over the "
        f"area and logarithmic from there; {COVERED:.0%} of the area lies within, the rest beyond "
        "the arrows."
    )
    plate.words(in_lines(words, 85))
    if any(np.isnan(getattr(mesh, quantity)).any() for mesh in meshes.values()):
        plate.neutral("no exact value")
    return plate.figure


@in_style
def error_map(mesh, estimates, quantity: str, surface, modules, draw) -> Figure:
    """The error of each estimator over one mesh.

    `estimates`: name -> estimates by quantity; `surface`: the surface's module; `modules`: the
    estimators'. One logarithmic scale for all, from the quantile 1 - COVERED of all errors to
    COVERED.
    """
    symbol, _, unit, _, error, _ = QUANTITIES[quantity]
    errors = {}
    for name, values in estimates.items():
        estimate = getattr(values, quantity, None)
        if estimate is not None and np.isfinite(estimate).any():
            errors[name] = error(getattr(mesh, quantity), estimate)
    every = np.concatenate([[], *errors.values()])
    norm = _logarithmic(every)
    part = getattr(surface, "CLOSE_UP", None)
    plate = _Plate(len(errors), below=50, foot=135, shape=0.52 if part else 1.0)
    for (name, values), panel in zip(errors.items(), plate.panels):
        colours = _colours(values, norm, SEQUENTIAL)
        for half, shown in zip(panel.halves() if part else [panel], (None, part)):
            scene = _view(mesh, surface, half, shown).scene(colours, ambient=AMBIENT)
            half.show(draw(scene), framed=shown is not None)
        panel.title(modules[name].LABEL)
    plate.words(f"{surface.LABEL}\n{len(mesh.faces)} triangles")
    plate.scale(norm, SEQUENTIAL, every, f"{difference(quantity, symbol)} ({unit})")
    plate.neutral("undefined")
    return plate.figure


def _view(mesh, module, panel, part=None):
    return View(mesh, panel.size, getattr(module, "UP", "z"), part)


def _colours(values, norm, colormap):
    """Colours (V, 3) of values (V,), NEUTRAL where they are NaN."""
    colours = colormap(norm(np.nan_to_num(values)))[:, :3]
    return np.where(np.isfinite(values)[:, None], colours, NEUTRAL)


def _around_zero(values, mesh, rounding):
    """The norm of a map of exact values, FLAT where none exceeds `rounding`."""
    a, b, c = mesh.vertices[mesh.faces].swapaxes(0, 1)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    areas = np.bincount(mesh.faces.ravel(), np.repeat(areas, 3), len(values))
    order = np.argsort(np.abs(values), kind="stable")[: np.isfinite(values).sum()]
    sizes, covered = np.abs(values[order]), np.cumsum(areas[order])
    if not (sizes > rounding).any():
        return FLAT
    typical, limit = np.interp([0.5, COVERED], covered / covered[-1], sizes)
    limit = max(limit, sizes[-1] / 1000)  # the quantile is 0 where nearly all values are
    return AsinhNorm(max(typical, limit / 1000), -limit, limit)


def _logarithmic(values):
    """A logarithmic norm from the quantile 1 - COVERED of the positive values to COVERED."""
    some = values[values > 0]
    low, high = np.quantile(some, [1 - COVERED, COVERED]) if len(some) else (1, 1)
    return LogNorm(low, max(high, 10 * low), clip=True)


class _Plate:
    """A figure of panels in rows: `below` pixels for text under each image, `foot` pixels for the
    common legend; `shape` is the height of an image over its width; `columns`: how many there may
    be, the number that leaves the fewest places empty."""

    def __init__(self, count, below, foot=0, shape=1.0, columns=(4, 3)):
        columns = min(columns, key=lambda c: -count % c)
        rows, cell = -(-count // columns), PIXELS // columns
        width, height = cell - GAP, round((cell - GAP) * shape)
        step = height + below + GAP
        top = foot + rows * step
        self.figure = Figure(figsize=(PIXELS / DPI, top / DPI), dpi=DPI)
        self.foot = _Panel(self.figure, GAP, 0, (PIXELS - 2 * GAP, foot))
        self.panels = []
        for k in range(count):
            row, column = divmod(k, columns)
            in_row = min(columns, count - row * columns)
            left = (PIXELS - in_row * cell + GAP) // 2 + column * cell
            bottom = top - (row + 1) * step + below
            self.panels.append(_Panel(self.figure, left, bottom, (width, height)))

    def words(self, text):
        self.foot.text(0, 0.5, text, ha="left")

    def scale(self, norm, colormap, values, label):
        width, height = self.foot.size
        axes = self.foot.axes(width // 4, height - 30, width // 2, 20)
        _bar(axes, norm, colormap, values).set_label(label, fontsize=WITH_EXPONENTS)

    def neutral(self, label):
        """A legend entry for NEUTRAL, the colour of undefined values."""
        handles = [Patch(color=NEUTRAL, label=label)]
        self.foot.axes(0, 0, *self.foot.size).legend(handles=handles, loc="right")


class _Panel:
    """The place of an image of `size` (width, height), in pixels."""

    def __init__(self, figure, left, bottom, size):
        self.figure, self.left, self.bottom, self.size = figure, left, bottom, size

    def halves(self):
        """Two panels side by side in the place of this one."""
        half = (self.size[0] - GAP) // 2
        lefts = (self.left, self.left + half + GAP)
        return [_Panel(self.figure, left, self.bottom, (half, self.size[1])) for left in lefts]

    def axes(self, left, bottom, width, height):
        """Invisible axes, placed relative to the lower left corner."""
        whole = np.array([PIXELS, self.figure.bbox.height] * 2)
        place = np.array([self.left + left, self.bottom + bottom, width, height])
        axes = self.figure.add_axes(place / whole)
        axes.axis("off")
        return axes

    def show(self, image, framed=False):
        axes = self.axes(0, 0, *self.size)
        axes.imshow(image, interpolation="nearest", aspect="auto")
        if framed:
            edge = {"color": "0.75", "linewidth": 0.8, "fill": False}
            axes.add_patch(Rectangle((0, 0), 1, 1, transform=axes.transAxes, **edge))

    def title(self, text):
        self.text(0.5, -22 / self.size[1], text, ha="center")

    def text(self, x, y, text, ha):
        self.axes(0, 0, *self.size).text(x, y, text, ha=ha, va="center", fontsize=7.5)

    def scale(self, norm, colormap, values):
        width = self.size[0]
        bar = _bar(self.axes(width // 20, -62, 9 * width // 10, 14), norm, colormap, values)
        bar.ax.tick_params(labelsize=SMALL)
        middle = float(f"{norm.inverse(0.75):.1g}")
        ticks = [norm.vmin, -middle, 0, middle, norm.vmax]
        labels = [f"{float(f'{t:.2g}'):g}".replace("-", "\N{MINUS SIGN}") for t in ticks]
        labels[1] = ""  # the scale is symmetric, and the place small
        bar.set_ticks(ticks, labels=labels)
        bar.minorticks_off()


def _bar(axes, norm, colormap, values):
    """A colour bar that fills the axes, with an arrow at each end that some value exceeds."""
    axes.axis("on")
    slack = ROUNDING * np.abs([norm.vmin, norm.vmax])
    low, high = (values < norm.vmin - slack[0]).any(), (values > norm.vmax + slack[1]).any()
    extend = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}[low, high]
    shown = ScalarMappable(norm, colormap)
    bar = axes.figure.colorbar(shown, axes, orientation="horizontal", extend=extend)
    bar.outline.set_visible(False)
    axes.tick_params(length=2, which="both")
    return bar
