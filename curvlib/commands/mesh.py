"""`curvlib mesh`: a mesh of a surface, with exact curvature."""

import click

from .terminal import PATH, json_option, names_of, put_json


@click.command()
@click.argument("surface", metavar="SURFACE", shell_complete=names_of("surfaces"))
@click.option(
    "-n", type=click.IntRange(2), required=True, metavar="N", help="Steps of the grid, each way."
)
@click.option(
    "-o", "--output", metavar="OUT", type=PATH, required=True, help="As of `curvlib estimate`."
)
@click.option(
    "--diagonal",
    type=click.Choice(["same", "alternate", "random", "shortest"]),
    default="same",
    show_default=True,
    help="How the quadrilaterals of the grid are cut.",
)
@click.option("--seed", type=int, default=0, metavar="N", help="Of random diagonals. Default: 0.")
@json_option
def command(surface, n, output, diagonal, seed, as_json):
    """Make a mesh with exact K, H, k1, k2, d1 and d2.

    SURFACE is a name of `curvlib list` or the path of a .py file.
    """
    import curvlib
    from curvlib.columns import EXACT
    from curvlib.meshes.writing import check_output, write

    check_output(output)
    random = {"seed": seed} if diagonal == "random" else {}
    mesh = curvlib.tessellate(curvlib.surface(surface), n, diagonal=diagonal, **random)
    named = {name: getattr(mesh, name) for name in ("normals", *EXACT)}
    write(output, mesh, {name: x for name, x in named.items() if x is not None})
    vertices, triangles = len(mesh.vertices), len(mesh.faces)
    if as_json:
        document = {"surface": surface, "vertices": vertices, "triangles": triangles}
        put_json(document | {"written": output})
        return
    print(f"{output}: {vertices} vertices, {triangles} triangles, with exact curvature")
    print(f"next: curvlib estimate {output}")
