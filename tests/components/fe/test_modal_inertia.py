"""Inertia of a body in modes against the Lagrangian of two bricks (tests/reference/two_bricks.py) in a 3-D state."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from acausal import as_expr
from components.fe.modal_inertia import ModalInertia
from components.fe.reduced_body import ReducedBody
from tests.reference.two_bricks import TwoBricks

MODES = pytest.mark.parametrize("modes", [1, 2, 5])
SEEDS = pytest.mark.parametrize("seed", [0, 1])
GRAVITY = np.array([1.2, -9.0, 3.0])


def reduced(bricks: TwoBricks) -> ReducedBody:
    return ReducedBody(**bricks.moments(), interfaces=())


def evaluate(bricks: TwoBricks, compute, **options) -> list[np.ndarray]:
    """Evaluate compute(inertia, a, z, w, v), written with symbols, at the motion of the bricks."""
    _, _, a, z, w, v = bricks.motion()
    values = [bricks.q, bricks.qd, bricks.qdd, a, z, w, v]
    symbols = [ca.SX.sym(f"s{k}", value.size) for k, value in enumerate(values)]
    q, qd, qdd, *rest = (as_expr(symbol) for symbol in symbols)
    results = compute(ModalInertia(reduced(bricks), q, qd, qdd, **options), *rest)
    function = ca.Function("ours", symbols, [as_expr(value).sx for value in results])
    return [np.array(value).ravel() for value in function.call(values)]


def generalized(bricks: TwoBricks, gravity: np.ndarray, **options) -> np.ndarray:
    """What `forces` gives, as forces on origin, angles and amplitudes."""
    A, G, *_ = bricks.motion()
    force, moment, modal = evaluate(bricks, lambda i, a, z, w, v: i.forces(a - A.T @ gravity, z, w), **options)
    return np.r_[A @ force, G.T @ moment, modal + bricks.K @ bricks.q]


@MODES
@SEEDS
def test_forces_are_those_of_the_lagrangian(modes, seed):
    bricks = TwoBricks(modes, seed)
    for gravity in (np.zeros(3), GRAVITY):
        expected = bricks.forces(gravity)
        np.testing.assert_allclose(generalized(bricks, gravity), expected, rtol=0, atol=1e-12 * np.abs(expected).max())
