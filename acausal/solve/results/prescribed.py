"""Prescribed variables: values that another solver computed, substituted in the expressions of a model."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import DeclarationError
from acausal.policy import POLICY
from acausal.symbols import inlined, scalars, stacked


@dataclass(frozen=True, eq=False)
class Prescribed:
    """Values of variables of a model that replace their equations.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    entries : list of (str, casadi.SX, array)
        Name, symbol in the model, and values at all times, of each scalar.
    """

    compiled: CompiledModel
    entries: list[tuple[str, Any, np.ndarray]]

    @cached_property
    def symbols(self) -> ca.SX:
        """A symbol for each scalar."""
        return ca.SX.sym("prescribed", len(self.entries))

    @cached_property
    def values(self) -> np.ndarray:
        """Values, shape (times, n)."""
        return np.column_stack([values for *_, values in self.entries])

    @cached_property
    def unknowns(self) -> list[tuple[int, Any, float]]:
        """Place, symbol and sign, 1 or -1, of each scalar that is an unknown of the flat model or its negative."""
        was, becomes = self.compiled.reduced.flat.unknowns.eliminated
        own, found = stacked([symbol for _, symbol, _ in self.entries]), []
        for k, entry in enumerate(scalars(ca.substitute([own], [was], [becomes])[0])):
            if entry.is_symbolic():
                found.append((k, entry, 1.0))
            elif not entry.is_constant() and entry.op() == ca.OP_NEG and entry.dep(0).is_symbolic():
                found.append((k, entry.dep(0), -1.0))
        return found

    def of_states(self) -> dict[int, tuple[str, np.ndarray]]:
        """Prescribed states: place -> name and values.

        Raises
        ------
        DeclarationError
            If two names of one variable have different values.
        """
        places = {s.element_hash(): k for k, s in enumerate(scalars(self.compiled.reduced.x))}
        known: dict[int, tuple[str, np.ndarray]] = {}
        states: dict[int, tuple[str, np.ndarray]] = {}
        for k, symbol, sign in self.unknowns:
            name, _, values = self.entries[k]
            first, before = known.setdefault(symbol.element_hash(), (name, sign * values))
            far = np.abs(sign * values - before).max(initial=0.0)
            if far > POLICY.consistent.given * np.abs(before).max(initial=0.0):
                raise DeclarationError(
                    f"`{first}` and `{name}` are one variable of the model, and have values that differ by up to {far:.3g}"
                )
            if symbol.element_hash() in places:
                states[places[symbol.element_hash()]] = first, before
        return states

    def resolve(self, expression: ca.SX) -> ca.SX:
        """Return an expression of the model in states, algebraic unknowns, parameters, time and prescribed variables."""
        reduced = self.compiled.reduced
        named = stacked([s for _, s, _ in self.entries]), self.symbols
        for was, becomes in (named, reduced.flat.unknowns.eliminated, self._replaced, self._definitions):
            expression = ca.substitute([expression], [was], [becomes])[0]
        return reduced.running.resolve(expression)

    @cached_property
    def _replaced(self) -> tuple[ca.SX, ca.SX]:
        """Prescribed unknowns of the flat model other than states, and their values."""
        own = {s.element_hash() for s in scalars(self.compiled.reduced.x)}
        found = {s.element_hash(): (s, sign * self.symbols[k]) for k, s, sign in self.unknowns}
        pairs = [pair for key, pair in found.items() if key not in own]
        return stacked([was for was, _ in pairs]), stacked([becomes for _, becomes in pairs])

    @cached_property
    def _definitions(self) -> tuple[ca.SX, ca.SX]:
        """Definitions of the other unknowns, in states, algebraic unknowns and prescribed variables."""
        known = {s.element_hash() for s in scalars(self._replaced[0])}
        symbols, expressions = (scalars(column) for column in self.compiled.reduced.definitions)
        pairs = [(s, e) for s, e in zip(symbols, expressions, strict=True) if s.element_hash() not in known]
        if not pairs:
            return ca.SX(0, 1), ca.SX(0, 1)
        was = stacked([s for s, _ in pairs])
        becomes = ca.substitute([stacked([e for _, e in pairs])], [self._replaced[0]], [self._replaced[1]])
        return was, inlined(was, becomes[0], [])[0]
