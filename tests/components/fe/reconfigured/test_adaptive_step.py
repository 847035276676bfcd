"""Steps in inertial frames whose size follows from their error."""

from __future__ import annotations

import signal
from functools import cache
from typing import Any

import numpy as np
import pytest

import acausal as ac
from components.fe import FrameLoad, FrameMotion, Readings, as_result, simulate_reconfigured
from components.fe.reconfigured.step_limits import limit
from tests.components.fe.reconfigured.test_reconfigured import fastest, plate, pulse

JUMP = 0.0213


def jumping(t: float) -> tuple[float, float, float]:
    return (20.0, 5.0, 10.0) if t < JUMP else (0.0, -10.0, 0.0)


SCENES: dict[str, dict[str, Any]] = {
    "tumbling": {"spin": (2, -6, 3), "stop_time": 0.1},
    "pushed": {"force": pulse, "stop_time": 0.15, "damping": 0.02, "breaks": (0.1,)},
    "jump": {"force": jumping, "stop_time": 0.05, "damping": 0.05, "spin": (2, -6, 3), "breaks": (JUMP,)},
    "falls": {"force": jumping, "stop_time": 0.05, "gravity": (0, 0, -9.81), "velocity": (30, 0, 0), "breaks": (JUMP,)},
}


def scene(name: str, **given: Any) -> FrameMotion:
    settings = dict(SCENES[name])
    force, breaks = settings.pop("force", None), settings.pop("breaks", ())
    loads = [FrameLoad("end", force=force, breaks=breaks)] if force else []
    return simulate_reconfigured(plate(), loads, **settings, **given)


def speeds(motion: FrameMotion, rates: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Root mean square over the mass, without translation."""
    J, mass = motion.modes.inertia, motion.modes.body.mass
    w, v = rates[..., 3:6], rates[..., 6:]
    squares = np.einsum("...i,ij,...j", w, J, w) + (v**2).sum(axis=-1) + q**2 @ np.diag(motion.modes.body.K)
    return np.sqrt(squares / mass)


@cache
def exact(name: str) -> FrameMotion:
    """By steps of one size, short ones, that end where the load breaks."""
    stop = SCENES[name]["stop_time"]
    return scene(name, dt=stop / round(stop / 5e-6))


def error(name: str, tolerance: float) -> tuple[float, FrameMotion]:
    found, best = scene(name, tolerance=tolerance), exact(name)
    wrong = speeds(best, found.rates[-1] - best.rates[-1], found.q[-1] - best.q[-1])
    return float(wrong / speeds(best, best.rates, best.q).max()), found


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("tolerance", [1e-3, 1e-5, 1e-7])
def test_errors_stay_within_the_tolerance(name, tolerance):
    """Errors of all steps come to the tolerance at most, up to what pairs under a thousandth of the run may have beside it."""
    found, motion = error(name, tolerance)
    assert found < 2 * tolerance
    assert motion.time[0] == 0
    assert motion.time[-1] == SCENES[name]["stop_time"]
    assert (np.diff(motion.time) > 0).all()
    assert (np.diff(motion.time) <= limit(motion.modes)[0]).all()


def test_errors_follow_the_tolerance():
    """Where fast modes matter, an order that is that of the steps: steps to the power of 4 and more for the error."""
    runs = [error("tumbling", tolerance) for tolerance in (1e-3, 1e-5, 1e-7)]
    errors, steps = np.array([e for e, _ in runs]), np.array([m.steps for _, m in runs])
    assert (errors[1:] < 0.1 * errors[:-1]).all()
    rates = -np.log(errors[1:] / errors[:-1]) / np.log(steps[1:] / steps[:-1])
    assert (rates > 3.5).all()


def test_longest_steps_are_stable_ones():
    """A tolerance that asks for nothing: no more steps than the limit does, and rest stays rest."""
    found = scene("falls", tolerance=0.1)
    assert found.steps < 3 * 0.05 * fastest() / 2.8 + 20
    still = simulate_reconfigured(plate(), (), 0.3, tolerance=1e-8, gravity=(0, 0, -9.81), velocity=(0, 0, 100))
    assert still.rejected == 0
    assert still.steps < 1.5 * 0.3 * fastest() / 2.8 + 20
    np.testing.assert_allclose(still.r_0[-1], (0, 0, 30 - 9.81 * 0.09 / 2), rtol=1e-12)


def test_steps_end_at_breaks():
    """Where a jump is named, steps of no other size are needed for it, and both sides have their own accelerations."""
    named, motion = error("jump", 1e-6)
    assert JUMP in motion.time
    assert motion.breaks == (JUMP,)
    at = int(np.searchsorted(motion.time, JUMP))
    steps = np.diff(motion.time)
    assert steps[at - 2 : at + 8].min() > 0.05 * np.median(steps)
    assert np.linalg.norm(motion.al[at] - motion.al[at - 1]) > 0.5 * np.linalg.norm(motion.al[at])
    hidden = dict(SCENES["jump"], breaks=())
    unnamed = simulate_reconfigured(
        plate(), [FrameLoad("end", force=jumping)], 0.05, tolerance=1e-6, damping=0.05, spin=hidden["spin"]
    )
    wrong = speeds(unnamed, unnamed.rates[-1] - exact("jump").rates[-1], unnamed.q[-1] - exact("jump").q[-1])
    assert wrong < 1e-5 * speeds(unnamed, unnamed.rates, unnamed.q).max()
    assert unnamed.steps > motion.steps  # it is passed in short steps
    assert unnamed.rejected > motion.rejected or np.diff(unnamed.time).min() < 0.1 * steps.min()
    assert named < 1e-6


def test_breaks_of_several_loads_that_rounding_parts():
    loads = [FrameLoad("end", force=jumping, breaks=(0.1 + 0.2, 0.02)), FrameLoad("P1", force=(0, 0, 1), breaks=(0.3,))]
    found = simulate_reconfigured(plate(), loads, 0.4, tolerance=1e-3, damping=0.05)
    assert found.breaks == (0.02, 0.3)
    assert np.diff(found.time).min() > 1e-7


def test_the_rigid_body():
    """No frequency bounds its steps."""
    spin, stop = (1.0, 2.0, 3.0), 5.0
    best = simulate_reconfigured(plate().first(0), (), stop, 1e-3, spin=spin)
    errors, steps = [], []
    for tolerance in (1e-4, 1e-6, 1e-8):
        found = simulate_reconfigured(plate().first(0), (), stop, tolerance=tolerance, spin=spin)
        errors.append(np.abs(found.w[-1] - best.w[-1]).max())
        steps.append(found.steps)
        assert np.abs(found.T[-1] - best.T[-1]).max() < 10 * tolerance
    assert steps[0] < 400
    assert (np.array(errors) < (1e-3, 1e-5, 1e-7)).all()


def test_result():
    found = as_result(scene("jump", tolerance=1e-4))
    assert found.stats.tolerance == 1e-4
    assert found.stats.break_times == [JUMP]
    assert found.stats.steps == len(found.time) - 1
    assert "steps accepted" in found.stats.method_reason
    assert np.isfinite(found["body.end.a"]).all()


def test_intervals():
    """The motion at equal times, at one of which a load breaks; the others are met by shorter steps."""
    push = FrameLoad("end", force=jumping, breaks=(JUMP, 0.1 * 3 / 10))
    given: dict[str, Any] = {"stop_time": 0.1, "damping": 0.05, "spin": (2, -6, 3), "tolerance": 1e-6}
    found = simulate_reconfigured(plate(), [push], intervals=50, **given)
    free = simulate_reconfigured(plate(), [push], **given)
    np.testing.assert_array_equal(found.time, np.linspace(0, 0.1, 51))
    assert found.breaks == pytest.approx((JUMP, 0.03), rel=1e-12)
    assert 0.8 * free.steps < found.steps < 1.5 * free.steps
    assert free.steps == len(free.time) - 1
    for name in ("r_0", "w", "q", "al"):
        a, b = getattr(found, name), getattr(free, name)
        assert np.abs(a[-1] - b[-1]).max() < 1e-5 * np.abs(b).max()
    rates = (found.r_0[2:] - found.r_0[:-2]) / 0.004
    expected = np.einsum("tij,ti->tj", found.T, found.rates[:, :3])[1:-1]
    assert np.abs(rates - expected).max() < 0.1 * np.abs(expected).max()


def test_interrupted_and_resumed():
    told: list[float] = []

    def interrupt(part, steps):
        told.append(part)
        if part > 0.5:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt) as caught:
        scene("tumbling", tolerance=1e-5, progress=interrupt)
    reached: Any = caught.value
    part = reached.result
    assert 0.05 < part.time[-1] < 0.09
    np.testing.assert_array_equal(part.w, scene("tumbling", tolerance=1e-5).w[: len(part.time)])
    assert told == sorted(told)


def test_diverged():
    with pytest.raises(ac.SimulationError, match=r"diverges in step \d+.*rotates at up to") as caught:
        simulate_reconfigured(plate(), (), 2.0, tolerance=1e-2, spin=(0, 400, 0), q=1e-4)
    assert isinstance(caught.value.result, FrameMotion)
    assert np.isfinite(caught.value.result.q).all()


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9])
def test_a_jump_from_rest_that_nobody_names(tolerance):
    """No speed to count errors against, and yet no end of steps: what the jump costs is a part of what the load does."""
    push = FrameLoad("end", force=lambda t: (0.0, 0.0, 30.0 * (t > 0.0133)))
    found = simulate_reconfigured(plate(), [push], 0.03, tolerance=tolerance, damping=0.05)
    named = FrameLoad("end", force=push.force, breaks=[0.0133])
    best = simulate_reconfigured(plate(), [named], 0.03, tolerance=1e-10, damping=0.05)
    wrong = speeds(best, found.rates[-1] - best.rates[-1], found.q[-1] - best.q[-1])
    assert wrong < 2 * tolerance * speeds(best, best.rates, best.q).max()
    assert found.steps < 3 * best.steps


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"dt": 1e-4}, "exclude each other"),
        ({"intervals": 0}, "positive integer, not 0"),
        ({"intervals": 2.5}, "positive integer, not 2.5"),
        ({"intervals": 10, "tolerance": None}, "needs adaptive steps"),
        ({"variant": "paper"}, 'applies to variant="corrected" only'),
        ({"readings": Readings()}, 'applies to variant="paper" only'),
        ({"tolerance": 0}, "the tolerance must be a positive, finite number, not 0"),
        ({"tolerance": "x"}, "the tolerance must be a positive"),
        ({"tolerance": 1e-14}, "from 1e-10 to 0.1"),
        ({"tolerance": 1}, "from 1e-10 to 0.1"),
        ({"stop_time": -1}, "the stop time must be a positive"),
    ],
)
def test_refused(given, words):
    with pytest.raises(ac.DeclarationError, match=words):
        simulate_reconfigured(plate(), (), **{"stop_time": 0.01, "tolerance": 1e-4, **given})
