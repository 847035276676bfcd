"""Attributes of the unknowns: a removed alias passes its attributes on to the remaining unknown."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field

import casadi as ca
import numpy as np

from acausal.flatten.collected_statements import CollectedStatements
from acausal.flatten.flat_model import FlatDiscontinuities
from acausal.flatten.linear_values import Linear, LinearValues
from acausal.flatten.variables import VariableArray
from acausal.language.fields import ALWAYS
from acausal.symbols import dense, scalars, stacked, vec
from acausal.units import Dimension, parse

SECOND = parse("s")
ZERO = ca.SX(0)


@dataclass
class Attributes:
    """Attributes of a scalar unknown, named as in `FlatUnknowns`.

    `weight` is the precedence of the start value: 2 from an instance, 1 from a class, 0 for none.
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
        """Return the attributes of the time derivative, which has no declaration."""
        return Attributes(f"der({self.name})", _rate(self.unit))

    def receive(self, alias: Attributes, offset: float, factor: float) -> None:
        """Take the attributes of an alias, which equals offset + factor times this unknown."""
        if alias.weight > self.weight:
            self.start, self.weight, self.guessed = (alias.start - offset) / factor, alias.weight, alias.guessed
        if alias.preference > self.preference == 0:
            self.preference = alias.preference
        if alias.sized and not self.sized:
            self.nominal, self.sized = alias.nominal / abs(factor), True


def attributes(
    raw: CollectedStatements, lower: list[int], jumping: Iterable[int], solved: Mapping[int, Linear]
) -> list[Attributes]:
    """Return the attributes of all unknowns, variables before derivatives.

    Parameters
    ----------
    raw : CollectedStatements
        Statements of the components.
    lower : list of int
        Position of the differentiated unknown, for each derivative.
    jumping : iterable of int
        Variables that jump at events, which must be states.
    solved : mapping of int to Linear
        Value of each removed unknown, in the order of removal.
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
    """Return the units of all unknowns, variables before derivatives; None for an unknown unit."""
    found = [unit for array in raw.arrays for unit in array.units]
    for k in lower:
        found.append(_rate(found[k]))
    return found


def jumping(raw: CollectedStatements, discontinuities: FlatDiscontinuities) -> list[int]:
    """Return the continuous variables that jump at events, which must be states."""
    targets = [jump.target for guard in discontinuities.guards for jump in guard.jumps if jump.target.is_symbolic()]
    places = (raw.index.get(target.element_hash(), -1) for target in targets)
    return [k for k in places if k >= 0]


def started_elsewhere(raw: CollectedStatements, linear: LinearValues, discontinuities: FlatDiscontinuities) -> set[int]:
    """Return the remaining unknowns that may start at other values than 0, or get there at an event.

    These have another start value, a guess too, or jump, or their sign chooses the mode of a set-valued law.

    Parameters
    ----------
    raw : CollectedStatements
        Statements of the components.
    linear : LinearValues
        Values of removed unknowns, whose start values count.
    discontinuities : FlatDiscontinuities
        Jumps and set-valued laws.
    """
    sliding = ca.symvar(stacked([law.speed for law in discontinuities.laws]))
    found = jumping(raw, discontinuities)
    found += [raw.index[s.element_hash()] for s in sliding if s.element_hash() in raw.index]
    zero, first = {key: start.sx.is_zero() for key, start in {id(a.start): a.start for a in raw.arrays}.items()}, 0
    for array in raw.arrays:
        if not zero[id(array.start)] or any(array.guessed) or any(array.fixed):
            for k, start in enumerate(scalars(dense(array.start.sx)), first):
                offset, _ = linear.resolve((0.0, ((k, 1.0),)))
                by_default = start.is_zero() and not (array.guessed[k - first] or array.fixed[k - first])
                if not by_default and not (start.is_constant() and float(start) == offset):
                    found.append(k)
        first += len(array.guessed)
    return {k for unknown in found for k, _ in linear.resolve((0.0, ((unknown, 1.0),)))[1]}


def by_preference(raw: CollectedStatements, lower: list[int], unknowns: Collection[int]) -> tuple[str, ...]:
    """Return the names of unknowns, those preferred as states first."""
    if not unknowns:
        return ()
    names, preferred = unknown_names(raw, lower), [a.declared.select > 0 for a in raw.arrays for _ in a.names]
    preferred += [False] * len(lower)
    return tuple(names[k] for k in sorted(unknowns, key=lambda k: (not preferred[k], k)))


def unknown_names(raw: CollectedStatements, lower: list[int]) -> list[str]:
    """Return the names of all unknowns, variables before derivatives."""
    names = [name for array in raw.arrays for name in array.names]
    for k in lower:
        names.append(f"der({names[k]})")
    return names


def weighing(raw: CollectedStatements) -> tuple[str, ...]:
    """Return the names of the parameters on which nominal values depend."""
    inside = {s.element_hash() for s in ca.symvar(stacked(_weights(raw).values()))}
    own = raw.build.parameters
    return tuple(name for name, s in zip(own.names, own.symbols, strict=True) if s.element_hash() in inside)


def _rate(unit: Dimension | None) -> Dimension | None:
    return unit and unit / SECOND


def _declared(array: VariableArray) -> Iterator[Attributes]:
    """Yield the declared attributes of each entry of a variable, except its nominal value."""
    starts = scalars(array.start.sx)
    entries = zip(array.names, array.units, starts, array.fixed, array.guessed, strict=True)
    for name, unit, start, fixed, given in entries:
        guessed = given or fixed
        weight = 2 if guessed else int(not start.is_zero())
        yield Attributes(
            name, unit, array.declared.select, sized=array.sized, start=start, guessed=guessed, weight=weight
        )


def _weights(raw: CollectedStatements) -> dict[int, ca.SX]:
    """Return the distinct nominal values, in parameters, by the identity of their expressions."""
    return {id(a.nominal): dense(vec(a.nominal.sx)) for a in {id(a.nominal): a for a in raw.arrays}.values()}


def _nominals(raw: CollectedStatements) -> list[float]:
    """Return the nominal values of all variables for the parameters when compiled."""
    own, weights = raw.build.parameters, _weights(raw)
    function = ca.Function("nominal", [stacked(own.symbols)], [stacked(weights.values())])
    found = np.array(function(np.array(own.values))).ravel().tolist()
    ends = np.cumsum([w.numel() for w in weights.values()]).tolist()
    known = {key: found[end - w.numel() : end] for (key, w), end in zip(weights.items(), ends, strict=True)}
    return [value for a in raw.arrays for value in known[id(a.nominal)]]
