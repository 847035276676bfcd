"""One-dimensional rotation: inertias, torsional springs, dampers, gears, drives and sensors."""

from components.flange import Flange, TwoFlanges
from components.rotational.absolute_sensor import AbsoluteSensor
from components.rotational.acc_sensor import AccSensor
from components.rotational.accelerate import Accelerate
from components.rotational.angle_sensor import AngleSensor
from components.rotational.angle_to_torque_adaptor import AngleToTorqueAdaptor
from components.rotational.bearing_friction import BearingFriction
from components.rotational.brake import Brake
from components.rotational.clutch import Clutch
from components.rotational.compliant import Compliant
from components.rotational.constant_speed import ConstantSpeed
from components.rotational.constant_torque import ConstantTorque
from components.rotational.cut_sensor import CutSensor
from components.rotational.damper import Damper
from components.rotational.disc import Disc
from components.rotational.eddy_current_torque import EddyCurrentTorque
from components.rotational.elasto_backlash import ElastoBacklash
from components.rotational.elasto_backlash2 import ElastoBacklash2
from components.rotational.fixed import Fixed
from components.rotational.friction import Friction
from components.rotational.gearbox import Gearbox
from components.rotational.general_angle_to_torque_adaptor import GeneralAngleToTorqueAdaptor
from components.rotational.general_torque_to_angle_adaptor import GeneralTorqueToAngleAdaptor
from components.rotational.ideal_gear import IdealGear
from components.rotational.ideal_planetary import IdealPlanetary
from components.rotational.inertia import Inertia
from components.rotational.initialize_flange import InitializeFlange
from components.rotational.inverse_speed_dependent_torque import InverseSpeedDependentTorque
from components.rotational.linear_speed_dependent_torque import LinearSpeedDependentTorque
from components.rotational.loading_torque import LoadingTorque
from components.rotational.lossy_gear import LossyGear
from components.rotational.move import Move
from components.rotational.multi_sensor import MultiSensor
from components.rotational.one_flange import OneFlange
from components.rotational.one_way_clutch import OneWayClutch
from components.rotational.position import Position
from components.rotational.power_sensor import PowerSensor
from components.rotational.pressed_shaft import PressedShaft
from components.rotational.quadratic_speed_dependent_torque import QuadraticSpeedDependentTorque
from components.rotational.rel_acc_sensor import RelAccSensor
from components.rotational.rel_angle_sensor import RelAngleSensor
from components.rotational.rel_speed_sensor import RelSpeedSensor
from components.rotational.relative_sensor import RelativeSensor
from components.rotational.relative_states import RelativeStates
from components.rotational.shaft_friction import ShaftFriction
from components.rotational.sign_torque import SignTorque
from components.rotational.sliding_torque import SlidingTorque
from components.rotational.slipping import Slipping
from components.rotational.speed import Speed
from components.rotational.speed_sensor import SpeedSensor
from components.rotational.spring import Spring
from components.rotational.spring_damper import SpringDamper
from components.rotational.torque import Torque
from components.rotational.torque2 import Torque2
from components.rotational.torque_sensor import TorqueSensor
from components.rotational.torque_step import TorqueStep
from components.rotational.torque_to_angle_adaptor import TorqueToAngleAdaptor
from components.rotational.two_flanges_and_support import TwoFlangesAndSupport
from components.translational.ideal_gear_r2t import IdealGearR2T
from components.translational.ideal_rolling_wheel import IdealRollingWheel

__all__ = [
    "AbsoluteSensor",
    "AccSensor",
    "Accelerate",
    "AngleSensor",
    "AngleToTorqueAdaptor",
    "BearingFriction",
    "Brake",
    "Clutch",
    "Compliant",
    "ConstantSpeed",
    "ConstantTorque",
    "CutSensor",
    "Damper",
    "Disc",
    "EddyCurrentTorque",
    "ElastoBacklash",
    "ElastoBacklash2",
    "Fixed",
    "Flange",
    "Friction",
    "Gearbox",
    "GeneralAngleToTorqueAdaptor",
    "GeneralTorqueToAngleAdaptor",
    "IdealGear",
    "IdealGearR2T",
    "IdealPlanetary",
    "IdealRollingWheel",
    "Inertia",
    "InitializeFlange",
    "InverseSpeedDependentTorque",
    "LinearSpeedDependentTorque",
    "LoadingTorque",
    "LossyGear",
    "Move",
    "MultiSensor",
    "OneFlange",
    "OneWayClutch",
    "Position",
    "PowerSensor",
    "PressedShaft",
    "QuadraticSpeedDependentTorque",
    "RelAccSensor",
    "RelAngleSensor",
    "RelSpeedSensor",
    "RelativeSensor",
    "RelativeStates",
    "ShaftFriction",
    "SignTorque",
    "SlidingTorque",
    "Slipping",
    "Speed",
    "SpeedSensor",
    "Spring",
    "SpringDamper",
    "Torque",
    "Torque2",
    "TorqueSensor",
    "TorqueStep",
    "TorqueToAngleAdaptor",
    "TwoFlanges",
    "TwoFlangesAndSupport",
]
