"""Runs over planned instants by the core alone."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, discrete, reinit, time, variable, when
from acausal.compiler.core_equations import core_sampled
from acausal.core import Back, Sampled, SampledState, Sampler, library
from acausal.core.sampler import THRESHOLDS

pytestmark = pytest.mark.skipif(library() is None, reason="needs the core")


class Held(Model):
    """Speed that is set every tenth of a second, and a count of passages below a level."""

    x: Scalar = variable("place", start=1, fixed=True)
    u: Scalar = discrete("speed")
    due: Scalar = discrete("time of the next sample", start=0.1)
    n: Scalar = discrete("passages")

    def equations(self):
        yield der(self.x) == self.u
        yield when(time >= self.due, reinit(self.u, -self.x), reinit(self.due, self.due + 0.1))
        yield when(self.x < 0.5, reinit(self.n, self.n + 1))


def sampled() -> Sampled:
    found = core_sampled(ac.compile(Held()), False, True)
    assert found
    return found


def sampler(room: int = 100) -> Sampler:
    limits = dict.fromkeys(THRESHOLDS, 1e-12) | {
        "span": 10.0,
        "tolerance": 1e-6,
        "soon": 1e-8,
        "moves": 1e-3,
        "level": 0.01,
    }
    return Sampler(
        *(sampled(), room, limits | {"reach": 3.0, "error": 3.0, "enough": 1e-7}),
        **{"p": np.zeros(0), "times": np.linspace(0, 10, 41), "nominal": np.ones(1), "declared": np.zeros(0)},
        **{"size": np.ones(1), "rate": np.zeros(1), "tolerance": 1e-6, "smooth": True, "largest": False},
        **{"singular": False, "fine": 8},
    )


def start(**changes: Any) -> tuple[tuple[Any, ...], dict[str, Any]]:
    """Arguments from the start: discrete variables u, due, n, then the feedback."""
    given = {"state": SampledState(), "x": np.ones(1), "z": np.zeros(0), "c": np.array([0.0, 0.1, 0.0, 1.0])} | changes
    return (*given.values(), np.zeros(2, dtype=bool)), {"end": 10.0, "steps": 10_000, "density": 1}


def test_up_to_where_something_else_happens() -> None:
    """Every sample takes a tenth of x; the first one finds a speed of 0. The passage of 0.5 is left to the caller."""
    at, how = start()
    found = sampler().go(*at, **how)
    assert found.back == Back.DOUBT
    samples = found.events[np.isfinite(found.events)]
    np.testing.assert_allclose(samples, 0.1 * np.arange(1, 8), rtol=1e-14)
    np.testing.assert_allclose(found.x[np.isfinite(found.events), 0], 0.9 ** np.arange(7), rtol=1e-12)
    assert found.state.instants == 7
    assert found.state.time == pytest.approx(0.7)
    np.testing.assert_array_equal(found.times[np.isnan(found.events)], [0.25])  # the output 0.5 is a sample
    assert not found.truth.any()
    assert found.peak[1] == pytest.approx(0.5)


def test_up_to_the_end() -> None:
    at, how = start()
    found = sampler().go(*at, **how | {"end": 0.4})
    assert found.back == Back.NO_INSTANT
    assert found.state.time == pytest.approx(0.3)


@pytest.mark.parametrize(("room", "instants"), [(1, 1), (2, 2), (3, 2), (4, 3)])
def test_as_far_as_there_is_room(room: int, instants: int) -> None:
    """Between the second and the third instant lies an output: both have room or none."""
    at, how = start()
    found = sampler(room).go(*at, **how)
    assert (found.back, found.state.instants) == (Back.FULL, instants)
    assert len(found.times) <= room


def test_in_parts_as_at_once() -> None:
    at, how = start()
    whole = sampler().go(*at, **how)
    parts, (at, how) = [], start()
    one = sampler(2)
    for _ in range(3):
        parts.append(found := one.go(*at, **how))
        state = SampledState(time=found.state.time, step=found.state.step)
        at = (state, found.x[-1], found.z[-1], found.c[-1], found.truth)
    n = sum(len(part.times) for part in parts)
    np.testing.assert_array_equal(np.concatenate([part.x for part in parts]), whole.x[:n])


def test_too_few_steps_leave_nothing_behind() -> None:
    at, how = start()
    found = sampler().go(*at, **how | {"steps": 0})
    assert (found.back, found.state.instants, len(found.times)) == (Back.FULL, 0, 0)
    assert found.state.time == 0.0


def test_arguments_that_do_not_fit() -> None:
    at, how = start(x=np.ones(2))
    with pytest.raises(ValueError, match="do not fit"):
        sampler().go(*at, **how)


class Looped(Held):
    """What is planned is watched in another way where nothing is sampled."""

    def equations(self):
        yield der(self.x) == self.u
        yield when(self.x < 0.5, reinit(self.u, 0))


def test_models_without_planned_instants_have_none() -> None:
    assert core_sampled(ac.compile(Looped()), False, True) is None
