"""How watched excesses move: the core against CasADi's functions and against differences."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal.compiler.core_equations import core_motion
from acausal.solve.initialization.initial_modes import start
from acausal.solve.integrate.consistent import Consistent
from acausal.solve.point import Rows
from acausal.solve.problem import Problem
from tests.benchmarks.events.engine import EngineV6
from tests.benchmarks.events.scenes import Ball, Drive, SampledPendulum, StickSlip

SCENES = {"engine": EngineV6, "ball": Ball, "drive": Drive, "sampled": SampledPendulum, "stick-slip": StickSlip}


def some(name: str) -> tuple[Problem, Rows]:
    """States beside the start, and unknowns that satisfy their equations there."""
    compiled = ac.compile(SCENES[name]())
    problem = Problem(compiled, compiled.parameter_values(None))
    at = start(problem, 0.0, 1e-3, "guesses").point
    beside = np.random.default_rng(0).standard_normal((7, problem.nx)) * problem.nominal[: problem.nx]
    x, times = at.x + 1e-3 * beside, 1e-4 * np.arange(1.0, 8.0)
    rows = Rows.within(times, x, np.tile(at.z, (7, 1)), at.constants.vector)
    found, lost = Consistent(problem)(rows, compiled.guards.needs)
    assert not lost
    return problem, found


@pytest.mark.parametrize("name", SCENES)
def test_rates_are_those_of_the_motion(name):
    """Along short straight ways in the direction of the derivatives of the states."""
    problem, rows = some(name)
    solve, h = Consistent(problem), 1e-6
    rates = solve.rates(solve(rows)[0])
    ends = []
    for sign in (-1, 1):
        moved = Rows(rows.times + sign * h, rows.x + sign * h * rates, rows.z, rows.constants)
        ends.append(problem.indicators(solve(moved, problem.compiled.guards.needs)[0])[0])
    rate = problem.indicators(rows)[1]
    np.testing.assert_allclose((ends[1] - ends[0]) / (2 * h), rate, rtol=1e-5, atol=1e-6 * np.max(np.abs(rate)))


def test_only_what_needs_rates_of_unknowns_solves_for_them():
    assert core_motion(ac.compile(Ball()))[0] is None
    square, tape = core_motion(ac.compile(EngineV6()))
    assert square is not None
    assert tape.sizes[-1] == len(square.unknowns)
