"""A model as the core integrates it without Python."""

from __future__ import annotations

from acausal.compiler.core_equations import core_equations
from acausal.core import StoredModel
from acausal.solve.integrate.one_step import are_rates
from acausal.solve.point import Point
from acausal.solve.problem import Problem


def stored(problem: Problem, at: Point, works: bool, moves: bool) -> StoredModel:
    """Return what a file holds of a model.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Where it starts, consistent.
    works, moves : bool
        As of `core_equations`.
    """
    return StoredModel(
        core_equations(problem.compiled, works, moves),
        at.time,
        *(at.x, at.z, problem.p, at.constants.vector),
        size=problem.nominal[: problem.nx],
        rate=are_rates(problem),
        names=problem.compiled.states,
    )
