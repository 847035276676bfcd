"""Assemblies of vehicles, in axes x forward, y up, z to the right, and a car that is made of them."""

from models.vehicle.arm import Arm
from models.vehicle.axle import Axle
from models.vehicle.ball_joint import BallJoint
from models.vehicle.car import Car
from models.vehicle.corner import Corner
from models.vehicle.double_wishbone import DoubleWishbone
from models.vehicle.upright import Upright
from models.vehicle.wheel import Wheel

__all__ = ["Arm", "Axle", "BallJoint", "Car", "Corner", "DoubleWishbone", "Upright", "Wheel"]
