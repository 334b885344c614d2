"""All sentences of the paper that are decided: CLAIMS, by number."""

from . import convergence, rankings  # noqa: F401  each registers its claims
from .claim import CLAIMS

__all__ = ["CLAIMS"]
