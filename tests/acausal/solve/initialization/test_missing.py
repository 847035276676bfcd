"""Which part and argument would fix a state that is left open, where the state's name is that of a port."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Connector, Model, Scalar, chain, connect, fixed, guess, parameter
from components import Body, FixedTranslation, World, rotational
from components.flange import TwoFlanges
from components.line_force import LineForce

I3 = 0.1 * np.eye(3)


class Rigid(LineForce):
    L: Scalar = parameter("length", unit="m", default=0.8)

    def law(self):
        yield self.s == self.L


class Hung(Model):
    world, line = World(), Rigid()
    bob = Body(m=2, I=I3, r_0=guess((0.8, 0, 0)), w_a=fixed((0, 0, 0)), angles_fixed=True)

    def connections(self):
        yield chain(self.world, self.line, self.bob)


class Free(Hung):
    bob = Body(m=2, I=I3, r_0=guess((0.8, 0, 0)))


class Aside(Hung):
    """The line ends beside the body."""

    arm = FixedTranslation(r=(0.1, 0, 0))

    def connections(self):
        yield chain(self.world, self.line, self.arm.frame_b)
        yield connect(self.arm.frame_a, self.bob.frame_a)


class Gear(TwoFlanges):
    ratio: Scalar = parameter("ratio", unit="1", default=2.0)

    def equations(self):
        yield self.flange_a.phi == self.ratio * self.flange_b.phi
        yield self.ratio * self.flange_a.tau + self.flange_b.tau == 0


class Geared(Model):
    wall, damper, gear = rotational.Fixed(), rotational.Damper(d=1), Gear()
    wheel = rotational.Inertia(J=1, w=fixed(0))

    def connections(self):
        yield chain(self.wall.flange, self.damper, self.gear, self.wheel)


@pytest.mark.parametrize(
    ("model", "lines"),
    [
        (Hung, ["bob: Body(r_0=fixed(...))", "bob: Body(v_0=fixed(...))"]),
        (Free, [f"bob: Body({text})" for text in ("r_0=fixed(...)", "w_a=fixed(...)", "angles_fixed=True")]),
        (Aside, ["bob: Body(r_0=fixed(...))"]),
        (Geared, ["wheel: Inertia(phi=fixed(...))"]),
    ],
)
def test_the_part_that_takes_the_value_is_named(model, lines):
    with pytest.raises(ac.InitializationError) as caught:
        ac.simulate(model(), stop_time=1)
    text = str(caught.value)
    assert all(f"  {line}\n" in text for line in lines), text
    assert not any(name in text for name in ("Rigid(", "Gear(", "FixedTranslation("))


class Pin(Connector):
    u: Scalar = ac.variable("level")
    i: Scalar = ac.flow("flow")


class Tank(Component):
    pin = ac.port(Pin)

    def equations(self):
        yield ac.der(self.pin.u) == self.pin.i


class Alone(Model):
    tank = Tank()


def test_a_value_that_no_part_takes_is_an_initial_equation():
    with pytest.raises(
        ac.InitializationError, match=r"  Alone\.initial_equations\(\): yield self\.tank\.pin\.u == \.\.\.\n"
    ):
        ac.simulate(Alone(), stop_time=1)

    class Repaired(Alone):
        def initial_equations(self):
            yield self.tank.pin.u == 2

    assert ac.simulate(Repaired(), stop_time=1)["tank.pin.u"][-1] == 2
