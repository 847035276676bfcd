"""Blocks with inputs and outputs: mathematics, limits, controllers, filters, samplers, logic, tables and sources."""

from components.blocks.abs import Abs
from components.blocks.add import Add
from components.blocks.add3 import Add3
from components.blocks.boolean_pulse import BooleanPulse
from components.blocks.boolean_step import BooleanStep
from components.blocks.casadi_function import CasadiFunction
from components.blocks.combi_table1_d import CombiTable1D
from components.blocks.combi_table2_d import CombiTable2D
from components.blocks.combi_time_table import CombiTimeTable
from components.blocks.constant import Constant
from components.blocks.cos import Cos
from components.blocks.cosine import Cosine
from components.blocks.critical_damping import CriticalDamping
from components.blocks.dead_zone import DeadZone
from components.blocks.der import Der
from components.blocks.derivative import Derivative
from components.blocks.discrete_pid import DiscretePID
from components.blocks.discrete_state_space import DiscreteStateSpace
from components.blocks.discrete_transfer_function import DiscreteTransferFunction
from components.blocks.division import Division
from components.blocks.edge import Edge
from components.blocks.exp import Exp
from components.blocks.exp_sine import ExpSine
from components.blocks.feedback import Feedback
from components.blocks.first_order import FirstOrder
from components.blocks.first_order_hold import FirstOrderHold
from components.blocks.fixed_delay import FixedDelay
from components.blocks.gain import Gain
from components.blocks.greater import Greater
from components.blocks.greater_equal_threshold import GreaterEqualThreshold
from components.blocks.greater_threshold import GreaterThreshold
from components.blocks.hysteresis import Hysteresis
from components.blocks.integrator import Integrator
from components.blocks.kinematic_ptp import KinematicPTP
from components.blocks.kinematic_ptp2 import KinematicPTP2
from components.blocks.less import Less
from components.blocks.less_equal_threshold import LessEqualThreshold
from components.blocks.less_threshold import LessThreshold
from components.blocks.lim_integrator import LimIntegrator
from components.blocks.lim_pid import LimPID
from components.blocks.limiter import Limiter
from components.blocks.logical_and import And
from components.blocks.logical_not import Not
from components.blocks.logical_or import Or
from components.blocks.logical_xor import Xor
from components.blocks.lowpass_butterworth import LowpassButterworth
from components.blocks.max import Max
from components.blocks.min import Min
from components.blocks.normal_noise import NormalNoise
from components.blocks.periodic_block import PeriodicBlock
from components.blocks.pi import PI
from components.blocks.pid import PID
from components.blocks.product import Product
from components.blocks.pulse import Pulse
from components.blocks.ramp import Ramp
from components.blocks.rs_flip_flop import RSFlipFlop
from components.blocks.sampled import Sampled
from components.blocks.sampler import Sampler
from components.blocks.saw_tooth import SawTooth
from components.blocks.second_order import SecondOrder
from components.blocks.si2so import SI2SO
from components.blocks.sign import Sign
from components.blocks.sin import Sin
from components.blocks.sine import Sine
from components.blocks.siso import SISO
from components.blocks.slew_rate_limiter import SlewRateLimiter
from components.blocks.so import SO
from components.blocks.sqrt import Sqrt
from components.blocks.state_space import StateSpace
from components.blocks.step import Step
from components.blocks.switch import Switch
from components.blocks.timer import Timer
from components.blocks.transfer_function import TransferFunction
from components.blocks.trapezoid import Trapezoid
from components.blocks.triggered_sampler import TriggeredSampler
from components.blocks.uniform_noise import UniformNoise
from components.blocks.unit_delay import UnitDelay
from components.blocks.variable_limiter import VariableLimiter
from components.blocks.wrap_angle import WrapAngle
from components.blocks.zero_order_hold import ZeroOrderHold

__all__ = [
    "PI",
    "PID",
    "SI2SO",
    "SISO",
    "SO",
    "Abs",
    "Add",
    "Add3",
    "And",
    "BooleanPulse",
    "BooleanStep",
    "CasadiFunction",
    "CombiTable1D",
    "CombiTable2D",
    "CombiTimeTable",
    "Constant",
    "Cos",
    "Cosine",
    "CriticalDamping",
    "DeadZone",
    "Der",
    "Derivative",
    "DiscretePID",
    "DiscreteStateSpace",
    "DiscreteTransferFunction",
    "Division",
    "Edge",
    "Exp",
    "ExpSine",
    "Feedback",
    "FirstOrder",
    "FirstOrderHold",
    "FixedDelay",
    "Gain",
    "Greater",
    "GreaterEqualThreshold",
    "GreaterThreshold",
    "Hysteresis",
    "Integrator",
    "KinematicPTP",
    "KinematicPTP2",
    "Less",
    "LessEqualThreshold",
    "LessThreshold",
    "LimIntegrator",
    "LimPID",
    "Limiter",
    "LowpassButterworth",
    "Max",
    "Min",
    "NormalNoise",
    "Not",
    "Or",
    "PeriodicBlock",
    "Product",
    "Pulse",
    "RSFlipFlop",
    "Ramp",
    "Sampled",
    "Sampler",
    "SawTooth",
    "SecondOrder",
    "Sign",
    "Sin",
    "Sine",
    "SlewRateLimiter",
    "Sqrt",
    "StateSpace",
    "Step",
    "Switch",
    "Timer",
    "TransferFunction",
    "Trapezoid",
    "TriggeredSampler",
    "UniformNoise",
    "UnitDelay",
    "VariableLimiter",
    "WrapAngle",
    "Xor",
    "ZeroOrderHold",
]
