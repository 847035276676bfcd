"""Tearing: substitution of explicit equations where it keeps the system sparse."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from heapq import heappop, heappush

from acausal.structure.block import Block
from acausal.structure.system import System

LIMIT = 12  # entries of a row and users of a variable beyond which an elimination costs too much


def worthwhile(fill: int, removed: int) -> bool:
    """Return whether an elimination with `fill` new entries and `removed` removed ones pays.

    Fill-in counts twice, because the factors fill further (measured on chains of beams).
    """
    return 2 * fill <= removed


def tear(system: System, blocks: Sequence[Block]) -> list[tuple[int, int]]:
    """Choose the (variable, equation) to substitute, by symbolic Gaussian elimination (Markowitz 1957), cheapest first.

    The chosen pairs can always be evaluated, in some order, from the original equations.

    Parameters
    ----------
    system : System
        The extended system.
    blocks : sequence of Block
        Blocks of the integrated system in order of solution, which breaks ties.

    Returns
    -------
    list of (int, int)
        The pairs in order of elimination.

    """
    equations = [e for block in blocks for e in block.equations]
    elimination = _Elimination(system, equations, {v for block in blocks for v in block.variables})
    elimination.offer((e, v) for e in equations for v in elimination.explicit[e])
    return elimination.run()


class _Elimination:
    def __init__(self, system: System, equations: list[int], unknowns: set[int]) -> None:
        self.rank = {e: k for k, e in enumerate(equations)}
        self.rows = {e: set(system.rows[e]) for e in equations}
        self.explicit = {e: set(system.monic[e] & unknowns) for e in equations}
        self.users: dict[int, set[int]] = {}
        for e in equations:
            for v in system.rows[e]:
                self.users.setdefault(v, set()).add(e)
        self.queue: list[tuple[int, int, int, int]] = []
        self.queued: set[tuple[int, int, int, int]] = set()

    def bound(self, e: int, v: int) -> int:
        """Return the largest possible net fill-in."""
        others, users = len(self.rows[e]) - 1, len(self.users[v]) - 1
        return others * users - others - users

    def admissible(self, e: int, v: int) -> bool:
        """Return whether v can be substituted from equation e at a cost that does not grow with the system."""
        if e not in self.rows or v not in self.explicit[e]:
            return False
        users = len(self.users[v]) - 1
        return not users or (users <= LIMIT and len(self.rows[e]) - 1 <= LIMIT)

    def offer(self, pairs: Iterable[tuple[int, int]]) -> None:
        """Queue pairs at their current cost."""
        for e, v in pairs:
            if self.admissible(e, v):
                entry = (self.bound(e, v), self.rank[e], v, e)
                if entry not in self.queued:
                    self.queued.add(entry)
                    heappush(self.queue, entry)

    def run(self) -> list[tuple[int, int]]:
        """Eliminate as long as it pays; return the chosen pairs."""
        chosen = []
        while self.queue:
            entry = heappop(self.queue)
            self.queued.discard(entry)
            bound, _, v, e = entry
            if not self.admissible(e, v) or bound != self.bound(e, v):
                continue
            row, users = self.rows[e], self.users[v]
            # Row e itself adds no fill, and every other user already contains v.
            fill = sum(len(row - self.rows[u]) for u in users)
            if worthwhile(fill, len(row) + len(users) - 1):
                chosen.append((v, e))
                self.offer(self.eliminate(e, v))
        return chosen

    def eliminate(self, e: int, v: int) -> list[tuple[int, int]]:
        """Substitute v and return the pairs whose cost may have changed."""
        row, users = self.rows.pop(e), self.users.pop(v)
        row.discard(v)
        users.discard(e)
        for c in row:
            self.users[c].discard(e)
        for u in users:
            target = self.rows[u]
            target.discard(v)
            for c in row - target:
                self.users[c].add(u)
            target |= row
            # Variables that also enter through v would make the evaluation order circular.
            self.explicit[u] -= row
            self.explicit[u].discard(v)
        near = users.union(*(self.users[c] for c in row if len(self.users[c]) <= LIMIT + 1))
        lone = [(u, c) for c in row if len(self.users[c]) == 1 for u in self.users[c]]
        return lone + [(u, c) for u in near if len(self.rows[u]) <= LIMIT + 1 for c in self.explicit[u]]
