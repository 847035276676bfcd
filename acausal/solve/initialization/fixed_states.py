"""Conditions of the start that give one state each by themselves, and other properties of single conditions."""

from __future__ import annotations

from dataclasses import replace

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.linearization import PointLinearization
from acausal.compiler.memo import memoized
from acausal.language.functions import initial as initial_flag
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.symbols import scalars


@memoized
def uses_initial_flag(compiled: CompiledModel) -> bool:
    """Return whether equations differ between the initial system and the run."""
    return any(ca.which_depends(ca.vertcat(compiled.reduced.ode, compiled.reduced.alg), initial_flag.sx, 1, True))


@memoized
def fixing(compiled: CompiledModel) -> dict[int, int]:
    """Conditions that fix one state by themselves, counted from the first algebraic equation -> this state."""
    J, nx, nz = compiled.pattern, compiled.nx, compiled.nz
    unknowns = np.bincount(J.indices, minlength=J.shape[0])[nx + nz :]
    last = np.zeros(J.shape[0], dtype=int)
    last[J.indices] = np.repeat(np.arange(J.shape[1]), np.diff(J.indptr))
    nonlinear = _nonlinear(compiled)
    return {
        nz + k: state
        for k, state in enumerate(last[nx + nz :].tolist())
        if unknowns[k] == 1 and state < nx and not nonlinear[k]
    }


@memoized
def steady_conditions(compiled: CompiledModel) -> frozenset[int]:
    """Conditions, counted from the first algebraic equation, that hold in equilibrium as well, not at the start alone."""
    steady = scalars(ca.substitute(compiled.conditions, initial_flag.sx, 0))
    return frozenset(compiled.nz + k for k, entry in enumerate(steady) if not entry.is_constant())


@memoized
def soft(compiled: CompiledModel) -> frozenset[int]:
    """Conditions, counted from the first algebraic equation, that closing loops overrides."""
    conditions = compiled.reduced.flat.equations.initial
    return frozenset(compiled.nz + k for k, condition in enumerate(conditions) if condition.soft)


@memoized
def _nonlinear(compiled: CompiledModel) -> list[bool]:
    """Whether each condition is nonlinear in the unknowns."""
    return ca.which_depends(compiled.conditions, ca.vertcat(compiled.reduced.x, compiled.reduced.z), 2, True)


def with_fixed_states(problem: Problem, direct: np.ndarray, at: Point, local: PointLinearization) -> Point:
    """Set states to the values that conditions fix, see `InitialSystem.fixing`; `local` is the linearised initial system."""
    rows, states = direct[0] + problem.nx, direct[1]
    x = at.x.copy()
    x[states] -= local.value[rows] / local.entries[_last_entries(problem.compiled)[rows]]
    return replace(at, x=x)


@memoized
def _last_entries(compiled: CompiledModel) -> np.ndarray:
    """Place of the last entry of each row of the Jacobian: the only one of conditions that fix a state."""
    J = compiled.pattern
    last = np.full(J.shape[0], -1)
    last[J.indices] = np.arange(J.nnz)
    return last
