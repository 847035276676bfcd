"""Fill-reducing order of the algebraic unknowns."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy

from acausal.structure.matching import maximum_matching
from acausal.structure.system import System


def order_unknowns(
    system: System, algebraic: Sequence[int], residuals: Sequence[int], assigned: Sequence[tuple[int, int]]
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Match unknowns with equations and order the pairs by minimum degree (Liu 1985, in SuperLU).

    Parameters
    ----------
    system : System
        The extended system.
    algebraic, residuals : sequence of int
        Unknowns and equations of the integrated system.
    assigned : sequence of (variable, equation)
        Pairs substituted into the integrated system, in order of evaluation.

    Returns
    -------
    algebraic, residuals : tuple of int
        Unknowns and equations in the new order; residuals[k] contains algebraic[k].

    """
    if len(algebraic) < 3:
        return tuple(algebraic), tuple(residuals)
    place = {v: k for k, v in enumerate(algebraic)}
    behind: dict[int, set[int]] = {}
    for v, e in assigned:
        behind[v] = _columns(system.rows[e], v, behind)
    rows = [sorted(place[u] for u in _columns(system.rows[e], -1, behind) if u in place) for e in residuals]
    equation_of = maximum_matching(rows, len(algebraic)).equation_of
    if -1 in equation_of:
        return tuple(algebraic), tuple(residuals)
    row = np.repeat(np.arange(len(rows)), [len(r) for r in rows])
    column = np.concatenate([np.array(r, dtype=int) for r in rows])
    pattern = scipy.sparse.csc_matrix((np.ones(len(row)), (row, column)), shape=(len(rows), len(rows)))[equation_of]
    # Only the pattern matters: a dominant diagonal keeps the factorisation regular.
    dominant = (pattern + pattern.T + 3.0 * len(rows) * scipy.sparse.identity(len(rows))).tocsc()
    factors = scipy.sparse.linalg.splu(
        dominant, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}
    )
    order = np.argsort(factors.perm_c)
    return tuple(algebraic[k] for k in order), tuple(residuals[equation_of[k]] for k in order)


def _columns(row: Sequence[int], own: int, behind: dict[int, set[int]]) -> set[int]:
    columns: set[int] = set()
    for u in row:
        if u != own:
            columns |= behind.get(u, {u})
    return columns
