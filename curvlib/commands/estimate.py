"""`curvlib estimate`: curvature of meshes into files, with a summary."""

import time
from pathlib import Path

import click

from .first_use import compiled_beside
from .mending import mended
from .options import options_of
from .summary import document, regions, text
from .terminal import (
    PATH,
    check_picture,
    json_option,
    names_of,
    progress,
    progress_of_work,
    put_json,
    threads_option,
    told_of_compiling,
    told_warnings,
    write_csv,
)

SET = "An option of the estimator, as `curvlib list NAME` tells them; may be repeated."
Y_UP = (".obj", ".glb", ".gltf")  # the latter two by definition
# The quantities that the terminal shows, of an estimator that has them.
SHOWN = ("K", "H", "k1", "k2", "K_error", "H_error", "k1_error", "k2_error")


def _quantities(context, parameter, begun):
    from curvlib.columns import QUANTITIES

    return [name for name in QUANTITIES if name.startswith(begun)]


@click.command()
@click.argument("meshes", nargs=-1, required=True, metavar="MESH...", type=PATH)
@click.option(
    "-e",
    "--estimator",
    "names",
    multiple=True,
    metavar="NAME",
    shell_complete=names_of("estimators", "peers"),
    help="A name of `curvlib list` or the path of a .py file; may be repeated. Without: the "
    "recommended one.",
)
@click.option(
    "-o",
    "--output",
    metavar="OUT",
    type=PATH,
    help=".vtp .vtk .vtkhdf .ply .csv .parquet .gii .curv; {stem} in it stands for the mesh's "
    "name, as in out/{stem}.vtp.",
)
@click.option("--rings", type=int, metavar="K", help="How many rings of neighbours.")
@click.option("--radius", metavar="R", help='A length in the mesh\'s unit, or "5 edges".')
@click.option("--set", "chosen", multiple=True, metavar="option=value", help=SET)
@click.option(
    "--quantity",
    "quantities",
    multiple=True,
    metavar="NAME",
    shell_complete=_quantities,
    help="Of K H k1 k2 d1 d2 shape_index curvedness category bending_energy K_error H_error "
    "k1_error k2_error crease; may be repeated. Default: all that there are.",
)
@click.option(
    "--c0",
    type=float,
    default=0.0,
    metavar="C0",
    help="Spontaneous curvature of the bending energy (2 H - C0)^2 / 2. Default: 0.",
)
@click.option(
    "--creases",
    type=click.Choice(["ignore", "one-sided", "nan"]),
    help="Where the surface bends sharply: cut there, with the values of the larger side or none. "
    "Default: one-sided of adaptive_fit, ignore of others.",
)
@click.option("--per", type=click.Choice(["vertex", "face"]), help="Default: vertex.")
@click.option(
    "--columns",
    type=click.Choice(["curvlib", "pycurv"]),
    default="curvlib",
    help="Names of the columns; pycurv's are per face.",
)
@click.option(
    "--by",
    metavar="LABEL",
    type=PATH,
    help="Statistics over the area by region: to OUT if it is a .csv, with percentiles and "
    "histograms, else to the terminal. LABEL: data of the mesh's file, or a .label.gii or .annot "
    "file.",
)
@click.option("--weld", is_flag=True, help="Join points at one place in what is written, too.")
@click.option("--orient", is_flag=True, help="Turn triangles to agree, and outward if closed.")
@click.option(
    "--picture", metavar="PNG", type=PATH, help="A picture of the first quantity, K by default."
)
@click.option(
    "--up",
    type=click.Choice(["x", "y", "z"]),
    help="The axis that points up in a picture. Default: y of .obj, .glb and .gltf, else z.",
)
@json_option
@threads_option
def command(meshes, names, output, per, columns, by, picture, **options):
    """Estimate curvature at the vertices of meshes.

    K and H are pointwise, H > 0 where the surface bends away from its normal; NaN is undefined.
    """
    per = per or ("face" if columns == "pycurv" else "vertex")
    outputs = _outputs(meshes, output, per), _outputs(meshes, picture, None)
    told = []
    with compiled_beside(names):
        for mesh, out, png in progress(list(zip(meshes, *outputs)), lambda item: item[0]):
            with told_warnings() as warnings, told_of_compiling():
                found = _run(mesh, names, out, png, per, columns, by, options)
            told.append(found | {"warnings": warnings})
    if options["as_json"]:
        put_json(told if len(told) > 1 else told[0])


def _outputs(meshes, pattern, per):
    """The path that is written for each mesh, None without a pattern; all are checked before any
    estimate. `per` is None for a picture."""
    if pattern is None:
        return [None] * len(meshes)
    from curvlib.errors import InputError
    from curvlib.meshes.writing import check_output

    paths = [pattern.replace("{stem}", Path(mesh).stem) for mesh in meshes]
    if len(set(paths)) < len(paths):
        raise InputError(
            f"{pattern!r} would be written for more than one mesh; name it with {{stem}}, such as "
            f"{{stem}}{Path(pattern).suffix}, and meshes of different names"
        )
    for mesh, path in zip(meshes, paths):
        if Path(path).resolve() == Path(mesh).resolve():
            raise InputError(f"{path!r}: would be written over the mesh itself; name another file")
        if per is not None:
            check_output(path, per)
        else:
            check_picture(path)
    return paths


def _run(path, names, out, png, per, columns, by, options):
    """Read, mend, estimate and write one mesh; return what --json tells of it."""
    import curvlib
    from curvlib.columns import columns as named
    from curvlib.estimation import BECAUSE, recommended
    from curvlib.meshes.labels import read_labels
    from curvlib.regions import by_region

    if not Path(path).exists() and path in curvlib.estimators():
        raise curvlib.InputError(f"{path!r} is an estimator, not a mesh: write -e {path}")
    say = (lambda words: None) if options["as_json"] else print
    mesh = curvlib.read(path)
    say(f"{path}: {len(mesh.vertices)} vertices, {len(mesh.faces)} triangles")
    if not names:
        names = [recommended(per, options["chosen"] or options["rings"] or options["radius"])]
        say(f"  estimator {names[0]}: {BECAUSE[names[0]]}")
    labels, labelled, names_of_labels = read_labels(by, path, mesh) if by else (None, None, {})
    told = {"mesh": path, "vertices": len(mesh.vertices), "triangles": len(mesh.faces)}
    mesh, kept, counts = mended(mesh, options["weld"], options["orient"])
    told |= counts
    for what, count in counts.items():
        say(f"  {count} {what}")
    if labelled == "vertex":
        labels = labels[kept]
    told |= {"seconds": 0.0, "estimators": {}}
    every, first = {}, None
    for name in names:
        given = options_of(name, options)
        start = time.perf_counter()
        with progress_of_work(name):
            found = curvlib.estimate(
                mesh, name, options["threads"], per, options["creases"], **given
            )
        told["seconds"] += time.perf_counter() - start
        own = _chosen(name, named(found, columns, options["c0"]), options["quantities"])
        first = first or next(iter(_numbers(own).items()), None)
        shown = _numbers(own) if options["quantities"] else _numbers(own, SHOWN)
        told["estimators"][name] = document(found, shown, given, options["c0"])
        say(text(name, told["estimators"][name]))
        stem = Path(name).stem if name.endswith(".py") else name
        every |= own if len(names) < 2 else {f"{column}_{stem}": x for column, x in own.items()}
    say(f"  {told['seconds']:.2f} s")
    table = by_region(mesh, labels, labelled, _numbers(every), per, names_of_labels) if by else None
    if by:
        told["regions"] = table
    of_regions = bool(by and out and Path(out).suffix == ".csv")
    if of_regions:
        write_csv(out, table)
    elif out:
        from curvlib.meshes.writing import write

        write(out, mesh, every, per)
    if by and not of_regions:
        say(regions(table))
    if png and not first:
        raise curvlib.InputError(f"{png!r}: no quantity is a number that colours can show")
    if png:
        from curvlib.figures.values import picture

        column, values = first
        up = options["up"] or ("y" if Path(path).suffix.lower() in Y_UP else "z")
        picture(png, found.used, values, per, column, up)
    told["written"] = [where for where in (out, png) if where]
    if told["written"]:
        say(f"  written: {', '.join(told['written'])}")
    else:
        say("next: the same with -o values.vtp, for ParaView, or --picture values.png")
    return told


def _chosen(name, columns, quantities):
    """The columns that are asked for, all if none is; InputError for one that is not there."""
    from curvlib.errors import check_name

    for quantity in quantities:
        check_name(f"quantity of {name}", quantity, columns)
    return {quantity: columns[quantity] for quantity in quantities or columns}


def _numbers(columns, among=None):
    """The columns of numbers that are no codes, of those `among` them if any is."""
    from curvlib.columns import CODES

    found = {
        column: x for column, x in columns.items() if x.ndim == 1 and not column.startswith(CODES)
    }
    return {column: x for column, x in found.items() if column in (among or found)} or found
