"""The command line `curvlib`: one file of this folder per verb."""

import argparse
import importlib
import sys
from pathlib import Path

from curvlib import __version__
from curvlib.errors import InputError


def main(arguments=None) -> int:
    """Run a command and return its exit status.

    Bad input is one line on stderr and status 1, wrong usage 2, an interruption 130.
    """
    parser = argparse.ArgumentParser(prog="curvlib", description="Curvature on triangle meshes.")
    parser.add_argument("--version", action="version", version=f"curvlib {__version__}")
    commands = parser.add_subparsers(required=True, metavar="command")
    for path in sorted(Path(__file__).parent.glob("*.py")):
        if path.stem in ("__init__", "main"):
            continue
        verb = importlib.import_module(f"curvlib.commands.{path.stem}")
        command = commands.add_parser(path.stem, help=verb.HELP, description=verb.__doc__)
        verb.arguments(command)
        command.set_defaults(run=verb.run)
    options = parser.parse_args(arguments)
    try:
        options.run(options)
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 130
    return 0
