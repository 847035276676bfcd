"""One-dimensional translation: masses, springs, dampers, drives and sensors."""

from components.translational.absolute_sensor import AbsoluteSensor
from components.translational.acc_sensor import AccSensor
from components.translational.accelerate import Accelerate
from components.translational.brake import Brake
from components.translational.compliant import Compliant
from components.translational.constant_force import ConstantForce
from components.translational.constant_speed import ConstantSpeed
from components.translational.cut_sensor import CutSensor
from components.translational.damper import Damper
from components.translational.eddy_current_force import EddyCurrentForce
from components.translational.elasto_gap import ElastoGap
from components.translational.fixed import Fixed
from components.translational.flange import TranslationalFlange, TwoFlanges
from components.translational.force import Force
from components.translational.force2 import Force2
from components.translational.force_sensor import ForceSensor
from components.translational.force_step import ForceStep
from components.translational.general_force_to_position_adaptor import GeneralForceToPositionAdaptor
from components.translational.general_position_to_force_adaptor import GeneralPositionToForceAdaptor
from components.translational.ideal_gear_r2t import IdealGearR2T
from components.translational.ideal_rolling_wheel import IdealRollingWheel
from components.translational.initialize_flange import InitializeFlange
from components.translational.inverse_speed_dependent_force import InverseSpeedDependentForce
from components.translational.linear_speed_dependent_force import LinearSpeedDependentForce
from components.translational.loading_force import LoadingForce
from components.translational.mass import Mass
from components.translational.mass_with_stop_and_friction import MassWithStopAndFriction
from components.translational.move import Move
from components.translational.multi_sensor import MultiSensor
from components.translational.one_flange import OneFlange
from components.translational.position import Position
from components.translational.position_sensor import PositionSensor
from components.translational.power_sensor import PowerSensor
from components.translational.quadratic_speed_dependent_force import QuadraticSpeedDependentForce
from components.translational.rel_acc_sensor import RelAccSensor
from components.translational.rel_position_sensor import RelPositionSensor
from components.translational.rel_speed_sensor import RelSpeedSensor
from components.translational.relative_sensor import RelativeSensor
from components.translational.relative_states import RelativeStates
from components.translational.rigid import Rigid
from components.translational.rod import Rod
from components.translational.rod_friction import RodFriction
from components.translational.rolling_resistance import RollingResistance
from components.translational.rotational_to_translational import RotationalToTranslational
from components.translational.sign_force import SignForce
from components.translational.speed import Speed
from components.translational.speed_sensor import SpeedSensor
from components.translational.spring import Spring
from components.translational.spring_damper import SpringDamper
from components.translational.support_friction import SupportFriction
from components.translational.vehicle import Vehicle

__all__ = [
    "AbsoluteSensor",
    "AccSensor",
    "Accelerate",
    "Brake",
    "Compliant",
    "ConstantForce",
    "ConstantSpeed",
    "CutSensor",
    "Damper",
    "EddyCurrentForce",
    "ElastoGap",
    "Fixed",
    "Force",
    "Force2",
    "ForceSensor",
    "ForceStep",
    "GeneralForceToPositionAdaptor",
    "GeneralPositionToForceAdaptor",
    "IdealGearR2T",
    "IdealRollingWheel",
    "InitializeFlange",
    "InverseSpeedDependentForce",
    "LinearSpeedDependentForce",
    "LoadingForce",
    "Mass",
    "MassWithStopAndFriction",
    "Move",
    "MultiSensor",
    "OneFlange",
    "Position",
    "PositionSensor",
    "PowerSensor",
    "QuadraticSpeedDependentForce",
    "RelAccSensor",
    "RelPositionSensor",
    "RelSpeedSensor",
    "RelativeSensor",
    "RelativeStates",
    "Rigid",
    "Rod",
    "RodFriction",
    "RollingResistance",
    "RotationalToTranslational",
    "SignForce",
    "Speed",
    "SpeedSensor",
    "Spring",
    "SpringDamper",
    "SupportFriction",
    "TranslationalFlange",
    "TwoFlanges",
    "Vehicle",
]
