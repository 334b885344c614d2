"""Functions of libraries, and our estimators, against every check: the table conformance.csv.

A function runs in processes of its own, as some end the process on a broken mesh or never return.
"""

import importlib.metadata
import json
import signal
import subprocess
import sys
import tempfile

from curvlib import __version__
from curvlib.catalogue import libraries
from curvlib.parallel import for_each

from .functions import CHECKS

LIMIT = 60  # seconds of processor time of a check
WAIT = 10  # as many limits of any time, for all checks of a process
OURS = ("gauss_bonnet", "quadric", "adaptive_fit")
COLUMNS = (
    "library",
    "version",
    "function",
    "label",
    "check",
    "verdict",
    "evidence",
    "remedy",
    "documented",
    "source",
)


def table(names=None, ours=OURS, threads: int = 1, limit: float = LIMIT):
    """conformance.csv: functions of other libraries, and our estimators, against every check.

    Parameters
    ----------
    names : list of str, optional
        Names or paths of files of library functions; all of the package's by default.
    ours : sequence of str
        Names of estimators.
    threads : int
    limit : float
        Seconds of processor time after which a check has failed; a process has WAIT times as many
        of any.

    Returns
    -------
    DataFrame
        Per `function` and `check` the `verdict`, "pass", "fail", "not applicable" or "not
        installed"; `evidence` from the run, `remedy` for a user where it fails, `documented`, what
        the documentation in `source` says on it; `library`, `version` and `label`, the call.
    """
    import pandas as pd

    names = libraries.names() if names is None else names
    rows = [_ours(name) for name in ours] + [_theirs(name) for name in names]
    found = for_each(lambda row: _cells(row, limit), rows, threads)
    return pd.DataFrame([cell for cells in found for cell in cells], columns=COLUMNS)


def versions() -> dict:
    """The version of every library by its distribution, None where it is not installed."""
    rows = map(_theirs, libraries.names())
    return {row["library"]: row["version"] for row in rows}


def _ours(name):
    return {
        "library": "curvlib",
        "version": __version__,
        "function": name,
        "label": f'curvlib.estimate(mesh, "{name}")',
        "source": "https://doi.org/10.1109/ROBOT.2003.1241726",
    }


def _theirs(name):
    file = libraries.module(name)
    distributions = file.REQUIRES.split()
    try:
        version, *_ = map(importlib.metadata.version, distributions)
    except importlib.metadata.PackageNotFoundError:
        version = None
    return {
        "library": distributions[0],
        "version": version,
        "function": name,
        "label": file.LABEL,
        "source": file.SOURCE,
        "documents": getattr(file, "DOCUMENTED", {}),
        "remedies": getattr(file, "REMEDIES", {}),
    }


def _cells(row, limit):
    """The rows of one function."""
    documents, remedies = row.pop("documents", {}), row.pop("remedies", {})
    if row["version"] is None:
        verdicts = {check: ("not installed", "", "") for check in CHECKS}
    else:
        own = row["function"] if row["library"] != "curvlib" else f"curvlib:{row['function']}"
        verdicts = judged(own, limit)
    return [
        row
        | {"check": check, "verdict": verdict, "evidence": evidence}
        | {"remedy": remedies.get(check, remedy) if verdict == "fail" else ""}
        | {"documented": documents.get(check, "")}
        for check, (verdict, evidence, remedy) in verdicts.items()
    ]


def judged(name: str, limit: float = LIMIT) -> dict:
    """Verdict, evidence and remedy by check of the function `name`, or the estimator
    `curvlib:name`; a check that ends its process or takes longer than `limit` seconds fails."""
    verdicts, left = {}, list(CHECKS)
    while left:
        lines, ended = _run(name, left, limit)
        found = [tuple(json.loads(line)) for line in lines]
        if len(found) < len(left):
            found.append(("fail", ended, "run it in a process of its own, on a mended mesh"))
        verdicts |= zip(left, found)
        left = left[len(found) :]
    return verdicts


def _run(name, checks, limit):
    """The lines that one process writes on the checks, and how it ended."""
    code = [sys.executable, "-m", "curvlib.conformance.cell", name, str(limit), *checks]
    with tempfile.TemporaryFile("w+", encoding="utf-8") as lines:
        try:
            # By processor time the process ends itself; this is for one that waits forever.
            wait = WAIT * limit
            code = subprocess.run(code, stdout=lines, stderr=subprocess.DEVNULL, timeout=wait)
            ended = _ended(code.returncode, limit)
        except subprocess.TimeoutExpired:
            ended = f"no answer within {wait:g} seconds"
        lines.seek(0)
        return lines.read().splitlines(), ended


def _ended(code, limit):
    if code == -signal.SIGPROF:
        return f"no answer within {limit:g} seconds of processor time"
    return f"ends the process: {signal.Signals(-code).name if code < 0 else f'exit code {code}'}"
