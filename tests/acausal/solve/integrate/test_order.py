"""Order limits of hand-made spectra, and the spectra of small and large linear systems."""

from __future__ import annotations

import numpy as np
import pytest
import scipy

from acausal.policy import POLICY
from acausal.solve.integrate.order import eigenvalues_of, order_limit
from tests.acausal.solve.made import linear

DENSE, FAST = POLICY.order.dense, POLICY.order.fast
SLOW = [1j, -1j]


def pair(size: float, degrees: float) -> list[complex]:
    """Two conjugate eigenvalues at an angle from the negative real axis."""
    value = -size * np.exp(1j * np.radians(degrees))
    return [value, value.conjugate()]


def limit(*values: complex, duration: float = 100.0) -> int:
    return order_limit(np.array(values, dtype=complex), duration)[0]


@pytest.mark.parametrize(
    ("degrees", "order"),
    [(0.1, 5), (51.8, 5), (51.9, 4), (73.3, 4), (73.4, 3), (86.0, 3), (86.1, 2), (90, 2), (95, 2)],
)
def test_fast_pairs_must_lie_in_the_wedge_of_the_order(degrees, order):
    assert limit(*SLOW, *pair(1e4, degrees)) == order
    assert limit(*SLOW, *pair(1e4, 10), *pair(1e3, degrees)) == order


def test_oscillations_that_the_steps_resolve_do_no_harm():
    assert limit(*SLOW, *pair(0.9 * FAST, 90)) == 5
    assert limit(*SLOW, *pair(1.1 * FAST, 90)) == 2


def test_what_decays_without_oscillation_does_no_harm():
    assert limit(*SLOW, -1e6, -1e3) == 5


def test_nothing_that_moves_is_stable():
    assert limit() == limit(0, 0) == 5


def test_where_the_slow_ones_rest_the_motion_is_a_turn_of_the_run():
    """Six zeros of a free body, and a vibration of 10 rad/s: fast if the run is long."""
    vibrations = [0] * 6 + pair(10, 90)
    assert limit(*vibrations, duration=100.0) == 2
    assert limit(*vibrations, duration=10.0) == 5


def test_what_hardly_turns_in_the_whole_run_is_not_fast():
    assert limit(*[1e-9] * 6, *pair(1e3, 90), duration=0.02) == 5


@pytest.mark.parametrize("seed", range(5))
def test_eigenvalues_of_a_small_system_are_those_without_its_algebraic_unknowns(seed):
    random, nx, nz = np.random.default_rng(seed), 6, 4
    A = random.standard_normal((nx + nz, nx + nz))
    schur = A[:nx, :nx] - A[:nx, nx:] @ np.linalg.solve(A[nx:, nx:], A[nx:, :nx])
    problem = linear(A, nx)
    found = eigenvalues_of(problem, problem.at(*np.zeros(nx + nz)))
    np.testing.assert_allclose(np.sort_complex(found), np.sort_complex(np.linalg.eigvals(schur)), rtol=1e-9)


def test_singular_equations_have_none():
    A = np.eye(4)
    A[3, 3] = 0
    problem = linear(A, 2)
    assert eigenvalues_of(problem, problem.at(0, 0, 0, 0)).size == 0


def spread(slow: complex, fast: complex, n: int) -> np.ndarray:
    """Blocks of the real matrices with the eigenvalues 10 and 20 times i, but for the first and the last."""
    values = [slow, *([10j, 20j] * n)[:n], fast]
    return scipy.linalg.block_diag(*[[[v.real, v.imag], [-v.imag, v.real]] for v in values])


@pytest.mark.parametrize("fast", [-10 + 1e4j, 1e5j, -1e4 + 1e4j])
def test_of_a_large_system_the_slowest_and_the_fastest_pair_are_found(fast):
    slow = -0.01 + 0.1j
    A = spread(slow, fast, DENSE)
    random, n = np.random.default_rng(0), len(A)
    mixed = np.linalg.qr(random.standard_normal(A.shape))[0]
    by_z, of_x, inner = random.standard_normal((n, 3)), random.standard_normal((3, n)), random.standard_normal((3, 3))
    whole = np.block([[mixed @ A @ mixed.T + by_z @ np.linalg.solve(inner, of_x), by_z], [of_x, inner]])
    problem = linear(whole, len(A))
    found = eigenvalues_of(problem, problem.at(*np.zeros(len(whole))))
    assert len(found) == 4
    for value in (slow, slow.conjugate(), fast, np.conj(fast)):
        assert np.min(np.abs(found - value)) < 1e-3 * abs(value)


def test_a_large_system_whose_rates_are_constant_has_nothing_fast():
    n = 2 * DENSE
    problem = linear(np.zeros((n, n)), n)
    assert order_limit(eigenvalues_of(problem, problem.at(*np.zeros(n))), 1.0)[0] == 5
