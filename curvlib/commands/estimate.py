"""`curvlib estimate`: curvature of meshes into files, with a summary."""

import time
from pathlib import Path

import click

from .terminal import (
    csv_text,
    json_option,
    number,
    progress,
    put_json,
    table_text,
    threads_option,
    told_of_compiling,
    told_warnings,
    write_csv,
)


@click.command()
@click.argument("meshes", nargs=-1, required=True, metavar="MESH...")
@click.option(
    "-e",
    "--estimator",
    "names",
    multiple=True,
    metavar="NAME",
    help="A name of `curvlib list` or the path of a .py file; may be repeated. Without: the "
    "recommended one.",
)
@click.option(
    "-o",
    "--output",
    metavar="OUT",
    help=".vtp .vtk .vtkhdf .ply .csv .parquet .gii .curv; {stem} in it stands for the mesh's "
    "name, as in out/{stem}.vtp.",
)
@click.option("--rings", type=int, metavar="K", help="How many rings of neighbours.")
@click.option("--radius", metavar="R", help='A length in the mesh\'s unit, or "5 edges".')
@click.option("--set", "chosen", multiple=True, metavar="option=value", help="May be repeated.")
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
    help="Statistics over the area by region, as CSV: to OUT if it is a .csv, else to the "
    "terminal. LABEL: data of the mesh's file, or a .label.gii or .annot file.",
)
@click.option("--weld", is_flag=True, help="Join points at one place in what is written, too.")
@click.option("--orient", is_flag=True, help="Turn triangles to agree, and outward if closed.")
@click.option("--picture", metavar="PNG", help="A picture of K, or of H where there is no K.")
@json_option
@threads_option
def command(meshes, names, output, per, columns, by, picture, as_json, **options):
    """Estimate curvature at the vertices of meshes.

    K and H are pointwise, H > 0 where the surface bends away from its normal; NaN is undefined.
    """
    per = per or ("face" if columns == "pycurv" else "vertex")
    outputs = _outputs(meshes, output, per), _outputs(meshes, picture, None)
    told = []
    for mesh, out, png in progress(list(zip(meshes, *outputs)), lambda item: item[0]):
        with told_warnings() as warnings, told_of_compiling():
            document = _run(mesh, list(names), out, png, per, columns, by, as_json, options)
        told.append(document | {"warnings": warnings})
    if as_json:
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
    for path in paths:
        if per is not None:
            check_output(path, per)
        elif Path(path).suffix != ".png":
            raise InputError(f"{path!r}: a picture is a .png file")
    return paths


def _run(path, names, out, png, per, columns, by, as_json, options):
    """Read, mend, estimate and write one mesh; return what --json tells of it."""
    import numpy as np

    import curvlib
    from curvlib.columns import columns as named
    from curvlib.estimation import BECAUSE, RECOMMENDED
    from curvlib.meshes.labels import read_labels
    from curvlib.regions import PROBABILITIES, by_region, quantiles

    if not Path(path).exists() and path in curvlib.estimators():
        raise curvlib.InputError(f"{path!r} is an estimator, not a mesh: write -e {path}")
    say = (lambda words: None) if as_json else print
    mesh = curvlib.read(path)
    say(f"{path}: {len(mesh.vertices)} vertices, {len(mesh.faces)} triangles")
    if not names:
        say(f"  estimator {RECOMMENDED[per]}: {BECAUSE[per]}")
    labels, labelled, regions = read_labels(by, path, mesh) if by else (None, None, {})
    document = {"mesh": path, "vertices": len(mesh.vertices), "triangles": len(mesh.faces)}
    mesh, kept, mended = _mended(mesh, options["weld"], options["orient"])
    document |= mended
    for what, count in mended.items():
        say(f"  {count} {what}")
    if labelled == "vertex":
        labels = labels[kept]
    names = names or [RECOMMENDED[per]]
    start = time.perf_counter()
    given = {name: _options(name, options) for name in names}
    found = {
        name: curvlib.estimate(mesh, name, threads=options["threads"], per=per, **given[name])
        for name in names
    }
    seconds = time.perf_counter() - start
    document |= {"seconds": seconds, "estimators": {}}
    all_columns = {}
    for name, estimates in found.items():
        own = named(estimates, columns)
        stem = Path(name).stem if name.endswith(".py") else name
        all_columns |= {k if len(found) == 1 else f"{k}_{stem}": v for k, v in own.items()}
        spread = {
            quantity: quantiles(mesh, getattr(estimates, quantity), per)
            for quantity in ("K", "H", "k1", "k2")
        }
        document["estimators"][name] = {
            "options": given[name],
            "undefined": estimates.undefined,
            "quantiles": {
                quantity: dict(zip(map(str, PROBABILITIES), values))
                for quantity, values in spread.items()
            },
        }
        _summary(say, name, given[name], estimates, spread, PROBABILITIES)
    say(f"  {seconds:.2f} s")
    table = None
    if by:
        table = by_region(mesh, labels, labelled, all_columns, per, regions)
        document["regions"] = table
    if table and out and Path(out).suffix == ".csv":
        write_csv(out, table)
    elif out:
        from curvlib.meshes.writing import write

        write(out, mesh, all_columns, per)
    if table and not (out and Path(out).suffix == ".csv") and not as_json:
        print(csv_text(table), end="")
    if png:
        from curvlib.figures.values import picture

        first = next(iter(found.values()))
        quantity = "K" if np.isfinite(first.K).any() else "H"
        picture(png, mesh, getattr(first, quantity), per, quantity)
    written = [where for where in (out, png) if where]
    document["written"] = written
    if written:
        say(f"  written: {', '.join(written)}")
    else:
        say(f"next: curvlib estimate {path} -o {Path(path).stem}.vtp, for ParaView")
    return document


def _mended(mesh, weld, orient):
    """The mesh welded and turned as asked; which of its vertices it keeps; counts by words."""
    import numpy as np

    import curvlib

    kept, mended = np.arange(len(mesh.vertices)), {}
    if orient:
        # A soup has edges once all points at one place are one; welding would leave apart what
        # does not agree.
        _, first, place = np.unique(mesh.vertices, axis=0, return_index=True, return_inverse=True)
        joined = curvlib.Mesh(mesh.vertices, first[place.reshape(-1)][mesh.faces], copy=False)
        _, turned = curvlib.orient(joined)
        faces = np.where(turned[:, None], mesh.faces[:, ::-1], mesh.faces)
        mesh = curvlib.Mesh(mesh.vertices, faces, normals=mesh.normals)
        mended["triangles turned over"] = int(turned.sum())
    if weld:
        welded, index = curvlib.weld(mesh)
        kept, new = np.unique(index, return_inverse=True)
        normals = None if welded.normals is None else welded.normals[kept]
        mesh = curvlib.Mesh(mesh.vertices[kept], new.reshape(-1)[mesh.faces], normals=normals)
        mended["vertices joined to others"] = len(index) - len(kept)
    return mesh, kept, mended


def _options(name, options):
    """The options of an estimator from --rings, --radius and --set."""
    from curvlib.errors import InputError, check_name
    from curvlib.kit.options import Lengths
    from curvlib.signatures import readings

    texts = {}
    for text in options["chosen"]:
        option, equals, value = text.partition("=")
        if not equals:
            raise click.UsageError(f"--set {text!r}: expected option=value")
        texts[option.strip()] = value.strip()
    for option in ("rings", "radius"):
        if options[option] is not None:
            texts[option] = str(options[option])
    known, chosen = readings(name), {}
    for option, text in texts.items():
        check_name(f"option of {name}", option, known)
        valid = known[option]
        same = [value for value in valid if str(value) == text]
        if isinstance(valid, Lengths) and not same:
            try:
                same = [float(text)]
            except ValueError:
                same = [text]
        if not same and not valid[1:]:
            raise InputError(f"{option} of {name}: has one value alone, {valid[0]}")
        chosen[option] = same[0] if same else text
    return chosen


def _summary(say, name, options, estimates, spread, probabilities):
    """Print the quantiles over the area, and what is undefined by cause."""
    words = ", ".join(f"{option}={value}" for option, value in options.items())
    say(f"{name}{f'({words})' if words else ''}, quantiles over the area:")
    heads = ("", *(f"{100 * p:.0f} %" for p in probabilities))
    rows = [(f"  {quantity}", *map(number, values)) for quantity, values in spread.items()]
    say(table_text(heads, rows))
    undefined = ", ".join(f"{n} {cause}" for cause, n in estimates.undefined.items())
    say(f"  undefined: {undefined or 'nowhere'}")
