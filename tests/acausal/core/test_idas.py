"""IDAS behind the interface of steppers: errors, interpolation, restarts, and what ends it."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import casadi as ca
import numpy as np
import pytest

from acausal.core import End, sundials, why_no_idas
from tests.acausal.core.stepper import Stepper, idas
from tests.acausal.core.stored import SPANS, scene
from tests.acausal.core.test_rodas import TIMES, equations, integrated, known, solution

GIVEN = [np.array(v, dtype=float) for v in ([0, 1], [0], [3], [])]


@pytest.fixture(autouse=True)
def _at_hand():
    if why := why_no_idas():
        pytest.skip(why)


def test_errors_follow_the_tolerance():
    for tolerance in (1e-4, 1e-6, 1e-8):
        found = integrated(idas(known()), TIMES, *GIVEN, size=np.ones(3), tolerance=tolerance)
        assert found.end == End.DONE
        assert np.max(np.abs(np.hstack([found.x, found.z]) - solution(TIMES)[1:])) < 100 * tolerance
        np.testing.assert_allclose(found.integral[:, 0], 1 - np.cos(TIMES[1:]), atol=50 * tolerance)


# Tolerance, order, what Newton iterations leave; most steps and residuals, greatest error of coordinates over size and value.
SCENES = {
    "spin-up": (1e-4, 2, 0.05, 45, 130, 1e-3),
    "pendulum": (1e-4, 2, 0.05, 625, 1800, 2e-2),
    "four-bar": (1e-4, 5, 0.005, 410, 1530, 1e-2),
    "governor": (1e-6, 5, 0.005, 1100, 2600, 1e-4),
}


@pytest.mark.parametrize("name", SCENES)
def test_scenes_take_the_steps_of_the_method(name):
    model, (tolerance, order, newton, steps, residuals, error) = scene(name), SCENES[name]
    e, times = model.equations, model.time + SPANS[name] * np.linspace(0, 1, 101)
    given, size = (model.x, model.z, model.p, model.c), np.append(model.size, np.ones(model.equations.nz))
    stepper = idas(e)
    found = integrated(stepper, times, *given, size=size, tolerance=tolerance, order=order, newton=newton)
    assert found.end == End.DONE
    assert found.progress.steps < steps
    assert found.progress.values < residuals
    assert found.progress.factors == found.progress.slopes < found.progress.values / 2
    exact = integrated(Stepper(e), times, *given, size=model.size, tolerance=1e-8).x
    errors = np.abs(found.x - exact) / (model.size + np.max(np.abs(exact), axis=0))
    assert np.max(errors[:, model.rate == 0]) < error


@pytest.mark.parametrize("order", range(1, 6))
def test_steps_are_known_everywhere_between_their_ends(order):
    """The interpolant is a polynomial as high as the order, equal to IDAS's own, without jumps where steps meet."""
    stepper = idas(known())
    stepper.begin(TIMES, *GIVEN, size=np.ones(3), tolerance=1e-6, room=1, curves=True, order=order)
    end, error = End.MORE, 0.0
    while end == End.MORE:
        end = stepper.go(1)
        curve, times = stepper.curve, np.linspace(stepper.curve.times[0], stepper.curve.times[-1], 30)
        np.testing.assert_array_equal(curve(curve.times), curve.y)
        error = max(error, float(np.max(np.abs(curve(times) - solution(times)))))
        assert np.max(np.abs(curve.dense[:, max(order - 1, 0) :]), initial=0.0) == 0
    assert error < 2e-3


def test_threads_and_parts_change_no_bit():
    def found(at_once: int) -> bytes:
        own = integrated(idas(known()), TIMES, *GIVEN, size=np.ones(3), tolerance=1e-9, at_once=at_once)
        return own.x.tobytes() + own.z.tobytes() + own.integral.tobytes()

    with ThreadPoolExecutor(4) as pool:
        assert set(pool.map(found, [1, 3, 100, 10**6] * 3)) == {found(10**6)}


def test_memory_that_served_before_leaves_no_trace():
    def found(tolerance: float) -> bytes:
        return integrated(idas(known()), TIMES, *GIVEN, size=np.ones(3), tolerance=tolerance).x.tobytes()

    first = found(1e-6)
    assert found(1e-9) != first
    assert found(1e-6) == first


def test_it_goes_on_from_other_values():
    stepper = idas(known())
    found = stepper.begin(TIMES, *GIVEN, size=np.ones(3), tolerance=1e-8, room=60)
    stepper.go(60)
    time, x, _ = stepper.last
    stepper.move(np.array([x[0], 2 * x[1]]), np.array([2 * x[0] * x[1] + time**2]))
    before = stepper.progress.steps
    assert stepper.go(1_000_000) == End.DONE
    assert stepper.progress.steps > before
    later = TIMES[1:] > time
    expected = solution(TIMES[1:])[:, 1] + np.where(later, x[1] * np.exp(time - TIMES[1:]), 0)
    np.testing.assert_allclose(found.x[:, 1], expected, atol=1e-5)


def test_what_cannot_be_integrated_says_why_and_how_far_it_came(capfd):
    def found(e, times, x, z=(), tolerance=1e-6, p=(0.0,), **options):
        given = (np.array(v, dtype=float) for v in (x, z, p, ()))
        return integrated(idas(e), np.array(times), *given, size=np.ones(e.nx + e.nz), tolerance=tolerance, **options)

    explodes = found(equations(lambda x, z, t, p: x**2), [0, 1.9], [1])
    assert explodes.end in (End.SHORT, End.UNSOLVED)
    assert explodes.progress.time == pytest.approx(1, abs=1e-3)
    no_value = found(equations(lambda x, z, t, p: ca.sqrt(0.5 - t)), [0, 1.0], [0])
    assert no_value.end == End.UNSOLVED
    assert no_value.progress.time == pytest.approx(0.5, abs=1e-2)
    undetermined = equations(lambda x, z, t, p: z, lambda x, z, t, p: p * z, nz=1)
    assert found(undetermined, [0, 1.0], [0], [0]).end == End.UNSOLVED
    assert found(equations(lambda x, z, t, p: ca.sqrt(x)), [0, 1.0], [-1]).end == End.UNSOLVED
    assert found(equations(lambda x, z, t, p: -x), [0, 1.0], [1], tolerance=1e-18).end == End.ROUNDING
    few = found(equations(lambda x, z, t, p: -x), [0, 1.0], [1], most=5)
    assert (few.end, few.progress.steps) == (End.MANY, 5)
    assert capfd.readouterr() == ("", "")


def test_a_library_without_it_is_told(monkeypatch, tmp_path):
    monkeypatch.setattr(sundials, "_folders", lambda: [tmp_path])
    assert f"no {sundials.FILE} in {tmp_path}" in why_no_idas.__wrapped__()
    (tmp_path / sundials.FILE).write_bytes(b"no library")
    assert "cannot be loaded" in why_no_idas.__wrapped__()
    monkeypatch.undo()
    monkeypatch.setattr(sundials, "_names", lambda: ["IDACreate", "no_such_function"])
    assert "does not export" in why_no_idas.__wrapped__()
