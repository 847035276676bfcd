"""Models with inputs as parts of larger models."""
# ruff: noqa: RUF012  (lists of parts in a class body)

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Model, Scalar, connect, cos, fixed, input, output, parameter, sin, time, variable
from components.rotational import Inertia, Position, Torque


class Drive(Model):
    """A wheel of 1 kg m2 under a torque."""

    u: Scalar = input("torque", unit="N.m")
    gain: Scalar = parameter("gain", default=2.0)
    motor = Torque(tau=gain * u)
    wheel = Inertia(J=1, phi=fixed(0), w=fixed(0))
    speed: Scalar = output("speed of the wheel", unit="rad/s")

    def connections(self):
        yield connect(self.motor.flange, self.wheel.flange_a)

    def equations(self):
        yield self.speed == self.wheel.w


class Cell(Component):
    """Passes its input on to a drive."""

    u: Scalar = input("torque", unit="N.m")
    drive = Drive(u=1.5 * u + 1)


class Line(Model):
    """A law of the parent, a constant, a function of time, and a value by an equation."""

    law: Scalar = variable("a torque", unit="N.m")
    c: Scalar = parameter("torque over speed", unit="N.m.s/rad", default=1.0)
    cell = [Cell(u=law), Cell(u=3.0), Cell(u=sin(time)), Cell()]

    def equations(self):
        yield self.law == cos(time)
        yield self.cell[3].u == self.c * self.cell[0].drive.speed


def last(model: Model, name: str, **given: object) -> float:
    return ac.simulate(model, stop_time=1, tolerance=1e-9, **given)[name][-1]  # type: ignore[arg-type]


def test_inputs_are_passed_on_through_two_levels() -> None:
    result = ac.simulate(Line(), stop_time=1, tolerance=1e-9)
    speeds = [result[f"cell[{k}].drive.wheel.w"][-1] for k in range(4)]
    fall = 1 - np.cos(1)
    right = [3 * np.sin(1) + 2, 11, 3 * fall + 2, 9 * fall + 3 + 2]  # integrals of 2 (1.5 u + 1)
    np.testing.assert_allclose(speeds, right, atol=1e-7)


class Follower(Model):
    """A part whose input depends on its own motion through a variable of the parent."""

    error: Scalar = variable("lag of the wheel", unit="N.m")
    drive = Drive(u=-4 * error)

    def equations(self):
        yield self.error == (self.drive.wheel.phi - 1) * 1


def test_an_input_closes_a_feedback_loop() -> None:
    assert last(Follower(), "drive.wheel.phi") == pytest.approx(1 - np.cos(np.sqrt(8)), abs=1e-7)


class Top(Model):
    u: Scalar = input("torque", unit="N.m")
    cell = Cell(u=u)


@pytest.mark.parametrize(("model", "given"), [(Top(u=2.0), {}), (Top(), {"parameters": {"u": 2.0}})])
def test_an_input_of_the_model_is_passed_on(model: Model, given: dict[str, object]) -> None:
    assert last(model, "cell.drive.wheel.w", **given) == pytest.approx(8, abs=1e-7)


class Doubled(Torque):
    """A drive whose class gives an inherited input in terms of its own."""

    level: Scalar = input("half of the torque", unit="N.m")
    tau = 2 * level


class Inherited(Model):
    motor, wheel = Doubled(level=sin(time)), Inertia(J=1, phi=fixed(0), w=fixed(0))

    def connections(self):
        yield connect(self.motor.flange, self.wheel.flange_a)


def test_a_class_gives_an_inherited_input_in_terms_of_its_own() -> None:
    assert last(Inherited(), "wheel.w") == pytest.approx(2 * (1 - np.cos(1)), abs=1e-8)


class Turned(Component):
    angle: Scalar = input("angle", unit="rad")
    motor, wheel = Position(phi_ref=angle), Inertia(J=1)

    def connections(self):
        yield connect(self.motor.flange, self.wheel.flange_a)


class Prescribed(Model):
    part = Turned(angle=sin(time))


class PrescribedFromOutside(Model):
    a: Scalar = input("angle", unit="rad")
    part = Turned(angle=a)


def test_an_input_with_a_law_has_derivatives() -> None:
    assert last(Prescribed(), "part.wheel.w") == pytest.approx(np.cos(1), abs=1e-9)
    assert last(Prescribed(), "part.motor.flange.tau") == pytest.approx(np.sin(1), abs=1e-9)


def test_an_input_of_the_model_that_is_passed_on_has_none() -> None:
    with pytest.raises(ac.DeclarationError, match="prescribes a motion by the input `a`"):
        ac.compile(PrescribedFromOutside())


class Crossed(Model):
    angle: Scalar = variable("angle", unit="m")
    drive = Drive(u=angle)

    def equations(self):
        yield self.angle == 2 * time


def test_the_unit_of_a_value_is_checked_where_the_part_is_given_it() -> None:
    with pytest.raises(ac.UnitsError, match=r"drive \(Drive\), .*u=\.\.\.: units differ: drive.u is in \[N.m\]"):
        ac.compile(Crossed())


class Forgotten(Model):
    drive = Drive()


def test_an_input_without_a_value_is_named() -> None:
    with pytest.raises(ac.UnbalancedModelError, match=r"Inputs that need a value or an equation: `drive\.u`"):
        ac.compile(Forgotten())
