"""Connections of outputs to inputs, and inputs with defaults."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Component,
    ConnectError,
    Model,
    Scalar,
    connect,
    der,
    fixed,
    input,
    output,
    parameter,
    sin,
    time,
    variable,
)
from components.rotational import Inertia, SpeedSensor, Torque


class Controller(Component):
    k: Scalar = parameter("gain", unit="N.m.s/rad", default=2.0)
    w: Scalar = input("speed", unit="rad/s")
    w_ref: Scalar = input("wanted speed", unit="rad/s", default=1.0)
    tau: Scalar = output("torque", unit="N.m")

    def equations(self):
        yield self.tau == self.k * (self.w_ref - self.w)


class Drive(Model):
    """A speed control of parts, with ports of signals passed on."""

    w_ref: Scalar = input("wanted speed", unit="rad/s", default=3.0)
    speed: Scalar = output("speed", unit="rad/s")
    controller, motor, sensor = Controller(), Torque(), SpeedSensor()
    rotor = Inertia(J=0.5, phi=fixed(0), w=fixed(0))

    def connections(self):
        yield connect(self.motor.flange, self.rotor.flange_a)
        yield connect(self.rotor.flange_b, self.sensor.flange)
        yield connect(self.controller.tau, self.motor.tau)
        yield connect(self.controller.w, self.sensor.w)  # in either order
        yield connect(self.w_ref, self.controller.w_ref)
        yield connect(self.speed, self.sensor.w)


def settles(result, path, w_ref):
    np.testing.assert_allclose(result[path], w_ref * (1 - np.exp(-4 * result.time)), atol=1e-5)


def test_outputs_are_connected_to_inputs():
    settles(ac.simulate(Drive(), stop_time=2), "speed", 3.0)
    settles(ac.simulate(Drive(), stop_time=2, parameters={"w_ref": 5.0}), "speed", 5.0)


class Two(Model):
    """Assemblies in an assembly: one takes its default, one an output of another, one an expression."""

    first, second, third = Drive(), Drive(), Drive(w_ref=2 * sin(time) ** 2)
    fourth = Drive()

    def connections(self):
        yield connect(self.first.speed, self.second.w_ref)

    def equations(self):
        yield self.fourth.w_ref == 4.0


def test_defaults_hold_where_nothing_gives_a_value():
    result = ac.simulate(Two(), stop_time=2, tolerance=1e-9)
    settles(result, "first.speed", 3.0)
    settles(result, "fourth.speed", 4.0)
    t = result.time
    np.testing.assert_allclose(result["second.speed"], 3 * (1 - (1 + 4 * t) * np.exp(-4 * t)), atol=1e-6)
    np.testing.assert_allclose(result["third.w_ref"], 2 * np.sin(t) ** 2, atol=1e-12)


class Left(Drive):
    """Only the default of the controller is left."""

    def connections(self):
        yield connect(self.motor.flange, self.rotor.flange_a)
        yield connect(self.rotor.flange_b, self.sensor.flange)
        yield connect(self.controller.tau, self.motor.tau)
        yield connect(self.sensor.w, self.controller.w)
        yield connect(self.sensor.w, self.speed)


def test_a_default_of_a_part():
    settles(ac.simulate(Left(), stop_time=2), "speed", 1.0)


class Twice(Drive):
    other = Controller()

    def connections(self):
        yield from super().connections()
        yield connect(self.other.tau, self.motor.tau)
        yield connect(self.sensor.w, self.other.w)


class Given(Drive):
    motor = Torque(tau=2.0)


class Inputs(Drive):
    def connections(self):
        yield connect(self.controller.w, self.motor.tau)


class Outputs(Drive):
    def connections(self):
        yield connect(self.controller.tau, self.sensor.w)


@pytest.mark.parametrize(
    ("model", "message"),
    [
        (Twice, "`motor.tau` takes one value, but it has two, other.tau and controller.tau"),
        (Given, "`motor.tau` takes one value, but it has two, controller.tau and the value that motor is created with"),
        (Inputs, "both take a value; connect an output to an input"),
        (Outputs, "both give a value; connect an output to an input"),
    ],
)
def test_wrong_connections_of_signals(model, message):
    with pytest.raises(ConnectError, match=message) as error:
        ac.compile(model())
    assert "test_signal_connections.py:" in str(error.value)


class Units(Drive):
    def connections(self):
        yield connect(self.sensor.w, self.motor.tau)


def test_units_of_connected_signals():
    with pytest.raises(ac.UnitsError, match="differ"):
        ac.compile(Units())


class Filter(Component):
    u: Scalar = input("signal", unit="1")
    y: Scalar = output("filtered signal", unit="1")

    def equations(self):
        yield ac.quantity(0.1, "s") * der(self.y) == self.u - self.y

    def initial_equations(self):
        yield self.y == 0


class Chain(Model):
    u: Scalar = input("signal", unit="1", default=2.0)
    x: Scalar = variable("other", unit="1", start=0, fixed=True)
    filters = tuple(Filter() for _ in range(3))
    y: Scalar = output("signal", unit="1")

    def connections(self):
        yield connect(self.u, self.filters[0].u)
        yield connect(self.filters[0].y, self.filters[1].u)
        yield connect(self.filters[1].y, self.filters[2].u)
        yield connect(self.filters[2].y, self.y)

    def equations(self):
        yield der(self.x) == -self.x / ac.quantity(1.0, "s")


def test_lists_of_parts():
    result = ac.simulate(Chain(), stop_time=1, tolerance=1e-9)
    s = result.time / 0.1
    np.testing.assert_allclose(result["y"], 2 * (1 - np.exp(-s) * (1 + s + s**2 / 2)), atol=1e-6)
