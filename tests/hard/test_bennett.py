"""Where constraints follow from one another in turns, others are kept on the way, whatever the method."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import connect, fixed, parts, piecewise, sin
from acausal.compiler.constants import Constants
from acausal.solve.initialization.independent_constraints import IndependentConstraints, selection
from acausal.solve.initialization.initial_modes import start
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from components import Revolute
from components.rotational import Torque
from tests.hard.bennett import ASKEW, GRAVITY, MASS, RATIO, SPEED, Bennett, OneCrank, Row, TwoCranks, energies, joints
from tests.hard.measure import within

STARTS = [(0.8, False), (2.0, False), (4.0, True)]
pytestmark = pytest.mark.filterwarnings("error::acausal.AcausalWarning")


def bennett(begins: float, askew: bool) -> Bennett:
    return Bennett(begins=begins, turned=ASKEW if askew else np.eye(3))


def off(begins: float, askew: bool, result: ac.Result) -> tuple[float, float]:
    """How far joints are from Bennett's relation in rad, and the speed from what energy says, over the fastest."""
    first = begins + result["joint[0].phi"]
    other = result["joint[1].phi"] - result["joint[1].phi"][0] + 2 * np.arctan(RATIO / np.tan(begins / 2))
    apart = np.abs(np.sin(first / 2) * np.sin(other / 2) - RATIO * np.cos(first / 2) * np.cos(other / 2)).max()
    found = np.array([energies(angle, (ASKEW.T if askew else np.eye(3)) @ [0, -1, 0]) for angle in first])
    energy = found[0, 0] * SPEED**2 + found[0, 1]
    speeds = np.sqrt(np.maximum(energy - found[:, 1], 0) / found[:, 0])
    return float(apart), float(np.abs(np.abs(result["joint[0].w"]) - speeds).max() / speeds.max())


@pytest.mark.parametrize(("begins", "askew"), STARTS)
@pytest.mark.parametrize(
    ("how", "bound"),
    [
        ({"method": "auto", "tolerance": 1e-4}, 1e-3),
        ({"method": "auto", "tolerance": 1e-7}, 1e-5),
        pytest.param({"method": "rosenbrock", "tolerance": 1e-7}, 1e-5, marks=pytest.mark.slow),
        ({"method": "auto", "tolerance": 1e-7, "constraints": "states"}, 1e-5),
        pytest.param({"method": "idas", "tolerance": 1e-7}, 1e-3, marks=pytest.mark.slow),
        pytest.param({"method": "resolve", "tolerance": 1e-7}, 1e-3, marks=pytest.mark.slow),
        pytest.param({"method": "idas", "tolerance": 1e-7, "constraints": "projection"}, 1e-3, marks=pytest.mark.slow),
    ],
)
def test_bennett_moves_as_its_geometry_and_energy_say(begins: float, askew: bool, how: Any, bound: float) -> None:
    result = ac.simulate(bennett(begins, askew), stop_time=3.0, intervals=300, energy=True, **how)
    apart, speed = off(begins, askew, result)
    within("Bennett's relation", apart, 1e-6)
    by_idas = result.stats.method == "idas"
    within("speed, over the fastest", speed, max(bound, 1e3 * how["tolerance"]) if by_idas else bound)
    assert result.stats.choices > 1
    assert by_idas == (how["method"] not in ("auto", "rosenbrock"))
    # What forces in the linkage bear depends on which are 0; no choice makes one of them large. With one: 4e4 N.
    forces = np.concatenate([np.abs(result[f"joint[{k}].frame_a.f"]).max(axis=1) for k in range(4)])
    within("force of a joint, N", float(forces.max()), 100.0)
    # Together they bear what moves.
    ends = [result[f"link[{k}].a_0"] for k in range(3)]
    borne = MASS * (ends[0] / 2 + ends[1] + ends[2] + 3 * GRAVITY * np.array([0, 1, 0]))
    given = -result["world.frame_b.f"] - result["end.frame_b.f"]
    within("force on the ground, over the greatest", float(np.abs(given - borne).max() / np.abs(borne).max()), 1e-6)


def test_events_are_those_of_the_motion() -> None:
    """The linkage is looked at after some steps, and begins anew at each event."""
    model = bennett(4.0, True)
    for how in ({"method": "auto", "tolerance": 1e-4}, {"method": "auto", "energy": True}, {"method": "idas"}):
        result = ac.simulate(model, stop_time=3.0, intervals=300, **how)
        risen = np.sin(result["joint[0].phi"]) > 0.3
        assert result["crossings"][-1] == np.sum(risen[1:] & ~risen[:-1])
        apart, speed = off(4.0, True, result)
        within("Bennett's relation", apart, 1e-6)
        within("speed, over the fastest", speed, 2e-3)
        forces = np.concatenate([np.abs(result[f"joint[{k}].frame_a.f"]).max(axis=1) for k in range(4)])
        within("force of a joint, N", float(forces.max()), 100.0)


@pytest.mark.parametrize(
    "intervals",
    [
        pytest.param(1, marks=pytest.mark.slow),
        pytest.param(2, marks=pytest.mark.slow),
        pytest.param(5, marks=pytest.mark.slow),
    ],
)
def test_few_outputs_of_many_turns(intervals: int) -> None:
    """IDAS is looked at after a call: it is asked for no more than what is kept may last, and costs what the time takes."""
    model = bennett(4.0, True)
    steps = []
    for stop_time in (5.0, 15.0):
        how: Any = {"stop_time": stop_time, "intervals": intervals, "tolerance": 1e-8}
        slow, quick = ac.simulate(model, method="idas", **how), ac.simulate(model, **how)
        assert np.abs(slow["joint[0].phi"] - quick["joint[0].phi"]).max() < 0.01
        assert slow["crossings"][-1] == quick["crossings"][-1] >= stop_time / 3
        steps.append(slow.stats.steps)
    assert steps[1] < 4 * steps[0]


class Switched(Bennett):
    """A torque changes its sign several times a turn."""

    drive = Torque()

    @parts
    def joint(self):
        """The first joint has a flange."""
        axes = [tuple(self.turned @ axis) for axis in joints(self.begins)[1]]
        first = Revolute(n=axes[0], phi=fixed(0), w=fixed(SPEED), use_axis_flange=True)
        return [first, *(Revolute(n=axis) for axis in axes[1:])]

    def connections(self):
        yield super().connections()
        yield connect(self.drive.flange, self.joint[0].axis)

    def equations(self):
        yield self.drive.tau == piecewise((6, sin(3 * self.joint[0].phi) > 0.2), -5)


@pytest.mark.parametrize("method", ["auto", pytest.param("idas", marks=pytest.mark.slow)])
def test_no_event_is_missed_where_outputs_are_few(method: str) -> None:
    compiled = ac.compile(Switched(begins=4.0, turned=ASKEW))
    for intervals in (1, 2, 4, 40):
        result = ac.simulate(compiled, stop_time=4.0, intervals=intervals, method=method)
        assert result.stats.events == 15
        assert result["joint[0].phi"][-1] == pytest.approx(15.1022, abs=0.01)  # at 1e-10


@pytest.mark.parametrize(
    "method", ["auto", pytest.param("rosenbrock", marks=pytest.mark.slow), pytest.param("idas", marks=pytest.mark.slow)]
)
def test_a_second_crank_changes_nothing(method: str) -> None:
    how: Any = {"stop_time": 5.0, "intervals": 200}
    exact = ac.simulate(OneCrank(), tolerance=1e-10, **how)
    for tolerance in (1e-4, 1e-6, 1e-8):
        found = ac.simulate(TwoCranks(), method=method, tolerance=tolerance, **how)
        used = "rosenbrock" if method == "auto" else method
        assert found.stats.method == used
        error = float(np.abs(found["bearing.phi"] - exact["bearing.phi"]).max())
        within(f"crank at {tolerance:g}, tolerances", error / tolerance, 2e4 if used == "idas" else 2000)
        within("cranks apart, rad", float(np.abs(found["bearing.phi"] - found["foot.phi"]).max()), 1e-9)
        across = np.eye(3) - np.outer(OneCrank.axis, OneCrank.axis)
        forces, expected = found["rocker.frame_b.f"] @ across, exact["rocker.frame_b.f"] @ across
        largest = np.abs(expected).max()
        within("force of the rocker, tolerances", float(np.abs(forces - expected).max() / largest / tolerance), 1e5)


def held(problem: Problem, at: Point, constants: Constants) -> IndependentConstraints:
    return IndependentConstraints.at(problem, replace(at, constants=constants))


def test_what_is_kept_is_independent() -> None:
    """How well constraints are kept is what singular values of all choices say; what is kept again is among the best."""
    compiled = ac.compile(Bennett())
    problem = Problem(compiled, compiled.parameter_values(None))
    at = start(problem, 0.0, 1.0, "fixed").point
    closures = len(at.constants.closures)
    chosen = [np.isin(np.arange(closures), kept).astype(float) for kept in combinations(range(closures), 3)]
    found = [held(problem, at, replace(at.constants, closures=kept)).conditioning[0] for kept in chosen]
    J = problem.scaled_gradients(at)[compiled.constraints.lowest].toarray().reshape(2, 3, -1)
    J = (J / np.linalg.norm(J, axis=2).max(axis=1)[:, None, None]).reshape(6, -1)
    kept = [np.linalg.svd(J[on > 0], compute_uv=False)[-1] for on in chosen]
    np.testing.assert_allclose(np.array(found) * np.linalg.svd(J, compute_uv=False)[2], kept, atol=1e-7)
    worst = replace(at.constants, closures=chosen[int(np.argmin(found))])
    again = selection(held(problem, at, worst))
    assert np.sum(again.closures) == 3
    assert held(problem, at, again).conditioning[0] > 0.7 * max(found)
    assert held(problem, at, replace(worst, closures=np.ones(closures))).conditioning[0] == 1


@pytest.mark.slow
def test_a_large_mechanism_keeps_what_is_independent() -> None:
    """What is kept of more than 100 constraints stays fit, and a choice that is not is mended."""
    compiled = ac.compile(Row())
    result = ac.simulate(compiled, stop_time=0.6, tolerance=1e-6, intervals=30, energy=True)
    assert result.stats.method == "rosenbrock"
    assert result.stats.choices == 0
    assert abs(result.stats.energy_method) < 1e-3
    problem = Problem(compiled, compiled.parameter_values(None))
    at = start(problem, 0.0, 1.0, "fixed").point
    right = at.constants.closures
    assert np.sum(right) > 100
    J = problem.scaled_gradients(at)[compiled.constraints.lowest].toarray()
    J /= np.linalg.norm(J.reshape(-1, 3, J.shape[1]), axis=2).max(axis=1).repeat(3)[:, None]
    shares = np.linalg.lstsq(J[right > 0].T, J[right == 0].T, rcond=None)[0]
    found = held(problem, at, at.constants).conditioning[0]
    assert found == pytest.approx((1 + np.linalg.norm(shares, 2) ** 2) ** -0.5, rel=1e-2)
    wrong = right.copy()
    # One of the first loop for one of the last.
    wrong[np.flatnonzero(right)[0]], wrong[np.flatnonzero(right == 0)[-1]] = 0, 1
    unfit = replace(at.constants, closures=wrong)
    assert held(problem, at, unfit).conditioning[0] < 0.5 * found
    again = selection(held(problem, at, unfit))
    assert np.sum(again.closures) == np.sum(right)
    assert held(problem, at, again).conditioning[0] > 0.9 * found
