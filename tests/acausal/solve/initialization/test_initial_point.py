"""The initial point of a run, which the next one may share, changes no bit of it."""

from __future__ import annotations

import time as clock
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import AcausalWarning, Model, Scalar, chain, der, fixed, guess, parameter, sin, variable
from acausal.compiler.memo import memo_seconds
from acausal.solve.initialization import initial_point
from components import Body, FixedTranslation, Revolute, World
from models import FourBar


class Decay(Model):
    """Falls to where the initial value and a parameter say."""

    k: Scalar = parameter("rate", default=1.0)
    x: Scalar = variable("state")

    def equations(self):
        yield der(self.x) == -self.k * sin(self.x)


@pytest.fixture
def starts(monkeypatch) -> list[Any]:
    """Count how often a start is sought."""
    seen: list[Any] = []
    start = initial_point.start
    monkeypatch.setattr(initial_point, "start", lambda *arguments: seen.append(arguments) or start(*arguments))
    return seen


def test_another_tolerance_method_or_grid_keeps_it(starts):
    compiled = ac.compile(Decay(x=fixed(1.0)))
    changes: list[dict[str, Any]] = [{}, {"tolerance": 1e-9}, {"method": "idas"}, {"intervals": 7}, {"energy": True}]
    for options in changes:
        ac.simulate(compiled, stop_time=1.0, **options)
    assert len(starts) == 1


@pytest.mark.parametrize(
    "other", [{"parameters": {"k": 2.0}}, {"start_time": -1.0}, {"stop_time": 2.0}, {"initial": "guesses"}]
)
def test_anything_else_seeks_another(starts, other):
    compiled = ac.compile(Decay(x=fixed(1.0)))
    for options in ({}, other, {}):
        given: Any = {"stop_time": 1.0, **options}
        ac.simulate(compiled, **given)
    assert len(starts) == 3


def test_a_run_again_is_the_same_to_the_last_bit():
    options: dict[str, Any] = {"stop_time": 0.5, "tolerance": 1e-4}
    compiled = ac.compile(FourBar())
    first, again = (ac.simulate(compiled, **options) for _ in range(2))
    ac.simulate(compiled, parameters={"world.g": 1.0}, **options)
    for result in (again, ac.simulate(compiled, **options)):
        np.testing.assert_array_equal(result["j1.phi"], first["j1.phi"])
        np.testing.assert_array_equal(result["j1.w"], first["j1.w"])
        assert result.stats.steps == first.stats.steps


def test_seconds_of_the_initialization_count_in_every_run():
    compiled = ac.compile(FourBar())
    runs = [ac.simulate(compiled, stop_time=0.01, intervals=1) for _ in range(2)]
    (first,) = compiled.memo[initial_point.shared_point.__wrapped__].values()
    assert all(run.stats.solve_seconds > first.seconds > 0 for run in runs)


@pytest.mark.parametrize("method", ["auto", "idas"])
def test_what_is_made_for_a_model_counts_as_compiled(method):
    compiled = ac.compile(FourBar())
    began = clock.perf_counter()
    first, again = (ac.simulate(compiled, stop_time=0.01, intervals=1, method=method).stats for _ in range(2))
    whole = clock.perf_counter() - began
    at_compiling, made = sum(compiled.seconds.values()), memo_seconds(compiled)
    assert first.compile_seconds > at_compiling + made / 2 > at_compiling
    assert again.compile_seconds < at_compiling + made / 2
    assert first.compile_seconds - at_compiling + first.solve_seconds < whole


def test_zeros_of_both_signs_are_not_the_same(starts):
    compiled = ac.compile(Decay(x=fixed(1.0)))
    for time in (0.0, -0.0):
        ac.simulate(compiled, start_time=time, stop_time=1.0)
    assert len(starts) == 2


class Standing(Model):
    """A pendulum that stands on its head."""

    world = World(g=9.81)
    hinge = Revolute(phi=guess(np.pi / 2), w=guess(0))
    bar = FixedTranslation(r=(1, 0, 0))
    mass = Body(m=1)

    def connections(self):
        yield chain(self.world, self.hinge, self.bar, self.mass)


def test_every_run_from_an_unstable_equilibrium_warns():
    compiled = ac.compile(Standing())
    for _ in range(2):
        with pytest.warns(AcausalWarning, match="unstable"):
            ac.simulate(compiled, stop_time=0.1, initial="steady")
