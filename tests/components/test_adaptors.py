"""Adaptors: what moves a flange by signals, and gives its motion as signals."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, UnbalancedModelError, chain, connect, fixed, input, sin, time
from components import rotational, translational


class Inverse(Model):
    """The torque that moves an inertia on a spring, with a motion that is given from outside."""

    phi: Scalar = input("angle", unit="rad")
    w: Scalar = input("speed", unit="rad/s")
    a: Scalar = input("acceleration", unit="rad/s2")
    adaptor, inertia = rotational.AngleToTorqueAdaptor(phi=phi, w=w, a=a), rotational.Inertia(J=2)
    spring, wall = rotational.Spring(c=3), rotational.Fixed()

    def connections(self):
        yield chain(self.adaptor.flange, self.inertia, self.spring, self.wall.flange)


class InverseGeneral(Inverse):
    adaptor = rotational.GeneralAngleToTorqueAdaptor(p=Inverse.phi, pder=Inverse.w, pder2=Inverse.a)


class Damped(Model):
    """Angle and speed from outside, on a flange with a torque that follows the speed."""

    phi: Scalar = input("angle", unit="rad")
    w: Scalar = input("speed", unit="rad/s")
    adaptor = rotational.AngleToTorqueAdaptor(phi=phi, w=w, use_a=False)
    load = rotational.LinearSpeedDependentTorque(tau_nominal=-3, w_nominal=1, torque_direction=False)

    def connections(self):
        yield connect(self.adaptor.flange, self.load.flange)


@pytest.mark.parametrize("model", [Inverse, InverseGeneral])
def test_torque_of_a_given_motion(model):
    compiled = ac.compile(model())
    assert compiled.states == ()
    result = ac.simulate(compiled, stop_time=1, parameters={"phi": 0.5, "w": 4, "a": 7})
    torque = result["adaptor.tau" if model is Inverse else "adaptor.f"]
    np.testing.assert_allclose(torque, 2 * 7 + 3 * 0.5)
    np.testing.assert_allclose(result["inertia.w"], 4)


def test_angle_and_speed_from_outside():
    result = ac.simulate(Damped(), stop_time=1, parameters={"phi": 0.5, "w": 4})
    np.testing.assert_allclose(result["adaptor.tau"], 3 * 4)


class Direct(Model):
    source, mass = translational.Force(f=3 * sin(time)), translational.Mass(m=2, s=fixed(0), v=fixed(0))
    adaptor = translational.GeneralForceToPositionAdaptor(f=1)

    def connections(self):
        yield chain(self.source.flange, self.mass, self.adaptor.flange)


def test_motion_as_signals():
    """2 a = 3 sin(t) - 1."""
    result = ac.simulate(Direct(), stop_time=2, tolerance=1e-9, energy=True)
    t = result.time
    np.testing.assert_allclose(result["adaptor.pder2"], 1.5 * np.sin(t) - 0.5, atol=1e-8)
    np.testing.assert_allclose(result["adaptor.pder"], 1.5 * (1 - np.cos(t)) - 0.5 * t, atol=1e-7)
    np.testing.assert_allclose(result["adaptor.p"], 1.5 * (t - np.sin(t)) - 0.25 * t**2, atol=1e-7)
    assert result.stats["energy_method"] == pytest.approx(0, abs=1e-6)


def test_a_missing_signal_is_named():
    with pytest.raises(UnbalancedModelError, match=r"adaptor\.a"):
        ac.compile(Inverse(adaptor=rotational.AngleToTorqueAdaptor(phi=sin(time), w=0)))


def test_a_signal_that_is_not_used_takes_no_value():
    with pytest.raises(ac.AcausalError, match=r"adaptor"):
        ac.compile(Damped(adaptor=rotational.AngleToTorqueAdaptor(phi=0, w=1, a=2, use_a=False)))
