"""Flows of unconnected ports that are stated by a containing component."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Model, Scalar, UnbalancedModelError, chain, connect, fixed, parameter, port, variable
from components import Body, Frame, Prismatic, World, rotational, translational


class Strut(Model):
    """A mass of 1 kg on a spring of 100 N/m: s = cos(10 t)."""

    k: Scalar = parameter("stiffness", unit="N/m", default=100)
    world, mass = World(g=0), Body(m=1)
    strut = Prismatic(s=fixed(1), v=fixed(0), use_axis_flange=True)

    def connections(self):
        yield chain(self.world, self.strut, self.mass)

    def equations(self):
        yield self.strut.axis.f == -self.k * self.strut.s

    def stored_energy(self):
        return self.k * self.strut.s**2 / 2


def test_a_law_takes_the_place_of_a_connection():
    result = ac.simulate(Strut(), stop_time=1, tolerance=1e-8, energy=True)
    np.testing.assert_allclose(result["strut.s"], np.cos(10 * result.time), atol=1e-6)
    assert abs(result.stats["energy_method"]) < 1e-5


class Inside(Component):
    """The same inside of a part."""

    frame_a = port(Frame, "root")
    strut, mass = Prismatic(s=fixed(1), v=fixed(0), use_axis_flange=True), Body(m=1)

    def connections(self):
        yield chain(self.frame_a, self.strut, self.mass)

    def equations(self):
        yield self.strut.axis.f == -100 * self.strut.s


class Outside(Model):
    world, inside = World(g=0), Inside()

    def connections(self):
        yield connect(self.world.frame_b, self.inside.frame_a)


def test_a_part_may_state_it():
    assert ac.simulate(Outside(), stop_time=1, tolerance=1e-8)["inside.strut.s"][-1] == pytest.approx(
        np.cos(10), abs=1e-6
    )


class Reading(Model):
    """A flow on the right is read, no more: nothing flows."""

    tau: Scalar = variable("torque", unit="N.m")
    rotor = rotational.Inertia(J=1, phi=fixed(0), w=fixed(1))

    def equations(self):
        yield self.tau == self.rotor.flange_a.tau


def test_a_flow_may_be_read():
    result = ac.simulate(Reading(), stop_time=1)
    assert result["rotor.phi"][-1] == pytest.approx(1, abs=1e-9)
    assert np.all(result["tau"] == 0)


class Both(Strut):
    damper = translational.Damper(d=1)

    def connections(self):
        yield from super().connections()
        yield chain(self.strut.support, self.damper, self.strut.axis)


def test_a_law_beside_a_connection_is_named():
    with pytest.raises(UnbalancedModelError, match=r"(?s)Both.*test_flows_outside.*damper"):
        ac.compile(Both())
