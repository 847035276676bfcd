"""Many turns and long times: what is conserved stays so, loops stay closed, quaternions keep their norm."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, fixed, parameter, quantity, sin, structural, tanh, time
from acausal.solve.events import hybrid
from components import Body, Revolute, World
from components.rotational import Damper
from models import Bricard, FourBar, NFourBar, SimplePendulum
from tests.hard.driven import DrivenFourBar
from tests.hard.measure import within
from tests.reference import bricard, four_bar, free_body, n_four_bar, pendulum


@pytest.mark.parametrize(("tolerance", "bound"), [(1e-8, 1e-1), (1e-10, 1e-3)])
def test_pendulum_for_1000_s(tolerance, bound):
    """424 swings from the horizontal; the error of a phase grows with time, 1,000 times the tolerance within 1 s."""
    result = ac.simulate(SimplePendulum(), stop_time=1000.0, tolerance=tolerance, intervals=1000, energy=True)
    x, y = pendulum.position(result.time)
    within("position, m", np.hypot(result["x"] - x, result["y"] - y).max(), bound)
    within("energy, of 9.81 J exchanged", abs(result.stats["energy_method"]) / 9.81, bound / 10)
    within("length, m", np.abs(np.hypot(result["x"], result["y"]) - 1).max(), 1e-12)


class Undamped(FourBar):
    """The four-bar without its damper: it swings for ever."""

    damper = Damper(d=0)


@pytest.mark.slow
def test_four_bar_for_1000_s():
    """A redundant loop; its energy is what the reference says in the angle of the crank."""
    result = ac.simulate(Undamped(), stop_time=1000.0, tolerance=1e-8, intervals=2000)
    reference = four_bar.FourBar(damping=0.0)
    pairs = list(zip(result["j1_phi"], result["j1_w"], strict=True))[::10]
    energy = np.array([reference.energy(*pair) for pair in pairs])
    exchanged = max(reference.energy(phi, 0.0) for phi in np.linspace(0, 2 * np.pi, 100)) - energy[0]
    within("energy, of what is exchanged", np.abs(energy - energy[0]).max() / abs(exchanged), 1000 * 1e-8 * 1000)
    crank = 0.4 * np.exp(1j * result["j1.phi"])
    coupler = (0.1 + 1.1j) * np.exp(1j * (result["j1.phi"] + result["j2.phi"]))
    gap = crank + coupler + 0.15 - 1j - (0.65 + 0.1j) * np.exp(1j * result["j3.phi"])
    within("closing gap, m", np.abs(gap).max(), 1e-10)


STUCK = pytest.mark.xfail(
    strict=False,  # where steps end beside flat is a matter of rounding, which differs between machines
    raises=AssertionError,
    reason="steps as short as this get stuck at flat; longer ones cost accuracy, and are told",
)


@pytest.mark.parametrize(
    ("N", "stop", "tolerance"),
    [
        (1, 10.0, 1e-6),
        (1, 10.0, 1e-8),
        pytest.param(2, 100.0, 1e-8, marks=pytest.mark.slow),
        pytest.param(1, 10.0, 1e-10, marks=[STUCK, pytest.mark.slow]),
    ],
)
def test_n_four_bar_through_its_flat_position(N, stop, tolerance):
    """It turns over, at 8 rad/s through flat twice a turn, and slowly, at 1 rad/s, over the top."""
    result = ac.simulate(NFourBar(N=N), stop_time=stop, tolerance=tolerance, intervals=200)
    feet = np.array([result[f"foot[{k}].phi"] for k in range(N + 1)])
    rate, angle = result["foot[0].w"], feet[0] + np.pi / 2
    inertia, moment = n_four_bar.inertia_and_moment(N)
    energy = inertia * rate**2 / 2 + moment * 9.81 * np.sin(angle)
    within("energy, of what is exchanged", np.abs(energy / energy[0] - 1).max() / 2, 1000 * tolerance * stop)
    # All uprights stay parallel: it leaves its flat position on the branch on which it came.
    within("uprights out of parallel, rad", np.abs(np.sin(feet - feet[0])).max(), 1e-6)
    assert feet[0, -1] < -2 * np.pi


@pytest.mark.slow
def test_single_parallelogram_for_100_s():
    """Forty-odd passages through flat."""
    result = ac.simulate(NFourBar(N=1), stop_time=100.0, tolerance=1e-8, intervals=400)
    rate, angle = result["foot[0].w"], result["foot[0].phi"] + np.pi / 2
    inertia, moment = n_four_bar.inertia_and_moment(1)
    energy = inertia * rate**2 / 2 + moment * 9.81 * np.sin(angle)
    print(result.stats["loosened_at"], result.stats["solve_seconds"])
    within("energy, of what is exchanged", np.abs(energy / energy[0] - 1).max() / 2, 1000 * 1e-8 * 100)


class Top(Model):
    """A rigid body that turns freely, without gravity."""

    principal: tuple[float, float, float] = structural(
        "principal moments of inertia", default=(1.0, 2.0, 3.0), shape=(3,)
    )
    spin: tuple[float, float, float] = structural("angular velocity at the start", default=(0.0, 0.0, 1.0), shape=(3,))
    world = World(gravity=None)

    @ac.part
    def body(self):
        """The body."""
        return Body(
            m=1,
            I=np.diag(self.principal),
            angles_fixed=True,
            r_0=fixed((0, 0, 0)),
            v_0=fixed((0, 0, 0)),
            w_a=fixed(self.spin),
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
    # The feedback, ten times a run, keeps the norm against what steps lose in a tenth of it.
    within("norm of the quaternion less 1", np.abs(np.linalg.norm(Q, axis=1) - 1).max(), bound / 10)
    return result


@pytest.mark.parametrize("axis", [0, 2])
def test_1000_turns_about_a_stable_axis(axis):
    spin = np.full(3, 0.01)
    spin[axis] = 2 * np.pi
    spun((1.0, 2.0, 3.0), tuple(spin), 1000, 1e-8)


@pytest.mark.slow
def test_1000_turns_of_a_symmetric_top():
    """Closed form: the angular velocity turns about the axis of symmetry at (I3 / I1 - 1) w3."""
    spin, tolerance = (1.0, 0.0, 2 * np.pi), 1e-9
    result = spun((1.0, 1.0, 1.5), spin, 1000, tolerance)
    angle = 0.5 * 2 * np.pi * result.time
    expected = np.column_stack([np.cos(angle), -np.sin(angle), np.full(len(angle), 2 * np.pi)])
    # 500 turns of the angular velocity: its phase.
    rate = -expected[:, 1]
    within(
        "angular velocity, rad/s",
        np.abs(np.abs(result["body.w_a"][:, 1]) - np.abs(rate)).max(),
        1000 * tolerance * 1000,
    )


def test_unstable_axis_for_many_tumbles():
    """It turns over again and again; against the closed form by elliptic functions."""
    principal, w1, w3 = (1.0, 2.0, 3.0), 1.0, 0.6
    result = ac.simulate(Top(principal=principal, spin=(w1, 0.0, w3)), stop_time=200.0, tolerance=1e-10, intervals=400)
    expected = free_body.torque_free_rate(principal, w1, w3, result.time)
    within("angular velocity, rad/s", np.abs(result["body.w_a"] - expected).max(), 1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("principal", [(1.0, 2.0, 3.0), (1.0, 1.0, 1.5)])
def test_10000_turns(principal):
    spun(principal, (0.1, 0.2, 2 * np.pi), 10_000, 1e-9)


@pytest.mark.slow
def test_bricard_for_100_s():
    """10 swings: one freedom and no loss, so that it comes back to its start at rest again and again."""
    result = ac.simulate(Bricard(), stop_time=100.0, tolerance=1e-8, intervals=2000)
    loop = bricard.loop()
    states = np.column_stack([result[f"joint[{k}].{name}"] for name in ("phi", "w") for k in range(6)])[::10]
    energy = np.array([loop.energy(state) for state in states])
    within("closing gap, m or 1", max(loop.gap(state) for state in states), 1e-10)
    within("energy, of 29 J exchanged", np.abs(energy - energy[0]).max() / 29, 1000 * 1e-8 * 100)
    point = np.array([result[n] for n in ("x", "y", "z")]).T
    away = np.linalg.norm(point - [1, -1, 0], axis=1)
    least = (away[1:-1] < away[:-2]) & (away[1:-1] <= away[2:]) & (away[1:-1] < 0.05)
    at = result.time[1:-1][least]
    # Published: 2.69e-4 m from the start at 10 s. Outputs are 0.05 s apart.
    within("first return less a tenth of the tenth, s", abs(at[at > 5][0] - at[at > 95][0] / 10), 0.05)


@pytest.mark.slow
def test_bricard_against_its_reference():
    result = ac.simulate(Bricard(), stop_time=20.0, tolerance=1e-9, intervals=20)
    within(
        "point, m", np.abs(np.array([result[n] for n in ("x", "y", "z")]).T - bricard.point(result.time)).max(), 1e-4
    )


class Rests(DrivenFourBar):
    """A four-bar without gravity that is shaken, or pushed, after a long rest."""

    begin: Scalar = parameter("when it begins", unit="s", default=1000.0)
    shaken: bool = structural("whether it is shaken", default=False, choices=(True, False))
    world = World(gravity=None)
    hinge = Revolute(phi=fixed(1.0), w=fixed(0), use_axis_flange=True)

    def equations(self):
        s = (time - self.begin) / quantity(1.0, "s")
        push = sin(200 * np.pi * s) if self.shaken else 0.1
        yield self.torque.tau == quantity(50.0, "N.m") * (1 + tanh(8 * s)) * push


@pytest.mark.parametrize("calls", [None, 1])
@pytest.mark.parametrize("shaken", [False, True])
def test_a_loop_that_moves_after_a_long_rest_creeps_nowhere(shaken, calls, monkeypatch):
    """However few steps a call of the core takes, as of large models."""
    if calls:
        monkeypatch.setattr(hybrid, "at_once", lambda equations: calls)
    run = ac.simulate(Rests(shaken=shaken), stop_time=1001.0, intervals=2002)
    assert run.stats.method == "rosenbrock"
