"""Propagation of constants and aliases: their unknowns are eliminated without solving equations.

An equation with one unknown and a constant coefficient gives a constant; one with two unknowns, both with constant
coefficients, gives an alias. Derivative chains stay consistent: an unknown and its derivative are never merged, and an
unknown is the derivative of one other at most.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from acausal.flatten.linear_values import Linear, LinearValues, add, scale
from acausal.policy import POLICY
from acausal.units import Dimension

DECLARED, CHAINED = 1, 2
PIVOT = POLICY.elimination.pivot
# Constant residual that counts as 0: round-off of a sum of constants of order 1, with a margin of about 5e3.
ZERO = 1e-12


class Source(NamedTuple):
    """A residual, or a derivative of it, which contains the derivatives `unknowns` in addition."""

    row: int
    unknowns: tuple[int, ...] = ()


@dataclass
class Simplification:
    """Result of the propagation, in indices of unknowns and residuals.

    `solved` is the linear value of each removed unknown (in removed and remaining ones), `derivative` the derivative
    chains of the remaining ones. `used` are the residuals that removed an unknown, `eliminated_by` the source that
    removed each unknown, `redundant` the residuals that became 0 = 0, `kept` those replaced by `unknown - constant`.
    `left` are derivatives of used residuals that removed no unknown, each with its source, `repeated` those that became
    0 = 0; `contradictions` are sources with a nonzero constant value.
    """

    derivative: list[int]
    rank: list[int]
    solved: dict[int, Linear] = field(default_factory=dict)
    used: dict[int, int] = field(default_factory=dict)
    eliminated_by: dict[int, Source] = field(default_factory=dict)
    redundant: list[int] = field(default_factory=list)
    kept: dict[int, Linear] = field(default_factory=dict)
    left: list[tuple[Linear, Source]] = field(default_factory=list)
    repeated: list[Source] = field(default_factory=list)
    contradictions: list[tuple[Source, float]] = field(default_factory=list)


class Simplifier:
    """Worklist algorithm over linear values of residuals.

    Parameters
    ----------
    linear : LinearValues
        Residuals with their linear values.
    derivative : list of int
        Position of the derivative of each unknown, or -1.
    rank : list of int
        Preference of each unknown to remain: its preference as a state, plus DECLARED.
    substitutes : dict of int to int, optional
        Residuals that remove no unknown, and the residual that replaces each if it is redundant.
    units : sequence of Dimension or None, optional
        Unit of each unknown, None if unknown; default: all equal.
    stay : collection of int, optional
        Unknowns that are neither removed nor merged into a derivative chain.
    """

    def __init__(
        self,
        linear: LinearValues,
        derivative: list[int],
        rank: list[int],
        substitutes: dict[int, int] | None = None,
        units: Sequence[Dimension | None] = (),
        stay: Collection[int] = (),
    ) -> None:
        self.linear = linear
        self.units = units or [None] * len(derivative)
        self.substitutes = substitutes or {}
        self.stay = stay
        self.up = list(derivative)
        self.down = [-1] * len(derivative)
        for lower, upper in enumerate(derivative):
            if upper >= 0:
                self.down[upper] = lower
        self.rank = rank
        self.result = Simplification(self.up, rank, linear.solved)
        self.extra: list[tuple[Linear, Source]] = []
        self.done: set[int] = set(self.substitutes.values())

    def run(self, stays_zero: Callable[[Simplifier], Mapping[int, Source]] | None = None) -> Simplification:
        """Propagate until nothing changes; return the result.

        Parameters
        ----------
        stays_zero : callable, optional
            Returns the remaining unknowns that stay 0, each with a source that is used up.
        """
        self._propagate(range(len(self.linear.residual)))
        if stays_zero is not None and (members := stays_zero(self)):
            self._set_to_zero(members)
            self._propagate(self.linear.update())
        self.result.left = [(value, source) for value, source in self._settled(self.extra) if value[1]]
        kept = self._settled([(value, Source(row)) for row, value in self.result.kept.items()])
        self.result.kept = {source.row: value for value, source in kept if value[1]}
        self.result.redundant += [source.row for value, source in kept if not value[1]]
        return self.result

    def _propagate(self, queue: Iterable[int]) -> None:
        """Visit residuals, and those whose value changes, until nothing changes."""
        while queue:
            for row in sorted(set(queue)):
                if row not in self.done:
                    self._visit(row)
            left = []
            while self.extra:
                value, source = self.extra.pop()
                if not self._derived(value, source):
                    left.append((value, source))
            # Later eliminations may enable these derivatives to remove an unknown.
            self.extra = left
            queue = self.linear.update()

    def _set_to_zero(self, members: Mapping[int, Source]) -> None:
        """Set whole derivative chains to 0, and use up the sources."""
        used = set(members.values())
        self.extra = [(value, source) for value, source in self.extra if source not in used]
        for unknown, source in members.items():
            self.linear.solve(unknown, (0.0, ()))
            self.result.eliminated_by[unknown] = source
            self.up[unknown] = self.down[unknown] = -1
            if not source.unknowns:
                self.result.used[source.row] = unknown
                self.result.kept.pop(source.row, None)
                self.done.add(source.row)

    def _settled(self, values: list[tuple[Linear, Source]]) -> list[tuple[Linear, Source]]:
        """Return values in remaining unknowns, and record contradictions."""
        found = [(self.linear.resolve(value), source) for value, source in values]
        self.result.contradictions += [(source, v[0]) for v, source in found if not v[1] and abs(v[0]) > ZERO]
        return found

    def _derived(self, value: Linear, source: Source) -> bool:
        """Use the derivative of a residual to remove an unknown; return False if it must remain as an equation."""
        value = self.linear.resolve(value)
        if not value[1]:
            if abs(value[0]) > ZERO:
                self.result.contradictions.append((source, value[0]))
            else:
                self.result.repeated.append(source)
            return True
        return self._assign(value, source)

    def _visit(self, row: int) -> None:
        value = self.linear.value[self.linear.residual[row]]
        value = self.linear.resolve(value) if value is not None else None
        if value is None:
            return
        if not value[1]:
            self.done.add(row)
            if abs(value[0]) > ZERO:
                self.result.contradictions.append((Source(row), value[0]))
            else:
                self.result.redundant.append(row)
                if row in self.substitutes:
                    self.done.discard(self.substitutes[row])
                    self._visit(self.substitutes[row])
        elif row not in self.substitutes and self._assign(value, Source(row)):
            self.done.add(row)

    def _assign(self, value: Linear, source: Source) -> bool:
        """Use `value == 0`, a residual or its derivative, to remove an unknown; return False if none may be removed."""
        c0, terms = value
        pivots = [term for term in terms if self._may_divide(term, terms)]
        candidates = sorted(pivots, key=lambda term: (self._preference(term[0]), -term[0]))
        for unknown, c in candidates:
            rest = tuple((u, k) for u, k in terms if u != unknown)
            solution = scale((c0, rest), -1 / c)
            if self._may_replace(unknown, solution):
                self._replace(unknown, solution, source)
                if not source.unknowns:
                    self.result.used[source.row] = unknown
                return True
        if len(terms) == 1 and not source.unknowns:
            # A constant derivative: other equations may use its value, but the derivative chain needs the unknown.
            self.result.kept[source.row] = value
            return True
        return False

    def _may_divide(self, term: tuple[int, float], terms: tuple[tuple[int, float], ...]) -> bool:
        """Return whether the coefficient of a term is not small relative to those of unknowns of the same unit."""
        unit = self.units[term[0]]
        return all(abs(term[1]) >= PIVOT * abs(c) for other, c in terms if self.units[other] == unit)

    def _preference(self, unknown: int) -> int:
        chained = self.up[unknown] >= 0 or self.down[unknown] >= 0
        return (10 * CHAINED if chained else 0) + self.rank[unknown]

    def _may_replace(self, unknown: int, solution: Linear) -> bool:
        c0, terms = solution
        if unknown in self.stay:
            return False
        if not terms:
            return self.down[unknown] < 0
        (other, c) = terms[0]
        chained = self.up[unknown] >= 0 or self.down[unknown] >= 0
        if self._same_chain(unknown, other) or (chained and other in self.stay):
            return False
        if self.down[unknown] >= 0:
            # The other unknown replaces it as the derivative.
            return c == 1 and c0 == 0 and self.down[other] < 0
        # A derivative of the removed unknown needs a counterpart.
        return self.up[unknown] < 0 or self.up[other] >= 0

    def _same_chain(self, a: int, b: int) -> bool:
        return self._bottom(a) == self._bottom(b)

    def _bottom(self, unknown: int) -> int:
        while self.down[unknown] >= 0:
            unknown = self.down[unknown]
        return unknown

    def _replace(self, unknown: int, solution: Linear, source: Source) -> None:
        self.linear.solve(unknown, solution)
        self.result.eliminated_by[unknown] = source
        upper, lower = self.up[unknown], self.down[unknown]
        self.up[unknown] = self.down[unknown] = -1
        other, c = solution[1][0] if solution[1] else (-1, 0.0)
        if lower >= 0:
            self.up[lower] = other
            self.down[other] = lower
        if upper < 0:
            return
        self.down[upper] = -1
        if other < 0:
            self.extra.append(((0.0, ((upper, 1.0),)), Source(source.row, (*source.unknowns, upper))))
        elif self.up[other] < 0:
            self.up[other], self.down[upper] = upper, other
        else:
            link = add((0.0, ((upper, 1.0),)), (0.0, ((self.up[other], c),)), -1.0)
            assert link is not None
            self.extra.append((link, Source(source.row, (*source.unknowns, upper, self.up[other]))))
