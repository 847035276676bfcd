"""Ideal gears and prescribed speeds, in the open and in loops."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Component, Model, Scalar, chain, connect, fixed, guess, parameter, port, structural
from components import BodyRod, Fixed, Flange, Revolute, World, rotational
from tests.acausal.solve.initialization.test_ideal import G


class Gear(Component):
    """Ideal gear without losses, whose housing stands still."""

    ends = ("flange_a", "flange_b")
    ratio: Scalar = parameter("flange_a.phi / flange_b.phi", unit="1")
    offset: Scalar = parameter("angle of flange_b where flange_a is at 0", unit="rad", default=0)
    flange_a: Flange = port(Flange, "first shaft end")
    flange_b: Flange = port(Flange, "second shaft end")

    def equations(self):
        yield self.flange_a.phi == self.ratio * (self.flange_b.phi - self.offset)
        yield self.ratio * self.flange_a.tau + self.flange_b.tau == 0


class TripleGear(Gear):
    """The same with a ratio that is a number."""

    ratio: Scalar = parameter("flange_a.phi / flange_b.phi", unit="1", default=3)

    def equations(self):
        yield self.flange_a.phi == 3 * self.flange_b.phi
        yield 3 * self.flange_a.tau + self.flange_b.tau == 0


class Geared(Model):
    """A rotor that drives another one, on a spring, through a gear."""

    a, b = rotational.Inertia(J=1, phi=fixed(0), w=fixed(1)), rotational.Inertia(J=2)
    spring, ground = rotational.Spring(c=3), rotational.Fixed()

    @ac.part
    def gear(self):
        """From a to b, 3 to 1."""
        return Gear(ratio=3)

    def connections(self):
        yield chain(self.a, self.gear, self.b, self.spring, self.ground)


class GearedByNumbers(Geared):
    gear = TripleGear()


class GearedSpeed(Geared):
    gear = TripleGear()
    a = rotational.Speed(w_ref=3, phi=fixed(0))

    def connections(self):
        yield connect(self.a.flange, self.gear.flange_a)
        yield chain(self.gear, self.b, self.spring, self.ground)


@pytest.mark.parametrize("model", [Geared, GearedByNumbers])
def test_gears_between_rotors(model: type[Model]) -> None:
    """J_a 9 + J_b turns with b on the spring, which starts at 1/3 rad/s."""
    result = ac.simulate(model(), stop_time=5, tolerance=1e-9)
    rate = np.sqrt(3 / (9 + 2))
    assert np.allclose(result["b.phi"], np.sin(rate * result.time) / rate / 3, atol=1e-6)
    assert np.allclose(result["a.phi"], 3 * result["b.phi"], atol=1e-9)


@pytest.mark.parametrize("speed", [2, 3.5])
def test_a_constant_speed(speed: float) -> None:
    class Turned(Model):
        drive, load = rotational.Speed(w_ref=speed, phi=fixed(0.5)), rotational.Inertia(J=1)

        def connections(self):
            yield connect(self.drive.flange, self.load.flange_a)

    result = ac.simulate(Turned(), stop_time=2)
    assert np.allclose(result["load.phi"], 0.5 + speed * result.time)
    assert np.allclose(result["load.w"], speed)
    assert np.allclose(result["load.a"], 0)
    assert np.allclose(result["drive.flange.tau"], 0)


def test_a_constant_speed_through_a_gear_of_numbers() -> None:
    result = ac.simulate(GearedSpeed(), stop_time=2)
    assert np.allclose(result["b.phi"], result.time)
    assert np.allclose(result["a.flange.tau"], -result.time, atol=1e-8)


def test_two_speeds_on_one_shaft_contradict() -> None:
    class Torn(Model):
        a, b, load = rotational.Speed(w_ref=2), rotational.Speed(w_ref=3), rotational.Inertia(J=1)

        def connections(self):
            yield connect(self.a.flange, self.b.flange, self.load.flange_a)

    with pytest.raises(ac.AcausalError):
        ac.compile(Torn())


class Rods(Model):
    """Parallelogram of uniform rods, 1 kg for each metre: (2/3 + 2) th'' = -3 g cos th + torque of the crank's drive."""

    driven: bool = structural("whether the drive gives the speed", default=False)
    world, far = World(g=G), Fixed(r=(2, 0, 0))
    crank, rocker, coupler = BodyRod(r=(1, 0, 0), m=1), BodyRod(r=(1, 0, 0), m=1), BodyRod(r=(2, 0, 0), m=2)
    pin1, pin2, foot2 = Revolute(phi=guess(-0.7)), Revolute(), Revolute(phi=guess(0.7))

    @ac.part
    def foot1(self):
        """Bearing of the crank."""
        speed = {} if self.driven else {"w": fixed(1)}
        return Revolute(phi=fixed(0.7), use_axis_flange=True, **speed)

    def connections(self):
        yield chain(self.world, self.foot1, self.crank, self.pin1, self.coupler, self.pin2, self.rocker.frame_b)
        yield chain(self.far, self.foot2, self.rocker)


class GearedLoop(Rods):
    """A rotor on the crank's axis; `ratio` is that of the crank over the rotor."""

    gear, rotor = Gear(ratio=2), rotational.Inertia(J=1)

    def connections(self):
        yield from super().connections()
        yield chain(self.foot1.axis, self.gear, self.rotor)


class TurnedGear(GearedLoop):
    gear = Gear(ratio=0.5)

    def connections(self):
        yield from Rods.connections(self)
        yield chain(self.foot1.axis, self.gear.flange_b)
        yield chain(self.gear.flange_a, self.rotor)


class GearByNumbers(GearedLoop):
    gear = TripleGear()


class DirectRotor(Rods):
    rotor = rotational.Inertia(J=1)

    def connections(self):
        yield from super().connections()
        yield chain(self.foot1.axis, self.rotor)


@pytest.mark.parametrize(("model", "ratio"), [(GearedLoop, 2), (TurnedGear, 2), (GearByNumbers, 3), (DirectRotor, 1)])
def test_a_rotor_on_a_joint_of_a_loop(model: type[Model], ratio: float) -> None:
    result = ac.simulate(model(), stop_time=0.6, tolerance=1e-9)
    inertia = 2 / 3 + 2 + 1 / ratio**2
    found = solve_ivp(
        lambda _, y: [y[1], -3 * G * np.cos(y[0]) / inertia],
        (0, 0.6),
        [0.7, 1],
        "DOP853",
        result.time,
        rtol=1e-12,
        atol=1e-12,
    )
    assert np.allclose(result["foot1.phi"], found.y[0], atol=1e-5)
    assert np.allclose(result["rotor.w"], result["foot1.w"] / ratio, atol=1e-9)


class SpeedInLoop(Rods):
    driven = structural("whether the drive gives the speed", default=True)
    gear, drive = Gear(ratio=2), rotational.Speed(w_ref=0.5)

    def connections(self):
        yield from super().connections()
        yield connect(self.foot1.axis, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.drive.flange)


class DirectSpeed(Rods):
    driven = structural("whether the drive gives the speed", default=True)
    drive = rotational.Speed(w_ref=1)

    def connections(self):
        yield from super().connections()
        yield connect(self.foot1.axis, self.drive.flange)


class VaryingSpeed(SpeedInLoop):
    drive = rotational.Speed(w_ref=0.5 * ac.cos(ac.time))


@pytest.mark.parametrize("model", [SpeedInLoop, DirectSpeed, VaryingSpeed])
def test_a_speed_in_a_loop(model: type[Model]) -> None:
    """Torque of the drive from the equation of motion."""
    result = ac.simulate(model(), stop_time=1, tolerance=1e-8)
    t = result.time
    angle, rate = (0.7 + np.sin(t), -np.sin(t)) if model is VaryingSpeed else (0.7 + t, 0 * t)
    assert np.allclose(result["foot1.phi"], angle, atol=1e-6)
    torque = (2 / 3 + 2) * rate + 3 * G * np.cos(angle)
    assert np.allclose(result["foot1.tau"], torque, atol=1e-4)


class FiveBar(Model):
    """Both cranks of a five-bar geared together: one freedom; symmetric, the top moves along a vertical line."""

    world, far = World(g=G), Fixed(r=(2, 0, 0))
    crank, rocker = BodyRod(r=(0.5, 0, 0), m=1), BodyRod(r=(0.5, 0, 0), m=1)
    left, right = BodyRod(r=(1.5, 0, 0), m=1), BodyRod(r=(1.5, 0, 0), m=1)
    foot1 = Revolute(phi=fixed(1.2), w=fixed(1), use_axis_flange=True)
    foot2 = Revolute(phi=guess(np.pi - 1.2), use_axis_flange=True)
    pin1, pin2, top = Revolute(phi=guess(-0.6)), Revolute(phi=guess(0.6)), Revolute(phi=guess(1.5))
    gear = Gear(ratio=-1, offset=np.pi)

    def connections(self):
        yield chain(self.world, self.foot1, self.crank, self.pin1, self.left, self.top, self.right.frame_b)
        yield chain(self.far, self.foot2, self.rocker, self.pin2, self.right)
        yield chain(self.foot1.axis, self.gear, self.foot2.axis)


def test_a_geared_five_bar() -> None:
    result = ac.simulate(FiveBar(), stop_time=1, tolerance=1e-9, energy=True)
    assert abs(result.stats["energy_method"]) < 1e-4
    assert np.allclose(result["left.frame_b.r_0"][:, 0], 1, atol=1e-7)
    assert np.allclose(result["foot2.phi"], np.pi - result["foot1.phi"], atol=1e-8)
