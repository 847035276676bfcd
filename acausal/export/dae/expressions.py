"""Expressions as lists of operations, readable without CasADi; common subexpressions stay shared."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from acausal.core.lookups import find, load
from acausal.core.tape import KIND, KINDS
from acausal.errors import ExportError
from acausal.garbage import uncollected
from acausal.instructions import CONSTANT, FIND, LOAD, READABLE, read_instructions
from acausal.symbols import stacked

INT, FLOAT = np.dtype("<i4"), np.dtype("<f8")
MOST = 1 << 24  # limit of rows or columns of an expression: more than any model has unknowns
_UNARY = (
    *(ca.OP_NEG, ca.OP_SQ, ca.OP_TWICE, ca.OP_INV, ca.OP_SQRT, ca.OP_SIN, ca.OP_COS, ca.OP_TAN, ca.OP_ASIN, ca.OP_ACOS),
    *(ca.OP_ATAN, ca.OP_EXP, ca.OP_LOG, ca.OP_SINH, ca.OP_COSH, ca.OP_TANH, ca.OP_ASINH, ca.OP_ACOSH, ca.OP_ATANH),
    *(ca.OP_FABS, ca.OP_SIGN, ca.OP_FLOOR, ca.OP_CEIL, ca.OP_LOG1P, ca.OP_EXPM1, ca.OP_ERF, ca.OP_NOT, ca.OP_ASSIGN),
)
UNARY = frozenset(KIND[op] for op in _UNARY)
# Names of the operations: those of numpy if it has the operation.
NAMES = (
    *(
        "add",
        "subtract",
        "multiply",
        "divide",
        "negative",
        "square",
        "twice",
        "reciprocal",
        "sqrt",
        "sin",
        "cos",
        "tan",
    ),
    *(
        "arcsin",
        "arccos",
        "arctan",
        "arctan2",
        "exp",
        "log",
        "power",
        "sinh",
        "cosh",
        "tanh",
        "arcsinh",
        "arccosh",
        "arctanh",
    ),
    *(
        "abs",
        "sign",
        "floor",
        "ceil",
        "fmod",
        "ieee_remainder",
        "copysign",
        "fmin",
        "fmax",
        "hypot",
        "log1p",
        "expm1",
        "erf",
    ),
    *("less", "less_equal", "equal", "not_equal", "logical_not", "logical_and", "logical_or", "if_else_zero", "assign"),
    *("find", "load"),
)


@dataclass(frozen=True, eq=False)
class Operations:
    """Operations on one array of numbers: constants, then symbols, then results.

    Attributes
    ----------
    constants : array of float
        The constants.
    symbols : list of str
        Names of the symbols.
    operations : array of int, shape (n, 3)
        Kind of each operation, and positions of its two arguments; a single argument is given twice.
    places : array of int
        Positions of the entries of all expressions.
    shapes : list
        Rows, columns, and positions of the nonzeros in column-major order, None for a dense expression.
    """

    constants: np.ndarray
    symbols: list[str]
    operations: np.ndarray
    places: np.ndarray
    shapes: list[tuple[int, int, list[int] | None]]


class Writer:
    """Collects expressions and converts them to operations."""

    def __init__(self) -> None:
        self._columns: list[ca.SX] = []
        self._shapes: list[tuple[int, int, list[int] | None]] = []

    def add(self, expression: ca.SX | ca.DM) -> int:
        """Add an expression and return its number."""
        expression = ca.SX(expression)
        rows, columns = expression.shape
        dense = expression.is_dense()
        self._columns.append(ca.vec(expression) if dense else expression.nz[:])
        self._shapes.append((rows, columns, None if dense else list(expression.sparsity().find())))
        return len(self._shapes) - 1

    @uncollected()
    def operations(self) -> tuple[Operations, list[Any]]:
        """Return the operations of all expressions, and the symbols in them.

        Raises
        ------
        ExportError
            If an expression contains an operation unknown to the core.
        """
        column = stacked(self._columns)
        symbols = ca.symvar(column)
        read = read_instructions(ca.Function("all", [stacked(symbols)], [column], READABLE))
        constants = [node for node, op in enumerate(read.op) if op == CONSTANT]
        seat = {node: k for k, node in enumerate(constants)}
        seat |= {node: len(constants) + element for node, (_, element) in read.place.items()}
        rows, first = [], len(constants) + len(symbols)
        for node, (op, arguments) in enumerate(zip(read.op, read.arguments, strict=True)):
            if not arguments:
                continue
            if op not in KIND:
                raise ExportError(f"the model contains an operation unknown to an open DAE, number {op} of CasADi.")
            seat[node] = first + len(rows)
            rows.append((KIND[op], seat[arguments[0]], seat[arguments[-1]]))
        found = Operations(
            np.array([read.constant[node] for node in constants], dtype=FLOAT),
            [s.name() for s in symbols],
            np.array(rows, dtype=INT).reshape(-1, 3),
            np.array([seat[node] for node in read.results[0]], dtype=INT),
            self._shapes,
        )
        return found, symbols


class Reader:
    """The expressions of a list of operations.

    Parameters
    ----------
    given : Operations
        From a Writer.
    known : callable
        Function from number and name of a symbol to the symbol.

    Raises
    ------
    ValueError
        If the operations are inconsistent.
    """

    @uncollected()
    def __init__(self, given: Operations, known: Callable[[int, str], Any]) -> None:
        check(given)
        values = [ca.SX(v) for v in given.constants.tolist()]
        values += [known(k, name) for k, name in enumerate(given.symbols)]
        unary, binary = ca.SX.unary, ca.SX.binary
        for kind, first, second in given.operations.tolist():
            op = KINDS[kind]
            if op in (FIND, LOAD):
                values.append((find if op == FIND else load)(values[first], values[second]))
            else:
                values.append(unary(op, values[first]) if kind in UNARY else binary(op, values[first], values[second]))
        self._column = stacked([values[k] for k in given.places.tolist()])
        self._shapes = given.shapes
        self._starts = np.cumsum([0, *(_size(s) for s in given.shapes)]).tolist()

    def __getitem__(self, number: int) -> ca.SX:
        rows, columns, pattern = self._shapes[number]
        begin, end = self._starts[number], self._starts[number + 1]
        entries = self._column[begin:end] if end > begin else ca.SX(0, 1)
        if pattern is None:
            return entries if columns == 1 else ca.reshape(entries, rows, columns)
        sparsity = ca.Sparsity.triplet(rows, columns, [k % rows for k in pattern], [k // rows for k in pattern])
        return ca.SX(sparsity, entries)


def check(given: Operations) -> None:
    """Raise ValueError if operations are inconsistent: the content of a file is not trusted."""
    first = len(given.constants) + len(given.symbols)
    before = first + np.arange(len(given.operations))
    kinds, arguments = given.operations[:, 0], given.operations[:, 1:]
    if np.any((kinds < 0) | (kinds >= len(KINDS))):
        raise ValueError("an operation is unknown")
    if np.any((arguments < 0) | (arguments >= before[:, None])):
        raise ValueError("an argument does not precede its result")
    if np.any((given.places < 0) | (given.places >= first + len(given.operations))):
        raise ValueError("an entry of an expression does not exist")
    for rows, columns, pattern in given.shapes:
        if not (0 <= rows <= MOST and 0 <= columns <= MOST):
            raise ValueError("the shape of an expression is invalid")
        if pattern is not None and any(not 0 <= k < rows * columns for k in pattern):
            raise ValueError("an entry of an expression is outside its shape")
    if sum(map(_size, given.shapes)) != len(given.places):
        raise ValueError("expressions and their entries differ in number")


def _size(shape: Sequence[Any]) -> int:
    rows, columns, pattern = shape
    return rows * columns if pattern is None else len(pattern)
