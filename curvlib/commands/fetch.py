"""`curvlib fetch`: get an archive of the mesh library, check its SHA-256, unpack it."""

from curvlib import __version__
from curvlib.dataset.fetch import fetch

HELP = "get the mesh library"
ARCHIVE = f"results/dataset/curvature-library-{__version__}.zip"


def arguments(command) -> None:
    """Add the arguments of this verb to its parser."""
    command.add_argument(
        "source",
        nargs="?",
        default=ARCHIVE,
        metavar="URL or path",
        help="the archive, with SHA256SUMS beside it (default: %(default)s, which `snakemake "
        "dataset` makes)",
    )
    command.add_argument(
        "-o",
        "--output",
        default=".",
        metavar="FOLDER",
        help="where to unpack; made if it does not exist (default: here)",
    )


def run(options) -> None:
    """Fetch an archive and name the next steps."""
    folder = fetch(options.source, options.output)
    print(f"{folder}: read its README.md; in Python, curvlib.load_library({str(folder)!r})")
