"""Explicit solution for unknowns that occur linearly with constant coefficients."""

from __future__ import annotations

import casadi as ca

from acausal.structure import Plan
from acausal.symbols import scalars


def solve_explicit(
    pairs: tuple[tuple[int, int], ...],
    residuals: list[ca.SX],
    explicit: dict[tuple[int, int], ca.SX],
    elements: list[ca.SX],
    plan: Plan,
) -> ca.SX:
    """Solve each (unknown, equation) for its unknown: v = -r(v = 0) / c.

    Rows that do not contain each other's unknowns share one substitution (greedy colouring).
    """
    owner = {v: k for k, (v, _) in enumerate(pairs)}
    colour = [0] * len(pairs)
    taken: list[set[int]] = [set() for _ in pairs]
    for k, (v, e) in enumerate(pairs):
        inside = [owner[u] for u in plan.system.rows[e] if u in owner and u != v]
        used = taken[k].union(colour[j] for j in inside if j < k)
        colour[k] = next(c for c in range(len(pairs) + 1) if c not in used)
        for j in inside:
            taken[j].add(colour[k])
    values: list[ca.SX] = [ca.SX(0)] * len(pairs)
    for c in range(max(colour, default=-1) + 1):
        chosen = [k for k in range(len(pairs)) if colour[k] == c]
        symbols = ca.vertcat(*[elements[pairs[k][0]] for k in chosen])
        column = ca.vertcat(*[residuals[pairs[k][1]] for k in chosen])
        rest = ca.substitute([column], [symbols], [ca.SX.zeros(len(chosen))])[0]
        for k, r in zip(chosen, scalars(rest), strict=True):
            v, e = pairs[k]
            coefficient = explicit[e, v]
            values[k] = -r if coefficient.is_one() else r if coefficient.is_minus_one() else -r / coefficient
    return ca.vertcat(*values)
