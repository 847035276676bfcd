"""Dependence of values on algebraic unknowns, and the order of solution."""

from __future__ import annotations

from collections.abc import Iterable

import casadi as ca
import numpy as np

from acausal.structure import Level, block_triangular, levels
from acausal.structure.matching import maximum_matching
from acausal.symbols import scalars


class Dependence:
    """Reachability among the algebraic equations.

    Parameters
    ----------
    alg, z : casadi.SX
        Residuals and algebraic unknowns, equal in number.
    """

    def __init__(self, alg: ca.SX, z: ca.SX) -> None:
        n = z.numel()
        self._place = {s.element_hash(): k for k, s in enumerate(scalars(z))}
        self._rows: list[list[int]] = [[] for _ in range(n)]
        pattern = ca.jacobian_sparsity(alg, z)  # type: ignore[attr-defined]
        for row, column in zip(*pattern.get_triplet(), strict=True):
            self._rows[row].append(column)
        self._equation_of = maximum_matching(self._rows, n).equation_of

    def inside(self, expression: ca.SX) -> set[int]:
        """Return the positions of the algebraic unknowns that occur in an expression."""
        found = (self._place.get(s.element_hash()) for s in ca.symvar(expression))
        return {k for k in found if k is not None}

    def needed(self, wanted: Iterable[int]) -> tuple[np.ndarray, np.ndarray]:
        """Return all unknowns on which the wanted ones depend, themselves included, ascending, and their equations."""
        stack = list(wanted)
        seen = set(stack)
        while stack:
            for k in self._rows[self._equation_of[stack.pop()]]:
                if k not in seen:
                    seen.add(k)
                    stack.append(k)
        unknowns = sorted(seen)
        return np.array(unknowns, dtype=int), np.array([self._equation_of[k] for k in unknowns], dtype=int)

    def needing(self, equations: Iterable[int]) -> set[int]:
        """Return the unknowns that depend on some equations."""
        wanted = set(equations)
        needed_by: list[list[int]] = [[] for _ in self._rows]
        for unknown, equation in enumerate(self._equation_of):
            for other in self._rows[equation]:
                needed_by[other].append(unknown)
        stack = [k for k, equation in enumerate(self._equation_of) if equation in wanted]
        seen = set(stack)
        while stack:
            more = [k for k in needed_by[stack.pop()] if k not in seen]
            seen.update(more)
            stack += more
        return seen


def solution_levels(J: ca.SX, unknowns: ca.SX) -> tuple[Level, ...]:
    """Return the levels of simultaneous solution, in order.

    Parameters
    ----------
    J : casadi.SX
        Jacobian of the residuals by the unknowns; row k is matched with column k.
    unknowns : casadi.SX
        The unknowns.
    """
    entries = list(zip(*J.sparsity().get_triplet(), strict=True))
    rows: list[list[int]] = [[] for _ in range(J.shape[0])]
    for row, column in entries:
        rows[row].append(column)
    second = ca.jacobian_sparsity(J.nz[:], unknowns)  # type: ignore[attr-defined]
    products = ((*entries[k], column) for k, column in zip(*second.get_triplet(), strict=True))
    return levels(block_triangular(rows, [(k, k) for k in range(len(rows))]), rows, products)
