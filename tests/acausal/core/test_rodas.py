"""Rodas5P: orders on a DAE with a known solution, stiffness, interpolation, and what ends it."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from math import pi

import casadi as ca
import numpy as np
import pytest

from acausal.core import End, Equations, make_equations
from tests.acausal.core.stepper import Progress, Stepper, with_powers


def equations(ode, alg=lambda x, z, t, p: ca.SX(0, 1), nx=1, nz=0, np=1, powers=None) -> Equations:
    x, z, t, p, c = (ca.SX.sym(name, n) for name, n in (("x", nx), ("z", nz), ("t", 1), ("p", np), ("c", 0)))
    found = make_equations(x, z, t, p, c, ca.vertcat(ode(x, z, t, p)), ca.vertcat(alg(x, z, t, p)))
    return found if powers is None else with_powers(found, [x, z, t, p, c], powers(x, z, t))


@cache
def known() -> Equations:
    """x = (sin t, exp(-t) cos t), z = x1 x2 + t^2; the algebraic equation is cubic and stands in the first derivative."""

    def ode(x, z, t, p):
        return ca.vertcat(ca.cos(t) + p * (z - x[0] * x[1] - t**2), -x[1] - ca.exp(-t) * x[0])

    def alg(x, z, t, p):
        right = x[0] * x[1] + t**2
        return z + z**3 - right - right**3

    return equations(ode, alg, 2, 1, powers=lambda x, z, t: ca.vertcat(x[0], z))


TIMES = np.linspace(0, 2, 9)


def solution(t: np.ndarray) -> np.ndarray:
    x = np.sin(t), np.exp(-t) * np.cos(t)
    return np.column_stack([*x, x[0] * x[1] + t**2])


@dataclass(frozen=True)
class Found:
    x: np.ndarray
    z: np.ndarray
    integral: np.ndarray
    end: End
    progress: Progress


def integrated(rodas: Stepper, times, *given, at_once=1_000_000, total=1_000_000, **options) -> Found:
    outputs, end = rodas.begin(times, *given, **options), End.MORE
    while end == End.MORE and total > 0:
        end = rodas.go(min(at_once, total))
        total -= at_once
    n = rodas.progress.written
    return Found(outputs.x[:n], outputs.z[:n], outputs.integral[:n], end, rodas.progress)


def integrate(e: Equations, times: np.ndarray, x, z=(), p=(3.0,), tolerance=1e-6, **options) -> Found:
    given = (np.array(v, dtype=float) for v in (x, z, p, ()))
    return integrated(Stepper(e), times, *given, size=np.ones(e.nx), tolerance=tolerance, **options)


def test_steps_grow_as_the_order_says_and_errors_follow_the_tolerance():
    expected, steps = solution(TIMES)[1:], []
    for tolerance in (1e-6, 1e-8, 1e-10, 1e-12):
        found = integrate(known(), TIMES, [0, 1], [0], tolerance=tolerance)
        assert found.end == End.DONE
        assert found.progress.written == len(TIMES) - 1
        steps.append(found.progress.steps)
        assert np.max(np.abs(found.x - expected[:, :2])) < 10 * tolerance
        np.testing.assert_allclose(found.integral[:, 0], 1 - np.cos(TIMES[1:]), atol=10 * tolerance)
    # The error of a step is h^5, order 4 of the embedded method and 1: a hundredth takes 100^(1/5) = 2.5 times the steps.
    assert np.log(steps[-1] / steps[1]) / np.log(1e4) == pytest.approx(1 / 5, abs=0.02)


def test_the_interpolant_has_order_4():
    errors = []
    for h in (0.2, 0.1, 0.05):
        times = np.linspace(0, h, 41)
        found = integrate(known(), times, [0, 1], [0], tolerance=1e-2, first_step=h)
        assert found.progress.steps == 1
        errors.append(np.max(np.abs(np.hstack([found.x, found.z]) - solution(times)[1:]), axis=0))
    rates = np.log2(errors[1] / errors[2])
    assert np.all(rates[:2] > 4.7), "over one step, states an order more"
    assert rates[2] > 3.7


def test_a_stiff_equation_takes_no_steps_for_its_fast_part():
    """Prothero and Robinson: x' = -L (x - sin t) + cos t."""
    e = equations(lambda x, z, t, p: -p * (x - ca.sin(t)) + ca.cos(t))
    counts = [integrate(e, np.array([0, 5.0]), [0], p=[L]) for L in (1e1, 1e4, 1e8)]
    assert max(found.progress.steps for found in counts) < 60
    for found in counts:
        assert found.x[-1, 0] == pytest.approx(np.sin(5.0), abs=1e-5)


def test_vibrations_that_errors_do_not_show_are_damped():
    """L-stable: a vibration of 1e6 rad/s within the tolerance is gone after a few steps."""
    e = equations(lambda x, z, t, p: ca.vertcat(x[1], -(p**2) * x[0]), nx=2)
    found = integrated(
        Stepper(e),
        *(np.array(v, dtype=float) for v in ([0, 1], [1e-9, 0], [], [1e6], [])),
        size=np.array([1.0, 1e6]),
        tolerance=1e-6,
    )
    assert found.progress.steps < 40
    assert abs(found.x[-1, 0]) < 1e-12


def test_steps_in_parts_and_other_threads_change_no_bit():
    once = integrate(known(), TIMES, [0, 1], [0], tolerance=1e-9)
    parts = integrate(known(), TIMES, [0, 1], [0], tolerance=1e-9, at_once=3)
    assert parts.progress.steps == once.progress.steps
    with ThreadPoolExecutor(4) as pool:
        others = list(pool.map(lambda _: integrate(known(), TIMES, [0, 1], [0], tolerance=1e-9), range(8)))
    for other in (parts, *others):
        for name in ("x", "z", "integral"):
            np.testing.assert_array_equal(getattr(other, name), getattr(once, name))


def test_one_integrator_is_used_again_for_other_parameters():
    e = equations(lambda x, z, t, p: -p * x)
    rodas, times, size = Stepper(e), np.array([0, 1.0]), np.ones(1)
    for p in (1.0, 50.0, 0.0, 1.0):
        given = (np.array(v) for v in ([1.0], [], [p], []))
        found = integrated(rodas, times, *given, size=size, tolerance=1e-8)
        assert found.x[-1, 0] == pytest.approx(np.exp(-p), abs=1e-7)


def test_what_cannot_be_integrated_says_how_far_it_came():
    times = np.linspace(0, 1.9, 20)
    explodes = integrate(equations(lambda x, z, t, p: x**2), times, [1], tolerance=1e-8)
    assert explodes.end == End.SHORT
    assert explodes.progress.time == pytest.approx(1, abs=1e-3)
    assert len(explodes.x) >= 9
    np.testing.assert_allclose(explodes.x[:9, 0], 1 / (1 - times[1:10]), rtol=1e-5)
    no_value = integrate(equations(lambda x, z, t, p: ca.sqrt(0.5 - t)), np.array([0, 1.0]), [0])
    assert no_value.end == End.UNSOLVED
    assert no_value.progress.time == pytest.approx(0.5, abs=1e-2)
    undetermined = equations(lambda x, z, t, p: z, lambda x, z, t, p: p * z, nz=1)
    assert integrate(undetermined, np.array([0, 1.0]), [0], [0], p=[0]).end == End.UNSOLVED
    few = integrate(known(), TIMES, [0, 1], [0], tolerance=1e-9, total=5)
    assert few.end == End.MORE
    assert few.progress.steps + few.progress.refused == 5


def test_without_states_and_without_outputs():
    found = integrate(
        equations(lambda x, z, t, p: ca.SX(0, 1), lambda x, z, t, p: z - ca.sin(t), nx=0, nz=1), TIMES, [], [0]
    )
    assert found.end == End.DONE
    assert integrate(known(), TIMES[:1], [0, 1], [0]).end == End.DONE


def test_arguments_that_do_not_fit_are_refused():
    with pytest.raises(ValueError, match="do not fit"):
        integrate(known(), TIMES, [0], [0])


def vibration(amplitude: float, **options) -> Found:
    """A motion, cos t, and beside it a vibration of 1000 rad/s."""

    def ode(x, z, t, p):
        return ca.vertcat(x[1], -ca.cos(t), x[3], -(p**2) * x[2])

    e = equations(ode, nx=4)
    given = (np.array(v, dtype=float) for v in ([1, 0, amplitude, 0], [], [1e3], []))
    return integrated(
        Stepper(e), np.array([0, 1.0]), *given, size=np.ones(4), tolerance=1e-3, first_step=1e-3, **options
    )


def test_errors_of_rates_leave_out_what_steps_do_not_resolve():
    rates = np.array([0, 1, 0, 1])
    # Steps of one run are chaotic where many are refused.
    few = [
        [vibration(amplitude, rate=rates, smooth=smooth) for smooth in (False, True)]
        for amplitude in (1e-5, 2e-5, 3e-5)
    ]
    assert sum(smooth.progress.steps for _, smooth in few) < 0.7 * sum(plain.progress.steps for plain, _ in few)
    for found in (found for pair in few for found in pair):
        assert found.x[-1, :2] == pytest.approx([np.cos(1.0), -np.sin(1.0)], abs=1e-5)
        assert abs(found.x[-1, 2]) < 3e-5
    # What positions show is followed all the same.
    large = [vibration(0.1, rate=rates, smooth=smooth) for smooth in (False, True)]
    assert large[1].progress.steps > 0.9 * large[0].progress.steps
    assert large[1].x[-1, 2] == pytest.approx(0.1 * np.cos(1e3), abs=1e-2)


@pytest.mark.parametrize("largest", [False, True])
def test_the_largest_error_counts_whatever_rests_beside_it(largest):
    def found(resting: int) -> Found:
        e = equations(lambda x, z, t, p: ca.vertcat(x[1], -x[0], ca.SX.zeros(resting)), nx=2 + resting)
        x, size = np.zeros(2 + resting), np.ones(2 + resting)
        x[0] = 1.0
        given = x, np.zeros(0), np.zeros(1), np.zeros(0)
        options = {"size": size, "tolerance": 1e-6, "first_step": 1e-2, "largest": largest}
        return integrated(Stepper(e), np.array([0, 20.0]), *given, **options)

    alone, beside = found(0), found(200)
    if largest:
        np.testing.assert_array_equal(beside.x[:, :2], alone.x)
    else:
        assert beside.progress.steps < 0.8 * alone.progress.steps


def test_steps_between_two_outputs_are_limited():
    whole = vibration(1e-4)
    found = vibration(1e-4, most=20)
    assert (found.end, found.progress.steps) == (End.MANY, 20)
    assert vibration(1e-4, most=whole.progress.steps).end == End.DONE


def test_a_limit_that_was_reached_can_be_raised_without_a_trace():
    e, start = known(), [np.array(v, dtype=float) for v in ([0, 1], [0], [3], [])]

    def found(*limits: int) -> tuple[End, bytes]:
        rodas = Stepper(e)
        first, *others = limits
        out = rodas.begin(TIMES[[0, -1]], *start, size=np.ones(2), tolerance=1e-9, most=first)
        end = rodas.go(2**62)
        for most in others:
            assert (end, rodas.progress.steps) == (End.MANY, first)
            rodas.allow(most)
            end = rodas.go(2**62)
        return end, out.x.tobytes()

    assert found(10, 10_000) == found(10_000)
    assert found(10, 20)[0] == End.MANY


def test_steps_are_kept():
    e, given = known(), [np.array(v, dtype=float) for v in ([0, 1], [0], [3], [])]
    rodas = Stepper(e)
    rodas.begin(TIMES, *given, size=np.ones(2), tolerance=1e-9, room=8)
    times, end = [], End.MORE
    while end == End.MORE:
        end = rodas.go(8)
        own, y = rodas.steps
        times += own[1:].tolist()
        np.testing.assert_allclose(y[:, :2], solution(own)[:, :2], atol=1e-7)
    assert len(times) == rodas.progress.steps
    assert np.all(np.diff(times) > 0)
    assert times[-1] == TIMES[-1]


def test_it_goes_on_from_other_values():
    e, given = known(), [np.array(v, dtype=float) for v in ([0, 1], [0], [3], [])]
    rodas = Stepper(e)
    found = rodas.begin(TIMES, *given, size=np.ones(2), tolerance=1e-9, room=8)
    rodas.go(8)
    time, x, _ = rodas.last
    rodas.move(np.array([x[0], 2 * x[1]]), np.array([2 * x[0] * x[1] + time**2]))
    assert rodas.go(1_000_000) == End.DONE
    # The second equation decays linearly: what is added to it decays as exp(-t).
    later = TIMES[1:] > time
    expected = solution(TIMES[1:])[:, 1] + np.where(later, x[1] * np.exp(time - TIMES[1:]), 0)
    np.testing.assert_allclose(found.x[:, 1], expected, atol=1e-7)


def oscillator(**options) -> Found:
    """A mass at 1 m/s on a spring of 1e6 rad/s, over 100 s in steps of any length."""
    e = equations(lambda x, z, t, p: ca.vertcat(x[1], -(p**2) * x[0]), nx=2)
    given = (np.array(v, dtype=float) for v in ([0, 1], [], [1e6], []))
    return integrated(Stepper(e), np.array([0, 100.0]), *given, size=np.ones(2), tolerance=1e-4, **options)


@pytest.mark.parametrize("first_step", [1.0, 0.0])
def test_a_first_step_resolves_what_moves(first_step):
    """Else an L-stable method would take it to rest at once, within the tolerance of the place."""
    assert abs(oscillator(first_step=first_step).x[-1, 1]) < 1e-3
    assert oscillator(first_step=first_step, rate=np.array([0, 1]), most=1).progress.time * 1e6 < 2


def driven(ode, rate: float, span: float, tolerance: float) -> Found:
    """A mass at rest on a spring of so many rad/s, the outputs far apart."""
    e = equations(lambda x, z, t, p: ca.vertcat(x[1], ode(x[0], t, p)), nx=2)
    given = (np.array(v, dtype=float) for v in ([0, 0], [], [rate], []))
    return integrated(
        Stepper(e), np.array([0, span]), *given, size=np.ones(2), tolerance=tolerance, rate=np.array([0, 1])
    )


@pytest.mark.parametrize("rate", [1.0, 1e3, 1e6])
@pytest.mark.parametrize(("tolerance", "lost"), [(1e-3, 0.2), (1e-6, 1e-4)])
def test_a_chosen_first_step_resolves_what_a_force_sets_moving(rate, tolerance, lost):
    """x'' = w^2 (1 - x) from rest; a hundredth of the way is ten rad, in which an L-stable step would bring it to rest."""
    span = 1e3 / rate
    found = driven(lambda x, t, p: p**2 * (1 - x), rate, span, tolerance)
    x, v = found.x[-1, 0] - 1, found.x[-1, 1] / rate
    assert 1 - lost < np.hypot(x, v) < 1 + lost
    assert abs(x + np.cos(1e3)) < lost


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9])
def test_a_chosen_first_step_is_long_where_nothing_moves(tolerance):
    """x'' = w^2 (t^3 - x) + 6 t, x = t^3: the spring is never set off."""
    found = driven(lambda x, t, p: p**2 * (t**3 - x) + 6 * t, 1e6, 1.0, tolerance)
    assert found.x[-1] == pytest.approx([1, 3], rel=10 * tolerance)
    assert found.progress.steps < 8


def test_steps_are_known_everywhere_between_their_ends():
    """The interpolant has order 4: half the steps, a 16th to a 32nd of the error."""
    e, given = known(), [np.array(v, dtype=float) for v in ([0, 1], [0], [3], [])]
    errors = []
    for tolerance in (1e-5, 1e-7, 1e-9):
        rodas = Stepper(e)
        rodas.begin(TIMES, *given, size=np.ones(2), tolerance=tolerance, room=4, curves=True)
        worst, steps, end = 0.0, 0, End.MORE
        while end == End.MORE:
            end = rodas.go(4)
            curve = rodas.curve
            times = np.linspace(curve.times[0], curve.times[-1], 40)
            worst = max(worst, float(np.max(np.abs(curve(times)[:, :2] - solution(times)[:, :2]))))
            np.testing.assert_array_equal(curve(curve.times), curve.y)
            steps += len(curve.dense)
        assert steps == rodas.progress.steps
        errors.append((steps, worst))
    (n, coarse), _, (m, fine) = errors
    assert np.log(coarse / fine) / np.log(m / n) > 3.5


@pytest.mark.parametrize("turns", [False, True])
@pytest.mark.parametrize("seed", range(8))
def test_the_sign_of_the_determinant_is_told_whichever_pivots_are_chosen(seed, turns):
    random, n = np.random.default_rng(seed), 5
    order, right = random.permutation(n).tolist(), random.standard_normal(n)

    def matrix(t):
        A = ca.SX.eye(n)
        for k in (0, 2):  # turned by a right angle, so that pivots wear out; the determinant of a turn is 1
            c, s = ca.sin(pi / 2 * ca.exp(-20 * t)), ca.cos(pi / 2 * ca.exp(-20 * t))
            A[k : k + 2, k : k + 2] = ca.vertcat(ca.horzcat(c, -s), ca.horzcat(s, c))
        A[4, 4] = 0.7531 - t if turns else 3.0
        return A[order, :]

    rodas = Stepper(equations(lambda x, z, t, p: -x, lambda x, z, t, p: matrix(t) @ z - ca.DM(right), nz=n, np=0))
    x, none, z = np.ones(1), np.empty(0), np.linalg.solve(ca.DM(ca.evalf(matrix(0))).full(), right)
    found = integrated(rodas, np.linspace(0, 1.5, 40), x, z, none, none, size=x, tolerance=1e-6)
    assert rodas.progress.pivots > 1
    if turns:
        assert 0 < found.progress.turned < found.progress.steps
    else:
        assert found.progress.turned == 0
        assert found.end == End.DONE
