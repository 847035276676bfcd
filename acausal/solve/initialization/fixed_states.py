"""Conditions of the start that give one state each by themselves, and other properties of single conditions."""

from __future__ import annotations

from dataclasses import replace

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.local import Local
from acausal.compiler.once import once
from acausal.language.functions import initial as initial_flag
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.symbols import scalars


@once
def flag_matters(compiled: CompiledModel) -> bool:
    """Whether equations differ while the initial system holds."""
    return any(ca.which_depends(ca.vertcat(compiled.reduced.ode, compiled.reduced.alg), initial_flag.sx, 1, True))


@once
def giving(compiled: CompiledModel) -> dict[int, int]:
    """Conditions that give one state by themselves, counted from the first algebraic equation, and that state."""
    J, nx, nz = compiled.pattern, compiled.nx, compiled.nz
    unknowns = np.bincount(J.indices, minlength=J.shape[0])[nx + nz :]
    last = np.zeros(J.shape[0], dtype=int)
    last[J.indices] = np.repeat(np.arange(J.shape[1]), np.diff(J.indptr))
    curved = _curved(compiled)
    return {
        nz + k: state
        for k, state in enumerate(last[nx + nz :].tolist())
        if unknowns[k] == 1 and state < nx and not curved[k]
    }


@once
def lasting(compiled: CompiledModel) -> frozenset[int]:
    """Conditions, counted from the first algebraic equation, that say something in equilibrium, where those of a start do not."""
    said = scalars(ca.substitute(compiled.conditions, initial_flag.sx, 0))
    return frozenset(compiled.nz + k for k, entry in enumerate(said) if not entry.is_constant())


@once
def soft(compiled: CompiledModel) -> frozenset[int]:
    """Conditions, counted from the first algebraic equation, that closed loops override."""
    conditions = compiled.reduced.flat.equations.initial
    return frozenset(compiled.nz + k for k, condition in enumerate(conditions) if condition.soft)


@once
def _curved(compiled: CompiledModel) -> list[bool]:
    """Which conditions are not linear in the unknowns."""
    return ca.which_depends(compiled.conditions, ca.vertcat(compiled.reduced.x, compiled.reduced.z), 2, True)


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
