"""Warnings about the point of a linear system."""

from __future__ import annotations

import warnings
from math import sqrt

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, chain, connect, fixed, guess, output
from components import Body, Fixed, FixedTranslation, FlexibleBeam, Prismatic, Revolute, SpringDamperParallel, World
from components.rotational import Inertia, Speed
from models import SimplePendulum
from tests.acausal.solve.initialization import test_steady_rotation as tsr


def told(model: Model, **how: str) -> list[str]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        ac.linearize(model, **how)
    return [str(one.message) for one in caught]


def test_a_straight_blade_that_turns_is_no_equilibrium():
    """The hub's angle turns, which is no reason; stretch of the blade is."""
    (text,) = told(tsr.Blade(), initial="guesses")
    assert "not an equilibrium" in text
    assert 'linearize(..., initial="steady"), or initial="static" of beam.' in text
    assert "der(beam.qd[42]) = " in text
    assert "der(hub.phi)" not in text


def test_rates_are_named_by_size():
    (text,) = told(SimplePendulum(hinge=Revolute(phi=fixed(0.3), w=fixed(0.5))))
    assert text.index("der(hinge.w)") < text.index("der(hinge.phi) = 0.5")
    assert "static" not in text


@pytest.mark.parametrize(
    "model", [tsr.Blade(), tsr.DrivenFlyball(), tsr.MotorAndFan(), tsr.OnAShaft(), tsr.OnASpring()]
)
def test_equilibria_are_silent(model):
    assert told(model, initial="steady") == []


def test_steady_rotation_by_given_values_is_silent():
    """Without stretch the straight blade rests; so does one whose start is static; the speed where a motor's torque is braked."""
    bent = FlexibleBeam(
        length=10.0, E=7e10, rho=2700.0, A=0.04, J=3.3e-5, elements=4, geometric_stiffness=True, axial="none"
    )
    assert told(tsr.Blade(beam=bent), initial="guesses") == []
    speed = (-0.2 + sqrt(0.2**2 + 4 * 0.05 * 2)) / (2 * 0.05)
    assert told(tsr.MotorAndFan(rotor=Inertia(J=0.3, w=fixed(speed), phi=fixed(0)))) == []
    (text,) = told(tsr.MotorAndFan(rotor=Inertia(J=0.3, w=fixed(0.9 * speed), phi=fixed(0))))
    assert "der(rotor.w)" in text


class TwoBlades(Model):
    """Two blades hinged to a hub on a pylon that sways along one axis."""

    world, slide, pylon, anchor = World(gravity=None), Prismatic(), Body(m=1.0), Fixed(r=(-1, 0, 0))
    hold = SpringDamperParallel(c=300.0, d=1.0, s_unstretched=1.0)
    hub, motor = Revolute(use_axis_flange=True, phi=guess(0.2)), Speed(w_ref=5.0)
    one, two = FixedTranslation(r=(0.3, 0, 0)), FixedTranslation(r=(-0.3, 0, 0))
    hinge1, hinge2 = Revolute(), Revolute()
    blade1, blade2 = (Body(m=0.5, r_CM=(x, 0, 0), I=0.01 * np.eye(3)) for x in (0.4, -0.4))

    def connections(self):
        yield chain(self.world, self.slide, self.pylon)
        yield connect(self.anchor.frame_b, self.hold.frame_a)
        yield connect(self.hold.frame_b, self.slide.frame_b)
        yield connect(self.motor.flange, self.hub.axis)
        yield chain(self.slide, self.hub)
        yield chain(self.hub, self.one, self.hinge1, self.blade1)
        yield chain(self.hub, self.two, self.hinge2, self.blade2)


def test_two_blades_on_a_pylon_are_a_periodic_system():
    """No load depends on the angle while both are straight; how they sway the pylon does, and a third blade would end that."""
    (text,) = told(TwoBlades(), initial="steady")
    assert "periodic: A changes as hub.phi turns" in text


class Shown(tsr.OnASpring):
    x: Scalar = output("place of the ball", unit="m")

    def equations(self):
        yield self.x == self.spoke.frame_b.r_0[0]


def test_an_output_in_axes_that_do_not_turn_is_periodic():
    (text,) = told(Shown(), initial="steady")
    assert "periodic: C changes as hub.phi turns" in text
