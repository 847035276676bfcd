"""Electrical circuits: resistors, capacitors, inductors, switches, diodes, amplifiers, sources, sensors and machines."""

from components.electrical.capacitor import Capacitor
from components.electrical.conductor import Conductor
from components.electrical.constant_current import ConstantCurrent
from components.electrical.constant_voltage import ConstantVoltage
from components.electrical.controlled_ideal_closing_switch import ControlledIdealClosingSwitch
from components.electrical.controlled_ideal_opening_switch import ControlledIdealOpeningSwitch
from components.electrical.controlled_ideal_switch import ControlledIdealSwitch
from components.electrical.current_sensor import CurrentSensor
from components.electrical.dc_electrical_excited import DCElectricalExcited
from components.electrical.dc_machine import DCMachine
from components.electrical.dc_permanent_magnet import DCPermanentMagnet
from components.electrical.ground import Ground
from components.electrical.ideal_closing_switch import IdealClosingSwitch
from components.electrical.ideal_diode import IdealDiode
from components.electrical.ideal_op_amp import IdealOpAmp
from components.electrical.ideal_op_amp3_pin import IdealOpAmp3Pin
from components.electrical.ideal_op_amp_limited import IdealOpAmpLimited
from components.electrical.ideal_opening_switch import IdealOpeningSwitch
from components.electrical.ideal_switch import IdealSwitch
from components.electrical.ideal_thyristor import IdealThyristor
from components.electrical.ideal_transformer import IdealTransformer
from components.electrical.inductor import Inductor
from components.electrical.one_port import OnePort
from components.electrical.pin import Pin
from components.electrical.potential_sensor import PotentialSensor
from components.electrical.power_sensor import PowerSensor
from components.electrical.pulse_current import PulseCurrent
from components.electrical.pulse_voltage import PulseVoltage
from components.electrical.ramp_current import RampCurrent
from components.electrical.ramp_voltage import RampVoltage
from components.electrical.resistor import Resistor
from components.electrical.rotational_emf import RotationalEMF
from components.electrical.signal_current import SignalCurrent
from components.electrical.signal_voltage import SignalVoltage
from components.electrical.sine_current import SineCurrent
from components.electrical.sine_voltage import SineVoltage
from components.electrical.source import Source
from components.electrical.step_current import StepCurrent
from components.electrical.step_voltage import StepVoltage
from components.electrical.table_current import TableCurrent
from components.electrical.table_voltage import TableVoltage
from components.electrical.transformer import Transformer
from components.electrical.translational_emf import TranslationalEMF
from components.electrical.two_port import TwoPort
from components.electrical.voltage_sensor import VoltageSensor

__all__ = [
    "Capacitor",
    "Conductor",
    "ConstantCurrent",
    "ConstantVoltage",
    "ControlledIdealClosingSwitch",
    "ControlledIdealOpeningSwitch",
    "ControlledIdealSwitch",
    "CurrentSensor",
    "DCElectricalExcited",
    "DCMachine",
    "DCPermanentMagnet",
    "Ground",
    "IdealClosingSwitch",
    "IdealDiode",
    "IdealOpAmp",
    "IdealOpAmp3Pin",
    "IdealOpAmpLimited",
    "IdealOpeningSwitch",
    "IdealSwitch",
    "IdealThyristor",
    "IdealTransformer",
    "Inductor",
    "OnePort",
    "Pin",
    "PotentialSensor",
    "PowerSensor",
    "PulseCurrent",
    "PulseVoltage",
    "RampCurrent",
    "RampVoltage",
    "Resistor",
    "RotationalEMF",
    "SignalCurrent",
    "SignalVoltage",
    "SineCurrent",
    "SineVoltage",
    "Source",
    "StepCurrent",
    "StepVoltage",
    "TableCurrent",
    "TableVoltage",
    "Transformer",
    "TranslationalEMF",
    "TwoPort",
    "VoltageSensor",
]
