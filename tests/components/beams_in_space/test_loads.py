"""Distributed loads against closed forms."""

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, as_expr, chain, fixed, part, sin, structural
from components import Body, Load, Revolute, Section, World
from tests.components.beams_in_space.scenes import Cantilever, beam_of

L, EJ_Z, EJ_Y, GJ = 2.0, 4.0, 1.0, 0.6
BEAM = {"length": L, "E": 1e4, "G": 2e3, "rho": 1.0, "A": 1.0, "J": 4e-4, "J_y": 1e-4, "J_t": 3e-4, "initial": "static"}
SHAPES = [{"elements": 4}, {"elements": 4, "reference": "pinned"}, {"volumes": 4}, {"elements": 4, "shear": True}]


def tip(**kind: Any) -> np.ndarray:
    """Deflection and rotation of the tip of a cantilever."""
    result = ac.simulate(Cantilever(kind=BEAM | kind), stop_time=1e-3, intervals=1, tolerance=1e-8)
    T = result["beam.frame_b.R.T"][0]
    turned = np.array([T[1, 2] - T[2, 1], T[2, 0] - T[0, 2], T[0, 1] - T[1, 0]]) / 2
    return np.r_[result["beam.frame_b.r_0"][0] - [L, 0, 0], turned]


@pytest.mark.parametrize("shape", SHAPES[:3])
def test_uniform_and_linear_forces(shape):
    """q L^4 / 8 EJ and q L^3 / 6 EJ; a load q s gives 11 q L^4 / 120 EJ and q L^3 / 8 EJ."""
    q = 1e-3
    found = tip(distributed=Load((0, q, 0)), **shape)
    np.testing.assert_allclose(found[[1, 5]], (q * L**4 / (8 * EJ_Z), q * L**3 / (6 * EJ_Z)), rtol=1e-4)
    found = tip(distributed=Load(lambda s, t, r, v, R: (0, 0, q * s)), **shape)
    np.testing.assert_allclose(found[[2, 4]], (11 * q * L**4 / (120 * EJ_Y), -q * L**3 / (8 * EJ_Y)), rtol=1e-4)


@pytest.mark.parametrize("shape", SHAPES[:3])
def test_moments(shape):
    """A moment m about z per length bends by m L^3 / 3 EJ, one about x twists by m L^2 / 2 GJ."""
    m = 1e-3
    found = tip(distributed=Load(moment=(m, 0, m)), **shape)
    np.testing.assert_allclose(found[1], m * L**3 / (3 * EJ_Z), rtol=1e-4)
    np.testing.assert_allclose(found[3], m * L**2 / (2 * GJ), rtol=1e-4)


@pytest.mark.parametrize("shape", SHAPES)
def test_load_on_a_part(shape):
    """On the outer 0.3 L, which ends within an element: by superposition of cantilevers."""
    q, a = 1e-3, 0.7 * L

    def deflection(x: float) -> float:
        """Of the tip, by a uniform load from 0 to x."""
        return q * x**4 / (8 * EJ_Z) + (L - x) * q * x**3 / (6 * EJ_Z)

    expected = deflection(L) - deflection(a)
    if shape.get("shear"):
        kGA = 5 / 6 * 2e3
        expected += q * (L**2 - a**2) / (2 * kGA)
    found = tip(distributed=Load((0, q, 0), between=(0.7, 1.0)), **shape)
    assert found[1] == pytest.approx(expected, rel=2e-4)


def test_section_loads_of_a_hanging_beam():
    """Under a uniform load the shear force is q (L - x), and the moment q (L - x)^2 / 2."""
    q = 1e-3
    for shape in SHAPES[:3]:
        kind = BEAM | {"distributed": Load((0, q, 0))} | shape
        result = ac.simulate(Cantilever(kind=kind), stop_time=1e-3, intervals=1, tolerance=1e-8)
        left = L - np.linspace(0, L, 5)
        np.testing.assert_allclose(result["beam.node_force"][0, :, 1], q * left, atol=1e-8)
        np.testing.assert_allclose(result["beam.node_moment"][0, :, 2], q * left**2 / 2, atol=1e-8)


class Wing(Model):
    """A hinged beam in gravity with air forces against its velocity, and a follower load."""

    kind: dict = structural("values of the beam", default=None)
    world, hinge = World(), Revolute(n=(0, 1, 1), phi=fixed(0.2), w=fixed(1.0))
    tip = Body(m=0.1)

    @part
    def beam(self):
        loads = (
            Load(lambda s, t, r, v, R: -0.3 * v),
            Load(
                (0, 0, 2.0), moment=lambda s, t, r, v, R: (0.1 * sin(5 * t), 0, 0), axes="section", between=(0.3, 0.8)
            ),
        )
        values = BEAM | {"rho": 1e3, "A": 1e-3, "E": 4e5, "J": 2e-6, "J_y": 1e-6, "J_t": 1.5e-6, "G": 1.6e5}
        return beam_of(**values | {"initial": "undeformed", "distributed": loads} | self.kind)

    def connections(self):
        yield chain(self.world, self.hinge, self.beam, self.tip)


@pytest.mark.parametrize(
    "shape", [{"elements": 2, "geometric_stiffness": True}, {"volumes": 2, "rotary_inertia": True}]
)
def test_power_of_the_loads_is_supplied(shape):
    result = ac.simulate(Wing(kind=shape), stop_time=0.5, intervals=10, tolerance=1e-8, energy=True)
    stats = result.stats
    assert abs(stats["energy_supplied"]) > 0.1
    assert abs(stats["energy_method"]) < 4e-6 * (abs(stats["energy_supplied"]) + abs(stats["energy_stored_change"]))


def strip_theory(V: float, e: float, incidence: float = 0.0) -> Load:
    """Lift 2 pi q c alpha at the distance e upstream of the axis, in air that flows along y with the speed V; rho = c = 1."""

    def lift(s, t, r, v, R):
        stream = np.array((0.0, V, -V * incidence)) - v
        return as_expr((0.0, 0.0, pi * V * (R.T @ stream)[2]))

    def moment(*state):
        return as_expr((-e * lift(*state)[2], 0.0, 0.0))

    return Load(lift, moment, axes="section")


@pytest.mark.parametrize("shape", SHAPES[:3])
def test_wing_twists_in_an_air_stream(shape):
    """GJ phi'' + 2 pi q c e (phi + incidence) = 0: phi = incidence (1 / cos(k L) - 1) at the tip diverges at k L = pi / 2."""
    e, small = 0.01, 1e-4
    for kL in (0.5, 1.2):
        V = kL / L * np.sqrt(GJ / (pi * e))
        found = tip(distributed=strip_theory(V, e, small), **shape)
        assert found[3] == pytest.approx(small * (1 / np.cos(kL) - 1), rel=2e-2)


def test_air_stream_damps_bending():
    """Lift pi rho V c against the velocity damps all modes by pi rho V c / (2 m)."""
    V, mass = 0.1, BEAM["rho"] * BEAM["A"]
    kind = BEAM | {"elements": 4, "distributed": strip_theory(V, 0.0), "bending": "xz", "torsion": False}
    values = np.linalg.eigvals(ac.linearize(Cantilever(kind=kind | {"axial": "none"})).A)
    np.testing.assert_allclose(values.real, -pi * V / (2 * mass), rtol=1e-6)


@pytest.mark.parametrize(
    ("wrong", "text"),
    [
        ({"axes": "body"}, "axes of a Load"),
        ({"between": (0.5, 0.2)}, "between of a Load"),
        ({"between": (0, 2)}, "between of a Load"),
        ({"moment": lambda s: (0, 0, s)}, "moment of a Load is a vector or a function"),
    ],
)
def test_wrong_loads_are_refused(wrong, text):
    with pytest.raises(ac.DeclarationError, match=text):
        Load((0, 0, 1), **wrong)


@pytest.mark.parametrize(
    ("wrong", "text"),
    [
        ({"distributed": 3}, "distributed takes a Load, or several, not 3"),
        ({"distributed": Load((1, 2))}, "force and moment of a Load are vectors of 3"),
        ({"A": None, "section": None}, "needs a value for `A`"),
        ({"section": 2.0}, "`section` takes a Rectangle"),
        ({"section": Section(1, 1, 1, 1, 1, 1, 1), "shear": True}, "shear=True needs the shear stiffnesses"),
        ({"torsional_inertia": 0}, "torsion=True needs torsional_inertia > 0"),
    ],
)
def test_beams_that_cannot_be_are_refused(wrong, text):
    kind = {name: value for name, value in (BEAM | wrong).items() if value is not None}
    with pytest.raises(ac.DeclarationError, match=text):
        ac.compile(Cantilever(kind=kind))
