"""Lateral buckling and buckling in the weak plane, of one stiffened frame."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

import acausal as ac
from tests.components.beams_in_space.scenes import Cantilever

# EJ_z = 1e4 EJ_y, so that bending before buckling does not count; EJ_y = GJ_t = 1.
THIN = {"length": 1.0, "E": 1e6, "G": 1e6, "rho": 1.0, "A": 1.0, "J": 1e-2, "J_y": 1e-6, "J_t": 1e-6}
LATERAL = (
    4.0125993  # load of a cantilever over sqrt(EJ_y GJ_t) / L^2 (Timoshenko, Gere, Theory of Elastic Stability, 6.3)
)


def critical(direction: tuple[float, float, float], low: float, high: float, **kind: Any) -> float:
    """Load at which the lowest squared frequency across is 0."""
    values = THIN | {"torsional_inertia": 1e-3, "axial": "none", "initial": "static"} | kind
    model = ac.compile(Cantilever(kind=values))

    def lowest(P: float) -> float:
        found = ac.linearize(model, parameters={"force": tuple(P * x for x in direction)})
        return float(np.sort(-(np.linalg.eigvals(found.A) ** 2).real)[:2].mean())

    found: Any = brentq(lowest, low, high, xtol=1e-6)
    return float(found)


@pytest.mark.parametrize(("elements", "most"), [(4, 1.7e-2), (8, 5e-3)])
def test_lateral_buckling_of_a_cantilever(elements, most):
    found = critical((0, -1, 0), 3.0, 5.0, elements=elements, geometric_stiffness=True)
    assert 0 < found / LATERAL - 1 < most


def test_lateral_buckling_of_a_linear_chain():
    found = critical((0, -1, 0), 3.0, 5.0, volumes=8)
    assert abs(found / LATERAL - 1) < 2e-2


def test_buckling_in_the_weak_plane_converges_with_order_4():
    errors = [critical((-1, 0, 0), 1.5, 3.5, elements=n, geometric_stiffness=True) / (np.pi**2 / 4) - 1 for n in (1, 2)]
    assert errors[0] < 1e-2
    assert errors[0] / errors[1] > 10
