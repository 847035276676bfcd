"""Inertia of the flexible beam, in both of its forms, against quadrature over material points.

Nodal coordinates of the components are U = (u, v, l v', w, l w', l phi), those of the reference are without l: U = D q.
"""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
import pytest

from acausal import as_expr
from components.beams.beam_motion import POINTS, WEIGHTS
from components.beams.inertia import Inertia, Place
from components.beams.nodes import Nodes
from components.beams.pair import Pair, Symmetric
from components.beams.point_inertia import PointInertia
from components.beams.rotary_inertia import Spin, micro_energy, micro_inertia
from components.beams.station import Station
from components.beams.stiffness import ONE, ZERO, Stiffness
from components.beams.strain import Strain
from tests.reference import floating_beam

LENGTH, RHO_A, POLAR = 1.4, 3.1, 0.07
FORMS = pytest.mark.parametrize("form", ["matrices", "points"])
BUBBLES = pytest.mark.parametrize("bubbles", [False, True])
ELEMENTS = pytest.mark.parametrize("elements", [1, 3])
SEEDS = pytest.mark.parametrize(
    "seed", [0, pytest.param(1, marks=pytest.mark.slow), pytest.param(2, marks=pytest.mark.slow)]
)
X = np.array([1.0, 0, 0])


def strain_of(elements: int, l: float, second_order: bool, centroid: Pair = ZERO) -> Strain:
    """Strain of a beam with stiffnesses of 1."""
    unit = Symmetric(1.0, 0.0, 1.0)
    return Strain(elements, l, Stiffness(1.0, 1.0, (unit, unit), ONE, ZERO, centroid, ZERO), second_order)


class Motion:
    """Random motion of the frame and of the nodes and bubbles, large enough for every product to count."""

    def __init__(
        self, elements: int, seed: int, bubbles: bool = False, offset: tuple[float, float] = (0.0, 0.0)
    ) -> None:
        rng = np.random.default_rng(100 * elements + seed)
        self.elements, self.l, self.bubbles, self.offset = elements, LENGTH / elements, bubbles, offset
        self.n = 6 * elements + 6
        self.q, self.qd, self.qdd = rng.normal(size=(3, self.n + elements * bubbles))
        self.a, self.z, self.w, self.v = rng.normal(size=(4, 3))
        self.D = np.r_[np.tile([1, 1, self.l, 1, self.l, self.l], elements + 1), np.ones(elements * bubbles)]

    def _split(self, U: Any) -> tuple[Nodes, Any]:
        return Nodes.of([U[k] for k in range(self.n)]), U[self.n :] if self.bubbles else ()

    def inertia(self, form: str, *motion: Any, **effects: bool) -> Inertia | PointInertia:
        """Return one of the forms of inertia at U, Ud, Udd."""
        place, rate, acceleration = (self._split(U) for U in motion)
        mu = RHO_A * self.l
        if form == "matrices":
            U, c = place
            at = Place.of(U._replace(u=U.u + self.l * np.arange(self.elements + 1)), c)
            return Inertia(self.elements, self.l, mu, at, Place.of(*rate), Place.of(*acceleration), **effects)
        strain, each = strain_of(self.elements, self.l, self.bubbles), as_expr(np.ones(self.elements))
        stations = [
            (Station(strain, s, Pair(*self.offset)), mu * weight / 2 * each)
            for s, weight in zip(POINTS, WEIGHTS, strict=True)
        ]
        return PointInertia(stations, place, rate, acceleration, **effects)

    def ours(self, form: str, compute, **effects: bool) -> list[np.ndarray]:
        """Evaluate compute(inertia, a, z, w, v), written with symbols, at this motion."""
        values = [self.D * self.q, self.D * self.qd, self.D * self.qdd, self.a, self.z, self.w, self.v]
        symbols = [ca.SX.sym(f"s{k}", value.size) for k, value in enumerate(values)]
        *motion, a, z, w, v = (as_expr(symbol) for symbol in symbols)
        results = [as_expr(value).sx for value in compute(self.inertia(form, *motion, **effects), a, z, w, v)]
        return [np.array(value).ravel() for value in ca.Function("ours", symbols, results).call(values)]

    def on_q(self, nodal: tuple[Nodes, Any]) -> Any:
        """Forces on the nodal coordinates of the reference, then on the bubbles."""
        nodes, bubbles = nodal
        return as_expr([*nodes.entries(), *bubbles]) * self.D

    def points(self, only: int | None = None):
        """Mass, place in the straight beam and matrix of the displacement, of each point of quadrature."""
        for j in range(self.elements) if only is None else (only,):
            for point, weight in zip(*np.polynomial.legendre.leggauss(5), strict=True):
                xi, (y, z) = (1 + point) / 2, self.offset
                x, h = self.l * (j + xi), 1e-3
                S = np.zeros((3, self.q.size))
                S[:, : self.n] = floating_beam.shape(LENGTH, self.elements, x, j)
                if self.bubbles:
                    S[0, self.n + j] = xi * (1 - xi)
                # Exact: the central difference of a cubic is its slope plus h^2 / 6 of its constant third derivative.
                one, two = (self._difference(x, j, step) for step in (h, 2 * h))
                S[0, : self.n] -= np.array([y, z]) @ (4 * one - two)[1:] / 3
                for row, arm in ((1, -z), (2, y)):
                    S[row, [6 * j + 5, 6 * j + 11]] += arm * np.array([1 - xi, xi])
                yield RHO_A * self.l * weight / 2, np.array([x, y, z]), S

    def _difference(self, x: float, j: int, step: float) -> np.ndarray:
        ahead, behind = (floating_beam.shape(LENGTH, self.elements, at, j) for at in (x + step, x - step))
        return (ahead - behind) / (2 * step)

    def by_points(self, only: int | None = None) -> tuple[np.ndarray, np.ndarray, np.ndarray, float, np.ndarray]:
        """Force, moment, forces on q, kinetic energy and first moment of mass, of all elements or of one."""
        force, moment, nodal, energy, first = np.zeros(3), np.zeros(3), np.zeros(self.q.size), 0.0, np.zeros(3)
        for m, place, S in self.points(only):
            r, rate = place + S @ self.q, S @ self.qd
            rigid = self.a + np.cross(self.z, r) + np.cross(self.w, np.cross(self.w, r))
            df = m * (rigid + 2 * np.cross(self.w, rate) + S @ self.qdd)
            speed = self.v + np.cross(self.w, r) + rate
            force, moment, nodal = force + df, moment + np.cross(r, df), nodal + S.T @ df
            energy, first = energy + m * speed @ speed / 2, first + m * r
        return force, moment, nodal, energy, first


def close(found: Any, expected: Any, rtol: float = 1e-12) -> None:
    np.testing.assert_allclose(found, expected, rtol=rtol, atol=rtol * np.abs(expected).max())


@ELEMENTS
@SEEDS
def test_points_of_this_file_are_those_of_the_reference(elements, seed):
    m = Motion(elements, seed)
    force, moment, nodal, energy, _ = m.by_points()
    state = LENGTH, RHO_A, elements, m.q, m.qd
    expected = floating_beam.inertia_forces(*state, m.qdd, m.a, m.z, m.w, np.zeros(3))
    for found, value in zip((force, moment, nodal), expected, strict=True):
        close(found, value)
    assert energy == pytest.approx(floating_beam.kinetic_energy(*state, m.v, m.w), rel=1e-12)


@FORMS
@BUBBLES
@ELEMENTS
@SEEDS
def test_forces_energy_and_moments_of_mass(form, bubbles, elements, seed):
    m = Motion(elements, seed, bubbles)

    def compute(inertia, a, z, w, v):
        force, moment, nodal = inertia.forces(a, z, w)
        return force, moment, m.on_q(nodal), inertia.kinetic_energy(v, w), inertia.first_moment(), inertia.mass

    *found, mass = m.ours(form, compute)
    for one, expected in zip(found, m.by_points(), strict=True):
        close(one, expected)
    assert float(mass[0]) == pytest.approx(RHO_A * LENGTH)


@FORMS
@BUBBLES
@ELEMENTS
@SEEDS
def test_momenta_of_the_deformation(form, bubbles, elements, seed):
    """Generalised momenta without the frame's motion, and those of a force and a moment."""
    m = Motion(elements, seed, bubbles)
    found = m.ours(form, lambda inertia, a, z, w, v: (m.on_q(inertia.momentum()), *inertia.deformation_momentum()))
    momenta, force, moment = 0.0, 0.0, 0.0
    for mass, place, S in m.points():
        rate = mass * (S @ m.qd)
        momenta, force = momenta + S.T @ rate, force + rate
        moment = moment + np.cross(place + S @ m.q, rate)
    for one, expected in zip(found, (momenta, force, moment), strict=True):
        close(one, expected)


@FORMS
@BUBBLES
@ELEMENTS
@SEEDS
def test_element_forces(form, bubbles, elements, seed):
    m = Motion(elements, seed, bubbles)
    for j in range(elements):
        found = m.ours(form, lambda inertia, a, z, w, v, j=j: inertia.element(j).forces(a, z, w)[:2])
        for one, expected in zip(found, m.by_points(j), strict=False):
            close(one, expected)


@BUBBLES
@ELEMENTS
@pytest.mark.parametrize(
    "effects", [{}, {"centrifugal": False}, {"coriolis": False}, {"centrifugal": False, "coriolis": False}]
)
def test_both_forms_agree(effects, bubbles, elements):
    """Whole and one element, with every set of effects, to round-off."""
    m = Motion(elements, 3, bubbles)

    def compute(inertia, a, z, w, v):
        parts = [inertia.element(j).forces(a, z, w)[:2] for j in range(elements)]
        force, moment, nodal = inertia.forces(a, z, w)
        return force, moment, m.on_q(nodal), *(value for part in parts for value in part)

    for one, other in zip(*(m.ours(form, compute, **effects) for form in ("matrices", "points")), strict=True):
        close(one, other, 1e-13)


@FORMS
@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("effect", ["centrifugal", "coriolis"])
def test_what_an_effect_adds(effect, seed, form):
    """Centrifugal: the body force of the displacement; Coriolis: that of its rate; with moments in the deflected place."""
    m = Motion(2, seed, bubbles=True)

    def compute(inertia, a, z, w, v):
        force, moment, nodal = inertia.forces(a, z, w)
        return force, moment, m.on_q(nodal)

    expected = [0.0, 0.0, 0.0]
    for mass, place, S in m.points():
        d, rate = S @ m.q, S @ m.qd
        own = np.cross(m.w, np.cross(m.w, d)) if effect == "centrifugal" else 2 * np.cross(m.w, rate)
        adds = mass * own, mass * np.cross(place + d, own), mass * S.T @ own
        expected = [one + more for one, more in zip(expected, adds, strict=True)]
    pairs = zip(m.ours(form, compute), m.ours(form, compute, **{effect: False}), strict=True)
    for (full, without), value in zip(pairs, expected, strict=True):
        close(full - without, value, 1e-11)


@BUBBLES
@ELEMENTS
@SEEDS
def test_masses_beside_the_axis(bubbles, elements, seed):
    """Centroid off the axis: the section carries it along, with its slopes and its angle."""
    m = Motion(elements, seed, bubbles, offset=(0.3, -0.2))

    def compute(inertia, a, z, w, v):
        force, moment, nodal = inertia.forces(a, z, w)
        return force, moment, m.on_q(nodal), inertia.kinetic_energy(v, w), inertia.first_moment()

    for found, expected in zip(m.ours("points", compute), m.by_points(), strict=True):
        close(found, expected, 1e-10)  # slopes of the reference are differences


@ELEMENTS
@SEEDS
def test_spin_of_the_sections(elements, seed):
    m = Motion(elements, seed)
    state = LENGTH, 0.0, elements, m.q, m.qd
    polar, zero = as_expr(np.full(elements, POLAR / elements)), np.zeros(3)

    def compute(inertia, a, z, w, v):
        rate, acceleration = inertia.rate[0], inertia.acceleration[0]
        sections = Spin(polar, m.l, rate, acceleration, True)
        parts = [sections.element(j).forces(z, w)[0] for j in range(elements)]
        moment, nodal = sections.forces(z, w)
        return moment, m.on_q((nodal, ())), sections.kinetic_energy(w), sum(parts[1:], parts[0])

    moment, nodal, energy, parts = m.ours("points", compute)
    _, *expected = floating_beam.inertia_forces(*state, m.qdd, m.a, m.z, m.w, zero, POLAR)
    for found, value in zip((moment, nodal, parts), (*expected, expected[0]), strict=True):
        close(found, value)
    assert float(energy[0]) == pytest.approx(floating_beam.kinetic_energy(*state, m.v, m.w, POLAR), rel=1e-12)


@ELEMENTS
def test_micro_inertia(elements):
    """Energy of the reference, and forces that are the gradient of it."""
    m = Motion(elements, 4)
    mass, polar = RHO_A * m.l, POLAR / elements / m.l**2

    def compute(inertia, a, z, w, v):
        rate = inertia.rate[0]
        zero = Nodes.zero(elements + 1)
        forces = zero._replace(u=micro_inertia(rate.u, mass), phi=micro_inertia(rate.phi, polar))
        return micro_energy(rate.u, mass) + micro_energy(rate.phi, polar), m.on_q((forces, ()))

    energy, forces = m.ours("points", compute)
    assert float(energy[0]) == pytest.approx(
        floating_beam.micro_energy(LENGTH, RHO_A, elements, m.qd, POLAR), rel=1e-12
    )
    at = LENGTH, RHO_A, elements
    steps = [[floating_beam.micro_energy(*at, rate + e, POLAR) for rate in (m.qd, 0 * m.qd)] for e in np.eye(m.q.size)]
    gradient = [changed - float(energy[0]) - alone for changed, alone in steps]  # of a quadratic function
    close(forces, np.array(gradient))
