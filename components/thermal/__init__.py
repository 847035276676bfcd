"""Heat transfer for the losses of machines: capacitors, conductors and temperatures."""

from components.thermal.convection import Convection
from components.thermal.fixed_temperature import FixedTemperature
from components.thermal.heat_capacitor import HeatCapacitor
from components.thermal.heat_loss import HeatLoss
from components.thermal.heat_port import HeatPort
from components.thermal.prescribed_temperature import PrescribedTemperature
from components.thermal.thermal_conductor import ThermalConductor

__all__ = [
    "Convection",
    "FixedTemperature",
    "HeatCapacitor",
    "HeatLoss",
    "HeatPort",
    "PrescribedTemperature",
    "ThermalConductor",
]
