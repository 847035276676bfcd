"""Attributes of the unknowns: what a removed alias was declared with passes on to the unknown that it is."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

import casadi as ca
import numpy as np

from acausal.flatten.collected_statements import CollectedStatements
from acausal.flatten.linear_values import Linear
from acausal.flatten.variables import VariableArray
from acausal.language.fields import ALWAYS
from acausal.symbols import dense, scalars, stacked, vec
from acausal.units import Dimension, parse

SECOND = parse("s")
ZERO = ca.SX(0)


@dataclass
class Attributes:
    """Attributes of one scalar unknown, with the words of `FlatUnknowns`.

    `weight` is that of the start value: an instance takes precedence over its class, and that over nothing.
    """

    name: str
    unit: Dimension | None
    preference: int = 0
    nominal: float = 1.0
    sized: bool = False
    start: ca.SX = field(default_factory=lambda: ZERO)
    guessed: bool = False
    weight: int = 0

    def derivative(self) -> Attributes:
        """Attributes of the time derivative, of which nothing else is declared."""
        return Attributes(f"der({self.name})", _rate(self.unit))

    def receive(self, alias: Attributes, offset: float, factor: float) -> None:
        """Take what an alias was declared with, which is offset + factor times this unknown."""
        if alias.weight > self.weight:
            self.start, self.weight, self.guessed = (alias.start - offset) / factor, alias.weight, alias.guessed
        if alias.preference > self.preference == 0:
            self.preference = alias.preference
        if alias.sized and not self.sized:
            self.nominal, self.sized = alias.nominal / abs(factor), True


def attributes(
    raw: CollectedStatements, lower: list[int], jumping: Iterable[int], solved: Mapping[int, Linear]
) -> list[Attributes]:
    """Return the attributes of all unknowns, those of the derivatives behind those of the variables.

    Parameters
    ----------
    raw : CollectedStatements
        What the components stated.
    lower : list of int
        Of each derivative, what it is the derivative of.
    jumping : iterable of int
        Variables that jump at instants, which have to be states.
    solved : mapping of int to Linear
        What each removed unknown is, in the order of removal.
    """
    found = [a for array in raw.arrays for a in _declared(array)]
    for attribute, nominal in zip(found, _nominals(raw), strict=True):
        attribute.nominal = nominal
    for k in jumping:
        found[k].preference = ALWAYS
    for k in lower:
        found.append(found[k].derivative())
    for k in reversed(list(solved)):
        offset, terms = solved[k]
        if terms:
            other, factor = terms[0]
            found[other].receive(found[k], offset, factor)
    return found


def unknown_units(raw: CollectedStatements, lower: list[int]) -> list[Dimension | None]:
    """Return the units of all unknowns, those of the derivatives behind those of the variables; None where not known."""
    found = [unit for array in raw.arrays for unit in array.units]
    for k in lower:
        found.append(_rate(found[k]))
    return found


def weighing(raw: CollectedStatements) -> tuple[str, ...]:
    """Names of the parameters that nominal values depend on."""
    inside = {s.element_hash() for s in ca.symvar(stacked(_weights(raw).values()))}
    own = raw.build.parameters
    return tuple(name for name, s in zip(own.names, own.symbols, strict=True) if s.element_hash() in inside)


def _rate(unit: Dimension | None) -> Dimension | None:
    return unit and unit / SECOND


def _declared(array: VariableArray) -> Iterator[Attributes]:
    """Yield what is declared of each entry of a variable, except for its nominal value."""
    starts = scalars(array.start.sx)
    entries = zip(array.names, array.units, starts, array.fixed, array.guessed, strict=True)
    for name, unit, start, fixed, given in entries:
        guessed = given or fixed
        weight = 2 if guessed else int(not start.is_zero())
        yield Attributes(
            name, unit, array.declared.select, sized=array.sized, start=start, guessed=guessed, weight=weight
        )


def _weights(raw: CollectedStatements) -> dict[int, ca.SX]:
    """Nominal values of variables, in parameters, by the expression that gives them."""
    return {id(a.nominal): dense(vec(a.nominal.sx)) for a in {id(a.nominal): a for a in raw.arrays}.values()}


def _nominals(raw: CollectedStatements) -> list[float]:
    """Nominal values of all variables as they are when compiled."""
    own, weights = raw.build.parameters, _weights(raw)
    function = ca.Function("nominal", [stacked(own.symbols)], [stacked(weights.values())])
    found = np.array(function(np.array(own.values))).ravel().tolist()
    ends = np.cumsum([w.numel() for w in weights.values()]).tolist()
    known = {key: found[end - w.numel() : end] for (key, w), end in zip(weights.items(), ends, strict=True)}
    return [value for a in raw.arrays for value in known[id(a.nominal)]]
