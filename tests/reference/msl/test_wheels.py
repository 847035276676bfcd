"""Rolling wheel sets of Modelica.Mechanics.MultiBody.Examples.Elementary."""

from __future__ import annotations

from math import pi

import numpy as np

from acausal import Model, chain, connect, fixed, sine, time_table
from components import Body, FixedTranslation, RollingWheelSet, World, WorldForce
from components.rotational import Torque2
from tests.reference.msl.published import compare

EXAMPLES = "Modelica.Mechanics.MultiBody.Examples.Elementary."


class Set(Model):
    """Two wheels, and a body ahead of the axle."""

    world = World(n=(0, 0, -1))
    wheelSet = RollingWheelSet(
        R_wheel=0.1, m_wheel=0.5, I_wheel_axis=0.01, I_wheel_long=0.02, track=0.5, x=fixed(0.1), y=fixed(0.1)
    )
    fixedTranslation, body = FixedTranslation(r=(0.2, 0, 0)), Body(m=0.01, I=0.001 * np.eye(3))

    def connections(self):
        yield chain(self.wheelSet.frame_middle, self.fixedTranslation, self.body)
        yield from self.load()


class Driving(Set):
    torque1, torque2 = Torque2(tau=sine(amplitude=2, f=1)), Torque2(tau=sine(amplitude=2, f=1, phase=pi / 2))

    def load(self):
        yield connect(self.wheelSet.axis1, self.torque1.flange_a)
        yield connect(self.torque1.flange_b, self.wheelSet.support)
        yield connect(self.wheelSet.axis2, self.torque2.flange_a)
        yield connect(self.wheelSet.support, self.torque2.flange_b)


def test_driving():
    compare(EXAMPLES + "RollingWheelSetDriving", Driving())


class Pulling(Set):
    force = WorldForce(
        force=(time_table([(0, 1), (1, 1), (2, 0), (3, 0)]), time_table([(0, 0), (1, 0), (2, 2), (3, 2)]), 0)
    )

    def load(self):
        yield connect(self.force.frame_b, self.fixedTranslation.frame_b)


def test_pulling():
    compare(EXAMPLES + "RollingWheelSetPulling", Pulling())
