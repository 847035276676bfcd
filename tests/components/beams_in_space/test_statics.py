"""Large deflections in space against the exact rod."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from tests.components.beams_in_space.scenes import Cantilever, bend_error, bent_tip
from tests.reference.rod import loaded_rod


def test_exact_rod_has_the_published_tip():
    start = np.array([100 * np.sin(np.pi / 4), 100 * (1 - np.cos(np.pi / 4)), 0])
    np.testing.assert_allclose(bent_tip() - start, (-23.8168, -13.7309, 53.6042), atol=2e-4)


@pytest.mark.parametrize(
    ("kind", "coarse", "fine"),
    [
        ({"geometric_stiffness": True}, 0.15, 0.03),
        pytest.param({"geometric_stiffness": True, "reference": "pinned"}, 0.08, 0.02, marks=pytest.mark.slow),
        ({}, 0.32, 0.08),
        pytest.param({"reference": "pinned"}, 0.08, 0.02, marks=pytest.mark.slow),
    ],
    ids=["stiffened", "stiffened pinned", "linear", "linear pinned"],
)
def test_bend_of_45_degrees(kind, coarse, fine):
    """The error falls with the square of the length of a volume: with plain angles it would fall with the length."""
    errors = [bend_error(count, **kind) for count in (8, 16)]
    assert errors[0] < coarse
    assert errors[1] < fine
    assert errors[0] / errors[1] > 3.5


WIDTH, HEIGHT, LENGTH, E, NU = 12.77e-3, 3.2024e-3, 0.508, 71.7e9, 0.31
STRIP = {
    "length": LENGTH,
    "E": E,
    "nu": NU,
    "rho": 2700.0,
    "A": WIDTH * HEIGHT,
    "J": HEIGHT * WIDTH**3 / 12,
    "J_y": WIDTH * HEIGHT**3 / 12,
    "J_t": WIDTH * HEIGHT**3 * (1 / 3 - 0.21 * HEIGHT / WIDTH * (1 - (HEIGHT / WIDTH) ** 4 / 12)),
    "initial": "static",
}


def strip(P: float = 13.345, **kind) -> tuple[np.ndarray, float]:
    """Displacement of the tip and twist, of a strip under a force at 45 degrees to its sections."""
    force = (0.0, -P / np.sqrt(2), -P / np.sqrt(2))
    result = ac.simulate(Cantilever(kind=STRIP | kind, force=force), stop_time=1e-7, intervals=1, tolerance=1e-4)
    T = result["beam.frame_b.R.T"][0]
    return result["beam.frame_b.r_0"][0] - [LENGTH, 0, 0], float(np.arctan2(T[1, 2], T[1, 1]))


def strip_errors(**kind) -> tuple[float, float]:
    G = E / (2 * (1 + NU))
    stiffness = (G * STRIP["J_t"], E * STRIP["J_y"], E * STRIP["J"])
    tip, T = loaded_rod(LENGTH, np.array([0, -1, -1]) * 13.345 / np.sqrt(2), stiffness, E * STRIP["A"])
    exact, twist = tip - [LENGTH, 0, 0], float(np.arctan2(T[2, 1], T[1, 1]))
    np.testing.assert_allclose(exact, (-28.7095e-3, -14.0572e-3, -152.5083e-3), atol=1e-6)
    found, turned = strip(**kind)
    return float(np.linalg.norm(found - exact) / np.linalg.norm(exact)), abs(turned / twist - 1)


def test_strip_at_45_degrees():
    coarse, fine = (strip_errors(volumes=n, geometric_stiffness=True) for n in (4, 8))
    assert coarse[0] < 3e-3
    assert coarse[1] < 1.5e-2
    assert coarse[0] / fine[0] > 3.5
    one, _ = strip_errors(elements=8, geometric_stiffness=True)
    assert one < 8e-3
