"""Inertia of the flexible beam against quadrature over material points (tests/reference/floating_beam.py).

Nodal coordinates of the components are U = (u, v, l theta), those of the reference q = (u, v, theta): U = D q.
"""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from acausal import as_expr
from components.beams.element import beam_matrices
from components.beams.inertia import Inertia
from tests.reference import floating_beam

LENGTH, RHO_A = 1.4, 3.1
ELEMENTS = pytest.mark.parametrize("elements", [1, 3])
SEEDS = pytest.mark.parametrize("seed", [0, 1, 2])


class Motion:
    """Random motion of the frame and of the nodes, large enough for every product to count."""

    def __init__(self, elements: int, seed: int) -> None:
        rng = np.random.default_rng(100 * elements + seed)
        self.elements, self.l = elements, LENGTH / elements
        self.q, self.qd, self.qdd = rng.normal(size=(3, 3 * elements + 3))
        self.a, self.z, self.w, self.v = rng.normal(size=(4, 3))
        self.D = np.tile([1, 1, self.l], elements + 1)

    def ours(self, compute) -> list[np.ndarray]:
        """Evaluate compute(inertia, a, z, w, v), written with symbols, at this motion."""
        values = [self.D * self.q, self.D * self.qd, self.D * self.qdd, self.a, self.z, self.w, self.v]
        symbols = [ca.SX.sym(f"s{k}", value.size) for k, value in enumerate(values)]
        U, Ud, Udd, a, z, w, v = (as_expr(symbol) for symbol in symbols)
        inertia = Inertia(beam_matrices(self.elements), self.elements, self.l, RHO_A * self.l, U, Ud, Udd)
        results = [as_expr(value).sx for value in compute(inertia, a, z, w, v)]
        return [np.array(value).squeeze() for value in ca.Function("ours", symbols, results).call(values)]

    def element(self, j: int) -> tuple[np.ndarray, np.ndarray]:
        """Force and moment of inertia of element j alone, by quadrature over its points."""
        points, weights = np.polynomial.legendre.leggauss(5)
        force, moment = np.zeros(3), np.zeros(3)
        for point, weight in zip(points, weights, strict=True):
            x = self.l * (j + (1 + point) / 2)
            S = floating_beam.shape(LENGTH, self.elements, x, j)
            u = np.array([x, 0, 0]) + S @ self.q
            rigid = self.a + np.cross(self.z, u) + np.cross(self.w, np.cross(self.w, u))
            df = RHO_A * self.l * weight / 2 * (rigid + 2 * np.cross(self.w, S @ self.qd) + S @ self.qdd)
            force, moment = force + df, moment + np.cross(u, df)
        return force, moment


@ELEMENTS
@SEEDS
def test_forces(elements, seed):
    m = Motion(elements, seed)
    force, moment, nodal = m.ours(lambda inertia, a, z, w, v: inertia.forces(a, z, w))
    expected = floating_beam.inertia_forces(LENGTH, RHO_A, elements, m.q, m.qd, m.qdd, m.a, m.z, m.w, np.zeros(3))
    np.testing.assert_allclose(force, expected[0], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(moment, expected[1], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(m.D * nodal, expected[2], rtol=1e-12, atol=1e-12)


@ELEMENTS
@SEEDS
def test_kinetic_energy(elements, seed):
    m = Motion(elements, seed)
    (energy,) = m.ours(lambda inertia, a, z, w, v: [inertia.kinetic_energy(v, w)])
    expected = floating_beam.kinetic_energy(LENGTH, RHO_A, elements, m.q, m.qd, m.v, m.w)
    assert float(energy) == pytest.approx(expected, rel=1e-12)


@ELEMENTS
@SEEDS
def test_mass_and_first_moment(elements, seed):
    m = Motion(elements, seed)
    mass, first = m.ours(lambda inertia, a, z, w, v: [inertia.mass, inertia.first()])
    still = np.zeros(m.q.size)
    _, deformed = floating_beam.momenta(LENGTH, RHO_A, elements, m.q, still, [0, 0, 1], np.zeros(3))
    assert float(mass) == pytest.approx(RHO_A * LENGTH)
    # The angular momentum of a translation along z is the first moment crossed with z.
    np.testing.assert_allclose(np.cross(first, [0, 0, 1]), deformed, rtol=1e-12, atol=1e-12)


@ELEMENTS
@SEEDS
def test_element_forces(elements, seed):
    m = Motion(elements, seed)
    for j in range(elements):
        force, moment = m.ours(lambda inertia, a, z, w, v, j=j: inertia.element(j).forces(a, z, w)[:2])
        expected = m.element(j)
        np.testing.assert_allclose(force, expected[0], rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(moment, expected[1], rtol=1e-12, atol=1e-12)


@ELEMENTS
def test_stiffness(elements):
    m, b = Motion(elements, 5), beam_matrices(elements)
    EA, EJ = 700.0, 40.0
    U = m.D * m.q
    forces = m.D * (EA / m.l * b.K_axial @ U + EJ / m.l**3 * b.K_bending @ U)
    np.testing.assert_allclose(forces, floating_beam.stiffness_forces(LENGTH, EA, EJ, elements, m.q), rtol=1e-11)
