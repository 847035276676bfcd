"""Values of variables that the equations of a model do not compute, as another method than the engine's has found them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import DeclarationError
from acausal.policy import POLICY
from acausal.symbols import scalars, stacked


@dataclass(frozen=True, eq=False)
class Known:
    """Values of quantities of a model that its equations do not compute: what follows from them, does so.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    entries : list of (str, casadi.SX, array)
        Of each scalar its name, its symbol in the model, and its values at all times.
    """

    compiled: CompiledModel
    entries: list[tuple[str, Any, np.ndarray]]

    @cached_property
    def symbols(self) -> ca.SX:
        """A symbol for each of them."""
        return ca.SX.sym("known", len(self.entries))

    @cached_property
    def values(self) -> np.ndarray:
        """Their values, shape (times, n)."""
        return np.column_stack([values for *_, values in self.entries])

    @cached_property
    def unknowns(self) -> list[tuple[int, Any, float]]:
        """Place of each that is an unknown of the flat model, or its opposite; the symbol of that; and 1 or -1."""
        was, becomes = self.compiled.reduced.flat.unknowns.eliminated
        own, found = stacked([symbol for _, symbol, _ in self.entries]), []
        for k, entry in enumerate(scalars(ca.substitute([own], [was], [becomes])[0])):
            if entry.is_symbolic():
                found.append((k, entry, 1.0))
            elif not entry.is_constant() and entry.op() == ca.OP_NEG and entry.dep(0).is_symbolic():
                found.append((k, entry.dep(0), -1.0))
        return found

    def of_states(self) -> dict[int, tuple[str, np.ndarray]]:
        """Values of each state that is among them, by its place; and by which name.

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
        """Express anything of the model in states, algebraic unknowns, parameters, time and what is known."""
        reduced = self.compiled.reduced
        named = stacked([s for _, s, _ in self.entries]), self.symbols
        for was, becomes in (named, reduced.flat.unknowns.eliminated, self._replaced, self._definitions):
            expression = ca.substitute([expression], [was], [becomes])[0]
        return reduced.running.resolve(expression)

    @cached_property
    def _replaced(self) -> tuple[ca.SX, ca.SX]:
        """Unknowns of the flat model but for the states, and what is known of them."""
        own = {s.element_hash() for s in scalars(self.compiled.reduced.x)}
        found = {s.element_hash(): (s, sign * self.symbols[k]) for k, s, sign in self.unknowns}
        pairs = [pair for key, pair in found.items() if key not in own]
        return stacked([was for was, _ in pairs]), stacked([becomes for _, becomes in pairs])

    @cached_property
    def _definitions(self) -> tuple[ca.SX, ca.SX]:
        """Definitions of the others, in states, algebraic unknowns and what is known."""
        known = {s.element_hash() for s in scalars(self._replaced[0])}
        symbols, expressions = (scalars(column) for column in self.compiled.reduced.definitions)
        pairs = [(s, e) for s, e in zip(symbols, expressions, strict=True) if s.element_hash() not in known]
        if not pairs:
            return ca.SX(0, 1), ca.SX(0, 1)
        was = stacked([s for s, _ in pairs])
        becomes = ca.substitute([stacked([e for _, e in pairs])], [self._replaced[0]], [self._replaced[1]])
        return was, ca.substitute_inplace([was], becomes, [])[0][0]
