"""The process in which a function of a library is checked: one line of JSON for each check."""

import json
import os
import signal
import sys
import warnings

from curvlib.catalogue import libraries
from curvlib.estimation import estimate

from .function import Failed, Function
from .functions import CHECKS
from .subject import NotApplicable


def function(name):
    """The function `name`, or our estimator `curvlib:name`, as the checks call it."""
    ours = name.removeprefix("curvlib:")
    if ours == name:
        return Function(libraries.module(name).values)

    def values(vertices, faces):
        found = estimate((vertices, faces), ours)
        return {k: getattr(found, k) for k in ("K", "H", "k1", "k2") if k in found.returned}

    return Function(values)


def verdict(subject, check):
    """(verdict, evidence, remedy) of a check by name."""
    try:
        return "pass", CHECKS[check](subject), ""
    except Failed as error:
        return "fail", str(error), error.remedy
    except NotApplicable as error:
        return "not applicable", str(error), ""
    except Exception as error:
        text = " ".join(f"{type(error).__name__}: {error}".split())[:120]
        return "fail", f"error, {text}", "mend or convert the mesh first"


def main(name, limit, *checks):
    """Check it; a check that takes more than `limit` seconds of processor time ends the process by
    SIGPROF."""
    # Libraries write to standard output, which is for the verdicts.
    lines = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    warnings.simplefilter("ignore")
    subject = function(name)
    for check in checks:
        signal.setitimer(signal.ITIMER_PROF, float(limit))
        print(json.dumps(verdict(subject, check)), file=lines, flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
