"""Structural dependencies of unknowns, through the equations that determine them."""

from __future__ import annotations

from collections.abc import Iterable

import casadi as ca
import numpy as np
import scipy

from acausal.structure.matching import maximum_matching
from acausal.symbols import scalars


class Reach:
    """Structural dependencies of unknowns, and of expressions in them, on given quantities.

    Parameters
    ----------
    equations, unknowns : casadi.SX
        Residuals and unknowns of a square system.
    given : casadi.SX
        Given quantities.
    """

    def __init__(self, equations: ca.SX, unknowns: ca.SX, given: ca.SX) -> None:
        self._unknown = {s.element_hash(): k for k, s in enumerate(scalars(unknowns))}
        self._given = {s.element_hash(): k for k, s in enumerate(scalars(given))}
        n = unknowns.numel()
        rows: list[list[int]] = [[] for _ in range(n)]
        own = [0] * n
        for row, column in _entries(equations, unknowns):
            rows[row].append(column)
        for row, column in _entries(equations, given):
            own[row] |= 1 << column
        equation_of = maximum_matching(rows, n).equation_of
        self._sets = _gathered([rows[equation_of[k]] for k in range(n)], [own[equation_of[k]] for k in range(n)])

    def __call__(self, expression: ca.SX) -> tuple[int, ...]:
        """Return the indices of the given quantities on which an expression depends, in ascending order."""
        bits = 0
        for symbol in ca.symvar(expression):
            key = symbol.element_hash()
            if key in self._unknown:
                bits |= self._sets[self._unknown[key]]
            elif key in self._given:
                bits |= 1 << self._given[key]
        return tuple(k for k in range(bits.bit_length()) if bits >> k & 1)


def _entries(equations: ca.SX, by: ca.SX) -> Iterable[tuple[int, int]]:
    return zip(*ca.jacobian_sparsity(equations, by).get_triplet(), strict=True)  # type: ignore[attr-defined]


def _gathered(needs: list[list[int]], own: list[int]) -> list[int]:
    """Return the union of the sets, as bits, of each node and of all its direct and indirect predecessors."""
    n = len(needs)
    if not n:
        return []
    heads = np.repeat(np.arange(n), [len(k) for k in needs])
    tails = np.array([k for row in needs for k in row], dtype=int)
    graph = scipy.sparse.csr_matrix((np.ones(len(heads)), (heads, tails)), shape=(n, n))
    count, label = scipy.sparse.csgraph.connected_components(graph, connection="strong")
    sets, after = [0] * count, [set[int]() for _ in range(count)]
    for k, bits in enumerate(own):
        sets[label[k]] |= bits
        after[label[k]].update(int(label[j]) for j in needs[k] if label[j] != label[k])
    for component in _leaves_first(after):
        for other in after[component]:
            sets[component] |= sets[other]
    return [sets[k] for k in label]


def _leaves_first(after: list[set[int]]) -> Iterable[int]:
    """Return the nodes in topological order, predecessors first."""
    users: list[list[int]] = [[] for _ in after]
    waits = [len(k) for k in after]
    for node, others in enumerate(after):
        for other in others:
            users[other].append(node)
    ready = [node for node, left in enumerate(waits) if not left]
    while ready:
        node = ready.pop()
        yield node
        for user in users[node]:
            waits[user] -= 1
            if not waits[user]:
                ready.append(user)
