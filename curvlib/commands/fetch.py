"""`curvlib fetch`: get an archive of the mesh library, check its SHA-256, unpack it."""

import click

from curvlib import __version__

from .terminal import PATH, json_option, put_json

ARCHIVE = f"results/dataset/curvature-library-{__version__}.zip"


@click.command()
@click.argument("source", default=ARCHIVE, metavar="[URL or path]", type=PATH)
@click.option(
    "-o",
    "--output",
    default=".",
    metavar="FOLDER",
    type=click.Path(),
    help="Where to unpack; made if it does not exist. Default: here.",
)
@json_option
def command(source, output, as_json):
    """Get the mesh library.

    The archive, with SHA256SUMS beside it, is checked and unpacked. By default it is the one that
    `snakemake dataset` makes.
    """
    from curvlib.dataset.fetch import fetch

    folder = fetch(source, output)
    if as_json:
        put_json({"folder": str(folder)})
    else:
        print(f"{folder}: read its README.md; in Python, curvlib.load_library({str(folder)!r})")
