"""Form the derivatives that equations request with der(), all in a few calls."""

from __future__ import annotations

import casadi as ca

from acausal.language.functions import time
from acausal.symbols import dense, scalars, vec


class Derivatives:
    """Symbols of the variables and of their time derivatives.

    Parameters
    ----------
    variables : casadi.SX
        All scalar variables, a column.
    declared : dict of int to casadi.SX
        Variables whose derivative is a declared expression of other variables.
    """

    def __init__(self, variables: ca.SX, declared: dict[int, ca.SX]) -> None:
        self.levels = [variables]
        self.declared = declared
        self._grow()

    def _grow(self) -> None:
        symbols = scalars(self.levels[-1])
        self.levels.append(ca.vertcat(*[ca.SX.sym(f"der({s.name()})") for s in symbols]))

    def of(self, expressions: ca.SX) -> ca.SX:
        """Differentiate a column of expressions with respect to time."""
        if ca.depends_on(expressions, self.levels[-1]):
            self._grow()
        first = scalars(self.levels[1])
        for index, expression in self.declared.items():
            first[index] = expression
        at = ca.vertcat(*self.levels[:-1], time.sx)
        seeds = ca.vertcat(*first, *self.levels[2:], 1)
        return dense(ca.jtimes(expressions, at, seeds))

    def resolve(self, pending: list[tuple[ca.SX, ca.SX]]) -> tuple[ca.SX, ca.SX]:
        """Return placeholders and the derivatives that they stand for; an expression may hold other placeholders."""
        names = {s.element_hash(): k for k, (p, _) in enumerate(pending) for s in scalars(p)}
        depth: list[int] = []
        for _, expression in pending:
            inside = (names.get(s.element_hash()) for s in ca.symvar(expression))
            depth.append(1 + max((depth[k] for k in inside if k is not None), default=0))
        placeholders, derivatives = ca.SX(0, 1), ca.SX(0, 1)
        for level in range(1, max(depth, default=0) + 1):
            chosen = [pending[k] for k, d in enumerate(depth) if d == level]
            expressions = ca.vertcat(*[dense(vec(e)) for _, e in chosen])
            expressions = ca.substitute([expressions], [placeholders], [derivatives])[0]
            placeholders = ca.vertcat(placeholders, *[vec(p) for p, _ in chosen])
            derivatives = ca.vertcat(derivatives, self.of(expressions))
        return placeholders, derivatives
