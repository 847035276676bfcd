"""Values between the steps of an integrator: algebraic variables, and events on them."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Model, Scalar, der, discrete, parameter, piecewise, reinit, sin, time, variable, when
from components import rotational
from models import SCENES, FourBarSpatial, NFourBar, SpinUp
from tests.acausal.solve.machines import Axis, Fall, Tether, Two
from tests.shared import compiled, pairwise

TOLERANCES = [1e-3, 1e-4, 1e-6, 1e-8, 1e-10]


@pytest.mark.parametrize("method", ["idas", "rosenbrock"])
@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_length_of_a_spring_is_the_distance_of_its_ends(tolerance, method):
    result = ac.simulate(compiled(Fall), stop_time=3.0, tolerance=tolerance, method=method)
    apart = np.linalg.norm(result["spring.frame_b.r_0"] - result["spring.frame_a.r_0"], axis=1)
    np.testing.assert_allclose(result["spring.s"], apart, rtol=1e-13)
    np.testing.assert_allclose(result["spring.v"], np.gradient(apart, result.time), atol=0.5)
    np.testing.assert_allclose(result["spring.f"], 1e-3 * apart, rtol=1e-12)


class Implicit(Model):
    """An algebraic loop that turns sharply, besides a motion that long steps follow."""

    x: Scalar = variable("x", start=-1, fixed=True)
    y: Scalar = variable("y", start=1)

    def equations(self):
        yield der(self.x) == 1
        yield self.y**3 + 1e-3 * self.y == self.x


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_implicit_equation_holds_to_rounding(tolerance):
    result = ac.simulate(compiled(Implicit), stop_time=2.0, tolerance=tolerance, method="idas")
    y, x = result["y"], result["x"]
    np.testing.assert_allclose(y**3 + 1e-3 * y, x, atol=1e-14)


def test_evaluations_are_counted_and_only_what_is_read_is_solved():
    result = ac.simulate(SpinUp(volumes=3), stop_time=20.0, tolerance=1e-4)
    before = result.stats["consistent_evaluations"]
    _ = result["tip_deflection"]
    assert result.stats["consistent_evaluations"] == before, "positions follow from the states alone"
    _ = result["drive.flange.tau"]
    assert before < result.stats["consistent_evaluations"] <= before + 5 * len(result.time)
    known = result.stats["consistent_evaluations"]
    _ = result["drive.flange.tau"] + result["tip_extension"]
    assert result.stats["consistent_evaluations"] == known, "what is known is not solved again"


@pytest.mark.parametrize("tolerance", [pytest.param(1e-3, marks=pytest.mark.slow), 1e-6])
@pytest.mark.parametrize("scene", ["four-bar-spatial", "slider-crank", "squeezer"])
def test_forces_of_a_loop_are_solved_for_once(scene, tolerance):
    """Positions and speeds are settled first, by a step or a few; accelerations and forces are linear then."""
    model, stop = compiled(SCENES[scene]), SCENES[scene].stop_time / 10
    result = ac.simulate(model, stop_time=stop, tolerance=tolerance, intervals=50)
    before = result.stats["consistent_evaluations"]
    _ = [result[name] for name in result.outputs]
    assert result.stats["consistent_evaluations"] - before <= 4.5 * len(result.time)


@pytest.mark.parametrize("constraints", ["states", "projection"])
def test_joints_of_a_loop_are_closed_at_each_output(constraints):
    result = ac.simulate(FourBarSpatial(), stop_time=1.0, tolerance=1e-4, constraints=constraints, intervals=37)
    gap = result["b3.frame_b.r_0"] - result["j5.frame_b.r_0"]
    assert np.max(np.abs(gap)) < 1e-12


def collision(tolerance: float = 1e-12) -> np.ndarray:
    """Position of the second ball of `Two` at 2 s, from the equations of two mass points."""

    def law(_: float, y: np.ndarray) -> np.ndarray:
        r = y[2:4] - y[:2]
        s = np.linalg.norm(r)
        push = 1e4 * min(s - 0.1, 0.0) * r / s
        return np.concatenate([y[4:], push, -push])

    start = [0, 0, 1, 0.02, 1, 0, 0, 0]
    return solve_ivp(law, (0, 2), start, "DOP853", rtol=tolerance, atol=tolerance, max_step=1e-3).y[2:4, -1]


@pytest.mark.parametrize(
    ("tolerance", "intervals", "method"), pairwise([1e-4, 1e-6, 1e-8, 1e-10], [400, 20, 7], ["idas", "rosenbrock"])
)
def test_no_contact_is_missed(tolerance, intervals, method):
    result = ac.simulate(
        compiled(Two), stop_time=2.0, tolerance=tolerance, intervals=intervals, method=method, energy=True
    )
    assert result.stats["events"] == 2
    first = (1 - np.sqrt(0.1**2 - 0.02**2)) / 1
    assert result.stats["event_times"][0] == pytest.approx(first, abs=1e-9)
    np.testing.assert_allclose(result["b.r_0"][-1, :2], collision(), atol=1e2 * tolerance + 1e-6)
    assert (
        abs(result.stats["energy_method"]) < 1e3 * tolerance
    )  # what a body that oscillates may lose, docs/background/hard-cases.md


@pytest.mark.parametrize("speed", [10.0, 100.0])
@pytest.mark.parametrize("intervals", [400, 20])
def test_contact_shorter_than_an_interval(speed, intervals):
    """Both ends of the contact lie between two outputs."""
    stop = 2.0 / speed
    result = ac.simulate(compiled(Two, speed=speed), stop_time=stop, intervals=intervals, method="idas", tolerance=1e-6)
    assert result.stats["event_times"][0] == pytest.approx((1 - np.sqrt(0.1**2 - 0.02**2)) / speed, rel=1e-8)


class Bounce(Model):
    """A mass meets a stiff stop and is pushed back: half a period of the contact takes 1 ms."""

    x: Scalar = variable("gap", start=1, fixed=True)
    v: Scalar = variable("speed", start=-2, fixed=True)

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == piecewise((-1e7 * self.x, self.x < 0), 0)


@pytest.mark.parametrize(("method", "tolerance"), [("auto", 1e-6), ("rosenbrock", 1e-4), ("idas", 1e-8)])
@pytest.mark.parametrize(("stop", "intervals"), [(100.0, 400), (20.0, 10), (1.3, 3)])
def test_end_of_a_contact_much_shorter_than_an_interval(stop, intervals, method, tolerance):
    """The release is the first one, not one some periods later."""
    result = ac.simulate(compiled(Bounce), stop_time=stop, intervals=intervals, method=method, tolerance=tolerance)
    contact = np.pi / np.sqrt(1e7)
    np.testing.assert_allclose(result.stats["event_times"], [0.5, 0.5 + contact], atol=contact * 100 * tolerance**0.75)
    assert result["v"][-1] == pytest.approx(2, rel=100 * tolerance)


@pytest.mark.parametrize(
    ("tolerance", "intervals", "method"), pairwise([1e-4, 1e-6, 1e-10], [400, 20], ["idas", "rosenbrock"])
)
def test_rope_is_found_taut_when_it_is(tolerance, intervals, method):
    result = ac.simulate(compiled(Tether), stop_time=1.2, tolerance=tolerance, intervals=intervals, method=method)
    taut = np.sqrt(2 * np.sqrt(1 - 0.3**2) / 9.80665)
    assert result.stats["event_times"][0] == pytest.approx(taut, abs=1e-6)
    assert result.stats["events"] == 4
    np.testing.assert_allclose(result.stats["event_times"][2], 0.96525086, atol=max(1e-6, 1e2 * tolerance))


@pytest.mark.parametrize(
    ("method", "intervals", "tolerance"), pairwise(["idas", "rosenbrock"], [2000, 500, 100], [1e-6, 1e-10])
)
def test_friction_sticks_at_rest_only(intervals, tolerance, method):
    result = ac.simulate(compiled(Axis), stop_time=1.0, tolerance=tolerance, intervals=intervals, method=method)
    stuck = np.abs(result["friction.mode"]) < 0.5
    assert result.stats["events"] == 5 or stuck.any()
    assert np.max(np.abs(result["motor.w"][stuck]), initial=0.0) < 1e-8
    assert result.stats["event_times"][0] == pytest.approx(0.130478, abs=1e-6)


class Never(NFourBar):
    """A condition that never holds changes nothing."""

    hit: Scalar = discrete("hits", unit="1")

    def equations(self):
        yield from super().equations()
        yield when(self.b0_x > 100, reinit(self.hit, 1))


@pytest.mark.slow
def test_a_condition_far_away_costs_no_run():
    """30 s through flat positions again and again, watched or not; the angle from minimal coordinates."""
    turn = solve_ivp(lambda _, y: [y[1], -1.2 * 9.81 * np.cos(y[0])], (0, 30), [np.pi / 2, -1], "DOP853", rtol=1e-12)
    result = ac.simulate(Never(N=1), stop_time=30.0, tolerance=1e-8)
    assert result.stats["events"] == 0
    assert result["b0_x"][-1] == pytest.approx(np.cos(turn.y[0, -1]), abs=5e-3)


def test_a_watched_loop_goes_where_an_unwatched_one_goes():
    watched, plain = (ac.simulate(m(N=1), stop_time=4.0, tolerance=1e-8) for m in (Never, NFourBar))
    np.testing.assert_allclose(watched["b0_x"], plain["b0_x"], atol=1e-4)


class Pulses(Model):
    """A guard that turns as fast as one likes, while the steps are as long as one likes."""

    rate: Scalar = parameter("rate of its phase", unit="1/s", default=1e6)
    least: Scalar = parameter("least value", default=2.0)
    x: Scalar = variable("x", unit="s", start=0, fixed=True)
    n: Scalar = discrete("count", unit="1")

    def equations(self):
        yield der(self.x) == 1
        yield when(sin(self.rate * self.x) > self.least, reinit(self.n, self.n + 1))


@pytest.mark.parametrize("intervals", [2, 400])
def test_conditions_faster_than_they_are_looked_at_are_told(intervals):
    with pytest.warns(ac.AcausalWarning, match=r"change faster than they are checked[\s\S]*tolerance"):
        ac.simulate(compiled(Pulses), stop_time=1.0, intervals=intervals, method="idas")


@pytest.mark.parametrize(
    ("turn", "intervals", "method"),
    pairwise([(100.0, 0.5), (51.0, 0.99), (32 * np.pi, 0.9999)], [1, 4, 5, 400], ["idas", "rosenbrock"]),
)
def test_no_turn_of_a_guard_is_missed(turn, intervals, method):
    """Also where it turns by whole or half turns from one look to the next."""
    rate, least = turn
    changes = {"rate": rate, "least": least}
    result = ac.simulate(compiled(Pulses), stop_time=1.0, intervals=intervals, method=method, parameters=changes)
    assert result["n"][-1] == 1 + (rate - np.arcsin(least)) // (2 * np.pi)


def test_a_cosine_that_comes_round_from_output_to_output():
    class Round(Pulses):
        def equations(self):
            yield der(self.x) == 1
            yield when(ac.cos(self.rate * self.x) < 0, reinit(self.n, self.n + 1))

    result = ac.simulate(Round(), stop_time=10.0, intervals=100, parameters={"rate": 20 * np.pi}, method="idas")
    assert result["n"][-1] == 100


class Rings(Model):
    """An oscillator far faster than its outputs, and a condition that it never meets."""

    x: Scalar = variable("x", start=1, fixed=True)
    v: Scalar = variable("v", start=0, fixed=True)
    n: Scalar = discrete("count", unit="1")

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == -1e6 * self.x
        yield when(self.x > 2, reinit(self.n, self.n + 1))


@pytest.mark.parametrize(
    ("intervals", "tolerance", "method"),
    [(8, 1e-8, "auto"), (10, 1e-6, "idas"), (20, 1e-6, "auto"), (10, 1e-6, "rosenbrock"), (1, 1e-6, "idas")],
)
def test_many_steps_an_interval_come_to_an_end(intervals, tolerance, method):
    result = ac.simulate(compiled(Rings), stop_time=1.0, intervals=intervals, tolerance=tolerance, method=method)
    assert result["x"][-1] == pytest.approx(np.cos(1000.0), abs=1e4 * tolerance)
    assert result.stats["steps"] < 200_000


@pytest.mark.parametrize("method", ["auto", "idas", "rosenbrock"])
@pytest.mark.parametrize("law", [lambda x: -3 * ac.sign(x), lambda x: -piecewise((3, x > 0), -3)])
def test_sliding_on_a_jump_ends(law, method):
    class Slides(Model):
        x: Scalar = variable("x", start=1, fixed=True)

        def equations(self):
            yield der(self.x) == law(self.x)

    with pytest.raises(ac.SimulationError, match="switch back and forth"):
        ac.simulate(Slides(), stop_time=1.0, method=method)


def test_sign_in_a_class_body_is_watched():
    class Relay(Model):
        u: Scalar = ac.input("input", unit="1")
        x: Scalar = variable("x", start=0, fixed=True)

        def equations(self):
            yield der(self.x) == self.u

    class Driven(Model):
        relay = Relay(u=ac.sign(ac.cos(20 * time)))

    result = ac.simulate(Driven(), stop_time=1.0, intervals=10)
    np.testing.assert_allclose(result.stats["event_times"], np.arange(1, 13, 2) * np.pi / 40, atol=1e-9)

    class Jumps(Model):
        drive, rotor = rotational.Position(phi_ref=ac.sign(time - 0.5)), rotational.Inertia(J=1)

        def connections(self):
            yield ac.connect(self.drive.flange, self.rotor.flange_a)

    with pytest.raises(ac.SimulationError, match="jump"):
        ac.simulate(Jumps(), stop_time=1.0)


def test_sign_of_a_passing_quantity_is_exact():
    class Passes(Model):
        x: Scalar = variable("x", start=0, fixed=True)

        def equations(self):
            yield der(self.x) == ac.sign(time - 0.3 + 0 * self.x) + ac.sign(self.x + 0.1)

    result = ac.simulate(Passes(), stop_time=1.0, tolerance=1e-6)
    np.testing.assert_allclose(result["x"], np.maximum(0, 2 * (result.time - 0.3)), atol=1e-8)
