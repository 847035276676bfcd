"""Entries and columns of CasADi matrices.

CasADi tries the types of all arguments on each call of one of its functions, for ten times as long as the work takes;
what leaves a matrix as it is, and sums, products and quotients of matrices, do without.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import casadi as ca

OPERATIONS = {"+": ca.OP_ADD, "-": ca.OP_SUB, "*": ca.OP_MUL, "/": ca.OP_DIV}


def scalars(matrix: ca.SX) -> list[Any]:
    """Return the entries of a matrix one by one, in column-major order; structural zeros too."""
    return matrix.elements()


def stacked(entries: Iterable[Any]) -> ca.SX:
    """Stack columns; of nothing an empty column of symbols, where CasADi gives numbers."""
    return ca.vertcat(ca.SX(0, 1), *entries)


def picked(column: ca.SX, places: list[int]) -> ca.SX:
    """Return entries of a column; of no places an empty column of symbols."""
    return column[places] if places else ca.SX(0, 1)


def vec(matrix: ca.SX) -> ca.SX:
    """Return the entries of a matrix as one column, in column-major order."""
    return matrix if matrix.size2() == 1 else ca.vec(matrix)


def dense(matrix: ca.SX) -> ca.SX:
    """Return a matrix without structural zeros."""
    return matrix if matrix.is_dense() else ca.densify(matrix)


def combined(left: ca.SX, operation: str, right: ca.SX) -> ca.SX:
    """Return what left + right gives, or another operation on entries."""
    return ca.SX.binary(OPERATIONS[operation], left, right)
