"""Unknowns that stay 0 for ever: a machine that moves in a plane, made of parts that could leave it.

S = 0 is an invariant subspace of the unknowns S if as many equations E vanish there as S has derivative chains,
whatever the other unknowns are. Then E depends on S alone where S = 0, so that the Jacobian is block triangular: if the
model is regular, E determines S, and all other equations the other unknowns. S and E are the largest ones that are
structurally regular, by the incidence to first order at S = 0: a product depends on a factor if the other one is not 0.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, field

import casadi as ca

from acausal.flatten.linear_values import Linear, LinearValues
from acausal.flatten.simplify import ZERO, Simplifier, Source
from acausal.flatten.zero_values import ZeroValues, zero_values
from acausal.structure.dulmage_mendelsohn import decompose
from acausal.structure.matching import maximum_matching


@dataclass(frozen=True)
class StaysZero:
    """The unknowns that stay 0.

    Attributes
    ----------
    chains : list of list of int
        Their derivative chains, each from the lowest unknown on.
    sources : list of Source
        The equation that each chain is matched with.
    links : mapping of Source to Linear
        Values of those of these that are derivatives.
    conditions : frozenset of int
        Numbers of the conditions at the start that they satisfy.
    solved : dict of int to Linear
        Values of the unknowns that were removed before.
    """

    chains: list[list[int]] = field(default_factory=list)
    sources: list[Source] = field(default_factory=list)
    links: Mapping[Source, Linear] = field(default_factory=dict)
    conditions: frozenset[int] = frozenset()
    solved: dict[int, Linear] = field(default_factory=dict)

    @property
    def members(self) -> dict[int, Source]:
        """The source of each unknown."""
        pairs = zip(self.chains, self.sources, strict=True)
        return {k: source for chain, source in pairs for k in chain}

    @property
    def differentiated(self) -> list[int]:
        """The unknowns with a derivative."""
        return [k for chain in self.chains for k in chain[:-1]]


@dataclass(frozen=True)
class ZeroBlock:
    """Equations that vanish with the unknowns that stay 0, and depend on them alone to first order.

    Parameters
    ----------
    residuals : casadi.SX
        The equations, a column, as many as derivative chains.
    symbols : casadi.SX
        The unknowns, a column.
    names : tuple of str
        Their names.
    derivative : tuple of int
        Position of the derivative of each, or -1.
    """

    residuals: ca.SX
    symbols: ca.SX
    names: tuple[str, ...]
    derivative: tuple[int, ...]


def stays_zero(
    simplifier: Simplifier, barred: Iterable[int], present: Collection[int], conditions: Callable[[], LinearValues]
) -> StaysZero:
    """Return the unknowns that stay 0 after the propagation of constants and aliases.

    Parameters
    ----------
    simplifier : Simplifier
        Its worklist is done.
    barred : iterable of int
        Unknowns that may start at other values than 0, or jump there.
    present : collection of int
        Unknowns that occur in the equations.
    conditions : callable
        Returns the conditions at the start, with the values of removed unknowns; called if unknowns may stay 0.
    """
    search = _Search(simplifier, barred, present)
    while (balanced := search.balanced()) is not None:
        starts = conditions()
        values = zero_values(starts, search.bits_of_unknowns(), range(len(starts.op)))
        if not search.remove(search.undetermined_at_start(starts, values, balanced)):
            satisfied = frozenset(k for k, node in enumerate(starts.residual) if _vanishes(values, node))
            return search.found(balanced, satisfied)
    return StaysZero()


def _vanishes(values: ZeroValues, node: int) -> bool:
    return abs(values.constant.get(node, 1.0)) <= ZERO


def _places(bits: int) -> list[int]:
    """Return the positions of the bits, ascending."""
    found = []
    while bits:
        found.append((bits & -bits).bit_length() - 1)
        bits &= bits - 1
    return found


@dataclass(frozen=True)
class _Balanced:
    """Equations that vanish with the members, and the chains that change each to first order."""

    sources: list[Source]
    rows: list[list[int]]


class _Search:
    """The derivative chains that may stay 0, reduced until as many equations vanish.

    Parameters are those of `stays_zero`.
    """

    def __init__(self, simplifier: Simplifier, barred: Iterable[int], present: Collection[int]) -> None:
        self.linear, self.simplifier = simplifier.linear, simplifier
        up, down = simplifier.up, simplifier.down
        self.chains: dict[int, list[int]] = {}
        for unknown in range(len(up)):
            if unknown in self.linear.solved or down[unknown] >= 0:
                continue
            if up[unknown] >= 0 or unknown in present:
                self.chains[unknown] = chain = [unknown]
                while up[chain[-1]] >= 0:
                    chain.append(up[chain[-1]])
        self.bottom = {k: bottom for bottom, chain in self.chains.items() for k in chain}
        self.remove({self.bottom[k] for k in barred if k in self.bottom})
        open_rows = (
            r for r in range(len(self.linear.residual)) if r not in simplifier.done or r in simplifier.result.kept
        )
        self.rows = {row: self.linear.residual[row] for row in open_rows}
        self.nodes: Iterable[int] = range(len(self.linear.op))

    def remove(self, bottoms: Collection[int]) -> bool:
        """Remove chains, each given by its lowest unknown; return whether there are any."""
        for bottom in bottoms:
            del self.chains[bottom]
        return bool(bottoms)

    def balanced(self) -> _Balanced | None:
        """Remove chains until as many equations vanish with the others; return None if no chain is left."""
        while self.chains:
            place = {bottom: n for n, bottom in enumerate(self.chains)}
            bits = {k: 1 << place[bottom] for bottom, chain in self.chains.items() for k in chain}
            values = zero_values(self.linear, bits, self.nodes)
            self.nodes = values.constant  # with fewer members no other operation becomes constant
            found = self._vanishing(values, place, bits)
            if not self.remove(self._unbalanced(found, list(place)) or self._unsuitable(values)):
                return found
        return None

    def _vanishing(self, values: ZeroValues, place: Mapping[int, int], bits: Mapping[int, int]) -> _Balanced:
        """Return the equations that vanish with the members.

        A closure of a loop counts with the flow that works on it alone: by itself it may be redundant.
        """
        found = _Balanced([], [])
        for row, node in self.rows.items():
            dual = self.simplifier.substitutes.get(row)
            if _vanishes(values, node) and (dual is None or _vanishes(values, self.linear.residual[dual])):
                found.sources.append(Source(row))
                found.rows.append(_places(values.changed_by.get(node, 0)))
        for value, source in self.simplifier.extra:
            c0, terms = self.linear.resolve(value)
            if abs(c0) <= ZERO and all(k in bits for k, _ in terms):
                found.sources.append(source)
                found.rows.append(sorted({place[self.bottom[k]] for k, _ in terms}))
        return found

    def _unsuitable(self, values: ZeroValues) -> set[int]:
        """Return the chains with which operations have no value, or equations would remain that hold no unknown."""
        nodes = list(values.undefined)
        nodes += (node for node in self.rows.values() if node in values.constant and not _vanishes(values, node))
        return {bottom for node in nodes for bottom in self._inside(self.linear, node) if bottom in self.chains}

    def _unbalanced(self, found: _Balanced, bottoms: list[int]) -> set[int]:
        """Return the chains of the under-determined part, or those of the over-determined one if there is none."""
        parts = decompose(found.rows, len(bottoms))
        if parts.under.variables:
            return {bottoms[k] for k in parts.under.variables}
        over = {bottoms[k] for k in parts.over.variables}
        for k in parts.over.equations:
            # Without incidence to first order, as x y = 0: with one member less it does not vanish.
            row = found.sources[k].row
            if not found.rows[k] and not found.sources[k].unknowns:
                over |= {b for b in self._inside(self.linear, self.linear.residual[row]) if b in self.chains}
        return over

    def _inside(self, linear: LinearValues, node: int) -> set[int]:
        """Return the chains of the unknowns in an expression, -1 for one that has none."""
        found, queue, seen = set[int](), [node], {node}
        while queue:
            node = queue.pop()
            value: Linear | None = linear.value[node]
            if value is not None:
                found.update(self.bottom.get(k, -1) for k, _ in value[1])
                continue
            queue += (new := set(linear.args[node]).difference(seen))
            seen |= new
        return found

    def bits_of_unknowns(self) -> dict[int, int]:
        """Return a bit for each member."""
        members = [k for chain in self.chains.values() for k in chain]
        return {k: 1 << n for n, k in enumerate(members)}

    def undetermined_at_start(self, starts: LinearValues, values: ZeroValues, balanced: _Balanced) -> set[int]:
        """Return the chains that start elsewhere, or whose start the vanishing equations and conditions do not determine.

        A condition on members alone that does not vanish would contradict.
        """
        elsewhere = set[int]()
        for node in starts.residual:
            inside = self._inside(starts, node) if not _vanishes(values, node) else set()
            if inside <= self.chains.keys():
                elsewhere |= inside
        if elsewhere:
            return elsewhere
        bits = self.bits_of_unknowns()
        own = zero_values(self.linear, bits, self.nodes)
        rows = [_places(own.changed_by.get(self.linear.residual[s.row], 0)) for s in balanced.sources if not s.unknowns]
        rows += [_places(values.changed_by.get(node, 0)) for node in starts.residual if _vanishes(values, node)]
        members, up = list(bits), self.simplifier.up
        free = (members[k] for k in decompose(rows, len(members)).under.variables)
        return {self.bottom[k] for k in free if up[k] >= 0}

    def found(self, balanced: _Balanced, conditions: frozenset[int]) -> StaysZero:
        """Return the chains, each with an equation that it is matched with."""
        matching = maximum_matching(balanced.rows, len(self.chains))
        sources = [balanced.sources[row] for row in matching.equation_of]
        links = {source: value for value, source in self.simplifier.extra if source in sources}
        return StaysZero(list(self.chains.values()), sources, links, conditions, dict(self.linear.solved))
