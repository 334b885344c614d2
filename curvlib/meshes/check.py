"""A mesh described, and what is wrong with it for curvature."""

from collections import namedtuple

import numpy as np

from curvlib.kit.ring import FLAT, ROUNDING

from .mend import Edges, once, orient, weld
from .mesh import Mesh
from .neighbourhoods import BROKEN, CLOSED
from .roughness import noise, staircase

SLIVER = 1.0  # degrees: a triangle with a smaller angle

Fault = namedtuple("Fault", "name count of where remedy")
Fault.__doc__ = """One kind of fault.

Attributes
----------
name : str
count : int
of : str
    Of what there are so many: "vertices", "edges", "triangles" or "components".
where : ndarray of int
    Their indices in the mesh; of edges their two vertices, (count, 2); of a component its first
    triangle.
remedy : str
    How curvlib deals with it, or what to do.
"""

Report = namedtuple(
    "Report",
    "vertices triangles components closed genus boundaries low high edges volume area noise "
    "staircase faults",
)
Report.__doc__ = """What `check` finds.

Attributes
----------
vertices, triangles, components : int
    Components are connected through shared vertices.
closed : bool
    There is an edge, and each edge has two triangles.
genus : int or None
    The sum over the components of a closed mesh on which all vertices have disks; else None.
boundaries : int
    Loops of edges of one triangle.
low, high : (3,)
    Corners of the box around the vertices that triangles use.
edges : (5,)
    Quantiles 0, 0.25, 0.5, 0.75 and 1 of the lengths of edges, in the unit of the mesh.
volume : float
    Within a closed mesh, in the cube of its unit, negative if its triangles face inward; NaN of an
    open one.
area : float
    In the square of the unit.
noise : float
    The standard deviation of vertices from smooth pieces of surface, in mean edges: that of noise,
    or detail that the edges do not resolve; NaN where there are too few closed rings to tell.
staircase : bool
    The edges are steps of a lattice, as those of voxels.
faults : list of Fault
"""


def check(mesh: Mesh) -> Report:
    """Describe a mesh, and name what is wrong with it for curvature.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    Report

    Examples
    --------
    >>> from curvlib import Mesh
    >>> report = check(Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [9, 9, 9]], [[0, 1, 2]]))
    >>> report.closed, report.boundaries, report.area
    (False, 1, 0.5)
    >>> [(fault.name, fault.count) for fault in report.faults]
    [('vertices without a triangle', 1)]
    """
    given, (mesh, _, _) = mesh, once(mesh, mesh.find_adjacency().stars != CLOSED)
    edges = Edges(mesh.faces)
    used = np.zeros(len(mesh.vertices), dtype=bool)
    used[mesh.faces] = True
    # No square or cube of a length overflows or underflows.
    unit, vertices = mesh.unit, mesh.vertices * mesh.unit
    points = vertices[used] if used.any() else np.full((1, 3), np.nan)
    corners = vertices[mesh.faces]
    facets = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    ends = vertices[edges.ends]
    lengths = np.sqrt(((ends[:, 1] - ends[:, 0]) ** 2).sum(1))
    uses = np.bincount(edges.edge[edges.edge >= 0], minlength=len(edges.ends))
    closed = bool(len(uses)) and bool((uses == 2).all())
    components = _components(edges.ends, used)
    stars = mesh.find_adjacency().stars
    genus = None
    if closed and not (stars[used] == BROKEN).any():
        faces = np.count_nonzero(edges.edge[::3] >= 0)
        genus = int(2 * components - (used.sum() - len(edges.ends) + faces)) // 2
    rim, on_rim = edges.ends[uses == 1], np.zeros_like(used)
    on_rim[rim] = True
    origin = points[0]
    volume = ((corners[:, 0] - origin) * facets).sum() / 6 if closed else np.nan
    quantiles = np.quantile(lengths, np.linspace(0, 1, 5)) if len(lengths) else np.full(5, np.nan)
    rough = noise(mesh)
    area = np.sqrt((facets * facets).sum(1)).sum() / 2
    return Report(
        vertices=len(mesh.vertices),
        triangles=len(mesh.faces),
        components=components,
        closed=closed,
        genus=genus,
        boundaries=_components(rim, on_rim),
        low=points.min(0) / unit,
        high=points.max(0) / unit,
        edges=quantiles / unit,
        volume=float(volume) / unit / unit / unit,
        area=float(area) / unit / unit,
        noise=rough,
        staircase=staircase(ends[:, 1] - ends[:, 0], rough),
        faults=[
            fault
            for fault in _faults(given, mesh, edges, uses, used, stars, corners, facets)
            if fault.count
        ],
    )


def _faults(given, mesh, edges, uses, used, stars, corners, facets):
    """Yield each kind of Fault, with those of no count; `mesh` is the one that is `given` without
    triangles that are there again."""
    nowhere, none = np.isnan(mesh.vertices[:, 0]), np.zeros(len(mesh.faces), dtype=bool)
    yield _fault(
        "vertices whose position is not finite",
        "vertices",
        nowhere,
        "have no value; left out, and triangles at them",
    )
    gone = none if mesh.left_out is None else mesh.left_out
    again = gone if given.left_out is None else gone & ~given.left_out
    every = "; every one is there twice" if len(again) == 2 * again.sum() else ""
    words = f"left out, whichever side they face{every}"
    yield _fault("triangles that are there again", "triangles", again, words)
    _, index = weld(given)
    joined = np.flatnonzero(index != np.arange(len(index)))
    yield Fault(
        "vertices that stand where another does",
        len(joined),
        "vertices",
        joined,
        "joined for an estimate; curvlib.weld joins them in the mesh",
    )
    yield _fault("vertices without a triangle", "vertices", ~used & ~nowhere, "have no value")
    many = edges.ends[uses > 2]
    yield Fault(
        "edges of more than two triangles",
        len(many),
        "edges",
        many,
        "their vertices have no value: remove the inner triangles, or split the mesh there",
    )
    first, second = edges.pairs().T
    same = edges.forward[first] == edges.forward[second]
    against = edges.ends[edges.edge[first[same]]]
    yield Fault(
        "edges whose two triangles face opposite sides",
        len(against),
        "edges",
        against,
        "their vertices have no value: curvlib.orient, or --orient",
    )
    known = np.zeros(len(used), dtype=bool)
    known[many], known[against] = True, True
    yield _fault(
        "vertices where surfaces touch in a point",
        "vertices",
        (stars == BROKEN) & used & ~known,
        "have no value: split the vertex, one for each surface",
    )
    _, turned = orient(mesh)
    inward = _inward(mesh, edges, turned)
    yield Fault(
        "closed components that face inward",
        len(inward),
        "components",
        inward,
        "H has the other sign: curvlib.orient, or --orient",
    )
    twice = edges.edge[::3] < 0
    yield _fault("triangles that name a vertex twice", "triangles", twice & ~gone, "left out")
    sides = corners - np.roll(corners, 1, axis=1)
    squares = (sides * sides).sum(2)
    total, double = squares.sum(1), np.sqrt((facets * facets).sum(1))
    size = np.abs(corners).max((1, 2), initial=0)
    flat = double <= np.sqrt(total * ((FLAT**2) * total + (ROUNDING * size) ** 2))
    yield _fault(
        "triangles without area",
        "triangles",
        flat & ~twice,
        "one-ring estimators have no value at their corners: collapse them, or use a fit",
    )
    with np.errstate(invalid="ignore", divide="ignore"):
        longest = np.sqrt(np.sort(squares, axis=1))
        angle = np.degrees(np.arcsin(np.minimum(double / (longest[:, 1] * longest[:, 2]), 1)))
    yield _fault(
        f"triangles with an angle below {SLIVER:g} degree",
        "triangles",
        (angle < SLIVER) & ~flat & ~twice,
        "values at their corners are worth little: a fit over rings or a radius is better",
    )


def _fault(name, of, mask, remedy):
    where = np.flatnonzero(mask)
    return Fault(name, len(where), of, where, remedy)


def _inward(mesh, edges, turned):
    """The first triangle of each closed component that faces inward: `orient` turns all of it."""
    if not turned.any():
        return np.zeros(0, dtype=np.intp)
    component = _labels(edges.face[edges.pairs()], len(mesh.faces))
    number = component.max() + 1
    share = np.bincount(component, turned, number) / np.bincount(component, minlength=number)
    open_ = np.bincount(component[edges.face[edges.uses == 1]], minlength=number) > 0
    _, first = np.unique(component, return_index=True)
    return first[(share == 1) & ~open_]


def _components(pairs, among):
    """The number of components of vertices (V,) bool that pairs (n, 2) connect."""
    return len(np.unique(_labels(pairs, len(among))[among]))


def _labels(pairs, count):
    """(count,) the number of each one's component."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    a, b = pairs.T
    return connected_components(
        coo_matrix((np.ones(len(a), bool), (a, b)), (count, count)), directed=False
    )[1]
