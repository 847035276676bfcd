"""Vehicles and eddy current brakes of Modelica.Mechanics and ModelicaTest.Translational."""

from __future__ import annotations

from math import atan, sin

import numpy as np
from scipy.integrate import cumulative_trapezoid

from acausal import Model, chain, connect, fixed, ramp, sine, time_table
from components import rotational
from components.thermal import HeatCapacitor
from components.translational import EddyCurrentForce, Mass, MultiSensor, Vehicle
from tests.reference.msl.published import compare

ROTATIONAL = "Modelica.Mechanics.Rotational.Examples."
TRANSLATIONAL = "Modelica.Mechanics.Translational.Examples."
COPPER = 3.920e-3
BRAKING = {"alpha20": COPPER, "excitation": ramp(height=1, duration=0.1, start_time=0.1), "use_heat_port": True}


class ShaftBrake(Model):
    eddyCurrentTorque = rotational.EddyCurrentTorque(tau_nominal=100, w_nominal=10, **BRAKING)
    inertia, heatCapacitor = rotational.Inertia(J=1, phi=fixed(0), w=fixed(20)), HeatCapacitor(C=1, T=fixed(293.15))

    def connections(self):
        yield connect(self.eddyCurrentTorque.flange, self.inertia.flange_a)
        yield connect(self.eddyCurrentTorque.heat_port, self.heatCapacitor.port)


def test_rotational_eddy_current_brake():
    names = {"eddyCurrentTorque.lossPower": "eddyCurrentTorque.loss_power"}
    compare(ROTATIONAL + "EddyCurrentBrake", ShaftBrake(), names)


class RodBrake(Model):
    eddyCurrentForce = EddyCurrentForce(f_nominal=100, v_nominal=10, **BRAKING)
    mass, heatCapacitor = Mass(m=1, s=fixed(0), v=fixed(20)), HeatCapacitor(C=1, T=fixed(293.15))

    def connections(self):
        yield connect(self.eddyCurrentForce.flange, self.mass.flange_a)
        yield connect(self.eddyCurrentForce.heat_port, self.heatCapacitor.port)


def test_translational_eddy_current_brake():
    names = {"eddyCurrentForce.lossPower": "eddyCurrentForce.loss_power"}
    compare(TRANSLATIONAL + "EddyCurrentBrake", RodBrake(), names)


TORQUE = [
    (0, 0),
    (5, 0),
    (5, 5.6),
    (10.8, 5.6),
    (10.8, 1),
    (20, 1),
    (20, 2.8),
    (25, 2.8),
    (25, 1),
    (50, 1),
    (50, -5),
    (55, -5),
]
TORQUE += [(55, 0), (60, 0)]
SLOPE = time_table([(0, 0), (20, 0), (20, 0.05), (25, 0.05), (25, 0), (60, 0)])
NOMINAL = (0.5 * 1 * 1.18 * (25 / 3.5) ** 2 / 2 + 0.01 * 100 * 9.80665) * 0.25


def bicycle(**start):
    return Vehicle(m=100, J=0, R=0.25, A=1, Cd=0.5, cr_constant=0.01, inclination=SLOPE, **start)


class Vehicles(Model):
    """One vehicle, and one with a trailer and twice the torque."""

    torque = rotational.Torque(tau=time_table([(t, NOMINAL * y) for t, y in TORQUE]))
    torque1 = rotational.Torque(tau=time_table([(t, 2 * NOMINAL * y) for t, y in TORQUE]))
    vehicle, vehicle1, trailer = bicycle(s=fixed(0), v=fixed(0)), bicycle(s=fixed(0), v=fixed(0)), bicycle()
    multiSensor = MultiSensor()

    def connections(self):
        yield connect(self.torque.flange, self.vehicle.flange_r)
        yield connect(self.torque1.flange, self.vehicle1.flange_r)
        yield chain(self.vehicle1.flange_t, self.multiSensor, self.trailer.flange_t)


def test_vehicle():
    compare(TRANSLATIONAL + "Vehicle", Vehicles())


def car(**resistance):
    given = {"A": 0, "cr_constant": 0, **resistance}
    return Vehicle(m=1200, J=2.3, R=0.31, Cd=0.31, s=fixed(0), v=fixed(27.777777777778), **given)


class Cars(Model):
    vehicleDrag, vehicleDragInConst = car(A=2.2, v_wind_constant=-2), car(A=2.2, v_wind=-2.0)
    vehicleDragInVar = car(A=2.2, v_wind=sine(amplitude=1, f=1, offset=-2))
    vehicleRoll, vehicleRollInConst = car(cr_constant=0.013), car(cr=0.013)
    vehicleRollInVar = car(cr=sine(amplitude=0.013, f=0.5, offset=0.013))
    vehicleInclination, vehicleInclinationInConst = car(inclination_constant=0.05), car(inclination=0.05)
    vehicleInclinationInVar = car(inclination=sine(amplitude=-0.05, f=1, offset=0.05))


def test_vehicles():
    """The drive train turns as the wheels do; the way of the wind is the integral of its speed."""
    names = {}
    for kind in ("Drag", "Roll", "Inclination"):
        for how in ("", "InConst", "InVar"):
            car = f"vehicle{kind}{how}"
            names |= {
                f"{car}.inertia.phi": lambda r, c=car: r[f"{c}.s"] / 0.31,
                f"{car}.inertia.w": lambda r, c=car: r[f"{c}.v"] / 0.31,
                f"{car}.windSpeed.v": lambda r, c=car: r[f"{c}.v_wind"],
                f"{car}.windSpeed.s": lambda r, c=car: cumulative_trapezoid(r[f"{c}.v_wind"], r.time, initial=0),
            }
    filtered = (
        "vehicleDragInVar.windSpeed.v",
        "vehicleDragInVar.windSpeed.s",
    )  # there the wind passes a filter of 50 Hz
    result = compare("ModelicaTest.Translational.Vehicles", Cars(), names, left_out=filtered)
    alpha = atan(0.05)
    decelerating = 9.80665 * sin(alpha) / (1 + 2.3 / 0.31**2 / 1200)
    np.testing.assert_allclose(result["vehicleInclination.a"], -decelerating, rtol=1e-9)
