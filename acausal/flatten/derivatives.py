"""Time derivatives requested with der(), formed in a few calls."""

from __future__ import annotations

from typing import Any

import casadi as ca

from acausal.language.functions import time
from acausal.symbols import dense, scalars, stacked, vec


class Derivatives:
    """Symbols of the variables and of their time derivatives that occur.

    Parameters
    ----------
    variables : casadi.SX
        All scalar variables, a column.
    declared : dict of int to casadi.SX
        Declared derivatives of variables, in other variables.
    """

    def __init__(self, variables: ca.SX, declared: dict[int, ca.SX]) -> None:
        self.variables, self.declared = variables, declared
        self._symbols: dict[tuple[int, int], ca.SX] = {}
        self._places = {s.element_hash(): (0, k) for k, s in enumerate(scalars(variables))}

    @property
    def levels(self) -> list[ca.SX]:
        """The variables, their first derivatives that occur, and so on, a column each."""
        last = max((level for level, _ in self._symbols), default=0)
        places = [sorted(place for place in self._symbols if place[0] == level) for level in range(1, last + 1)]
        return [self.variables, *[stacked([self._symbols[place] for place in level]) for level in places]]

    @property
    def lower(self) -> list[int]:
        """Position of the differentiated symbol, for each derivative, in all levels one after the other."""
        n = self.variables.numel()
        at = {place: n + k for k, place in enumerate(sorted(self._symbols))}
        return [variable if level == 1 else at[level - 1, variable] for level, variable in at]

    def symbol(self, variable: int, level: int = 1) -> ca.SX:
        """Return the symbol of a derivative of a variable."""
        if level == 0:
            return self.variables[variable]
        place = level, variable
        if place not in self._symbols:
            own = self._symbols[place] = ca.SX.sym(f"der({self.symbol(variable, level - 1).name()})")
            self._places[own.element_hash()] = place
        return self._symbols[place]

    def of(self, expressions: ca.SX) -> ca.SX:
        """Return the time derivatives of a column of expressions."""
        at, seeds = list[Any](), list[Any]()
        for symbol in ca.symvar(expressions):
            level, variable = self._places.get(symbol.element_hash(), (0, -1))
            if variable >= 0:
                at.append(symbol)
                known = self.declared.get(variable) if level == 0 else None
                seeds.append(self.symbol(variable, level + 1) if known is None else known)
        return dense(ca.jtimes(expressions, ca.vertcat(*at, time.sx), ca.vertcat(*seeds, 1)))

    def resolve(self, pending: list[tuple[ca.SX, ca.SX]]) -> tuple[ca.SX, ca.SX]:
        """Return placeholders and their derivatives; an expression may contain other placeholders."""
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
