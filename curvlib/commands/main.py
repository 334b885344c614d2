"""The command line: `curvlib`."""

import argparse
import sys

from curvlib import __version__
from curvlib.dataset.fetch import fetch
from curvlib.errors import InputError

ARCHIVE = f"results/dataset/curvature-library-{__version__}.zip"


def main(arguments=None) -> int:
    """Run a command; its exit status. Wrong input is one line on stderr and status 1."""
    parser = argparse.ArgumentParser(prog="curvlib", description="Curvature on triangle meshes.")
    parser.add_argument("--version", action="version", version=f"curvlib {__version__}")
    commands = parser.add_subparsers(required=True, metavar="command")
    command = commands.add_parser(
        "fetch",
        help="get the mesh library",
        description="Get an archive of the mesh library, check its SHA-256, unpack it.",
    )
    command.add_argument(
        "source",
        nargs="?",
        default=ARCHIVE,
        metavar="URL or path",
        help="the archive, with SHA256SUMS beside it (default: %(default)s, which `snakemake "
        "dataset` makes)",
    )
    command.add_argument(
        "-o", "--output", default=".", metavar="FOLDER", help="where to unpack (default: here)"
    )
    command.set_defaults(run=_fetch)
    options = parser.parse_args(arguments)
    try:
        options.run(options)
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


def _fetch(options):
    folder = fetch(options.source, options.output)
    print(f"{folder}: read its README.md; in Python, curvlib.load_library({str(folder)!r})")
