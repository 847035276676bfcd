"""Conflicting initial conditions: which others, together with the equations, determine the same quantity."""

from __future__ import annotations

import numpy as np
import scipy

from acausal.policy import POLICY
from acausal.solve.diagnosis.initialization import contradiction_text
from acausal.solve.diagnosis.singularity import undetermined
from acausal.solve.initialization.newton import InitialSystem
from acausal.solve.initialization.rank import scaled
from acausal.solve.point import Point
from acausal.solve.problem import Problem


def contradiction(problem: Problem, system: InitialSystem, at: Point, wrong: list[int]) -> str:
    """Return the message on conditions that the solution of the initial system violates, with those they contradict."""
    # Undetermined unknowns take arbitrary values, which only seem to contradict conditions on them.
    if text := undetermined(problem, at):
        return f"at t = {at.time:.6g} s {text}"
    value = problem.values(at, 1.0)[problem.nx :].copy()
    return contradiction_text(problem.compiled, value, wrong, _conflicting(problem, system, at, wrong))


def _conflicting(problem: Problem, system: InitialSystem, at: Point, wrong: list[int]) -> list[int]:
    """Return the conditions that hold and, with the equations, determine the residuals of the violated ones.

    Parameters
    ----------
    problem : Problem
        The model.
    system : InitialSystem
        The initial system.
    at : Point
        Its solution.
    wrong : list of int
        Conditions that it violates.

    Returns
    -------
    list of int
        Those whose gradients, with those of the equations, span the gradients of the violated ones; empty for systems
        that are too large for the dense least squares.
    """
    nx, nz = problem.nx, problem.nz
    if nx + nz > POLICY.causes.largest:
        return []
    J = problem.local(at, 1.0).jacobian.toarray()[nx:] * problem.nominal
    direct = dict(system.direct)
    conditions = [k for k in (*direct, *system.rows.tolist()) if k >= nz]
    guesses = np.eye(nx + nz)[np.setdiff1d(system.known, list(direct.values()))]
    closed = np.pad(problem.scaled_gradients(at).toarray(), ((0, 0), (0, nz)))
    basis = scaled(np.vstack([J[conditions], J[:nz], closed, guesses]))
    weights = scipy.linalg.lstsq(basis.T, scaled(J[wrong]).T, check_finite=False)[0][: len(conditions)]
    heavy = np.max(np.abs(weights), axis=1, initial=0.0)
    return [k for k, weight in zip(conditions, heavy, strict=True) if weight > POLICY.causes.weight]
