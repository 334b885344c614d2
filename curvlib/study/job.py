"""What every job of the workflow does around its work: keep a log, and fail in one line."""

import contextlib
import sys
import time
import traceback
from pathlib import Path

from curvlib.errors import InputError


@contextlib.contextmanager
def logged(path):
    """Send what is printed to a log file, and at the end how much processor time the job took,
    to start and for its work. An error ends the job and stands in the log and on the terminal:
    one line where the input is at fault, else the traceback."""
    start = time.process_time()
    with (
        Path(path).open("w", buffering=1) as log,
        contextlib.redirect_stdout(log),
        contextlib.redirect_stderr(log),
    ):
        try:
            yield
        except Exception as error:
            wrong_input = isinstance(error, InputError)
            message = f"error: {error}" if wrong_input else traceback.format_exc()
            for stream in (log, sys.__stderr__):
                print(message, file=stream)
            sys.exit(1)
        work = time.process_time() - start
        print(f"processor time: {start:.2f} s to start, {work:.2f} s of work")
