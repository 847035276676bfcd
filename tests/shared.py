"""What many tests of one process share: models are compiled once, whatever they are then run with."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import acausal as ac


@cache
def compiled(make: Callable[..., Any], **values: Any) -> ac.CompiledModel:
    """Return a model, compiled; values that can be hashed are those of its class."""
    return ac.compile(make(**values))
