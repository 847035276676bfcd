"""The warning of unknowns that stay 0 although a disturbance would grow."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
import scipy

import acausal as ac
from acausal import connect, fixed
from acausal.solve.checks.growth import growth_rate, growth_warnings
from acausal.solve.initialization.initial_modes import start
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from components import Revolute
from components.rotational import Spring
from models import SCENES
from tests.acausal.flatten.test_stays_zero import INERTIA, REST, Arm
from tests.acausal.flatten.test_stays_zero_models import TwoElastic

WORDS = "disturbance would grow e-fold in"


class Upright(Arm):
    hinge = Revolute(phi=fixed(np.pi / 2), w=fixed(0))


class Leaning(Upright):
    across = Revolute(n=(0, 1, 0), phi=fixed(1e-3), w=fixed(0))


class Hanging(Arm):
    hinge = Revolute(phi=fixed(-np.pi / 2), w=fixed(0))


class Column(Upright):
    """A column of one link, with a spring across at its foot: it buckles if m g l > c."""

    across = Revolute(n=(0, 1, 0), use_axis_flange=True, **REST)
    spring = Spring(c=1.0)

    def connections(self):
        yield from super().connections()
        yield connect(self.spring.flange_b, self.across.axis)
        yield connect(self.spring.flange_a, self.across.support)


LOAD, TURNED = 0.5 * 9.81 * 0.4, INERTIA[1, 1] + 0.5 * 0.4**2


def doubts(model: ac.Model | ac.CompiledModel, **how) -> list[str]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ac.simulate(model, **{"stop_time": 1.0, "intervals": 5} | how).stats["doubts"]


def test_an_upright_pendulum_would_fall_sideways():
    (text,) = doubts(Upright())
    assert text.startswith("`across.phi` stays 0 in this run, but that is unstable at t = 0 s")
    assert float(text.partition(f"{WORDS} ")[2].split()[0]) == pytest.approx(np.sqrt(TURNED / LOAD), rel=1e-2)
    assert "Do this: give it a small start value, or apply a force across" in text
    with pytest.warns(ac.AcausalWarning, match=WORDS):
        ac.simulate(Upright(), stop_time=1.0)


def test_it_is_the_eigenvalue_of_the_full_system():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        largest = np.real(ac.linearize(Arm()).eigenvalues).max()
    (text,) = doubts(Arm())
    assert f"{WORDS} {1 / largest:.3g} s" in text


def test_a_hanging_pendulum_does_not():
    assert doubts(Hanging()) == []


@pytest.mark.parametrize(("part", "buckles"), [(0.9, True), (1.1, False)])
def test_a_column_above_its_buckling_load(part: float, buckles: bool):
    compiled = ac.compile(Column())
    found = doubts(compiled, parameters={"spring.c": part * LOAD}, stop_time=10.0)
    assert any(WORDS in text for text in found) == buckles


def test_a_short_run_is_not_disturbed():
    assert doubts(Upright(), stop_time=0.1) == []


def test_nothing_is_told_of_the_full_model_or_of_one_that_moves():
    assert doubts(ac.compile(Upright(), full=True)) == []
    assert doubts(Leaning()) == []


def test_closures_of_a_loop_are_constraints():
    assert not any(WORDS in text for text in doubts(TwoElastic(), stop_time=0.01))


@pytest.mark.parametrize("scene", list(SCENES))
def test_no_alarm_on_any_scene(scene: str):
    compiled = ac.compile(SCENES[scene]())
    if compiled.report["stays_zero"]:
        at_start = growth_warnings(*_started(compiled), span=1e3)
        assert at_start == []


def _started(compiled: ac.CompiledModel) -> tuple[Problem, Point]:
    problem = Problem(compiled, compiled.parameter_values(None))
    return problem, start(problem, 0.0, 1e-3, "guesses").point


def pencil(stiffness: np.ndarray, damping: np.ndarray, constraints: np.ndarray) -> tuple[Any, np.ndarray]:
    """M = 1: x'' + D x' + K x = G' f, G x = 0, as equations of v = (x, x', x'', f)."""
    n, m = len(stiffness), len(constraints)
    J = np.block(
        [
            [stiffness, damping, np.eye(n), -constraints.T],
            [constraints, np.zeros((m, 2 * n + m))],
        ]
    )
    derivative = np.concatenate([np.arange(n, 3 * n), np.full(n + m, -1)])
    return scipy.sparse.csc_matrix(J), derivative


def rate(K, D=None, G=None) -> float:
    n = len(K)
    J, derivative = pencil(
        np.asarray(K, float), np.zeros((n, n)) if D is None else D, np.zeros((0, n)) if G is None else G
    )
    return growth_rate(J, derivative)[0]


def test_growth_rates():
    assert rate(np.diag((4.0, 9e8))) == 0, "vibrations"
    assert rate(np.diag((0.0, 9e8))) == 0, "a free motion: a double zero"
    assert rate(np.diag((-4.0, 9e8))) == pytest.approx(2.0, rel=1e-6)
    assert rate(np.diag((4.0, 9.0)), -0.02 * np.eye(2)) == pytest.approx(0.01, rel=1e-6), "negative damping"


def test_constraints_are_deflated():
    """Two inverted pendulums of rates 2 and 3; a constraint holds one of them, or couples both."""
    K = np.diag((-4.0, -9.0))
    assert rate(K) == pytest.approx(3.0)
    assert rate(K, G=np.array([[0.0, 1.0]])) == pytest.approx(2.0)
    assert rate(K, G=np.array([[1.0, -1.0]])) == pytest.approx(np.sqrt(6.5))
    assert rate(K, G=np.eye(2)) == 0


def test_a_singular_system_is_not_judged():
    J, derivative = pencil(np.diag((-4.0, -9.0)), np.zeros((2, 2)), np.array([[1.0, 0.0], [2.0, 0.0]]))
    assert growth_rate(J, derivative)[0] == 0
