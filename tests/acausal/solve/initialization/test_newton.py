"""The damped Newton iteration and the homotopy, on small functions with known roots."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import acausal as ac
import models
from acausal import Model, Scalar, der, fixed, variable
from acausal.policy import POLICY
from acausal.solve.initialization.initial_modes import start
from acausal.solve.initialization.newton import InitialSystem, _algebraic, algebraic, homotopy, newton
from acausal.solve.problem import Problem
from tests.acausal.solve.made import Made, linear

NEWTON = POLICY.newton


def system(n: int, known=(), rows=None) -> InitialSystem:
    return InitialSystem(np.arange(n) if rows is None else np.array(rows), np.empty(0, int), np.array(known, dtype=int))


def scalar(f, slope) -> Made:
    return Made(lambda y: f(y), lambda y: np.atleast_2d(slope(y)), 1)


def solved(problem: Made, *start: float, **how) -> np.ndarray:
    return newton(problem, system(len(start)), problem.at(*start), 1.0, **how).y


# A circle and a parabola: (x, y) with x = y^2, x^2 + y^2 = 1.
GOLDEN = (5**0.5 - 1) / 2
ROOT = np.array([GOLDEN, GOLDEN**0.5])


def curves(y):
    return np.array([y[0] ** 2 + y[1] ** 2 - 1, y[0] - y[1] ** 2])


def slopes(y):
    return np.array([[2 * y[0], 2 * y[1]], [1.0, -2 * y[1]]])


def test_it_converges_quadratically():
    problem = Made(curves, slopes, 2)
    np.testing.assert_allclose(solved(problem, 0.4, 1.2), ROOT, rtol=1e-11)
    error = np.array([np.max(np.abs(y - ROOT)) for y in problem.seen])
    error = error[(error > 1e-13) & (error < 0.1)]
    assert len(error) >= 3
    orders = np.log(error[2:] / error[1:-1]) / np.log(error[1:-1] / error[:-2])
    assert np.all(orders > 1.8)


@pytest.mark.parametrize("seed", range(5))
def test_iterates_are_the_same_for_equations_mixed_and_scaled(seed):
    """Affine covariance: the test of monotonicity is one of steps, not of residuals."""
    random = np.random.default_rng(seed)
    A = random.standard_normal((2, 2)) * 10.0 ** random.integers(-3, 4, (2, 1))
    plain, mixed = Made(curves, slopes, 2), Made(lambda y: A @ curves(y), lambda y: A @ slopes(y), 2)
    for problem in (plain, mixed):
        np.testing.assert_allclose(solved(problem, 3.0, 0.1), ROOT, rtol=1e-9)
    assert len(plain.seen) == len(mixed.seen)
    np.testing.assert_allclose(plain.seen, mixed.seen, rtol=1e-6)


@pytest.mark.parametrize("n", [1, 5, 40])
def test_linear_equations_take_one_step(n):
    random = np.random.default_rng(n)
    A, b = random.standard_normal((n, n)) + n * np.eye(n), random.standard_normal(n)
    problem = Made(lambda y: A @ y - b, lambda y: A, n)
    np.testing.assert_allclose(solved(problem, *np.zeros(n)), np.linalg.solve(A, b), rtol=1e-12, atol=1e-14)
    assert len(problem.seen) == 1


@pytest.mark.parametrize(
    ("f", "slope", "start", "root"),
    [
        (np.arctan, lambda y: 1 / (1 + y**2), 20.0, 0.0),
        (np.log, lambda y: 1 / y, 10.0, 1.0),
        (lambda y: np.sqrt(y) - 0.1, lambda y: 0.5 / np.sqrt(y), 4.0, 0.01),
    ],
    ids=["steps too far", "no value beyond", "no value beyond, a root near the edge"],
)
def test_damping_keeps_steps_where_they_lead_on(f, slope, start, root):
    with np.errstate(invalid="ignore", divide="ignore"):
        assert solved(scalar(f, slope), start)[0] == pytest.approx(root, abs=1e-12)


def test_a_double_root_is_found_as_well_as_it_can_be():
    assert solved(scalar(lambda y: (y - 1) ** 2, lambda y: 2 * (y - 1)), 2.0)[0] == pytest.approx(1.0, abs=1e-7)


def test_equations_without_a_root_are_named_the_worst_first():
    problem = Made(lambda y: np.array([y[0] - 1, y[1] ** 2 + 0.25]), lambda y: np.diag([1.0, 2 * y[1]]), 2)
    with pytest.raises(ac.InitializationError, match=r"equation 1: off by 0\.25.*\n.*equation 0: off by 0"):
        solved(problem, 0.0, 1.0)


def test_known_unknowns_stay_and_the_others_follow():
    problem = Made(curves, slopes, 2, nx=1)
    found = newton(problem, system(1, known=[0], rows=[-1]), problem.at(0.6, 0.5), 1.0).y
    np.testing.assert_allclose(found, [0.6, 0.8], rtol=1e-14)


def test_nothing_to_solve_for_returns_the_point():
    problem = Made(curves, slopes, 2)
    assert newton(problem, system(2, known=[0, 1]), at := problem.at(5.0, 5.0), 1.0) is at


def test_an_offset_is_what_the_equations_then_are():
    problem = Made(curves, slopes, 2)
    found = solved(problem, 0.5, 0.9, offset=np.array([0.1, -0.2]))
    np.testing.assert_allclose(curves(found), [0.1, -0.2], atol=1e-14)


def test_more_equations_than_unknowns_are_solved_if_they_agree():
    problem = Made(lambda y: np.array([y[0] - 2, y[0] ** 2 - 4, np.sin(y[0] - 2)]), None, 3, nx=2)  # type: ignore[arg-type]
    problem.jacobian = lambda y: np.array([[1, 0, 0], [2 * y[0], 0, 0], [np.cos(y[0] - 2), 0, 0]])
    start = problem.at(1.5, 7.0, 7.0)
    found = newton(problem, system(3, known=[1, 2], rows=[-2, -1, 0]), start, 1.0).y
    np.testing.assert_allclose(found, [2, 7, 7], rtol=1e-12)


def test_a_singular_start_takes_the_step_of_least_norm():
    problem = Made(lambda y: np.array([y[0] + y[1] - 2, (y[0] + y[1]) ** 2 - 4]), None, 2)  # type: ignore[arg-type]
    problem.jacobian = lambda y: np.array([[1, 1], [2 * (y[0] + y[1])] * 2])
    np.testing.assert_allclose(solved(problem, 3.0, 1.0), [2, 0], atol=1e-12)


def exponential() -> Made:
    return scalar(lambda y: np.exp(y) - 1, np.exp)


def test_the_homotopy_arrives_where_the_iteration_alone_runs_out_of_steps():
    """From far up an exponential each step is 1, whatever the distance."""
    start = POLICY.newton.iterations + 2.0
    with pytest.raises(ac.InitializationError):
        solved(exponential(), start)
    problem = exponential()
    found = homotopy(problem, system(1), problem.at(start))
    assert found is not None
    assert found.y[0] == pytest.approx(0.0, abs=1e-12)


def test_the_homotopy_ends_where_its_path_does():
    """The path of y^3 - 2 y + 2 from 0 turns back at the root of 2/3, and the only root lies on the other side."""
    problem = scalar(lambda y: y**3 - 2 * y + 2, lambda y: 3 * y**2 - 2)
    assert homotopy(problem, system(1), problem.at(0.0)) is None


def test_algebraic_unknowns_alone():
    A = np.array([[5.0, 1, 2], [1, 2, 1], [3, 0, 4]])
    problem = linear(A, nx=1)
    found = algebraic(problem, problem.at(2.0, 0.0, 0.0))
    assert found.x.tolist() == [2.0]
    np.testing.assert_allclose(found.z, np.linalg.solve(A[1:, 1:], -A[1:, 0] * 2), rtol=1e-14)


class Root(Model):
    """z^3 = x, whose slope is 0 at z = 0."""

    x: Scalar = variable("what it follows from")
    z: Scalar = variable("the root", start=1)

    def equations(self):
        yield der(self.x) == -self.x
        yield self.z**3 == self.x


@pytest.mark.parametrize(
    "scene", ["FourBar", "NFourBar", "Bricard", "FourBarSpatial", "Squeezer", "SliderCrank", "Governor"]
)
def test_the_core_finds_what_the_damped_iteration_finds(scene):
    compiled = ac.compile(getattr(models, scene)())
    problem = Problem(compiled, compiled.parameter_values(None), runs=True)
    at = start(problem, 0.0, 0.5, "guesses").point
    rng, accepted = np.random.default_rng(0), 0
    multipliers = compiled.constraints.multipliers
    for size in (0.0, 1.0, 1e3):
        z = at.z.copy()
        z[multipliers] += size * rng.standard_normal(len(multipliers))
        there = replace(at, z=z)
        found, expected = problem.solved(there, NEWTON.quick), newton(problem, _algebraic(compiled), there, 0.0)
        if found:
            accepted += 1
            np.testing.assert_allclose(found.z, expected.z, rtol=1e-9, atol=1e-9 * np.max(np.abs(expected.z)))
    assert accepted


def test_what_the_core_does_not_find_at_once_is_left_to_the_damped_iteration():
    compiled = ac.compile(Root(x=fixed(8.0)))
    problem = Problem(compiled, compiled.parameter_values(None), runs=True)
    far = replace(start(problem, 0.0, 1.0, "guesses").point, z=np.array([-1e-3]))
    assert problem.solved(far, NEWTON.quick) is None
    assert algebraic(problem, far).z == pytest.approx([2.0])
