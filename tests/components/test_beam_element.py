"""The integrals of an element against sympy, to the last digit."""

import numpy as np
import pytest
import sympy as sp

from components.beams.element import element_matrices

xi = sp.Symbol("xi")
ALONG = (1 - xi, 0, 0, xi, 0, 0, xi * (1 - xi))
ACROSS = (0, 1 - 3 * xi**2 + 2 * xi**3, xi - 2 * xi**2 + xi**3, 0, 3 * xi**2 - 2 * xi**3, xi**3 - xi**2, 0)


def vector(row, weight):
    return [float(sp.integrate(s * weight, (xi, 0, 1))) for s in row]


def matrix(left, right, order=0):
    return [
        [float(sp.integrate(sp.diff(p, xi, order) * sp.diff(q, xi, order), (xi, 0, 1))) for q in right] for p in left
    ]


@pytest.mark.parametrize("bubble", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_integrals_are_exact(bubble):
    along, across = ALONG[: 6 + bubble], ACROSS[: 6 + bubble]
    expected = {
        "s1": vector(along, 1),
        "s2": vector(across, 1),
        "x1": vector(along, xi),
        "x2": vector(across, xi),
        "M11": matrix(along, along),
        "M12": matrix(along, across),
        "M22": matrix(across, across),
        "K_axial": matrix(along, along, 1),
        "K_bending": matrix(across, across, 2),
        "G": matrix(across, across, 1),
    }
    for name, numbers in expected.items():
        np.testing.assert_array_equal(getattr(element_matrices(bubble), name), numbers, err_msg=name)
