"""A block of the block lower triangular form."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Block:
    """Equations to be solved simultaneously; `equations[i]` is matched with `variables[i]`."""

    equations: tuple[int, ...]
    variables: tuple[int, ...]
