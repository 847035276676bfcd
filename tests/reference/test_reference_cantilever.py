import numpy as np
import pytest
from scipy.integrate import quad

from tests.reference import cantilever

LENGTH, RHO_A, EJ = 1.7, 2.3, 40.0


def test_roots_of_the_textbook():
    expected = [1.875104068711961, 4.694091132974175, 7.854757438237613, 10.995540734875467, 14.137168391046471]
    np.testing.assert_allclose(cantilever.frequency_roots(5), expected, rtol=1e-13)


def test_finite_elements_converge_to_the_exact_frequencies_from_above():
    exact = cantilever.bending_frequencies(LENGTH, RHO_A, EJ, 3)
    coarse, fine = (cantilever.element_frequencies(LENGTH, RHO_A, EJ, n)[:3] / exact - 1 for n in (8, 16))
    assert (coarse > 0).all()
    np.testing.assert_allclose(coarse / fine, 16, rtol=0.05)


def test_rayleigh_quotient_of_the_static_shape_bounds_the_first_frequency():
    shape = lambda x: float(cantilever.uniform_load_deflection(x, LENGTH, EJ, 1.0)[0])  # noqa: E731
    work, mass = quad(shape, 0, LENGTH)[0], quad(lambda x: RHO_A * shape(x) ** 2, 0, LENGTH)[0]
    ratio = np.sqrt(work / mass) / cantilever.bending_frequencies(LENGTH, RHO_A, EJ, 1)[0]
    assert 1 < ratio < 1.005


def test_axial_frequency_is_a_quarter_wave():
    assert cantilever.axial_frequencies(2.0, 8.0, 50.0, 2) == pytest.approx(np.array([1, 3]) * np.pi / 4 * 2.5)


def test_static_deflections_against_elements():
    # Cubic elements are exact at nodes, with consistent loads.
    _, K = cantilever.bending_matrices(LENGTH, RHO_A, EJ, 3)
    x, h = LENGTH * np.array([1, 2, 3]) / 3, LENGTH / 3
    tip = np.array([0, 0, 0, 0, 1.0, 0])
    deflection, slope = cantilever.tip_force_deflection(x, LENGTH, EJ, 5.0)
    np.testing.assert_allclose(np.linalg.solve(K, 5 * tip), np.column_stack([deflection, slope]).ravel(), rtol=1e-11)
    assert deflection[-1] == pytest.approx(5 * LENGTH**3 / (3 * EJ))
    deflection, slope = cantilever.uniform_load_deflection(x, LENGTH, EJ, 4.0)
    load = 4 * np.array([h, 0, h, 0, h / 2, -(h**2) / 12])
    np.testing.assert_allclose(np.linalg.solve(K, load), np.column_stack([deflection, slope]).ravel(), rtol=1e-11)
    assert deflection[-1] == pytest.approx(4 * LENGTH**4 / (8 * EJ))


def test_rolled_up():
    x, y, angle = cantilever.rolled_up([LENGTH / 2, LENGTH], EJ, 2 * np.pi * EJ / LENGTH)
    np.testing.assert_allclose(x, 0, atol=1e-15)
    np.testing.assert_allclose(y, [LENGTH / np.pi, 0], atol=1e-15)
    np.testing.assert_allclose(angle, [np.pi, 2 * np.pi])
    x, y, angle = cantilever.rolled_up(0.9, EJ, -30.0)
    assert x == pytest.approx(quad(lambda s: np.cos(30 / EJ * s), 0, 0.9)[0])
    assert y == pytest.approx(-quad(lambda s: np.sin(30 / EJ * s), 0, 0.9)[0])
    assert cantilever.rolled_up(0.9, EJ, 0.0)[0] == pytest.approx(0.9)
