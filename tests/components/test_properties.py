"""Every component against every property: balanced, power balance, frame invariance, turned round, documented, units."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

import acausal as ac
import components
from acausal import Component, Connector, Model, Record, fixed, sin, structural, time, units
from acausal.language import fields as f
from components import (
    Body,
    TwoFrames,
    World,
    assemblies,
    blocks,
    constraints,
    contact,
    electrical,
    fe,
    rotational,
    sensors,
    thermal,
    translational,
)
from components.flange import TwoFlanges
from tests.components.scenes import assemblies as scenes_of_assemblies
from tests.components.scenes import (
    bodies,
    contacts,
    drives,
    forces,
    friction,
    gears,
    guides,
    heat,
    joints,
    mountings,
    rods,
    tyres,
    wheels,
)
from tests.components.scenes import constraints as constraint_scenes
from tests.components.scenes import sensors as sensor_scenes
from tests.components.scenes.bodies import (
    OnBeam,
    OnBodyBox,
    OnBodyCylinder,
    OnBodyRod,
    OnBodyShape,
    OnFEBody,
    OnFixed,
    OnRotation,
    OnSubstructuredBeam,
    OnTranslation,
)
from tests.components.scenes.forces import (
    OnDamper,
    OnForce,
    OnSpring,
    OnSpringDamper,
    OnTorque,
    OnWorldForce,
    OnWorldTorque,
)
from tests.components.scenes.joints import OnDrivenPrismatic, OnPlanarLoop, OnPrismatic, OnRevolute, OnSphericalJoint
from tests.components.scenes.scene import INERTIA, SPIN, M, Plain, Scene
from tests.components.scenes.shafts import (
    OnShaftAngleToTorque,
    OnShaftDamper,
    OnShaftFixed,
    OnShaftGeneralAngleToTorque,
    OnShaftGeneralTorqueToAngle,
    OnShaftInertia,
    OnShaftMove,
    OnShaftPosition,
    OnShaftSpeed,
    OnShaftSpring,
    OnShaftSpringDamper,
    OnShaftTorque,
    OnShaftTorqueToAngle,
    Shaft,
)
from tests.shared import compiled

SCENES: dict[str, type[Scene]] = {
    "World": Plain,
    "Body": Plain,
    "Fixed": OnFixed,
    "FixedTranslation": OnTranslation,
    "FixedRotation": OnRotation,
    "BodyShape": OnBodyShape,
    "BodyBox": OnBodyBox,
    "BodyCylinder": OnBodyCylinder,
    "BodyRod": OnBodyRod,
    "Revolute": OnRevolute,
    "RevolutePlanarLoopConstraint": OnPlanarLoop,
    "Prismatic": OnDrivenPrismatic,
    "Universal": joints.OnUniversal,
    "Cylindrical": joints.OnCylindrical,
    "Planar": joints.OnPlanar,
    "FreeMotion": joints.OnFreeMotion,
    "ConstantVelocityJoint": guides.OnConstantVelocityJoint,
    "PointOnCurve": guides.OnPointOnCurve,
    "RackAndPinion": guides.OnRackAndPinion,
    "ScrewJoint": guides.OnScrewJoint,
    "RollingWheel": wheels.OnRollingWheel,
    "RollingWheelJoint": wheels.OnRollingWheelJoint,
    "RollingWheelSet": wheels.OnRollingWheelSet,
    "RollingWheelSetJoint": wheels.OnRollingWheelSetJoint,
    "FreeMotionScalarInit": joints.OnFreeMotionScalarInit,
    "GearConstraint": drives.OnGearConstraint,
    "Rotor1D": drives.OnRotor,
    "Mounting1D": drives.OnMounting,
    "BevelGear1D": drives.OnBevelGear,
    "SpringDamperSeries": forces.OnSpringDamperSeries,
    "LineForceWithMass": forces.OnLineForceWithMass,
    "LineForceWithTwoMasses": forces.OnLineForceWithTwoMasses,
    "Bushing": mountings.OnBushing,
    "TriaxialSpring": mountings.OnTriaxialSpring,
    "LineForceLaw": mountings.OnLineForceLaw,
    "Drag": mountings.OnDrag,
    "Rope": mountings.OnRope,
    "contact.PointOnPlane": contacts.OnPointOnPlane,
    "contact.SphereOnPlane": contacts.OnSphereOnPlane,
    "contact.RimOnPlane": contacts.OnRimOnPlane,
    "contact.SphereOnSphere": contacts.OnSphereOnSphere,
    "contact.PointOnProfile": contacts.OnPointOnProfile,
    "contact.SphereOnProfile": contacts.OnSphereOnProfile,
    "PointMass": bodies.OnPointMass,
    "Tyre": tyres.OnTyre,
    "ForceAndTorque": forces.OnForceAndTorque,
    "WorldForceAndTorque": forces.OnWorldForceAndTorque,
    "Spherical": OnSphericalJoint,
    "SphericalSpherical": joints.OnSphericalSpherical,
    "UniversalSpherical": joints.OnUniversalSpherical,
    "assemblies.JointRRP": scenes_of_assemblies.OnSprungRRP,
    "assemblies.JointSSP": scenes_of_assemblies.OnSprungSSP,
    "assemblies.JointUSP": scenes_of_assemblies.Sprung,
    "assemblies.JointRRR": scenes_of_assemblies.OnJointRRR,
    "assemblies.JointSSR": scenes_of_assemblies.OnJointSSR,
    "assemblies.JointUPS": scenes_of_assemblies.OnJointUPS,
    "assemblies.JointUSR": scenes_of_assemblies.OnJointUSR,
    "constraints.Prismatic": constraint_scenes.OnPrismaticConstraint,
    "constraints.Revolute": constraint_scenes.OnRevoluteConstraint,
    "constraints.Spherical": constraint_scenes.OnSphericalConstraint,
    "constraints.Universal": constraint_scenes.OnUniversalConstraint,
    "Spring": OnSpring,
    "Damper": OnDamper,
    "SpringDamperParallel": OnSpringDamper,
    "Force": OnForce,
    "Torque": OnTorque,
    "WorldForce": OnWorldForce,
    "WorldTorque": OnWorldTorque,
    "FlexibleBeam": OnBeam,
    "SubstructuredBeam": OnSubstructuredBeam,
    "fe.FEBody": OnFEBody,
    "rotational.Spring": OnShaftSpring,
    "rotational.Damper": OnShaftDamper,
    "rotational.SpringDamper": OnShaftSpringDamper,
    "rotational.Friction": friction.OnShaftFriction,
    "rotational.Clutch": friction.OnShaftClutch,
    "rotational.OneWayClutch": friction.OnOneWayClutch,
    "rotational.BearingFriction": friction.OnBearingFriction,
    "rotational.Brake": friction.OnBrake,
    "rotational.LossyGear": friction.OnLossyGear,
    "rotational.Gearbox": friction.OnGearbox,
    "translational.SupportFriction": friction.OnSupportFriction,
    "translational.Brake": friction.OnRodBrake,
    "translational.MassWithStopAndFriction": friction.OnMassWithStopAndFriction,
    "rotational.Fixed": OnShaftFixed,
    "rotational.Inertia": OnShaftInertia,
    "rotational.Torque": OnShaftTorque,
    "rotational.Move": OnShaftMove,
    "rotational.AngleToTorqueAdaptor": OnShaftAngleToTorque,
    "rotational.GeneralAngleToTorqueAdaptor": OnShaftGeneralAngleToTorque,
    "rotational.TorqueToAngleAdaptor": OnShaftTorqueToAngle,
    "rotational.GeneralTorqueToAngleAdaptor": OnShaftGeneralTorqueToAngle,
    "rotational.Position": OnShaftPosition,
    "rotational.Speed": OnShaftSpeed,
    "rotational.IdealGear": gears.OnIdealGear,
    "rotational.IdealPlanetary": gears.OnIdealPlanetary,
    "rotational.Disc": gears.OnDisc,
    "translational.IdealGearR2T": gears.OnGearR2T,
    "translational.IdealRollingWheel": gears.OnRollingWheel,
    "rotational.IdealGearR2T": gears.OnGearR2T,
    "rotational.IdealRollingWheel": gears.OnRollingWheel,
    "rotational.ElastoBacklash": gears.OnBacklash,
    "rotational.ElastoBacklash2": gears.OnBacklash2,
    "rotational.Torque2": gears.OnShaftTorque2,
    "rotational.ConstantTorque": gears.OnConstantTorque,
    "rotational.TorqueStep": gears.OnTorqueStep,
    "rotational.SignTorque": gears.OnSignTorque,
    "rotational.LinearSpeedDependentTorque": gears.OnLinearTorque,
    "rotational.QuadraticSpeedDependentTorque": gears.OnQuadraticTorque,
    "rotational.InverseSpeedDependentTorque": gears.OnInverseTorque,
    "rotational.ConstantSpeed": gears.OnConstantSpeed,
    "rotational.Accelerate": gears.OnAccelerate,
    "rotational.EddyCurrentTorque": gears.OnEddyCurrentTorque,
    "rotational.InitializeFlange": gears.OnInitializeFlange,
    "translational.EddyCurrentForce": rods.OnRodEddyCurrentForce,
    "translational.RollingResistance": rods.OnRodRollingResistance,
    "translational.Vehicle": rods.OnRodVehicle,
    "translational.InitializeFlange": rods.OnRodInitializeFlange,
    "rotational.RelativeStates": gears.OnRelativeStates,
    "rotational.AngleSensor": gears.OnAngleSensor,
    "rotational.SpeedSensor": gears.OnSpeedSensor,
    "rotational.AccSensor": gears.OnAccSensor,
    "rotational.RelAngleSensor": gears.OnRelAngleSensor,
    "rotational.RelSpeedSensor": gears.OnRelSpeedSensor,
    "rotational.RelAccSensor": gears.OnRelAccSensor,
    "rotational.TorqueSensor": gears.OnTorqueSensor,
    "rotational.PowerSensor": gears.OnPowerSensor,
    "rotational.MultiSensor": gears.OnMultiSensor,
    "translational.Spring": rods.OnRodSpring,
    "translational.Damper": rods.OnRodDamper,
    "translational.SpringDamper": rods.OnRodSpringDamper,
    "translational.ElastoGap": rods.OnRodElastoGap,
    "translational.Mass": rods.OnRodMass,
    "translational.Rod": rods.OnRodRod,
    "translational.Fixed": rods.OnRodFixed,
    "translational.Force": rods.OnRodForce,
    "translational.Force2": rods.OnRodForce2,
    "translational.ConstantForce": rods.OnRodConstantForce,
    "translational.ForceStep": rods.OnRodForceStep,
    "translational.SignForce": rods.OnRodSignForce,
    "translational.LinearSpeedDependentForce": rods.OnRodLinearForce,
    "translational.QuadraticSpeedDependentForce": rods.OnRodQuadraticForce,
    "translational.InverseSpeedDependentForce": rods.OnRodInverseForce,
    "translational.Move": rods.OnRodMove,
    "translational.GeneralPositionToForceAdaptor": rods.OnRodPositionToForce,
    "translational.GeneralForceToPositionAdaptor": rods.OnRodForceToPosition,
    "translational.Position": rods.OnRodPosition,
    "translational.Speed": rods.OnRodSpeed,
    "translational.ConstantSpeed": rods.OnRodConstantSpeed,
    "translational.Accelerate": rods.OnRodAccelerate,
    "translational.RelativeStates": rods.OnRodRelativeStates,
    "translational.PositionSensor": rods.OnRodPositionSensor,
    "translational.SpeedSensor": rods.OnRodSpeedSensor,
    "translational.AccSensor": rods.OnRodAccSensor,
    "translational.RelPositionSensor": rods.OnRodRelPositionSensor,
    "translational.RelSpeedSensor": rods.OnRodRelSpeedSensor,
    "translational.RelAccSensor": rods.OnRodRelAccSensor,
    "translational.ForceSensor": rods.OnRodForceSensor,
    "translational.PowerSensor": rods.OnRodPowerSensor,
    "translational.MultiSensor": rods.OnRodMultiSensor,
    "sensors.AbsolutePosition": sensor_scenes.OnAbsolutePosition,
    "sensors.AbsoluteVelocity": sensor_scenes.OnAbsoluteVelocity,
    "sensors.AbsoluteAngularVelocity": sensor_scenes.OnAbsoluteAngularVelocity,
    "sensors.AbsoluteAngles": sensor_scenes.OnAbsoluteAngles,
    "sensors.AbsoluteSensor": sensor_scenes.OnAbsoluteSensor,
    "sensors.RelativePosition": sensor_scenes.OnRelativePosition,
    "sensors.RelativeVelocity": sensor_scenes.OnRelativeVelocity,
    "sensors.RelativeAngularVelocity": sensor_scenes.OnRelativeAngularVelocity,
    "sensors.RelativeAngles": sensor_scenes.OnRelativeAngles,
    "sensors.RelativeSensor": sensor_scenes.OnRelativeSensor,
    "sensors.Distance": sensor_scenes.OnDistance,
    "sensors.CutForce": sensor_scenes.OnCutForce,
    "sensors.CutTorque": sensor_scenes.OnCutTorque,
    "sensors.CutForceAndTorque": sensor_scenes.OnCutForceAndTorque,
    "sensors.Power": sensor_scenes.OnPower,
    "thermal.HeatCapacitor": heat.OnCapacitor,
    "thermal.ThermalConductor": heat.OnConductor,
    "thermal.Convection": heat.OnConvection,
    "thermal.FixedTemperature": heat.OnFixedTemperature,
    "thermal.PrescribedTemperature": heat.OnPrescribedTemperature,
}
TURNED = SCENES | {"Prismatic": OnPrismatic}
TURNED |= {f"assemblies.Joint{kind}": getattr(scenes_of_assemblies, f"OnJoint{kind}") for kind in ("RRP", "SSP", "USP")}
BASES = {
    "DrivenJoint",
    "LineForce",
    "MovingBody",
    "TwoFrameBody",
    "TwoFrames",
    "TwoFlanges",
    "rotational.Compliant",
    "rotational.OneFlange",
}
BASES |= {f"sensors.{name}" for name in ("OneFrameSensor", "TwoFrameSensor", "CutSensor", "HasAngles")}
BASES |= {"assemblies.PrismaticEnd", "assemblies.RevoluteEnd", "constraints.PositionConstraint", "contact.Contact"}
BASES |= {"MassOnLine", "FrameLoad", "WorldLoad", "rotational.TwoFlanges", "rotational.Slipping", "thermal.HeatLoss"}
BASES |= {f"translational.{name}" for name in ("TwoFlanges", "Rigid", "Compliant", "OneFlange", "LoadingForce")}
BASES |= {
    f"{p}.{name}" for p in ("translational", "rotational") for name in ("AbsoluteSensor", "RelativeSensor", "CutSensor")
}
BASES |= {
    "rotational.PressedShaft",
    "rotational.ShaftFriction",
    "rotational.SlidingTorque",
    "translational.RodFriction",
}
BASES |= {"rotational.LoadingTorque", "rotational.TwoFlangesAndSupport", "translational.RotationalToTranslational"}


MECHANICS = (assemblies, constraints, contact, rotational, translational, thermal, sensors, fe)


def exported(*packages: Any) -> dict[str, type]:
    """All component, connector and record classes that some packages export."""
    found = {}
    for package in packages:
        short = package.__name__.rpartition(".")[2]
        found |= {f"{short}.{name}": getattr(package, name) for name in package.__all__}
    return {name: c for name, c in found.items() if inspect.isclass(c) and issubclass(c, Component)}


EXPORTED = exported(*MECHANICS)
EXPORTED |= {
    name: c
    for name in components.__all__
    if inspect.isclass(c := getattr(components, name)) and issubclass(c, Component)
}
SIGNALS = exported(blocks, electrical)
# Frame_a is fixed to a plane or profile, frame_b to what touches it.
ONE_WAY = {
    f"contact.{name}" for name in ("PointOnPlane", "SphereOnPlane", "RimOnPlane", "PointOnProfile", "SphereOnProfile")
}
SIDED = [
    name
    for name in SCENES
    if (issubclass(EXPORTED[name], TwoFrames | TwoFlanges | translational.TwoFlanges) or name == "fe.FEBody")
    and name not in ONE_WAY
]
DISSIPATING = {
    "Damper",
    "SpringDamperParallel",
    "Revolute",
    "ScrewJoint",
    "Prismatic",
    "FlexibleBeam",
    "SubstructuredBeam",
}
DISSIPATING |= {"fe.FEBody", "Tyre", "SpringDamperSeries", "LineForceWithMass", "LineForceWithTwoMasses"}
DISSIPATING |= {"rotational.Damper", "rotational.SpringDamper", "rotational.Friction", "rotational.Clutch"}
DISSIPATING |= {f"rotational.{name}" for name in ("OneWayClutch", "BearingFriction", "Brake", "LossyGear", "Gearbox")}
DISSIPATING |= {f"translational.{name}" for name in ("SupportFriction", "Brake", "MassWithStopAndFriction")}
SUPPLYING = {"Force", "Torque", "WorldForce", "WorldTorque", "Prismatic", "rotational.Inertia", "rotational.Torque"}
SUPPLYING |= {
    "ForceAndTorque",
    "WorldForceAndTorque",
    "rotational.Move",
    "rotational.Position",
    "rotational.Speed",
    "thermal.FixedTemperature",
    "thermal.PrescribedTemperature",
}
SUPPLYING |= {"translational.MassWithStopAndFriction"}
SUPPLYING |= {"Drag"}
DISSIPATING |= {"Bushing", "LineForceLaw", "Drag", "Rope"} | {name for name in SCENES if name.startswith("contact.")}
SUPPLYING |= {"Rotor1D", "Mounting1D", "BevelGear1D"}
SUPPLYING |= {"thermal.ThermalConductor", "thermal.Convection"}
DISSIPATING |= {"rotational.ElastoBacklash", "rotational.ElastoBacklash2", "rotational.EddyCurrentTorque"}
DISSIPATING |= {f"translational.{name}" for name in ("EddyCurrentForce", "RollingResistance", "Vehicle")}
SUPPLYING |= {"translational.Vehicle"}
SUPPLYING |= {f"rotational.{name}" for name in ("Torque2", "ConstantTorque", "TorqueStep", "SignTorque")}
SUPPLYING |= {f"rotational.{kind}SpeedDependentTorque" for kind in ("Linear", "Quadratic", "Inverse")}
SUPPLYING |= {"rotational.ConstantSpeed", "rotational.Accelerate"}
DISSIPATING |= {f"translational.{name}" for name in ("Damper", "SpringDamper", "ElastoGap")}
SUPPLYING |= {
    f"translational.{name}" for name in ("Mass", "Force", "Force2", "ConstantForce", "ForceStep", "SignForce")
}
SUPPLYING |= {f"translational.{kind}SpeedDependentForce" for kind in ("Linear", "Quadratic", "Inverse")}
SUPPLYING |= {f"rotational.{kind}Adaptor" for kind in ("AngleToTorque", "TorqueToAngle")}
SUPPLYING |= {f"rotational.General{kind}Adaptor" for kind in ("AngleToTorque", "TorqueToAngle")}
SUPPLYING |= {f"translational.General{kind}Adaptor" for kind in ("PositionToForce", "ForceToPosition")}
SUPPLYING |= {f"translational.{name}" for name in ("Move", "Position", "Speed", "ConstantSpeed", "Accelerate")}


@dataclass
class Motion:
    """What a run shows of the tip, resolved in the place."""

    position: np.ndarray
    orientation: np.ndarray
    kinetic: np.ndarray
    stats: dict[str, Any]


_cache: dict[tuple, Motion] = {}


def run(model: type[Scene], moved: bool = False, turned: bool = False) -> Motion:
    """Simulate a scene once."""
    key = (model, moved, turned)
    if key not in _cache:
        result = ac.simulate(
            compiled(model, moved=moved, turned=turned), stop_time=0.5, tolerance=1e-9, intervals=10, energy=not moved
        )
        T, T_tip = result["place.frame_b.R.T"][0], result["tip.frame_a.R.T"]
        position = (result["tip.r_0"] - result["place.frame_b.r_0"]) @ T.T
        kinetic = M * np.sum(result["tip.v_0"] ** 2, axis=1) / 2
        kinetic = kinetic + np.einsum("ki,ij,kj->k", result["tip.w_a"], INERTIA, result["tip.w_a"]) / 2
        _cache[key] = Motion(position, T_tip @ T.T, kinetic, result.stats)
    return _cache[key]


def same(one: Motion, other: Motion) -> None:
    """Both move alike, and they move."""
    assert np.ptp(one.orientation, axis=0).max() > 0.1
    np.testing.assert_allclose(one.position, other.position, atol=2e-6)
    np.testing.assert_allclose(one.orientation, other.orientation, atol=2e-6)


def every(names: Any) -> Callable:
    return pytest.mark.parametrize("name", list(names))


def test_no_component_is_forgotten():
    concrete = {n for n, c in EXPORTED.items() if not issubclass(c, Connector | Record)} - BASES
    assert concrete == set(SCENES)
    assert set(EXPORTED) >= BASES
    for name, model in SCENES.items():
        made = getattr(model, "it", None)
        assert name in ("World", "Body") or made is not None
    for name in BASES:
        assert any(issubclass(EXPORTED[n], EXPORTED[name]) for n in SCENES), f"nothing extends {name}"
    ports = {p.make for n in SCENES for p in EXPORTED[n].fields.values() if isinstance(p, f.Part)}
    classes = {p if inspect.isclass(p) else type(p) for p in ports}
    assert components.Frame in classes


@every(SCENES)
def test_scene_holds_the_component_and_compiles_without_surplus(name):
    model = compiled(SCENES[name], moved=False, turned=False)
    part = {"World": "world", "Body": "tip"}.get(name, "it")
    assert type(getattr(model.tree, part)) is EXPORTED[name]
    report = model.report
    assert report["redundant_constraints"] == []
    assert report["redundant"] == 0
    assert len(model.states) + len(model.algebraic) == report["equations_reduced"]


@every(SCENES)
def test_power_balance(name):
    motion = run(SCENES[name])
    stats = motion.stats
    exchanged = np.ptp(motion.kinetic) + abs(stats["energy_supplied"]) + stats["energy_dissipated"]
    assert exchanged > 0.1
    assert abs(stats["energy_method"]) < 1e-6 * exchanged
    if name in DISSIPATING:
        assert stats["energy_dissipated"] > 1e-4
    else:
        assert stats["energy_dissipated"] == 0
    if name in SUPPLYING:
        assert abs(stats["energy_supplied"]) > 1e-2
    else:
        assert stats["energy_supplied"] == 0


@every(SCENES)
def test_frame_invariance(name):
    """In another place, and turned round at once where the scene can be."""
    turned = name in SIDED and TURNED[name] is SCENES[name]
    same(run(SCENES[name]), run(SCENES[name], moved=True, turned=turned))


@every([name for name in SIDED if TURNED[name] is not SCENES[name]])
def test_turned_round(name):
    same(run(TURNED[name]), run(TURNED[name], turned=True))


def is_argument(field: Any) -> bool:
    """Whether the Parameters section of the class lists the field."""
    return isinstance(field, f.Structural | f.Parameter) or getattr(field, "causality", "") == "input"


@every(EXPORTED | SIGNALS)
def test_documented(name):
    """The docstring names what the constructor takes, ports and variables, each with its kind, unit and what it is."""
    cls = (EXPORTED | SIGNALS)[name]
    text = inspect.getdoc(cls) or ""
    assert text.strip()
    given = {n for n, d in cls.fields.items() if is_argument(d)}
    read = {n for n, d in cls.fields.items() if isinstance(d, f.Variable | f.Observed)} - given
    ports = {n for n, d in cls.fields.items() if isinstance(d, f.Part) and d.is_port and d.make is not None}
    for title, names in (("Parameters", given), ("Ports", ports), ("Variables", read)):
        section = "".join(re.findall(rf"{title}\n-+\n(?:Start values.*?\n\n)?(.*?)(?:\n\n|\Z)", text, re.S))
        entries = {n: (head, said) for n, head, said in re.findall(r"^(\w+) : (.+)\n((?:    .*\n?)+)", section, re.M)}
        assert set(entries) == names, title
        for n, (head, said) in entries.items():
            d = cls.fields[n]
            assert isinstance(d.unit, str) is False or d.unit == "1" or f"in {d.unit}" in head
            assert d.description.strip()
            assert d.description.lower() in " ".join(said.split()).lower()
    for n in ports:
        connector = cls.fields[n].connector
        assert re.search(r"\b[A-Z]", connector), f"{n}: annotate the method with the class of its port"
        assert re.search(rf"^{n} : {re.escape(connector)}$", text, re.M)


@every(EXPORTED | SIGNALS)
def test_signature(name):
    """inspect.signature shows all that the constructor takes by name, with type, unit and default."""
    cls = (EXPORTED | SIGNALS)[name]
    shown = inspect.signature(cls).parameters
    assert set(shown) == {n for n, d in cls.fields.items() if is_argument(d) or isinstance(d, f.Variable)}
    for n, argument in shown.items():
        d, said = cls.fields[n], str(argument.annotation)
        assert argument.kind is argument.KEYWORD_ONLY
        assert argument.annotation is not argument.empty
        assert isinstance(d.unit, str) is False or d.unit == "1" or f"in {d.unit}" in said
        assert is_argument(d) or said.endswith("fixed() or guess()")
        value = cls._class_values.get(n, d.default)
        if isinstance(d, f.Structural | f.Parameter) and (value is f.MISSING or np.isscalar(value)):
            assert argument.default is argument.empty if value is f.MISSING else argument.default == value
    cls(**{n: a.default for n, a in shown.items() if not (a.default is a.empty or repr(a.default) == "...")})


DRY = {"BearingFriction", "Brake", "Clutch", "Friction", "LossyGear", "MassWithStopAndFriction", "OneWayClutch"}
DRY |= {"PressedShaft", "RodFriction", "ShaftFriction", "SlidingTorque", "Slipping", "SupportFriction"}
DIMENSIONLESS = {
    ("Orientation", "T"),
    ("FEBody", "damping_ratio"),
    ("FEBody", "stiffness"),
    ("Frame", "Q"),
    ("Spherical", "Q"),
    ("FreeMotion", "Q"),
    *[(kind, name) for kind in DRY for name in ("mode", "shared", "share", "peak", "f_normalized", "stopped")],
    ("Brake", "cgeo"),
    *[(joint, name) for joint in ("DrivenJoint", "Revolute", "Prismatic", "ScrewJoint") for name in ("mu", "peak")],
    ("LossyGear", "ratio"),
    ("Gearbox", "ratio"),
    ("ElastoGap", "n"),
    ("LineForceWithMass", "length_fraction"),
    ("MassOnLine", "length_fraction"),
    ("Spring", "length_fraction"),
    *[("RollingResistance", name) for name in ("cr", "cr_constant", "inclination", "inclination_constant")],
    *[("Vehicle", name) for name in ("Cd", "cr", "cr_constant", "inclination", "inclination_constant")],
    ("EddyCurrentForce", "excitation"),
    ("EddyCurrentTorque", "excitation"),
    ("IdealGear", "ratio"),
    ("BevelGear1D", "ratio"),
    ("GearConstraint", "ratio"),
    ("IdealPlanetary", "ratio"),
    *[("PointOnCurve", name) for name in ("u", "der_u", "der2_u")],
    *[(name, coefficient) for name in contact.__all__ for coefficient in ("e", "mu")],
    *[(name, "slope") for name in ("PointOnProfile", "SphereOnProfile")],
    ("Drag", "c_d"),
    ("FlexibleBeam", "nu"),
    ("SubstructuredBeam", "nu"),
    *[("Bushing", name) for name in ("stiffness", "damping")],  # entries of several units
    ("Tyre", "mu"),
    ("Tyre", "e_z"),
}


@every(EXPORTED)
def test_units_are_declared(name):
    cls = EXPORTED[name]
    for n, d in cls.fields.items():
        if isinstance(d, f.Parameter | f.Variable) and not callable(d.unit):
            each = d.unit if isinstance(d.unit, list | tuple) else [d.unit]
            for unit in each:
                units.parse(unit or "1")
                assert unit not in (None, "1") or (cls.__name__, n) in DIMENSIONLESS, f"{name}.{n} has no unit"


class AllPrescribed(Shaft):
    """Nothing is left to integrate."""

    starts = structural("whether the joint has values at the start", default=False)
    it = rotational.Position(phi_ref=0.5 * sin(3 * time))


def test_a_motion_may_be_prescribed_altogether():
    result = ac.simulate(AllPrescribed(), stop_time=0.5, intervals=5)
    np.testing.assert_allclose(result["joint.phi"], 0.5 * np.sin(3 * result.time), atol=1e-12)


class PointGravity(Model):
    """A body in the field of a central mass."""

    world = World(gravity="point", mu=10.0)
    body = Body(
        m=M,
        I=INERTIA,
        r_0=fixed((1.0, 0.2, 0.0)),
        v_0=fixed((0.0, 2.5, 0.8)),
        w_a=fixed(tuple(SPIN)),
        angles_fixed=True,
    )


def test_power_balance_in_point_gravity():
    result = ac.simulate(PointGravity(), stop_time=1.0, tolerance=1e-9, energy=True)
    kinetic = M * np.sum(result["body.v_0"] ** 2, axis=1) / 2
    potential = -M * 10.0 / np.linalg.norm(result["body.r_0"], axis=1)
    assert np.ptp(kinetic) > 1
    np.testing.assert_allclose(kinetic + potential, kinetic[0] + potential[0], atol=1e-5)
    assert abs(result.stats["energy_method"]) < 1e-6 * np.ptp(kinetic)
