"""Equations of models at random points near their start."""

from __future__ import annotations

import casadi as ca
import numpy as np

import acausal as ac


def jacobian(model: ac.CompiledModel) -> ca.Function:
    """Return values and Jacobian of the equations that are integrated, with places for the rates of all states."""
    r = model.reduced
    values = ca.vertcat(r.running.ode, r.running.alg)
    J, states = ca.jacobian(values, ca.vertcat(r.x, r.z)), list(range(model.nx))
    J = ca.project(J, J.sparsity() + ca.Sparsity.triplet(*J.shape, states, states))
    return ca.Function("equations", model.arguments[:-1], [ca.densify(values), J])


def points(model: ac.CompiledModel, n: int, seed: int = 0) -> list[np.ndarray]:
    """Return states, algebraic unknowns, parameters, times and constants at n places; constants are any numbers."""
    random, p = np.random.default_rng(seed), model.parameter_values(None)
    start = model.start(p, 0.0)[0].copy()
    near = start + 0.1 * random.standard_normal((n, len(start)))
    constants = random.standard_normal((n, model.reduced.constants.numel()))
    times = random.uniform(0, 1, (n, 1))
    return [near[:, : model.nx], near[:, model.nx :], p, times, constants]
