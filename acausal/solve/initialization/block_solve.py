"""Solve the initial system block by block, where the guesses are too far off for one Newton iteration on all of it."""

from __future__ import annotations

import numpy as np

from acausal.errors import InitializationError
from acausal.solve.initialization.newton import InitialSystem, newton
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.structure.blt import block_triangular
from acausal.structure.matching import maximum_matching


def by_blocks(problem: Problem, system: InitialSystem, at: Point) -> Point | None:
    """Return the solution of the initial system, block by block of its block lower triangular form; None if that fails.

    Parameters
    ----------
    problem : Problem
        The model.
    system : InitialSystem
        As many equations as unknowns.
    at : Point
        Guesses.
    """
    whole = system.block(problem.compiled.pattern, problem.nx)
    rows: list[list[int]] = [[] for _ in whole.rows]
    for row, column in whole.places.T.tolist():
        rows[row].append(column)
    matched = maximum_matching(rows, len(whole.columns)).variable_of
    if len(whole.rows) != len(whole.columns) or -1 in matched:
        return None
    every, none = np.arange(problem.nx + problem.nz), np.empty(0, int)
    try:
        for block in block_triangular(rows, [(variable, row) for row, variable in enumerate(matched)]):
            known = np.setdiff1d(every, whole.columns[list(block.variables)])
            at = newton(problem, InitialSystem(system.rows[list(block.equations)], none, known), at, 1.0)
        return newton(problem, system, at, 1.0)
    except InitializationError:
        return None
