"""Order limit from the eigenvalues."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal.solve.order import eigenvalues_of, order_limit, state_matrix
from models import SpinUp


def pairs(*values: complex) -> np.ndarray:
    return np.array([v for value in values for v in (value, np.conj(value))])


@pytest.mark.parametrize(
    ("values", "order"),
    [
        (pairs(1j), 5),
        (pairs(1j, 5j), 5),
        (pairs(1j, 500j), 2),
        (pairs(1j, 500 * np.exp(1j * np.radians(180 - 80))), 3),
        (pairs(1j, 500 * np.exp(1j * np.radians(180 - 60))), 4),
        (pairs(1j, 500 * np.exp(1j * np.radians(180 - 40))), 5),
        (np.array([-1.0 + 0j, -1e6 + 0j]), 5),
        (np.zeros(3, dtype=complex), 5),
        (np.zeros(0, dtype=complex), 5),
    ],
)
def test_fast_oscillations_lie_inside_the_wedge(values: np.ndarray, order: int) -> None:
    assert order_limit(values, duration=20.0) == order


def test_estimate_of_a_large_system() -> None:
    compiled = ac.compile(SpinUp(volumes=20))
    result = ac.simulate(compiled, stop_time=20.0)
    assert result.stats["max_order"] == 2
    p, modes = compiled.parameter_values(None), np.zeros(0)
    from acausal.solve.initialize import initialize

    x, z, modes = initialize(compiled, p, 0.0, modes, "fixed")
    exact = np.abs(
        np.linalg.eigvals(
            state_matrix(compiled.at(x, z, p, 0.0, modes, 0.0).jacobian[: compiled.nx + compiled.nz], compiled.nx)
        )
    )
    found = np.abs(eigenvalues_of(compiled, x, z, p, 0.0, modes))
    assert found.max() == pytest.approx(exact.max(), rel=0.2)
    assert found.min() == pytest.approx(exact.min(), rel=0.2)
