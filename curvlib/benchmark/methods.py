"""What the benchmark compares: calls of estimators, and other libraries with their versions."""

from importlib import metadata

from curvlib.catalogue import peers


def methods(plan):
    """methods.csv: the calls, with the library of a peer, its version, and whether it is there."""
    import pandas as pd

    rows = []
    for call in plan.calls():
        row = {"estimator": str(call), "kind": "ours", "library": "", "version": "", "note": ""}
        if call.estimator in peers.names():
            row |= _library(call.estimator)
        rows.append(row)
    return pd.DataFrame(rows)


def versions(plan) -> list[str]:
    """The peers of a plan that are installed, with the versions of their libraries."""
    found = {name: _library(name)["version"] for name in plan.peers}
    return [f"{name} {version}" for name, version in found.items() if version]


def _library(name):
    required = peers.module(name).REQUIRES.split()
    row = {"kind": "peer", "library": " ".join(required)}
    versions = []
    for distribution in required:
        try:
            versions.append(metadata.version(distribution))
        except metadata.PackageNotFoundError:
            return row | {"version": "", "note": "not installed"}
    return row | {"version": " ".join(versions), "note": ""}
