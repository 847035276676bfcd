"""Vehicle assemblies with axes x forward, y up, z right, a car built from them, and a gearbox."""

from models.vehicle.arm import Arm
from models.vehicle.axle import Axle
from models.vehicle.car import Car
from models.vehicle.corner import Corner
from models.vehicle.double_wishbone import DoubleWishbone
from models.vehicle.planetary_gearbox import PlanetaryGearbox
from models.vehicle.shifting import Shifting
from models.vehicle.upright import Upright
from models.vehicle.wheel import Wheel

__all__ = [
    "Arm",
    "Axle",
    "Car",
    "Corner",
    "DoubleWishbone",
    "PlanetaryGearbox",
    "Shifting",
    "Upright",
    "Wheel",
]
