"""Frequencies of beams in space, and their orders of convergence."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from tests.components.beams_in_space.scenes import Cantilever
from tests.reference import cantilever

# EJ_z = 4, EJ_y = 1, GJ_t = 0.6, EA = 1e4, each with frequencies of its own.
THIN = {"length": 1.0, "E": 1e4, "G": 2e3, "rho": 1.0, "A": 1.0, "J": 4e-4, "J_y": 1e-4, "J_t": 3e-4}
INERTIA = 5e-4


def frequencies(**kind) -> np.ndarray:
    """Angular frequencies of a cantilever."""
    return ac.linearize(Cantilever(kind=THIN | kind)).frequencies_hz * 2 * np.pi


def nearest(found: np.ndarray, exact: float) -> float:
    """Relative error of the frequency next to an exact one."""
    return float(found[np.argmin(np.abs(found - exact))] / exact - 1)


EXACT = {
    "xy": cantilever.bending_frequencies(1.0, 1.0, 4.0, 2)[0],
    "xz": cantilever.bending_frequencies(1.0, 1.0, 1.0, 2)[0],
    "torsion": np.pi / 2 * np.sqrt(0.6 / INERTIA),
    "stretch": np.pi / 2 * np.sqrt(1e4),
}


@pytest.mark.parametrize("mode", EXACT)
@pytest.mark.parametrize("shape", [{}, {"reference": "pinned"}])
def test_first_frequencies_converge_with_order_4(mode, shape):
    coarse, fine = (nearest(frequencies(elements=n, **shape), EXACT[mode]) for n in (4, 8))
    assert abs(fine) < 5e-6
    assert np.log2(coarse / fine) > 3.8


def test_off_effects_leave_the_other_frequencies():
    whole = frequencies(elements=4)
    for kind, gone in (
        ({"bending": "xy"}, "xz"),
        ({"bending": "xz"}, "xy"),
        ({"torsion": False}, "torsion"),
        ({"axial": "none"}, "stretch"),
    ):
        found = frequencies(elements=4, **kind)
        assert abs(nearest(found, EXACT[gone])) > 1e-2
        for mode in EXACT.keys() - {gone}:
            assert nearest(found, EXACT[mode]) == pytest.approx(nearest(whole, EXACT[mode]), abs=1e-9)


def timoshenko(slenderness: float) -> np.ndarray:
    """First angular frequencies of a Timoshenko cantilever of EJ = 1, with rotary inertia, by its transfer determinant."""
    r2, s2 = slenderness**-2, slenderness**-2 * 2.6 / (5 / 6)  # J / (A L^2), EJ / (k G A L^2)

    def determinant(w: float) -> float:
        # State (v, theta, M, V): v' = theta + s2 V, theta' = M, M' = -V - r2 w^2 theta, V' = w^2 v with signs below.
        A = np.array([[0, 1, 0, s2], [0, 0, 1, 0], [0, -r2 * w * w, 0, -1], [-w * w, 0, 0, 0]])
        from scipy.linalg import expm

        return float(np.linalg.det(expm(A)[2:, 2:]))

    from scipy.optimize import brentq

    guess = cantilever.bending_frequencies(1.0, 1.0, 1.0, 1)[0]
    return np.array([brentq(determinant, 0.5 * guess, 1.1 * guess, xtol=1e-13)])


@pytest.mark.parametrize(("bending", "sides"), [("xy", ("J", "J_y")), ("xz", ("J_y", "J"))])
def test_shear_converges_with_order_2(bending, sides):
    """Slenderness 16: a square bar of EJ = 1, EA L^2 = 256, against Timoshenko's equations."""
    strong = {"length": 1.0, "E": 256.0, "rho": 1.0, "A": 1.0, "J": 1 / 256, "J_y": 1 / 256, "nu": 0.3, "axial": "none"}
    exact = timoshenko(16.0)[0]
    errors = []
    for n in (4, 8, 16):
        kind = strong | {"elements": n, "shear": True, "rotary_inertia": True, "bending": bending, "torsion": False}
        errors.append(nearest(ac.linearize(Cantilever(kind=kind)).frequencies_hz * 2 * np.pi, exact))
    assert abs(errors[-1]) < 1e-4
    np.testing.assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])), 2, atol=0.2)
