"""Newton steps that solve for algebraic unknowns part by part."""

from __future__ import annotations

import casadi as ca
import numpy as np

from acausal.compiler.algebraic_newton import newton_steps
from acausal.reduce.dependence import Dependence

x, z, p = ca.SX.sym("x"), ca.SX.sym("z", 5), ca.SX.sym("p")
t, c = ca.SX.sym("t"), ca.SX.sym("c")
# Linear, a nonlinear pair, then linear in what follows from it.
ALG = ca.vertcat(z[1] - 2 * x, z[0] + z[2] ** 2 - z[1], z[0] * z[2] - p, z[4] * z[2] - z[0] - t, z[3] - z[4] + c * z[2])


def exact(X: float) -> np.ndarray:
    """For p = 1, t = 3, c = 2: z2 from z2^3 - 2 X z2 + 1 = 0, its largest root."""
    z2 = max(np.roots([1, 0, -2 * X, 1]).real)
    z4 = (1 / z2 + 3) / z2
    return np.array([1 / z2, 2 * X, z2, z4 - 2 * z2, z4])


def test_parts_are_solved_one_after_the_other():
    unknowns, equations = Dependence(ALG, z).needed(range(5))
    passes = newton_steps(ALG, z, [ca.vertcat(x), z, p, t, c], unknowns, equations)
    assert [step.linear for step in passes] in ([True, False, True], [False, True])
    assert sorted(k for step in passes for k in step.unknowns) == list(range(5))
    X = np.array([[2.0], [3.0]])
    found = np.tile([0.3, 1.0, 1.8, 0.0, 0.0], (2, 1))
    for step in passes:
        for _ in range(1 if step.linear else 8):
            found[:, step.unknowns] = step.function(X, found, np.ones(1), np.full((2, 1), 3.0), np.full((2, 1), 2.0))
    np.testing.assert_allclose(found, [exact(2.0), exact(3.0)], rtol=1e-13)
