"""States that a condition gives by itself: linear, and in no other unknown."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.local import Local
from acausal.compiler.once import once
from acausal.solve.point import Point
from acausal.solve.problem import Problem


def with_direct(problem: Problem, direct: np.ndarray, at: Point, local: Local) -> Point:
    """Give states the values that conditions state for them, see `InitialSystem.given`; `local` is the initial system there."""
    rows, states = direct[0] + problem.nx, direct[1]
    x = at.x.copy()
    x[states] -= local.value[rows] / local.entries[_last_entries(problem.compiled)[rows]]
    return replace(at, x=x)


@once
def _last_entries(compiled: CompiledModel) -> np.ndarray:
    """Place of the last entry of each row of the Jacobian; of the only one in the rows of conditions that give a state."""
    J = compiled.pattern
    last = np.full(J.shape[0], -1)
    last[J.indices] = np.arange(J.nnz)
    return last
