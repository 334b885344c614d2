"""The frame of every job of the workflow: a log, and errors in one line."""

import contextlib
import sys
import time
import traceback
from pathlib import Path

from curvlib.catalogue import estimators, surfaces
from curvlib.errors import InputError


@contextlib.contextmanager
def logged(path):
    """Redirect output to a log file; append the processor time of start and work.

    The terminal shows the job's name and, on failure, one line for an error in the input, in a
    file of estimators or surfaces, or on disk. The traceback is in the log, and for any other error
    on the terminal too.
    """
    start, terminal = time.process_time(), sys.stderr
    print(_name(path), file=terminal, flush=True)
    try:
        with (
            Path(path).open("w", buffering=1, encoding="utf-8") as log,
            contextlib.redirect_stdout(log),
            contextlib.redirect_stderr(log),
        ):
            try:
                yield
            except (Exception, SystemExit) as error:
                print(_message(error, path), file=terminal, flush=True)
                traceback.print_exc(file=log)
                sys.exit(1)
            work = time.process_time() - start
            print(f"processor time: {start:.2f} s to start, {work:.2f} s of work")
    except OSError as error:  # of the log itself, on a full disk for one
        print(f"error: {path}: {error.strerror}", file=terminal, flush=True)
        sys.exit(1)


def _message(error, path):
    """What the terminal shows of an error in a job with this log."""
    told = estimators.told(error) or surfaces.told(error)
    if isinstance(error, InputError | OSError):
        return f"error: {error}"
    if told:
        return f"error: {told} (traceback: {path})"
    return "".join(traceback.format_exception(error))


def _name(path):
    """The name of a job after its log: `estimate gauss_bonnet`, logs/estimate/gauss_bonnet.log."""
    parts = Path(path).with_suffix("").parts
    return " ".join(parts[parts.index("logs") + 1 :])
