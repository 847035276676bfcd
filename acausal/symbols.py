"""Entries of CasADi matrices, with the type that CasADi's own stubs lack."""

from __future__ import annotations

from typing import Any

import casadi as ca


def scalars(matrix: ca.SX) -> list[Any]:
    """Return the entries of a matrix one by one, in column-major order."""
    return matrix.elements()
