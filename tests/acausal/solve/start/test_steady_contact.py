"""Machines find where they rest on contacts, which their laws open and close."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Model, Scalar, as_expr, chain, connect, guess, parameter, piecewise, port, variable
from components import Body, FixedTranslation, Frame, Prismatic, Revolute, World, resolve2, rotational

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


@pytest.mark.parametrize("position", [-SINKS, -0.5 * SINKS, -0.05])
def test_a_contact_that_the_guess_of_the_position_closes(position):
    result = ac.simulate(OnWheel(guide=Prismatic(n=(0, 1, 0), s=guess(position))), stop_time=0.1, initial="steady")
    np.testing.assert_allclose(result["guide.s"], -SINKS, atol=1e-9)
    np.testing.assert_allclose(result["tyre.force"], (WHEEL + CAR) * G, rtol=1e-7)
    np.testing.assert_allclose(result["low.phi"], 0.0, atol=1e-8)
