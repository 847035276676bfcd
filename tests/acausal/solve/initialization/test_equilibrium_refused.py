"""What cannot rest, or not where it is asked to: refused, and named."""

from __future__ import annotations

import pytest

import acausal as ac
from acausal import Model, Scalar, chain, connect, fixed, parameter
from components import (
    Body,
    FixedTranslation,
    Prismatic,
    Revolute,
    World,
    rotational,
)
from models import FourBar, Squeezer
from tests.acausal.solve.initialization.test_equilibrium import Double, I, started


class Falling(Model):
    world, rail, body = World(g=9.81), Prismatic(n=(0, 1, 0)), Body(m=1)

    def connections(self):
        yield chain(self.world, self.rail, self.body)


class Driven(Model):
    d: Scalar = parameter("damping", unit="N.m.s/rad", default=0.5)
    torque, rotor = rotational.Torque(tau=1), rotational.Inertia(J=1)

    def connections(self):
        yield connect(self.torque.flange, self.rotor.flange_a)


class Braked(Driven):
    """It turns at a constant speed."""

    brake, ground = rotational.Damper(d=0.5), rotational.Fixed()

    def connections(self):
        yield from super().connections()
        yield chain(self.rotor, self.brake, self.ground)


class Turned(Model):
    drive, rotor = rotational.Speed(w_ref=2), rotational.Inertia(J=1)

    def connections(self):
        yield connect(self.drive.flange, self.rotor.flange_a)


class Carried(Model):
    drive, rotor = rotational.Position(phi_ref=0.1 * ac.time), rotational.Inertia(J=1)

    def connections(self):
        yield connect(self.drive.flange, self.rotor.flange_a)


class Drifting(Model):
    """A free body without weight rests anywhere, but not under a force."""

    world, body, push = World(g=9.81), Body(m=1, I=I), FixedTranslation(r=(1, 0, 0))

    def connections(self):
        yield connect(self.body.frame_a, self.push.frame_a)


@pytest.mark.parametrize(("model", "name"), [(Falling, "rail.v"), (Driven, "rotor.w")])
def test_what_cannot_rest_is_refused(model: type[Model], name: str) -> None:
    with pytest.raises(ac.InitializationError, match=rf"these rates remain:(.|\n)*der\({name}"):
        started(model())


@pytest.mark.parametrize(("model", "speed"), [(Braked, 1 / 0.5), (Turned, 2), (Carried, 0.1)])
def test_what_turns_at_a_constant_speed_is_steady(model: type[Model], speed: float) -> None:
    assert started(model())["rotor.w"] == pytest.approx(speed, rel=1e-8)


def test_a_free_fall_is_refused() -> None:
    with pytest.raises(ac.InitializationError, match="these rates remain"):
        started(Drifting())


class Held(Double):
    hinge = Revolute(phi=fixed(0.3))


@pytest.mark.parametrize("model", [Held, FourBar, pytest.param(Squeezer, marks=pytest.mark.slow)])
def test_fixed_values_that_do_not_rest_are_named(model: type[Model]) -> None:
    with pytest.raises(ac.InitializationError, match=r"(?s)violates initial conditions.*phi = .*off by"):
        started(model())
