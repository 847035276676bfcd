"""Sensors of frames; unread outputs cost nothing. The functions compute the same in methods marked `@observed`."""

from components.sensors.absolute_angles import AbsoluteAngles
from components.sensors.absolute_angular_velocity import AbsoluteAngularVelocity, absolute_angular_velocity
from components.sensors.absolute_position import AbsolutePosition, absolute_position
from components.sensors.absolute_sensor import AbsoluteSensor
from components.sensors.absolute_velocity import AbsoluteVelocity, absolute_velocity
from components.sensors.angles import HasAngles, axes_angles
from components.sensors.cut_force import CutForce
from components.sensors.cut_force_and_torque import CutForceAndTorque
from components.sensors.cut_sensor import CutSensor
from components.sensors.cut_torque import CutTorque
from components.sensors.distance import Distance, distance
from components.sensors.one_frame_sensor import OneFrameSensor
from components.sensors.power import Power, frame_power
from components.sensors.relative_angles import RelativeAngles
from components.sensors.relative_angular_velocity import RelativeAngularVelocity, relative_angular_velocity
from components.sensors.relative_position import RelativePosition, relative_position
from components.sensors.relative_sensor import RelativeSensor
from components.sensors.relative_velocity import RelativeVelocity, relative_velocity
from components.sensors.two_frame_sensor import TwoFrameSensor

__all__ = [
    "AbsoluteAngles",
    "AbsoluteAngularVelocity",
    "AbsolutePosition",
    "AbsoluteSensor",
    "AbsoluteVelocity",
    "CutForce",
    "CutForceAndTorque",
    "CutSensor",
    "CutTorque",
    "Distance",
    "HasAngles",
    "OneFrameSensor",
    "Power",
    "RelativeAngles",
    "RelativeAngularVelocity",
    "RelativePosition",
    "RelativeSensor",
    "RelativeVelocity",
    "TwoFrameSensor",
    "absolute_angular_velocity",
    "absolute_position",
    "absolute_velocity",
    "axes_angles",
    "distance",
    "frame_power",
    "relative_angular_velocity",
    "relative_position",
    "relative_velocity",
]
