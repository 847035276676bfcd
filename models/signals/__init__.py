"""Machines with signals: tables, controllers, circuits and functions in Python."""

from models.signals.crane import Crane
from models.signals.motor_drive import MotorDrive
from models.signals.quarter_car import QuarterCar
from models.signals.rectifier_drive import RectifierDrive
from models.signals.wiper import Wiper

__all__ = ["Crane", "MotorDrive", "QuarterCar", "RectifierDrive", "Wiper"]
