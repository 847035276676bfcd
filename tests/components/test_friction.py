"""Brakes, clutches and lossy gears against closed forms, and wrong input."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import AcausalError, Model, Scalar, chain, connect, fixed, parameter
from components import rotational as r
from components import thermal
from components import translational as t


class SpinDown(Model):
    """J w' = -(a + b w) from w_0: w = (w_0 + a / b) exp(-b t / J) - a / b, to rest."""

    w_0: Scalar = parameter("speed at the start", unit="rad/s", default=5)
    rotor, bearing = r.Inertia(J=2.0, phi=fixed(0), w=fixed(w_0)), r.BearingFriction(tau_pos=[(0, 1), (2, 2), (3, 2.5)])

    def connections(self):
        yield chain(self.rotor, self.bearing)


@pytest.mark.parametrize("sense", [1, -1])
def test_friction_over_the_speed(sense):
    result = ac.simulate(SpinDown(), stop_time=8.0, tolerance=1e-9, parameters={"w_0": 5.0 * sense})
    a, b = 1.0, 0.5
    law = (5 + a / b) * np.exp(-b * result.time / 2) - a / b
    np.testing.assert_allclose(result["rotor.w"], sense * np.maximum(law, 0), atol=1e-7)
    assert result.stats["event_times"][-1] == pytest.approx(2 / b * np.log(1 + 5 * b / a), abs=1e-7)


class HotBrake(Model):
    rotor, brake = r.Inertia(J=2.0, phi=fixed(0), w=fixed(5)), r.Brake(tau_max=4, f_normalized=0.5, use_heat_port=True)
    drum = thermal.HeatCapacitor(C=50, T=fixed(300))

    def connections(self):
        yield chain(self.rotor, self.brake)
        yield connect(self.brake.heat_port, self.drum.port)


def test_a_brake_warms_its_drum():
    result = ac.simulate(HotBrake(), stop_time=8.0)
    assert result["drum.T"][-1] == pytest.approx(300 + 2 * 5**2 / 2 / 50, abs=1e-6)
    assert result.stats["event_times"] == pytest.approx([5 * 2 / 2], abs=1e-6)


class Lifted(Model):
    """A load on a worm gear, which lets it down slowly, holds it, or lifts it."""

    torque: Scalar = parameter("torque of the motor", unit="N.m", default=0)
    motor, gear = r.Torque(tau=torque), r.LossyGear(ratio=20, loss_table=[(0, 0.4, 0.05, 0.1, 0.1)])
    shaft, load = r.Inertia(J=0.01), r.Inertia(J=1.0, phi=fixed(0), w=fixed(0))
    weight = r.ConstantTorque(tau_constant=-8)

    def connections(self):
        yield chain(self.motor.flange, self.shaft, self.gear, self.load, self.weight.flange)


@pytest.mark.parametrize(("tau", "w"), [(0.0, -(8 - 20 * 0.1) / (1 + 4 / 0.05)), (1.0, 0.0), (1.5, 2 / (1 + 4 * 0.4))])
def test_worm_gear(tau, w):
    """With m = J + ratio^2 J_motor eta, up m w' = ratio (eta_mf1 tau - tau_bf) - 8; down with 1 / eta_mf2 and - tau_bf."""
    result = ac.simulate(Lifted(), stop_time=1.0, parameters={"torque": tau})
    assert result["load.w"][-1] == pytest.approx(w, abs=1e-6)


class Twisted(Model):
    """An elastic gear of the ratio 2 between two rotors: phi_rel'' = -c (1 / J_b + 1 / (4 J_a)) phi_rel."""

    gearbox = r.Gearbox(ratio=2, c=300, phi_rel=fixed(0.1), w_rel=fixed(0))
    first, second = r.Inertia(J=0.5), r.Inertia(J=3, phi=fixed(0), w=fixed(1))

    def connections(self):
        yield chain(self.first, self.gearbox, self.second)


def test_a_gearbox_starts_twisted():
    result = ac.simulate(Twisted(), stop_time=1.0, tolerance=1e-9)
    law = 0.1 * np.cos(np.sqrt(300 * (1 / 3 + 1 / 2)) * result.time)
    np.testing.assert_allclose(result["gearbox.phi_rel"], law, atol=1e-7)


class Stops(Model):
    """A mass runs into a stop, rests there while it is pushed, and is drawn away."""

    mass = t.MassWithStopAndFriction(
        m=2, L=0.2, smax=1.1, F_prop=0, F_Coulomb=1, F_Stribeck=0, fexp=0, s=fixed(0), v=fixed(0)
    )
    push = t.Force(f=ac.piecewise((5.0, ac.time < 2), -5.0))

    def connections(self):
        yield chain(self.push.flange, self.mass)


def test_a_mass_rests_at_its_stop():
    result = ac.simulate(Stops(), stop_time=3.0, intervals=300)
    touches = np.sqrt(2 * 1.0 / 2)
    assert result.stats["event_times"][0] == pytest.approx(touches, abs=1e-6)
    at = result.time
    expected = np.where(at < touches, at**2, np.where(at < 2, 1.0, 1 - (at - 2) ** 2))
    np.testing.assert_allclose(result["mass.s"], expected, atol=1e-6)


def test_one_way_clutch_does_not_start_against_its_sense():
    class Backward(Model):
        a, b = r.Inertia(J=1, phi=fixed(0), w=fixed(1)), r.Inertia(J=1, phi=fixed(0), w=fixed(0))
        clutch = r.OneWayClutch(tau_max=1, f_normalized=0)

        def connections(self):
            yield chain(self.a, self.clutch, self.b)

    with pytest.raises(AcausalError, match="clutch starts with w_rel < 0"):
        ac.simulate(Backward(), stop_time=1)


@pytest.mark.parametrize(
    ("part", "problem"),
    [
        (lambda: r.BearingFriction(), "bearing has no friction torque; give `tau_sliding`, or `tau_pos`"),
        (lambda: r.BearingFriction(tau_pos=[(0, 1, 2)]), r"`tau_pos` of bearing is .*; give rows \(speed, value\)"),
        (lambda: r.BearingFriction(tau_pos=[(1, 1), (0, 2)]), "ascending speeds"),
        (lambda: r.BearingFriction(tau_pos="no"), r"give rows \(speed, value\)"),
        (lambda: r.BearingFriction(tau_pos=1, tau_sliding=2), "differs from its `tau_pos`"),
        (lambda: r.BearingFriction(tau_sliding=2, tau_static=1), "exceeds `tau_static`"),
        (lambda: r.Brake(f_normalized=1), "Give one of them"),
        (lambda: r.Brake(f_normalized=1, fn_max=1, tau_max=2), "`tau_max` of bearing is not mu_pos cgeo fn_max"),
        (lambda: r.LossyGear(ratio=1, loss_table=[(0, 1.2, 1, 0, 0)]), "has an efficiency"),
        (lambda: r.LossyGear(ratio=1, loss_table=[(0, 1, 1)]), r"give rows \(speed, 4 values\)"),
    ],
)
def test_wrong_input_is_named(part, problem):
    class Wrong(SpinDown):
        bearing = part()

    with pytest.raises(AcausalError, match=problem):
        ac.compile(Wrong())
