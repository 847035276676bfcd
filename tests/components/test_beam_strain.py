"""Strain of the flexible beam against quadrature over material points, and its forces against its energy."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
import pytest

from acausal import as_expr
from components.beams.elasticity import Elasticity
from components.beams.nodes import Nodes
from components.beams.pair import Pair, Symmetric
from components.beams.stiffness import ONE, ZERO, Stiffness
from components.beams.strain import Strain
from tests.reference import floating_beam

LENGTH, EA, EJ_Z, EJ_Y, GJ_T = 1.4, 700.0, 40.0, 90.0, 15.0
BENDING = Symmetric(EJ_Z, 0.0, EJ_Y)
SKEW = (Symmetric(40.0, 7.0, 90.0), Symmetric(31.0, -4.0, 77.0))  # pre-twist and taper
SECOND_ORDER = pytest.mark.parametrize("second_order", [False, True])


def strain_of(elements: int, second_order: bool, **more: Any) -> Strain:
    own: dict = {"bending": (BENDING, BENDING), "psi": ONE, "shear": ZERO, "centroid": ZERO, "shear_centre": ZERO}
    return Strain(elements, LENGTH / elements, Stiffness(EA, GJ_T, **own | more), second_order)


def scales(elements: int) -> np.ndarray:
    """D of the nodal coordinates U = D q."""
    l = LENGTH / elements
    return np.tile([1, 1, l, 1, l, l], elements + 1)


def numbers(expr: Any) -> np.ndarray:
    return np.array(ca.DM(as_expr(expr).sx)).ravel()


@pytest.mark.parametrize("seed", [0, 1])
def test_shortening_and_its_place(seed):
    """Against quadrature of (v'^2 + w'^2) / 2 over material points; what is left is of fourth order in the slopes."""
    size, elements = 1e-4, 2
    q = size * np.random.default_rng(seed).normal(size=18) * np.tile([0, 1, 1, 1, 1, 1], 3)
    l, points = LENGTH / elements, np.polynomial.legendre.leggauss(6)
    strain, U = strain_of(elements, True), Nodes.of(list(scales(elements) * q))
    bend = strain.bend(U)
    found = np.r_[numbers(strain.shortening(bend, bend, bend)[0]), numbers(strain.bubbles((U, U, U))[0])]
    expected = np.zeros(4)
    for j in range(elements):
        for point, weight in zip(*points, strict=True):
            at, h = l * (j + (1 + point) / 2), 1e-6
            right, left = (floating_beam.shape(LENGTH, elements, x, j)[1:] @ q for x in (at + h, at - h))
            f = np.sum(((right - left) / (2 * h)) ** 2) / 2
            expected[[j, elements + j]] += l * weight / 2 * f * np.array([1, 3 * point])
    np.testing.assert_allclose(found, expected, atol=200 * size**4)
    assert np.abs(expected).min() > size**2 / 1000


@pytest.mark.parametrize("elements", [1, 3])
def test_stiffness(elements):
    """Linear forces of stretch, torsion and bending in both planes."""
    q, D = np.random.default_rng(5).normal(size=6 * elements + 6), scales(elements)
    U = Nodes.of(list(D * q))
    elasticity = Elasticity(strain_of(elements, False), 0.0, True)
    forces = D * numbers(elasticity.forces(U, U, elasticity.tensions(U, U)).entries())
    stiffness = EA, EJ_Z, EJ_Y, GJ_T
    np.testing.assert_allclose(forces, floating_beam.stiffness_forces(LENGTH, stiffness, elements, q), rtol=1e-11)
    energy = numbers(elasticity.energy(U, stretches=True))[0]
    assert energy == pytest.approx(floating_beam.elastic_energy(LENGTH, stiffness, elements, q), rel=1e-12)


KINDS = {
    "plain": {},
    "varying": {"bending": SKEW},
    "shear": {"psi": Pair(0.6, 0.7), "shear": Pair(3 * EJ_Z * (1 / 0.6 - 1), 3 * EJ_Y * (1 / 0.7 - 1))},
    "offsets": {"centroid": Pair(0.02, -0.03), "shear_centre": Pair(-0.01, 0.04)},
}


@SECOND_ORDER
@pytest.mark.parametrize("twists", [True, False])
@pytest.mark.parametrize("kind", KINDS)
def test_forces_are_the_gradient_of_the_energy(kind, twists, second_order):
    """And with damping, their power is what it dissipates."""
    n, rng = 2, np.random.default_rng(6)
    x, rate = 0.3 * rng.normal(size=(2, 6 * n + 6)) * np.tile([1, 1, 1, 1, 1, twists], n + 1)
    u, ud = ca.SX.sym("u", x.size), ca.SX.sym("ud", x.size)
    U, Ud = (Nodes.of([as_expr(s[k]) for k in range(x.size)]) for s in (u, ud))
    strain = strain_of(n, second_order, **KINDS[kind])
    still, damped = (Elasticity(strain, beta, twists) for beta in (0.0, 0.7))
    forces, braked = (as_expr(e.forces(U, Ud, e.tensions(U, Ud)).entries()).sx for e in (still, damped))
    energy = still.energy(U, stretches=True).sx
    power, lost = ca.dot(braked - forces, ud), damped.dissipated(U, Ud, stretches=True).sx
    values = ca.Function("values", [u, ud], [forces, ca.gradient(energy, u), power, lost, energy])(x, rate)
    found, expected, power, lost, energy = (np.array(v).ravel() for v in values)
    free = [k for k in range(x.size) if twists or k % 6 != 5]
    np.testing.assert_allclose(found[free], expected[free], atol=1e-12 * np.abs(expected).max())
    np.testing.assert_allclose(power, lost, rtol=1e-11)
    assert min(lost, energy) > 1


def curvature_energy(elements: int, q: np.ndarray, points: int) -> float:
    """Bending energy by quadrature, of the sections turned on the shortest way to the tangents and by phi about them."""
    l, total, h = LENGTH / elements, 0.0, 1e-3
    for j in range(elements):
        for point, weight in zip(*np.polynomial.legendre.leggauss(points), strict=True):
            x = l * (j + (1 + point) / 2)
            at = [floating_beam.shape(LENGTH, elements, x + k * h, j)[1:] @ q for k in (-2, -1, 0, 1, 2)]
            slope = (at[0] - 8 * at[1] + 8 * at[3] - at[4]) / (12 * h)  # exact for cubics
            bend = (at[1] - 2 * at[2] + at[3]) / h**2
            t = np.r_[np.sqrt(1 - slope @ slope), slope]
            td = np.r_[-(slope @ bend) / t[0], bend]
            # Shortest turn of e_y, e_z from e_x to t: e - (e.t) / (1 + t_x) (e_x + t).
            y, z = (e - (e @ t) / (1 + t[0]) * (np.eye(3)[0] + t) for e in np.eye(3)[1:])
            phi = np.interp((1 + point) / 2, [0, 1], q[[6 * j + 5, 6 * j + 11]])
            along, across = np.cos(phi) * y + np.sin(phi) * z, np.cos(phi) * z - np.sin(phi) * y
            total += l * weight / 4 * (EJ_Z * (td @ along) ** 2 + EJ_Y * (td @ across) ** 2)
    return total


def test_bending_energy_of_second_order_is_that_of_turned_sections():
    """Up to the fourth order in slopes and angles: at half the size the difference is a thirty-second or less."""
    elements, rng, off = 2, np.random.default_rng(8), []
    shape = rng.normal(size=18) * np.tile([0, 0.3, 1, 0.3, 1, 1], 3)
    for size in (0.1, 0.05, 0.025):
        q = size * shape
        U = Nodes.of(list(scales(elements) * q))
        energy = numbers(Elasticity(strain_of(elements, True), 0.0, False).energy(U, stretches=False))[0]
        off.append(abs(energy - curvature_energy(elements, q, 2)))
    orders = np.log2(np.divide(off[:-1], off[1:]))
    assert (orders > 4.7).all()
