"""Structural analysis: from the incidence of a system to a solution plan."""

from __future__ import annotations

from acausal.structure.blt import block_triangular
from acausal.structure.check import check
from acausal.structure.coordinate_projection import Constrained, constrain
from acausal.structure.extension import Extension
from acausal.structure.observed import split_observed
from acausal.structure.ordering import order_unknowns
from acausal.structure.pantelides import pantelides
from acausal.structure.plan import Plan
from acausal.structure.singularity import StructuralSingularity, Subsystem
from acausal.structure.states import StateSelection, select_states
from acausal.structure.system import System
from acausal.structure.tearing import tear


def _reduce(system: System) -> tuple[Extension, Constrained, StateSelection]:
    """Differentiate equations, project coordinates on the constraints, and match."""
    extension = pantelides(system)
    constrained = constrain(extension)
    lower = extension.lower.difference(row for c in constrained.constraints for row in c.rows)
    # Projected states stay states: otherwise a level of a projected coordinate could be algebraic although the level
    # below is not.
    integrated = {p.state for p in constrained.projections}
    selection = select_states(extension.system(), lower, integrated=integrated)
    if not selection.left:
        return extension, constrained, selection
    # The constraints hold too few states: select dependent states through variable coefficients as well.
    extension = pantelides(system)
    selection = select_states(extension.system(), extension.lower, constant=False)
    if selection.left:
        raise StructuralSingularity(
            over=(Subsystem.of(selection.left, (v for e in selection.left for v in extension.rows[e])),)
        )
    return extension, Constrained(), selection


def analyse(system: System) -> Plan:
    """Reduce the index, select the states, and order, split and tear the equations.

    Raises
    ------
    StructuralSingularity
        If the equations cannot determine the variables, whatever their coefficients.

    """
    check(system)
    extension, constrained, selection = _reduce(system)
    extended = extension.system()
    states, equation_of = selection.states, selection.equation_of
    blocks = block_triangular(extended.rows, [(v, e) for v, e in enumerate(equation_of) if e >= 0])
    needed, observed = split_observed(extended, states, blocks)
    torn = tear(extended, needed)
    assigned = block_triangular(extended.rows, torn)
    torn_variables, torn_equations = {v for v, _ in torn}, {e for _, e in torn}
    pairs = [(block.variables[0], block.equations[0]) for block in assigned]
    algebraic, residuals = order_unknowns(
        extended,
        [v for block in needed for v in block.variables if v not in torn_variables],
        [e for block in needed for e in block.equations if e not in torn_equations],
        pairs,
    )
    return Plan(
        system=extended,
        differentiated=tuple(extension.differentiated),
        created=tuple(extension.created),
        states=states,
        blocks=blocks,
        algebraic=algebraic,
        residuals=residuals,
        assigned=tuple(pairs),
        observed=tuple(observed),
        constrained=constrained,
    )
