"""Many turns and long times: what is conserved stays so, loops stay closed, quaternions keep their norm."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, fixed, structural
from components import Body, World
from models import Bricard, NFourBar, SimplePendulum
from tests.hard.measure import within
from tests.reference import bricard, free_body, n_four_bar, pendulum


@pytest.mark.parametrize(("tolerance", "bound"), [(1e-8, 1e-1), (1e-10, 1e-3)])
def test_pendulum_for_1000_s(tolerance, bound):
    """424 swings from the horizontal; the error of a phase grows with time, 1,000 times the tolerance within 1 s."""
    result = ac.simulate(SimplePendulum(), stop_time=1000.0, tolerance=tolerance, intervals=1000, energy=True)
    x, y = pendulum.position(result.time)
    within("position, m", np.hypot(result["x"] - x, result["y"] - y).max(), bound)
    within("energy, of 9.81 J exchanged", abs(result.stats["energy_method"]) / 9.81, bound / 10)
    within("length, m", np.abs(np.hypot(result["x"], result["y"]) - 1).max(), 1e-12)


def test_parallelogram_for_1000_s():
    """A pendulum with a redundant loop, which swings through its flat position."""
    result = ac.simulate(NFourBar(N=1), stop_time=1000.0, tolerance=1e-8, intervals=2000, energy=True)
    one, two, pin = (result[f"{name}.phi"] for name in ("foot[0]", "foot[1]", "pin[0]"))
    gap = 1j * np.exp(1j * one) + np.exp(1j * (one + pin)) - 1 - 1j * np.exp(1j * two)
    within("closing gap, m", np.abs(gap).max(), 1e-10)
    rate, angle = result["foot[0].w"], one + np.pi / 2
    inertia, moment = n_four_bar.inertia_and_moment(1)
    energy = inertia * rate**2 / 2 + moment * 9.81 * np.sin(angle)
    within("energy, of 39 J exchanged", np.abs(energy - energy[0]).max() / 39.2, 1e-2)


class Top(Model):
    """A rigid body that turns freely, without gravity."""

    principal: tuple[float, float, float] = structural("principal moments of inertia", default=(1.0, 2.0, 3.0), shape=(3,))
    spin: tuple[float, float, float] = structural("angular velocity at the start", default=(0.0, 0.0, 1.0), shape=(3,))
    world = World(gravity=None)

    @ac.part
    def body(self):
        """The body."""
        return Body(
            m=1, I=np.diag(self.principal), angles_fixed=True, r_0=fixed((0, 0, 0)), v_0=fixed((0, 0, 0)), w_a=fixed(self.spin)
        )


def spun(principal: tuple[float, ...], spin: tuple[float, ...], turns: int, tolerance: float) -> ac.Result:
    """Free rotation for a number of turns about the axis of the largest speed; assert what must be conserved."""
    stop = turns * 2 * np.pi / np.max(np.abs(spin))
    result = ac.simulate(Top(principal=principal, spin=spin), stop_time=stop, tolerance=tolerance, intervals=500)
    w, Q, T = result["body.w_a"], result["body.frame_a.Q"], result["body.frame_a.R.T"]
    I = np.array(principal)
    energy = w**2 @ I / 2
    momentum = np.einsum("kji,kj->ki", T, w * I)  # in the world
    # 1,000 times the tolerance for each 10 turns, steadily one way.
    bound = 1000 * tolerance * turns / 10
    within("energy, relative", np.abs(energy / energy[0] - 1).max(), bound)
    size = np.linalg.norm(momentum[0])
    within("angular momentum, relative", np.abs(np.linalg.norm(momentum, axis=1) / size - 1).max(), bound)
    within("its direction, rad", np.abs(momentum / size - momentum[0] / size).max(), bound)
    # The feedback of 1/s keeps the norm against what steps lose in a second.
    within("norm of the quaternion less 1", np.abs(np.linalg.norm(Q, axis=1) - 1).max(), 1000 * tolerance)
    return result


@pytest.mark.parametrize("axis", [0, 2])
def test_1000_turns_about_a_stable_axis(axis):
    spin = np.full(3, 0.01)
    spin[axis] = 2 * np.pi
    spun((1.0, 2.0, 3.0), tuple(spin), 1000, 1e-8)


def test_1000_turns_of_a_symmetric_top():
    """Closed form: the angular velocity turns about the axis of symmetry at (I3 / I1 - 1) w3."""
    spin, tolerance = (1.0, 0.0, 2 * np.pi), 1e-9
    result = spun((1.0, 1.0, 1.5), spin, 1000, tolerance)
    angle = 0.5 * 2 * np.pi * result.time
    expected = np.column_stack([np.cos(angle), -np.sin(angle), np.full(len(angle), 2 * np.pi)])
    # 500 turns of the angular velocity: its phase.
    rate = -expected[:, 1]
    within("angular velocity, rad/s", np.abs(np.abs(result["body.w_a"][:, 1]) - np.abs(rate)).max(), 1000 * tolerance * 1000)


def test_unstable_axis_for_many_tumbles():
    """Turns over again and again; against the closed form by elliptic functions."""
    spin = (0.0, 0.0, 0.0)
    principal, w1, w3 = (1.0, 2.0, 3.0), 1.0, 0.6
    result = ac.simulate(Top(principal=principal, spin=(w1, 0.0, w3)), stop_time=200.0, tolerance=1e-10, intervals=400)
    expected = free_body.torque_free_rate(principal, w1, w3, result.time)
    found = result["body.w_a"]
    assert spin is not None
    within("angular velocity, rad/s", np.abs(found - expected).max(), 1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("principal", [(1.0, 2.0, 3.0), (1.0, 1.0, 1.5)])
def test_10000_turns(principal):
    spun(principal, (0.1, 0.2, 2 * np.pi), 10_000, 1e-9)


@pytest.mark.parametrize("stop", [100.0])
def test_bricard_for_100_s(stop):
    """One freedom: at equal positions the energy returns, and the mechanism comes back to its start at rest."""
    result = ac.simulate(Bricard(), stop_time=stop, tolerance=1e-8, intervals=2000, energy=True)
    loop = bricard.loop()
    q = np.array([result[f"joint[{k}].phi"] for k in range(6)]).T
    v = np.array([result[f"joint[{k}].w"] for k in range(6)]).T
    states = np.hstack([q, v])
    energy = np.array([loop.energy(state) for state in states[::10]])
    within("closing gap, m or 1", max(loop.gap(state) for state in states[::10]), 1e-10)
    within("energy, of 29 J exchanged", np.abs(energy - energy[0]).max() / 29, 1000 * 1e-8 * stop)
    # It never rises above the height at which it starts at rest, and comes near it once in each swing.
    height = np.array([result[n] for n in ("x", "y", "z")]).T - [1, -1, 0]
    back = np.linalg.norm(height, axis=1)
    returns = np.flatnonzero((back[1:-1] < back[:-2]) & (back[1:-1] <= back[2:]) & (back[1:-1] < 0.05))
    assert len(returns) >= 8, len(returns)


def test_bricard_returns():
    """Over one whole swing it comes to rest at its start, as published: 2.69e-4 m from it at 10 s."""
    result = ac.simulate(Bricard(), stop_time=100.0, tolerance=1e-9, intervals=100)
    # Rest at the start and rest at the other end alternate: 10 s is close to a whole number of swings.
    expected = bricard.point(result.time[:21])
    found = np.array([result[n] for n in ("x", "y", "z")]).T[:21]
    within("point over 20 s, m", np.abs(found - expected).max(), 1e-4)
