"""The integrals of an element against sympy, to the last digit."""

import numpy as np
import pytest
import sympy as sp

from components.beams.element import beam_matrices, places

xi = sp.Symbol("xi")
ALONG = (1 - xi, xi, xi * (1 - xi))
ACROSS = (1 - 3 * xi**2 + 2 * xi**3, xi - 2 * xi**2 + xi**3, 3 * xi**2 - 2 * xi**3, xi**3 - xi**2)


def matrix(left, right):
    return np.array([[float(sp.integrate(p * q, (xi, 0, 1))) for q in right] for p in left])


def expected(bubble):
    along = ALONG[: 2 + bubble]
    return {"along": matrix(along, along), "mixed": matrix(along, ACROSS), "across": matrix(ACROSS, ACROSS)}


@pytest.mark.parametrize("bubble", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_integrals_are_exact(bubble):
    own, (along, across) = beam_matrices(1, bubble), places(0, 1, bubble)
    at = {"along": (along, along), "mixed": (along, across), "across": (across, across)}
    for name, numbers in expected(bubble).items():
        np.testing.assert_array_equal(getattr(own, name)[np.ix_(*at[name])], numbers, err_msg=name)


@pytest.mark.parametrize("bubble", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_elements_add_up(bubble):
    """Every coordinate belongs to the elements beside its node, a bubble to its own element."""
    whole, one, n = beam_matrices(3, bubble), expected(bubble), 4
    totals = {name: np.zeros_like(getattr(whole, name)) for name in one}
    for j in range(3):
        along, across = [j, j + 1, *[n + j] * bubble], [j, n + j, j + 1, n + j + 1]
        for name, rows, columns in (("along", along, along), ("mixed", along, across), ("across", across, across)):
            totals[name][np.ix_(rows, columns)] += one[name]
    for name, total in totals.items():
        np.testing.assert_allclose(getattr(whole, name), total, rtol=1e-15, err_msg=name)
