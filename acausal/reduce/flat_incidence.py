"""Incidence of a flat model, the input of the structural analysis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from acausal.flatten import FlatModel
from acausal.language.functions import feedback, initial, time
from acausal.policy import POLICY
from acausal.structure import System
from acausal.symbols import scalars


@dataclass(frozen=True)
class Incidence:
    """Pattern of a Jacobian, and its coefficients that are numbers or functions of parameters.

    `rows` are the columns of each row; `explicit` maps (row, column) to its constant coefficient. `cancelled` are
    columns by row whose unknowns occur in a residual that does not depend on them, such as I w_1 w_2 - I w_2 w_1: it
    must be evaluated without them.
    """

    rows: tuple[tuple[int, ...], ...]
    explicit: dict[tuple[int, int], ca.SX]
    cancelled: dict[int, list[int]]


def jacobian(residuals: ca.SX, unknowns: ca.SX, others: ca.SX) -> Incidence:
    """Return the incidence of `residuals` and their constant coefficients, from one sparse Jacobian.

    Parameters
    ----------
    residuals, unknowns : casadi.SX
        Columns.
    others : casadi.SX
        Further symbols on which a coefficient must not depend: time, constants.
    """
    # Without cse(), equal subexpressions such as two equal moments of inertia would not cancel.
    pattern = ca.jacobian(ca.cse(residuals), unknowns)
    J = ca.sparsify(pattern)
    entries: list[Any] = J.nonzeros()
    row, column = (np.array(i) for i in J.sparsity().get_triplet())
    varying = np.array(ca.which_depends(ca.vertcat(*entries), ca.vertcat(unknowns, others), 1, True), dtype=bool)
    rows: list[list[int]] = [[] for _ in range(residuals.numel())]
    explicit = {}
    for i, j, entry, varies in zip(row.tolist(), column.tolist(), entries, varying, strict=True):
        rows[i].append(j)
        if not varies:
            explicit[i, j] = entry
    cancelled: dict[int, list[int]] = {}
    if pattern.nnz() > J.nnz():
        for i, j in zip(*pattern.sparsity().get_triplet(), strict=True):
            if j not in rows[i]:
                cancelled.setdefault(i, []).append(j)
    return Incidence(tuple(map(tuple, rows)), explicit, cancelled)


def system_of(flat: FlatModel) -> tuple[System, Incidence]:
    """Return the System of a flat model, and the Jacobian of its residuals."""
    unknowns, constants = flat.unknowns, flat.discontinuities.constants
    linear = jacobian(flat.equations.residuals, unknowns.symbols, ca.vertcat(time.sx, initial.sx, constants))
    explicit: list[set[int]] = [set() for _ in linear.rows]
    monic: list[set[int]] = [set() for _ in linear.rows]
    for (i, j), coefficient in linear.explicit.items():
        explicit[i].add(j)
        if coefficient.is_one() or coefficient.is_minus_one():
            monic[i].add(j)
    declared: dict[int, tuple[int, ...]] = {}
    if unknowns.declared:
        column = ca.vertcat(*unknowns.declared.values())
        function = ca.Function("declared", [unknowns.symbols, time.sx, flat.parameters.symbols, constants], [column])
        pattern = function.jac_sparsity(0, 0)
        found: list[list[int]] = [[] for _ in unknowns.declared]
        for i, j in zip(*pattern.get_triplet(), strict=True):
            found[i].append(j)
        declared = {k: tuple(js) for k, js in zip(unknowns.declared, found, strict=True)}
    system = System(
        rows=linear.rows,
        explicit=tuple(frozenset(e) for e in explicit),
        derivative=unknowns.derivative,
        declared={k: v for k, v in declared.items() if unknowns.derivative[k] < 0},
        defines=tuple(
            d if d >= 0 and d in declared and unknowns.derivative[d] < 0 else -1 for d in flat.equations.defines
        ),
        preference=unknowns.preference,
        monic=tuple(frozenset(m) for m in monic),
        pivots=_pivots(flat, linear),
        closures=_closures(flat),
    )
    return system, linear


def _pivots(flat: FlatModel, linear: Incidence) -> tuple[frozenset[int], ...]:
    """Return the unknowns of each equation whose coefficient is not small relative to others of the same unit."""
    found: list[set[int]] = [set() for _ in linear.rows]
    given = [flat.parameters.symbols, feedback.sx]
    function = ca.Function("coefficients", given, [ca.vertcat(*linear.explicit.values())])
    sizes = np.abs(np.array(function(flat.parameters.values, 1.0))).ravel().tolist()
    places = [(i, j, flat.unknowns.units[j]) for i, j in linear.explicit]
    largest: dict[tuple[int, Any], float] = {}
    for (i, _, unit), size in zip(places, sizes, strict=True):
        largest[i, unit] = max(size, largest.get((i, unit), 0.0))
    for (i, j, unit), size in zip(places, sizes, strict=True):
        if size >= POLICY.elimination.pivot * largest[i, unit]:
            found[i].add(j)
    return tuple(map(frozenset, found))


def _closures(flat: FlatModel) -> dict[int, tuple[int, ...]]:
    """Return the unknowns of the flow that works on each residual that closes a loop."""
    if not flat.loops.closures:
        return {}
    index = {s.element_hash(): k for k, s in enumerate(scalars(flat.unknowns.symbols))}
    # Dependent constraints of parts share the flows that work on them.
    shared = ca.vertcat(*[flat.loops.closures[k].dual for k in flat.loops.of_parts])
    return {
        c.row: tuple(
            index[s.element_hash()] for s in ca.symvar(c.dual if c.loop >= 0 else shared) if s.element_hash() in index
        )
        for c in flat.loops.closures
    }
