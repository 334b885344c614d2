"""The command line `curvlib`: one file of this folder per verb."""

import importlib
import os
import sys

import click

from curvlib import __version__
from curvlib.catalogue import estimators
from curvlib.errors import InputError

# In the order of work.
VERBS = ("info", "estimate", "list", "mesh", "check", "compare", "fetch")


class Verbs(click.Group):
    """The verbs, each imported when it is asked for."""

    def list_commands(self, context):
        return list(VERBS)

    def get_command(self, context, name):
        if name in VERBS:
            return importlib.import_module(f"curvlib.commands.{name}").command
        return None


HELP = """\b
Exit codes: 0 done; 1 an error, told in one line; 2 wrong usage; 130 interrupted.
Completion of names, options and files, by a line in
  ~/.bashrc:                   eval "$(_CURVLIB_COMPLETE=bash_source curvlib)"
  ~/.zshrc:                    eval "$(_CURVLIB_COMPLETE=zsh_source curvlib)"
  ~/.config/fish/config.fish:  _CURVLIB_COMPLETE=fish_source curvlib | source
"""


@click.command(epilog=HELP, cls=Verbs, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, message="curvlib %(version)s")
def curvlib():
    """Curvature on triangle meshes. Begin with `curvlib info MESH`."""


def main(arguments=None) -> int:
    """Run a command and return its exit status.

    Bad input is one line on stderr and status 1, wrong usage 2, an interruption 130.
    """
    try:
        return curvlib.main(arguments, prog_name="curvlib", standalone_mode=False) or 0
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except MemoryError:
        print("error: not enough memory", file=sys.stderr)
        return 1
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except BrokenPipeError:
        # The reader of our output has ended, as `head` does; what is left goes nowhere.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except OSError as error:
        about = f"{error.filename}: " if error.filename else ""
        print(f"error: {about}{error.strerror or error}", file=sys.stderr)
        return 1
    except (KeyboardInterrupt, click.Abort):
        print("interrupted", file=sys.stderr)
        return 130
    except Exception as error:
        told = estimators.told(error)
        if told is None:
            raise  # a fault of ours
        print(f"error: {told}", file=sys.stderr)
        return 1
