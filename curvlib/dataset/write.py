"""Write the library: every mesh in every format, and the surface that it samples."""

from pathlib import Path

from curvlib.files import whole_file
from curvlib.nurbs.surface import Surface
from curvlib.nurbs.tessellation import tessellate

from .formats import write_ply, write_text
from .library import KINDS, mesh_files, nurbs_file
from .sums import write_sums
from .vtkhdf import write_vtkhdf

CONVENTIONS = (
    "exact at the vertices, pointwise; lengths in the unit of the mesh, K in 1/length^2, H in "
    "1/length; H > 0 where the surface bends away from its outward normal; NaN where the "
    "surface is not C^2"
)

WRITERS = dict(zip(KINDS, (write_vtkhdf, write_ply, write_text), strict=True))


def write_library(surface: Surface, meshes, folder) -> None:
    """Tessellate a surface for every (diagonal, n) of `meshes` and write the files of each mesh.

    SHA256SUMS lists the files that are loaded. Files are whole or not there; raises InputError
    where the system refuses one, as on a full disk.
    """
    for diagonal, n in meshes:
        mesh = tessellate(surface, n, diagonal)
        about = {
            "surface": f"{surface.label} ({surface.name})",
            "mesh": f"{n} x {n} cells, diagonal {diagonal}, "
            f"{len(mesh.faces)} triangles, {len(mesh.vertices)} vertices",
            "values": CONVENTIONS,
            "source": f"curvlib, from the NURBS surface in {nurbs_file(surface.name)}",
        }
        for file, write in zip(mesh_files(surface.name, diagonal, n), WRITERS.values()):
            with whole_file(Path(folder, file)) as part:
                write(part, mesh, about)
    loaded = [Path(mesh_files(surface.name, *mesh)[0]).name for mesh in meshes]
    write_sums(Path(folder, surface.name), loaded)


def write_nurbs(surface: Surface, folder) -> None:
    """Write the surface itself, for `geomdl.exchange.import_json`."""
    from geomdl.exchange import export_json

    with whole_file(Path(folder, nurbs_file(surface.name))) as part:
        export_json(surface.model, str(part))
