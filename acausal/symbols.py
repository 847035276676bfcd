"""Entries and columns of CasADi matrices.

CasADi tries the types of all arguments on each call of one of its functions, for ten times as long as the work takes;
what leaves a matrix as it is, and sums, products and quotients of matrices, do without.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Iterable
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


class Distinct:
    """Distinct scalar expressions, numbered in the order of their first appearance.

    Equality is that of `casadi.is_equal`, which compares two expressions; a key made of their outer operations tells which
    ones are worth comparing, so that n expressions take n comparisons, not n^2.
    """

    # Operations that `casadi.is_equal` compares, and those of the key: time - 0.1 and time - 0.2 differ in the first.
    _COMPARED, _KEYED = 9, 3

    def __init__(self) -> None:
        self._count = 0
        self._alike = defaultdict[Hashable, list[tuple[int, ca.SX]]](list)

    def number(self, expression: ca.SX, kind: str) -> int:
        """Return the number of an expression of some kind; a new one gets the next number."""
        alike = self._alike[kind, _key(expression, self._KEYED)]
        for number, known in alike:
            if ca.is_equal(known, expression, self._COMPARED):
                return number
        alike.append((self._count, expression))
        self._count += 1
        return self._count - 1


def _key(expression: ca.SX, depth: int) -> Hashable:
    """Key of the outer operations of a scalar; operands have no order, as `casadi.is_equal` lets them commute."""
    if expression.is_constant():
        return float(expression)
    if expression.is_symbolic():
        return expression.element_hash()
    operands = range(expression.n_dep()) if depth else ()
    return expression.op(), frozenset(_key(expression.dep(k), depth - 1) for k in operands)
