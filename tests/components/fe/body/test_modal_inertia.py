"""Inertia of a body in modes against the Lagrangian of two bricks (tests/reference/two_bricks.py) in a 3-D state."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from acausal import Expr, as_expr
from components.fe.body.modal_inertia import ModalInertia
from components.fe.reduction.reduced_body import ReducedBody
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
    q, qd, qdd, *rest = (Expr(symbol, shape=(symbol.numel(),)) for symbol in symbols)
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


@MODES
@SEEDS
def test_kinetic_energy_is_that_of_the_nodes(modes, seed):
    bricks = TwoBricks(modes, seed)
    _, _, _, _, w, v = bricks.motion()
    places = bricks.nodes + bricks.fields @ bricks.q
    rates = v + np.cross(w, places) + bricks.fields @ bricks.qd
    (energy,) = evaluate(bricks, lambda i, a, z, w, v: [i.kinetic_energy(v, w)])
    assert energy[0] == pytest.approx(np.einsum("ij,ik,jk->", bricks.masses, rates, rates) / 2, rel=1e-13)


def test_the_printed_sign_of_equation_77_would_show():
    """It turns 2 w x (relative angular momentum) round, which does no work, but is a third of the moment here."""
    bricks = TwoBricks(5, 0)
    _, G, _, _, w, _ = bricks.motion()
    places, rates = bricks.nodes + bricks.fields @ bricks.q, bricks.fields @ bricks.qd
    relative = np.einsum("ij,ijk->k", bricks.masses, np.cross(places[:, None], rates[None]))
    expected = bricks.forces(np.zeros(3))[3:6]
    printed = generalized(bricks, np.zeros(3))[3:6] - 2 * G.T @ np.cross(w, relative)
    assert np.abs(printed - expected).max() > 0.1 * np.abs(expected).max()
    assert abs(w @ np.cross(w, relative)) < 1e-12 * np.abs(relative).max() * (w @ w)


@pytest.mark.parametrize("order", ["second_order", "first_order"])
def test_power_of_the_forces_is_the_rate_of_the_energy(order):
    """Along the motion of a frame whose velocity has the rate a - w x v."""
    bricks = TwoBricks(4, 3)
    _, _, a, z, w, v = bricks.motion()

    def power(i, a, z, w, v):
        force, moment, modal = i.forces(a, z, w)
        return [force @ v + moment @ w + modal @ i.qd]

    def energy(i, a, z, w, v):
        return [i.kinetic_energy(v, w)]

    (given,) = evaluate(bricks, power, order=order)
    step, found = 1e-4, []
    for sign in (-1, 1):
        moved = TwoBricks(4, 3)
        moved.q, moved.qd = bricks.q + sign * step * bricks.qd, bricks.qd + sign * step * bricks.qdd
        v_1, w_1 = v + sign * step * (a - np.cross(w, v)), w + sign * step * z
        moved.motion = lambda v=v_1, w=w_1: (None, None, a, z, w, v)
        found.append(evaluate(moved, energy, order=order)[0].item())
    assert given[0] == pytest.approx((found[1] - found[0]) / (2 * step), rel=1e-6)


def test_effects_leave_out_what_they_say():
    bricks = TwoBricks(4, 1)
    everything = generalized(bricks, GRAVITY)
    for options in ({"order": "first_order"}, {"order": "constant"}, {"centrifugal": False}, {"coriolis": False}):
        assert np.abs(generalized(bricks, GRAVITY, **options) - everything).max() > 1e-5 * np.abs(everything).max()
    still = TwoBricks(4, 1)
    still.q, still.qd = 0 * still.q, 0 * still.qd
    everything = generalized(still, GRAVITY)
    for options in ({"order": "first_order"}, {"order": "constant"}, {"centrifugal": False}, {"coriolis": False}):
        np.testing.assert_allclose(generalized(still, GRAVITY, **options), everything, rtol=1e-13, atol=1e-9)
    still.qd = bricks.qd
    for options in ({"order": "first_order"}, {"centrifugal": False}):
        np.testing.assert_allclose(generalized(still, GRAVITY, **options), generalized(still, GRAVITY), rtol=1e-12)
