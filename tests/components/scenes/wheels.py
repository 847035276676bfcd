"""Rolling wheels, each in a scene."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from acausal import connect, fixed, part
from components import FixedRotation, RollingWheel, RollingWheelJoint, RollingWheelSet, RollingWheelSetJoint, World
from tests.components.scenes.scene import ANGLE, Scene


class OnRoad(Scene):
    """The tip is a wheel or the body of an axle; the scene is turned about z and shifted along the road."""

    world = World(n=(0, 0, -1))
    it: Any

    @property
    def turn(self) -> Rotation:
        return Rotation.from_euler("z", ANGLE * self.moved)

    @part
    def place(self):
        return FixedRotation(r=tuple(self.moved * np.array([1.0, 2.0, 0.0])), n=(0, 0, 1), angle=ANGLE * self.moved)

    def at(self) -> dict[str, Any]:
        """Start of x and y."""
        x, y, _ = self.turn.apply([0.2, 0.1, 0.0]) + self.moved * np.array([1.0, 2.0, 0.0])
        return {"x": fixed(x), "y": fixed(y)}

    def graph(self):
        yield connect(getattr(self.it, self.it.ends[0]), self.tip.frame_a)


class OnRollingWheelJoint(OnRoad):
    """The tip rolls, though its mass centre is not on the axis."""

    @part
    def it(self):
        start = {"angles": fixed((0.3 + ANGLE * self.moved, 0.0, 0.2)), "der_angles": fixed((0.5, 5.0, 0.4))}
        return RollingWheelJoint(radius=0.3, **start, **self.at())


class OnRollingWheel(OnRoad):
    @part
    def it(self):
        start = {"angles": fixed((0.3 + ANGLE * self.moved, 0.0, 0.2)), "der_angles": fixed((0.5, 5.0, 0.4))}
        return RollingWheel(radius=0.3, m=1, I_axis=0.06, I_long=0.04, **start, **self.at())


class OnRollingWheelSetJoint(OnRoad):
    """The tip runs ahead of the axle, and turns it."""

    @part
    def it(self):
        start = {"theta1": fixed(0.2), "theta2": fixed(0.1), "der_theta1": fixed(20.0), "der_theta2": fixed(30.0)}
        return RollingWheelSetJoint(radius=0.1, track=0.3, phi=fixed(0.3 + ANGLE * self.moved), **start, **self.at())


class OnRollingWheelSet(OnRoad):
    @part
    def it(self):
        wheel = {"R_wheel": 0.1, "m_wheel": 0.5, "I_wheel_axis": 0.01, "I_wheel_long": 0.005, "track": 0.3}
        start = {"der_theta1": fixed(20.0), "der_theta2": fixed(30.0)}
        return RollingWheelSet(**wheel, phi=fixed(0.3 + ANGLE * self.moved), **start, **self.at())
