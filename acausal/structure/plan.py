"""Result of the structural analysis."""

from __future__ import annotations

from dataclasses import dataclass

from acausal.structure.block import Block
from acausal.structure.coordinate_projection import Constrained
from acausal.structure.system import System


@dataclass(frozen=True)
class Plan:
    """Solution plan of a `System`.

    Parameters
    ----------
    system : System
        The system, extended at the end by differentiated equations and created variables, then by projections.
    differentiated : tuple of int
        Equation that each added equation differentiates, possibly an added one itself.
    created : tuple of int
        Variable that each added variable differentiates.
    states : tuple of int
        The states, ascending.
    blocks : tuple of Block
        Block lower triangular form of all equations and all other variables, in order of solution.
    algebraic : tuple of int
        Algebraic unknowns of the integrated system, in a fill-reducing order.
    residuals : tuple of int
        Equations of the integrated system; `residuals[k]` contains `algebraic[k]`.
    assigned : tuple of tuple of int
        (variable, equation) substituted into the integrated system, in order of evaluation.
    observed : tuple of tuple of int
        (variable, equation) that no state derivative needs, in order of evaluation.
    constrained : Constrained
        Constraints that hold at several levels, and the projected coordinates; each projection appends two equations,
        in this order, to the system.

    """

    system: System
    differentiated: tuple[int, ...]
    created: tuple[int, ...]
    states: tuple[int, ...]
    blocks: tuple[Block, ...]
    algebraic: tuple[int, ...]
    residuals: tuple[int, ...]
    assigned: tuple[tuple[int, int], ...]
    observed: tuple[tuple[int, int], ...]
    constrained: Constrained
