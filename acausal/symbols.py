"""Entries and columns of CasADi matrices.

CasADi's overload resolution on each call takes ten times as long as the operation itself; the functions here avoid it
for matrices that stay unchanged and for sums, products and quotients.
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
    """Return the stacked columns; for none an empty SX column, where CasADi returns numbers."""
    return ca.vertcat(ca.SX(0, 1), *entries)


def picked(column: ca.SX, places: list[int]) -> ca.SX:
    """Return entries of a column; for no places an empty SX column."""
    return column[places] if places else ca.SX(0, 1)


def vec(matrix: ca.SX) -> ca.SX:
    """Return the entries of a matrix as one column, in column-major order."""
    return matrix if matrix.size2() == 1 else ca.vec(matrix)


def dense(matrix: ca.SX) -> ca.SX:
    """Return a matrix without structural zeros."""
    return matrix if matrix.is_dense() else ca.densify(matrix)


def combined(left: ca.SX, operation: str, right: ca.SX) -> ca.SX:
    """Return left + right, or the result of another entrywise operation."""
    return ca.SX.binary(OPERATIONS[operation], left, right)


def called(column: ca.SX) -> set[str]:
    """Return the names of the functions that an expression calls."""
    return set(ca.Function("column", [], [column], {"allow_free": True}).get_function())


def inlined(symbols: ca.SX, values: ca.SX, expressions: list[ca.SX]) -> tuple[ca.SX, list[ca.SX]]:
    """Return definitions, each inserted in those after it, and expressions with all of them inserted."""
    if not called(ca.vertcat(values, *map(vec, expressions))):
        definitions, others = ca.substitute_inplace([symbols], [values], expressions)
        return definitions[0], others
    # CasADi's substitute_inplace gives wrong values where functions are called.
    depth, levels = dict[int, int](), defaultdict[int, list[int]](list)
    for k, (symbol, value) in enumerate(zip(scalars(symbols), scalars(values), strict=True)):
        own = 1 + max((depth.get(s.element_hash(), -1) for s in ca.symvar(value)), default=-1)
        depth[symbol.element_hash()] = own
        levels[own].append(k)
    found, before = ca.SX(values), list[int]()
    for level in range(len(levels)):
        if before:
            found[levels[level]] = ca.substitute(found[levels[level]], symbols[before], found[before])
        before += levels[level]
    return found, ca.substitute(expressions, [symbols], [found])


class Distinct:
    """Distinct scalar expressions, numbered in the order of their first appearance.

    Equality is that of `casadi.is_equal`; only expressions with equal hash keys of their outer operations are compared,
    so that n expressions take n comparisons, not n^2.
    """

    # Depth, in operations, of the comparison and of the key: time - 0.1 and time - 0.2 differ at depth 1.
    _COMPARED, _KEYED = 9, 3

    def __init__(self) -> None:
        self._count = 0
        self._alike = defaultdict[Hashable, list[tuple[int, ca.SX]]](list)

    def number(self, expression: ca.SX, kind: str) -> int:
        """Return the number of an expression of a kind; a new expression gets the next number."""
        alike = self._alike[kind, _key(expression, self._KEYED)]
        for number, known in alike:
            if ca.is_equal(known, expression, self._COMPARED):
                return number
        alike.append((self._count, expression))
        self._count += 1
        return self._count - 1


def _key(expression: ca.SX, depth: int) -> Hashable:
    """Return a key of the outer operations of a scalar; operands are unordered, as in `casadi.is_equal`."""
    if expression.is_constant():
        return float(expression)
    if expression.is_symbolic():
        return expression.element_hash()
    operands = range(expression.n_dep()) if depth else ()
    return expression.op(), frozenset(_key(expression.dep(k), depth - 1) for k in operands)
