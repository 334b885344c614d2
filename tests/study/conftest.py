"""A small config that needs nothing of the checkout."""

import pytest


@pytest.fixture
def config(tmp_path):
    return {
        "surfaces": ["sphere"],
        "estimators": ["gauss_bonnet", "watanabe_b", "watanabe"],
        "resolutions": [12, 8, 8],
        "diagonals": ["same", "random-1"],
        "more": [{"diagonals": ["same"], "resolutions": [12, 64]}],
        "readings": {"default": {}, "half": {"area": "half"}},
        "more_readings": ["default", "half"],
        "vary": ["area", "normal", "vertices"],
        "product": ["area", "dihedral"],
        "frontier": [12, 18, 24],
        "benchmark": "config/benchmark.yaml",
        "library": str(tmp_path),
        "results": str(tmp_path),
    }
