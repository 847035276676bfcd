"""Machines find where they rest on contacts, which their laws open and close."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Component,
    Model,
    Scalar,
    as_expr,
    chain,
    connect,
    der,
    discrete,
    guess,
    parameter,
    piecewise,
    port,
    quantity,
    reinit,
    time,
    variable,
    when,
)
from components import Body, BodyRod, FixedTranslation, Frame, Prismatic, Revolute, World, resolve2, rotational

WHEEL, CAR, STIFFNESS, G = 30.0, 350.0, 2e5, 9.80665
SINKS = (WHEEL + CAR) * G / STIFFNESS


class Contact(Component):
    """A spring that presses, and does not pull; its compression is guessed as 0, where it is open."""

    frame_a = port(Frame, "what touches the ground")
    k: Scalar = parameter("stiffness", unit="N/m", default=STIFFNESS)
    compression: Scalar = variable("compression", unit="m")
    force: Scalar = variable("force", unit="N")

    def equations(self):
        yield self.compression == -self.frame_a.r_0[1]
        yield self.force == piecewise((self.k * self.compression, self.compression > 0), 0)
        yield self.frame_a.f == -resolve2(self.frame_a.R, as_expr((0, self.force, 0)))
        yield self.frame_a.t == (0, 0, 0)


class OnWheel(Model):
    """A car on a slide, and its wheel on a parallelogram that a spring holds."""

    world = World(g=G)
    guide = Prismatic(n=(0, 1, 0), s=guess(-SINKS))
    car, wheel, tyre = Body(m=CAR), Body(m=WHEEL), Contact()
    upper, upright = FixedTranslation(r=(0, 0.25, 0)), FixedTranslation(r=(0, 0.25, 0))
    low = Revolute(phi=guess(0), use_axis_flange=True)
    high, foot, head = Revolute(phi=guess(0)), Revolute(phi=guess(0)), Revolute(phi=guess(0))
    arm, other = FixedTranslation(r=(0.35, 0, 0)), FixedTranslation(r=(0.35, 0, 0))
    spring = rotational.Spring(c=2e4, phi_rel0=-CAR * G * 0.35 / 2e4)

    def connections(self):
        yield chain(self.world, self.guide, self.car)
        yield chain(self.low.support, self.spring, self.low.axis)
        yield chain(self.guide, self.low, self.arm, self.foot, self.upright, self.head.frame_a)
        yield chain(self.guide, self.upper, self.high, self.other, self.head.frame_b)
        yield connect(self.foot.frame_b, self.wheel.frame_a)
        yield connect(self.foot.frame_b, self.tyre.frame_a)


@pytest.mark.parametrize(
    "position",
    [pytest.param(-SINKS, marks=pytest.mark.slow), -0.5 * SINKS, pytest.param(-0.05, marks=pytest.mark.slow)],
)
def test_a_contact_that_the_guess_of_the_position_closes(position):
    result = ac.simulate(OnWheel(guide=Prismatic(n=(0, 1, 0), s=guess(position))), stop_time=0.1, initial="steady")
    np.testing.assert_allclose(result["guide.s"], -SINKS, atol=1e-9)
    np.testing.assert_allclose(result["tyre.force"], (WHEEL + CAR) * G, rtol=1e-7)
    np.testing.assert_allclose(result["low.phi"], 0.0, atol=1e-8)


@pytest.mark.parametrize(
    "position",
    [1e-3, *(pytest.param(position, marks=pytest.mark.slow) for position in (0.0, 0.05, 1.0))],
)
def test_a_contact_that_the_guess_of_the_position_has_open(position):
    result = ac.simulate(OnWheel(guide=Prismatic(n=(0, 1, 0), s=guess(position))), stop_time=0.1, initial="steady")
    np.testing.assert_allclose(result["guide.s"], -SINKS, atol=1e-9)
    np.testing.assert_allclose(result["tyre.force"], (WHEEL + CAR) * G, rtol=1e-7)


class Table(Model):
    """A board that falls on four springs which press alone, two of them shorter."""

    height: Scalar = variable("of its middle", unit="m", start=0.3)
    speed: Scalar = variable("of its middle", unit="m/s")
    tilt: Scalar = variable("angle", unit="rad")
    turning: Scalar = variable("rate of the angle", unit="rad/s")
    feet = ((-1.0, 0.1), (1.0, 0.1), (-0.5, 0.08), (0.5, 0.099))

    def equations(self):
        forces = []
        for x, length in self.feet:
            gap = self.height + quantity(x, "m") * self.tilt - quantity(length, "m")
            forces.append(piecewise((-quantity(1e4, "N/m") * gap, gap < 0), 0))
        damping, inertia = quantity(50.0, "N.s/m"), quantity(10.0, "kg.m2")
        yield der(self.height) == self.speed
        yield der(self.tilt) == self.turning
        yield quantity(10.0, "kg") * der(self.speed) == sum(forces) - damping * self.speed - quantity(10 * G, "N")
        moment = sum(quantity(x, "m") * force for (x, _), force in zip(self.feet, forces, strict=True))
        yield inertia * der(self.turning) == moment - quantity(50.0, "N.m.s") * self.turning


def test_a_board_that_falls_on_several_springs():
    run = ac.simulate(Table(), stop_time=1.0, initial="steady")
    height, tilt = run["height"][0], run["tilt"][0]
    force = [1e4 * max(length - height - x * tilt, 0) for x, length in Table.feet]
    np.testing.assert_allclose(sum(force), 10 * G, rtol=1e-8)
    np.testing.assert_allclose(sum(x * f for (x, _), f in zip(Table.feet, force, strict=True)), 0, atol=1e-6)
    np.testing.assert_allclose(run["height"], height, atol=1e-9)


class Braked(Model):
    """A rod that a brake holds, or does not."""

    world = World(g=G)
    hinge = Revolute(phi=guess(0.3), use_axis_flange=True, d=0.5)
    rod = BodyRod(r=(1, 0, 0), m=2.0)
    brake = rotational.Friction(tau_sliding=1.0, tau_static=20.0)

    def connections(self):
        yield chain(self.world, self.hinge, self.rod)
        yield chain(self.hinge.support, self.brake, self.hinge.axis)


def test_a_brake_rests_where_it_holds_alone():
    compiled = ac.compile(Braked())
    np.testing.assert_allclose(ac.simulate(compiled, stop_time=1.0, initial="steady")["hinge.phi"], 0.3, atol=1e-9)
    for run in (ac.simulate, ac.linearize):
        how = {"stop_time": 1.0} if run is ac.simulate else {}
        with pytest.raises(
            ac.InitializationError, match=r"does not last: this condition is true there(.|\n)*dry_friction\.py"
        ):
            run(compiled, initial="steady", parameters={"brake.tau_static": 2.0}, **how)


class Sampled(Model):
    """What a controller does at the start moves a model from its equilibrium."""

    due: Scalar = discrete("time of the next sample", unit="s")
    held: Scalar = discrete("what was set")
    x: Scalar = variable("state", start=3)

    def equations(self):
        yield when(time >= self.due, reinit(self.due, self.due + 0.1), reinit(self.held, 2.0), at_start=True)
        yield der(self.x) == self.held - self.x


def test_planned_instants_may_move_an_equilibrium_at_once():
    run = ac.simulate(Sampled(), stop_time=1.0, initial="steady", tolerance=1e-9)
    np.testing.assert_allclose(run["x"], 2 - 2 * np.exp(-run.time), atol=1e-7)
