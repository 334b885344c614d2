"""`curvlib check`: what every estimator has to keep, on a file of yours."""

import click

from .terminal import PATH, json_option, put_json


@click.command(short_help="Check that an estimator keeps what every one has to.")
@click.argument("mine", metavar="MINE.py", type=PATH)
@json_option
def command(mine, as_json):
    """Check that an estimator keeps what every one has to: invariances, NaN where undefined.

    MINE.py is a file, or a name of `curvlib list`. Exit code 1 if a check fails.
    """
    from curvlib.catalogue import estimators
    from curvlib.conformance.run import verdicts

    found = []
    for verdict in verdicts(mine):
        found.append(verdict)
        if not as_json:
            place = f"{estimators.path(mine)}:{verdict.line}: " if verdict.line else ""
            words = f": {place}{verdict.words}" if verdict.verdict != "pass" else ""
            print(f"{verdict.verdict:<15}{verdict.check}{words}", flush=True)
    failed = sum(verdict.verdict == "fail" for verdict in found)
    if as_json:
        put_json({"mine": mine, "failed": failed, "checks": [v._asdict() for v in found]})
    elif failed:
        print(f"{failed} of {len(found)} checks failed")
    else:
        print(f"next: curvlib compare {mine}")
    return 1 if failed else 0
