"""What every job of the workflow does around its work: keep a log, and fail in one line."""

import contextlib
import sys
import traceback
from pathlib import Path

from .errors import InputError


@contextlib.contextmanager
def logged(path):
    """Send what is printed to a log file; end with one line there where the input is at fault."""
    with (
        Path(path).open("w", buffering=1) as log,
        contextlib.redirect_stdout(log),
        contextlib.redirect_stderr(log),
    ):
        try:
            yield
        except InputError as error:
            print(f"error: {error}")
            sys.exit(1)
        except Exception:
            traceback.print_exc()
            sys.exit(1)
