"""Symbolic equations of constraints and projections."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from acausal.flatten import FlatModel
from acausal.language.functions import feedback
from acausal.reduce.explicit import solve_explicit
from acausal.structure import Plan
from acausal.symbols import inlined, scalars, stacked


@dataclass(frozen=True)
class Projections:
    """Constraints in terms of integrated variables, and the projections on them.

    Parameters
    ----------
    constraints : casadi.SX
        Residuals of the constraints at all their levels in integrated variables, without projection.
    choice : casadi.SX
        Symbols of numbers that are chosen numerically: for each closure, 1 if it is independent and 0 if it is
        redundant; for each constraint of a part, the weights of the flows of all such constraints, whose weighted sum
        vanishes if it is redundant; 1 if D varies with the constraint Jacobian, 0 if it is constant; the entries of D
        of all projections (see `acausal.structure.coordinate_projection`), or factors of those of the Jacobian.
    coordinates, states : casadi.SX
        Projected coordinates, and the integrated variable of each.
    following : casadi.SX
        Values of the unknowns that follow explicitly from states, without projection.
    moves : casadi.SX
        Entry of `choice` that is 1 if D varies with the constraint Jacobian.
    """

    constraints: ca.SX
    choice: ca.SX
    coordinates: ca.SX
    states: ca.SX
    following: ca.SX
    moves: ca.SX


def constrain(
    flat: FlatModel,
    plan: Plan,
    elements: list[ca.SX],
    residuals: list[ca.SX],
    explicit: dict[tuple[int, int], ca.SX],
) -> Projections:
    """Modify the residuals of closures, append those of projections, and return the constraints.

    Parameters
    ----------
    flat : FlatModel
        The model.
    plan : Plan
        Solution plan of the model.
    elements : list of casadi.SX
        All unknowns.
    residuals : list of casadi.SX
        Residuals of the extended system without projections; modified in place.
    explicit : dict of (int, int) to casadi.SX
        Constant coefficients by (residual, unknown); modified in place.
    """
    projections = plan.constrained.projections
    coordinates = stacked([elements[p.coordinate] for p in projections])
    states = stacked([elements[p.state] for p in projections])
    unprojected, following = _unprojected(plan, elements, residuals, explicit)
    counts = _independence(flat, plan, elements, residuals)
    unprojected, following = ca.substitute([unprojected, following], [coordinates], [states])
    moves, D = ca.SX.sym("moves"), []
    row_of = {m: k for k, m in enumerate(m for c in plan.constrained.constraints for m in c.multipliers)}
    J = ca.jacobian(unprojected, states)
    for column, p in enumerate(projections):
        row = len(residuals)
        entries = [ca.SX.sym(f"D{len(D) + k}") for k in range(len(p.multipliers))]
        D += entries
        own = [d * (moves * J[row_of[m], column] + (1 - moves)) for d, m in zip(entries, p.multipliers, strict=True)]
        x, rate, state, state_rate = (elements[v] for v in (p.coordinate, p.rate, p.state, p.state_rate))
        shift = sum((d * elements[m] for d, m in zip(own, p.multipliers, strict=True)), ca.SX(0))
        residuals.append(x - state - shift)
        residuals.append(state_rate - rate - feedback.sx * (x - state))
        one = ca.SX(1)
        explicit.update({(row, p.coordinate): one, (row, p.state): -one})
        explicit.update({(row + 1, p.state_rate): one, (row + 1, p.rate): -one})
    choice = ca.vertcat(*counts, moves, *D) if plan.constrained.constraints else ca.SX(0, 1)
    return Projections(unprojected, choice, coordinates, states, following, moves)


def _independence(flat: FlatModel, plan: Plan, elements: list[ca.SX], residuals: list[ca.SX]) -> list[ca.SX]:
    """Give each closure a symbol: 1 if it is independent, 0 if it is redundant, where its flow is 0 instead.

    A redundant constraint of a part is replaced by a weighted sum of the flows of all such constraints; return the
    symbols of the closures, then the weights.
    """
    duals = {c.row: c.dual for c in flat.loops.closures}
    counts = {row: ca.SX.sym(f"s{k}") for k, row in enumerate(duals)}
    own = [flat.loops.closures[k] for k in flat.loops.of_parts]
    shares = ca.SX.sym("share", len(own), len(own))
    if own:
        sums = ca.mtimes(shares, ca.vertcat(*[c.dual for c in own]))
        duals.update(zip([c.row for c in own], scalars(sums), strict=True))
    for constraint in plan.constrained.constraints:
        on = counts.get(constraint.base)
        if on is None:
            continue
        for row, multiplier in zip(constraint.rows, constraint.multipliers, strict=True):
            residuals[row] = on * residuals[row] + (1 - on) * elements[multiplier]
        residuals[constraint.top] = on * residuals[constraint.top] + (1 - on) * duals[constraint.base]
    return [*counts.values(), *scalars(ca.vec(shares))]


def _unprojected(
    plan: Plan, elements: list[ca.SX], residuals: list[ca.SX], explicit: dict[tuple[int, int], ca.SX]
) -> tuple[ca.SX, ca.SX]:
    """Return the constraints at all levels, and the unknowns that follow from states, in terms of states."""
    constrained = plan.constrained
    rows = [row for c in constrained.constraints for row in c.rows]
    column = stacked([residuals[row] for row in rows])
    pairs = constrained.following
    if not pairs:
        return column, ca.SX(0, 1)
    symbols = ca.vertcat(*[elements[v] for v, _ in pairs])
    values = solve_explicit(pairs, residuals, explicit, elements, plan)
    definitions, others = inlined(symbols, values, [column])
    return others[0], definitions
