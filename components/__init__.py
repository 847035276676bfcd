"""Machine components: joints, bodies, forces and drives; drive trains are in `components.rotational`."""

from components import constraints, contact, rotational, sensors, thermal, translational
from components.beams import Circle, FlexibleBeam, Load, Rectangle, Section, SubstructuredBeam, Tube
from components.bevel_gear_1d import BevelGear1D
from components.body import Body
from components.body_box import BodyBox
from components.body_cylinder import BodyCylinder
from components.body_rod import BodyRod
from components.body_shape import BodyShape
from components.bushing import Bushing
from components.constant_velocity_joint import ConstantVelocityJoint
from components.cylindrical import Cylindrical
from components.damper import Damper
from components.drag import Drag
from components.driven_joint import DrivenJoint
from components.fixed import Fixed
from components.fixed_rotation import FixedRotation
from components.fixed_translation import FixedTranslation
from components.flange import Flange, TwoFlanges
from components.force import Force
from components.force_and_torque import ForceAndTorque
from components.frame import Frame, TwoFrames, move
from components.free_motion import FreeMotion
from components.free_motion_scalar_init import FreeMotionScalarInit
from components.gear_constraint import GearConstraint
from components.line_force import LineForce
from components.line_force_law import LineForceLaw
from components.line_force_with_mass import LineForceWithMass
from components.line_force_with_two_masses import LineForceWithTwoMasses
from components.load import FrameLoad, WorldLoad
from components.mass_on_line import MassOnLine
from components.mounting_1d import Mounting1D
from components.moving_body import MovingBody
from components.orientation import (
    Orientation,
    RelativeOrientation,
    absolute_rotation,
    fixed_rotation,
    from_quaternion,
    inverse_rotation,
    null_rotation,
    planar_rotation,
    resolve1,
    resolve2,
)
from components.planar import Planar
from components.point_mass import PointMass
from components.point_on_curve import PointOnCurve
from components.prismatic import Prismatic
from components.rack_and_pinion import RackAndPinion
from components.revolute import Revolute
from components.revolute_planar_loop_constraint import RevolutePlanarLoopConstraint
from components.rolling_wheel import RollingWheel
from components.rolling_wheel_joint import RollingWheelJoint
from components.rolling_wheel_set import RollingWheelSet
from components.rolling_wheel_set_joint import RollingWheelSetJoint
from components.rope import Rope
from components.rotor_1d import Rotor1D
from components.screw_joint import ScrewJoint
from components.spherical import Spherical
from components.spherical_spherical import SphericalSpherical
from components.spring import Spring
from components.spring_damper_parallel import SpringDamperParallel
from components.spring_damper_series import SpringDamperSeries
from components.table import table
from components.torque import Torque
from components.translational.flange import TranslationalFlange
from components.triaxial_spring import TriaxialSpring
from components.two_frame_body import TwoFrameBody
from components.tyre import Tyre
from components.universal import Universal
from components.universal_spherical import UniversalSpherical
from components.world import World
from components.world_force import WorldForce
from components.world_force_and_torque import WorldForceAndTorque
from components.world_torque import WorldTorque

__all__ = [
    "BevelGear1D",
    "Body",
    "BodyBox",
    "BodyCylinder",
    "BodyRod",
    "BodyShape",
    "Bushing",
    "Circle",
    "ConstantVelocityJoint",
    "Cylindrical",
    "Damper",
    "Drag",
    "DrivenJoint",
    "Fixed",
    "FixedRotation",
    "FixedTranslation",
    "Flange",
    "FlexibleBeam",
    "Force",
    "ForceAndTorque",
    "Frame",
    "FrameLoad",
    "FreeMotion",
    "FreeMotionScalarInit",
    "GearConstraint",
    "LineForce",
    "LineForceLaw",
    "LineForceWithMass",
    "LineForceWithTwoMasses",
    "Load",
    "MassOnLine",
    "Mounting1D",
    "MovingBody",
    "Orientation",
    "Planar",
    "PointMass",
    "PointOnCurve",
    "Prismatic",
    "RackAndPinion",
    "Rectangle",
    "RelativeOrientation",
    "Revolute",
    "RevolutePlanarLoopConstraint",
    "RollingWheel",
    "RollingWheelJoint",
    "RollingWheelSet",
    "RollingWheelSetJoint",
    "Rope",
    "Rotor1D",
    "ScrewJoint",
    "Section",
    "Spherical",
    "SphericalSpherical",
    "Spring",
    "SpringDamperParallel",
    "SpringDamperSeries",
    "SubstructuredBeam",
    "Torque",
    "TranslationalFlange",
    "TriaxialSpring",
    "Tube",
    "TwoFlanges",
    "TwoFrameBody",
    "TwoFrames",
    "Tyre",
    "Universal",
    "UniversalSpherical",
    "World",
    "WorldForce",
    "WorldForceAndTorque",
    "WorldLoad",
    "WorldTorque",
    "absolute_rotation",
    "constraints",
    "contact",
    "fixed_rotation",
    "from_quaternion",
    "inverse_rotation",
    "move",
    "null_rotation",
    "planar_rotation",
    "resolve1",
    "resolve2",
    "rotational",
    "sensors",
    "table",
    "thermal",
    "translational",
]
