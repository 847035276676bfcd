"""Linear values of expressions, updated while unknowns are replaced by constants and aliases.

An expression is read once as a list of elementary operations. The value of each operation is c0 + c1 x + c2 y with at
most two unknowns, or None for other expressions. CasADi folds constants when an expression is built, but not when an
unknown becomes known later; a worklist over these operations does so in linear time.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Mapping

import casadi as ca

from acausal.instructions import READABLE, read_instructions
from acausal.symbols import combined

Linear = tuple[float, tuple[tuple[int, float], ...]]  # c0 and up to two terms (unknown, c)

_UNARY: dict[int, Callable[[float], float]] = {
    ca.OP_SIN: math.sin,
    ca.OP_COS: math.cos,
    ca.OP_TAN: math.tan,
    ca.OP_EXP: math.exp,
    ca.OP_SQRT: math.sqrt,
    ca.OP_INV: lambda x: 1 / x,
}
_SCALE = {ca.OP_NEG: -1.0, ca.OP_TWICE: 2.0, ca.OP_ASSIGN: 1.0}


class LinearValues:
    """Operations of residuals, each with its linear value in the unknowns.

    Parameters
    ----------
    unknowns, others, residuals : casadi.SX
        Columns; `others` are parameters, time and all other symbols that are not unknowns.
    solved : dict of int to Linear, optional
        Values of removed unknowns.
    """

    def __init__(
        self, unknowns: ca.SX, others: ca.SX, residuals: ca.SX, solved: dict[int, Linear] | None = None
    ) -> None:
        read = read_instructions(ca.Function("residuals", [unknowns, others], [residuals], READABLE))
        self.args, self.constant, self.residual = read.arguments, read.constant, read.results[0]
        # The first of the two arguments contains the unknowns.
        self.unknown = {node: element for node, (argument, element) in read.place.items() if argument == 0}
        self.op = [
            ca.OP_PARAMETER if op == ca.OP_INPUT and k not in self.unknown else op for k, op in enumerate(read.op)
        ]
        self.input = {element: node for node, element in self.unknown.items()}
        self.users: list[list[int]] = [[] for _ in self.op]
        for node, args in enumerate(self.args):
            for arg in args if len(args) < 2 or args[0] != args[1] else args[:1]:
                self.users[arg].append(node)
        self.residuals_at: dict[int, list[int]] = {}
        for row, node in enumerate(self.residual):
            self.residuals_at.setdefault(node, []).append(row)
        self.solved: dict[int, Linear] = solved or {}
        self.followers: dict[int, list[int]] = {}
        self._stale: list[int] = []
        self.value: list[Linear | None] = [None] * len(self.op)
        for node in range(len(self.op)):
            self.value[node] = self._evaluate(node)

    def _evaluate(self, node: int) -> Linear | None:
        op = self.op[node]
        if op == ca.OP_CONST:
            return self.constant[node], ()
        if op == ca.OP_INPUT:
            return self.resolve((0.0, ((self.unknown[node], 1.0),)))
        values = [self.value[arg] for arg in self.args[node]]
        if op in (ca.OP_MUL, ca.OP_DIV):
            return _product(values[0], values[1], op == ca.OP_DIV)
        if None in values or not values:
            return None
        a = values[0]
        assert a is not None
        if op in (ca.OP_ADD, ca.OP_SUB):
            assert values[1] is not None
            return add(a, values[1], 1.0 if op == ca.OP_ADD else -1.0)
        if op in _SCALE:
            return scale(a, _SCALE[op])
        if a[1] or len(values) > 1:
            return None
        if op == ca.OP_SQ:
            return a[0] * a[0], ()
        return (_UNARY[op](a[0]), ()) if op in _UNARY else None

    def resolve(self, value: Linear) -> Linear:
        """Return a value with solved unknowns replaced, along chains of aliases."""
        return resolved(value, self.solved)

    def solve(self, unknown: int, solution: Linear) -> None:
        """Record the value of an unknown, and redirect its aliases."""
        self.solved[unknown] = solution
        led_here = [unknown, *self.followers.pop(unknown, [])]
        self._stale.extend(self.input[u] for u in led_here if u in self.input)
        for other, _ in solution[1]:
            self.followers.setdefault(other, []).extend(led_here)

    def update(self) -> list[int]:
        """Evaluate all operations that depend on newly solved unknowns; return the residuals whose value changed."""
        queue = sorted(set(self._stale))
        self._stale = []
        queued = set(queue)
        changed: list[int] = []
        while queue:
            node = heapq.heappop(queue)
            queued.discard(node)
            value = self._evaluate(node)
            if value == self.value[node]:
                continue
            self.value[node] = value
            changed.extend(self.residuals_at.get(node, ()))
            for user in self.users[node]:
                if user not in queued:
                    queued.add(user)
                    heapq.heappush(queue, user)
        return changed


def resolved(value: Linear, solved: Mapping[int, Linear]) -> Linear:
    """Return a value with solved unknowns replaced, along chains of aliases."""
    c0, terms = value
    for unknown, _ in terms:
        if unknown in solved:
            break
    else:
        return value
    result: Linear | None = (c0, ())
    for unknown, c in terms:
        term: Linear = (0.0, ((unknown, c),))
        while term[1] and term[1][0][0] in solved:
            known = scale(solved[term[1][0][0]], term[1][0][1])
            term = (term[0] + known[0], known[1])
        result = add(result, term, 1.0)
        assert result is not None
    return result


def scale(value: Linear, factor: float) -> Linear:
    """Return a linear value times a number."""
    if factor == 1:
        return value
    if factor == 0:
        return 0.0, ()
    return value[0] * factor, tuple((u, c * factor) for u, c in value[1])


def add(a: Linear, b: Linear, factor: float) -> Linear | None:
    """Return a + factor b, or None if it has more than two unknowns."""
    if not b[1]:
        return a[0] + factor * b[0], a[1]
    if not a[1]:
        return a[0] + factor * b[0], scale(b, factor)[1]
    terms = dict(a[1])
    for unknown, c in b[1]:
        total = terms.get(unknown, 0.0) + factor * c
        if total == 0:
            terms.pop(unknown, None)
        else:
            terms[unknown] = total
    return (a[0] + factor * b[0], tuple(sorted(terms.items()))) if len(terms) <= 2 else None


def _product(a: Linear | None, b: Linear | None, divide: bool) -> Linear | None:
    if a is not None and not a[1] and a[0] == 0:
        return 0.0, ()
    if divide:
        return scale(a, 1 / b[0]) if a is not None and b is not None and not b[1] and b[0] != 0 else None
    if b is not None and not b[1]:
        if b[0] == 0:
            return 0.0, ()
        return scale(a, b[0]) if a is not None else None
    return scale(b, a[0]) if a is not None and not a[1] and b is not None else None


def expressions(values: list[Linear], unknowns: ca.SX) -> ca.SX:
    """Return linear values as expressions of the unknowns, a column."""
    if not values:
        return ca.SX(0, 1)
    # Missing terms are padded with coefficient 0, which CasADi drops.
    padded = [(*terms, (0, 0.0), (0, 0.0))[:2] for _, terms in values]
    first, second = (
        combined(unknowns[[terms[n][0] for terms in padded]], "*", ca.SX(ca.DM([terms[n][1] for terms in padded])))
        for n in (0, 1)
    )
    return combined(combined(first, "+", second), "+", ca.SX(ca.DM([c0 for c0, _ in values])))
