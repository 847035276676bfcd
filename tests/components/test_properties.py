"""Every component against every property: balanced, power balance, frame invariance, turned round, documented, units.

Each component stands in a small scene: what a scene holds hangs on `place`, the scene moves a body `tip`.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import acausal as ac
import components
from acausal import Component, Connector, Model, Record, chain, connect, cos, fixed, part, sin, structural, time, units
from acausal.language import fields as f
from components import (
    Body,
    BodyBox,
    BodyCylinder,
    BodyRod,
    BodyShape,
    Damper,
    Fixed,
    FixedRotation,
    FixedTranslation,
    FlexibleBeam,
    Force,
    Prismatic,
    Revolute,
    RevolutePlanarLoopConstraint,
    Spherical,
    Spring,
    SpringDamperParallel,
    SubstructuredBeam,
    Torque,
    TranslationalFlange,
    TwoFrames,
    World,
    WorldForce,
    WorldTorque,
    rotational,
)
from components.flange import TwoFlanges

SHIFT = np.array([1.0, 2.0, 3.0])
AXIS = np.array([1.0, -2.0, 0.5]) / np.linalg.norm([1.0, -2.0, 0.5])
ANGLE = 1.1
M, R_CM = 1.5, (0.1, 0.05, -0.04)
INERTIA = np.array([[0.02, 0.001, 0.0], [0.001, 0.03, -0.002], [0.0, -0.002, 0.04]])
SPIN = np.array([1.0, 2.0, 1.5])
RUBBER = {"length": 0.5, "E": 1e7, "rho": 1000.0, "A": 1e-3, "J": 1e-7, "reference": "pinned", "beta": 1e-4}


class Scene(Model):
    """Gravity, a place that may be turned and shifted with it, and a body that moves."""

    moved = structural("whether the scene is turned and shifted", default=False)
    turned = structural("whether the component is connected the other way round", default=False)

    @property
    def turn(self) -> Rotation:
        return Rotation.from_rotvec(ANGLE * AXIS * self.moved)

    @part
    def world(self):
        return World(n=tuple(self.turn.apply([0.0, -1.0, 0.0])))

    @part
    def place(self):
        return FixedRotation(r=tuple(SHIFT * self.moved), n=tuple(AXIS), angle=ANGLE * self.moved)

    @part
    def tip(self):
        return Body(m=M, r_CM=R_CM, I=INERTIA)

    def through(self, component: Any) -> tuple[Any, Any]:
        """First and second end on the way from the place."""
        a, b = component.ends
        ends = getattr(component, a), getattr(component, b)
        return ends[::-1] if self.turned else ends

    def path(self, *members: Any):
        """Chain from the place to the tip, component under test turned round where it is asked for."""
        last = self.place.frame_b
        for member in members:
            first, second = (
                self.through(member)
                if member is getattr(self, "it", None)
                else (
                    member.frame_a,
                    member.frame_b,
                )
            )
            yield connect(last, first)
            last = second
        yield connect(last, self.tip.frame_a)

    def connections(self):
        yield chain(self.world, self.place)
        yield from self.graph()


class OnSpherical(Scene):
    """place - spherical joint - it - tip."""

    joint = Spherical(angles_fixed=True, w_rel_a=fixed(tuple(SPIN)))

    def graph(self):
        yield from self.path(self.joint, self.it)


class Plain(Scene):
    joint = Spherical(angles_fixed=True, w_rel_a=fixed(tuple(SPIN)))

    def graph(self):
        yield from self.path(self.joint)


class OnFixed(Plain):
    """A spring to a point that Fixed holds."""

    spring = Spring(c=40.0, s_unstretched=0.2)
    arm = FixedTranslation(r=(0.3, 0.1, 0.0))

    @part
    def it(self):
        return Fixed(r=tuple(self.turn.apply([0.4, -0.6, 0.3]) + SHIFT * self.moved))

    def graph(self):
        yield from super().graph()
        yield connect(self.tip.frame_a, self.arm.frame_a)
        yield connect(self.arm.frame_b, self.spring.frame_a)
        yield connect(self.it.frame_b, self.spring.frame_b)


class OnTranslation(OnSpherical):
    @part
    def it(self):
        return FixedTranslation(r=tuple(np.array([0.3, -0.2, 0.4]) * (-1 if self.turned else 1)))


class OnRotation(OnSpherical):
    @part
    def it(self):
        r, n = np.array([0.3, -0.2, 0.4]), np.array([1.0, 2.0, 2.0]) / 3
        if self.turned:
            return FixedRotation(r=tuple(-Rotation.from_rotvec(-0.7 * n).apply(r)), n=tuple(n), angle=-0.7)
        return FixedRotation(r=tuple(r), n=tuple(n), angle=0.7)


class OnBodyShape(OnSpherical):
    @part
    def it(self):
        r, r_CM = np.array([0.3, -0.2, 0.4]), np.array([0.2, 0.1, 0.1])
        sign, centre = (-1, r_CM - r) if self.turned else (1, r_CM)
        return BodyShape(r=tuple(sign * r), r_CM=tuple(centre), m=2.0, I=INERTIA)


class OnBodyBox(OnSpherical):
    @part
    def it(self):
        r = np.array([0.3, -0.2, 0.4]) * (-1 if self.turned else 1)
        return BodyBox(r=tuple(r), width=0.05, height=0.08, width_direction=(0.0, 1.0, 1.0))


class OnBodyCylinder(OnSpherical):
    @part
    def it(self):
        r = np.array([0.3, -0.2, 0.4]) * (-1 if self.turned else 1)
        return BodyCylinder(r=tuple(r), diameter=0.08, inner_diameter=0.05)


class OnBodyRod(OnSpherical):
    @part
    def it(self):
        r = np.array([0.3, -0.2, 0.4]) * (-1 if self.turned else 1)
        return BodyRod(r=tuple(r), m=2.0)


class OnPlanarLoop(Scene):
    """A four-bar in the xy plane of the place; the tip rides on the coupler."""

    first, second, third = Revolute(phi=fixed(0), w=fixed(3.0)), Revolute(), Revolute()
    crank, coupler, rocker = BodyRod(r=(0.2, 0, 0), m=1), BodyRod(r=(0.1, 0.5, 0), m=1), BodyRod(r=(0.4, 0.05, 0), m=1)
    ground = FixedTranslation(r=(-0.1, 0.45, 0))
    it = RevolutePlanarLoopConstraint()

    def graph(self):
        a, b = self.through(self.it)
        yield chain(self.place, self.first, self.crank, self.second, self.coupler, self.tip)
        yield chain(self.place, self.ground, self.third, self.rocker, b)
        yield connect(self.coupler.frame_b, a)


class OnRevolute(Scene):
    @part
    def it(self):
        s = -1 if self.turned else 1
        return Revolute(n=(0, 1, 2), phi=fixed(0.4 * s), w=fixed(3.0 * s), d=0.02, tau_dry=0.05, w_dry=0.5)

    def graph(self):
        yield from self.path(self.it)


BRAKE = ac.quantity(3.0, "N.s/m")


class Rod(Component):
    """A drive rod that pushes with a force that varies and is braked, as a flange's neighbour in a scene."""

    ends = ("flange", "flange")
    flange = ac.port(TranslationalFlange, "rod")
    v = ac.variable("speed", unit="m/s")

    def equations(self):
        yield self.v == ac.der(self.flange.s)
        yield self.flange.f == -20 * sin(5 * time) + BRAKE * self.v

    def supplied_power(self):
        """Power of the push."""
        return 20 * sin(5 * time) * self.v

    def dissipated_power(self):
        """Power of the brake."""
        return BRAKE * self.v**2


class OnPrismatic(OnSpherical):
    """The joint slides on a body that turns; a spring keeps it near."""

    use_axis_flange = structural("whether the joint has a drive rod", default=False)
    base = Body(m=2.0, I=np.diag([0.1, 0.2, 0.15]))
    spring = Spring(c=60.0, s_unstretched=0.2)

    @part
    def it(self):
        s = -1 if self.turned else 1
        drive = {"compliance": 2e-3, "f": fixed(5.0), "use_axis_flange": True} if self.use_axis_flange else {}
        return Prismatic(n=(1, 2, 2), s=fixed(0.3 * s), v=fixed(0.5 * s), d=0.5, f_dry=0.4, v_dry=0.2, **drive)

    def graph(self):
        yield from super().graph()
        yield connect(self.joint.frame_b, self.base.frame_a)
        yield connect(self.base.frame_a, self.spring.frame_a)
        yield connect(self.spring.frame_b, self.tip.frame_a)


class OnDrivenPrismatic(OnPrismatic):
    """Not for turning round: the drive force changes its sense then."""

    use_axis_flange = structural("whether the joint has a drive rod", default=True)
    rod = Rod()

    def graph(self):
        yield from super().graph()
        yield connect(self.it.axis, self.rod.flange)


class OnSphericalJoint(Scene):
    @part
    def it(self):
        angles, sequence = (0.3, -0.2, 0.5), (1, 2, 3)
        if self.turned:
            opposite = tuple(-a for a in angles[::-1])
            w = fixed(tuple(-SPIN))
            return Spherical(angles_start=opposite, sequence_start=sequence[::-1], angles_fixed=True, w_rel=w)
        return Spherical(angles_start=angles, sequence_start=sequence, angles_fixed=True, w_rel_a=fixed(tuple(SPIN)))

    def graph(self):
        yield from self.path(self.it)


class Line(Scene):
    """A force between a point of the place and a body on an arm."""

    joint = Spherical(angles_fixed=True, w_rel_a=fixed(tuple(SPIN)))
    arm = FixedTranslation(r=(0.3, 0.2, 0.1))
    anchor = FixedTranslation(r=(0.5, -0.6, 0.2))

    def graph(self):
        yield from self.path(self.joint, self.arm)
        first, second = self.through(self.it)
        yield connect(self.place.frame_b, self.anchor.frame_a)
        yield connect(self.anchor.frame_b, first)
        yield connect(second, self.tip.frame_a)


class OnSpring(Line):
    it = Spring(c=70.0, s_unstretched=0.4)


class OnDamper(Line):
    it = Damper(d=2.0)


class OnSpringDamper(Line):
    it = SpringDamperParallel(c=70.0, d=2.0, s_unstretched=0.4)


PUSH = np.array([3.0, -2.0, 4.0])


class Between(OnSpherical):
    """A load between a body that turns and a tip that slides or turns on it."""

    base = Body(m=2.0, I=np.diag([0.1, 0.2, 0.15]))

    def load(self, kind: Any, name: str) -> Any:
        sign, frame = (-1, "frame_a") if self.turned else (1, "frame_b")
        value = tuple(sign * c * (1 + cos(6 * time)) for c in PUSH)
        return kind(resolve_in_frame=frame, **{name: value})

    def graph(self):
        yield from self.path(self.joint, self.mobile)
        yield connect(self.joint.frame_b, self.base.frame_a)
        first, second = self.through(self.it)
        yield connect(self.base.frame_a, first)
        yield connect(self.tip.frame_a, second)


class OnForce(Between):
    mobile = Prismatic(n=(1, 2, 2), s=fixed(0.3), v=fixed(0.5))

    @part
    def it(self):
        return self.load(Force, "force")


class OnTorque(Between):
    mobile = Revolute(n=(1, 2, 2), phi=fixed(0.3), w=fixed(0.5))

    @part
    def it(self):
        return self.load(Torque, "torque")


class Outside(Plain):
    """A load from outside, in one scene resolved in the world, added to one resolved in frame_b."""

    arm = FixedTranslation(r=(0.3, 0.2, 0.1))
    kind: Any = None
    what = ""

    @part
    def it(self):
        return self.kind(**{self.what: tuple(c * (1 + cos(6 * time)) for c in self.turn.apply(PUSH))})

    @part
    def own(self):
        return self.kind(resolve_in_frame="frame_b", **{self.what: tuple(c * sin(4 * time) for c in PUSH[::-1])})

    def graph(self):
        yield from self.path(self.joint, self.arm)
        yield connect(self.it.frame_b, self.tip.frame_a)
        yield connect(self.own.frame_b, self.tip.frame_a)


class OnWorldForce(Outside):
    kind, what = WorldForce, "force"


class OnWorldTorque(Outside):
    kind, what = WorldTorque, "torque"


class OnBeam(Scene):
    """Turned round, frame_b is at the joint; two half turns put x and y where they were."""

    joint = Spherical(angles_fixed=True, w_rel_a=fixed(tuple(SPIN)))

    @part
    def it(self):
        return FlexibleBeam(elements=2, **RUBBER)

    @part
    def before(self):
        return FixedRotation(n=(0, 0, 1), angle=np.pi if self.turned else 0.0)

    @part
    def after(self):
        return FixedRotation(n=(0, 0, 1), angle=np.pi if self.turned else 0.0)

    def graph(self):
        yield from self.path(self.joint, self.before, self.it, self.after)


class OnSubstructuredBeam(OnBeam):
    @part
    def it(self):
        return SubstructuredBeam(volumes=2, **RUBBER)


class Shaft(Scene):
    """A body on a revolute joint whose shaft is driven."""

    starts = structural("whether the joint has values at the start", default=True)

    @part
    def joint(self):
        start = {"phi": fixed(0.4), "w": fixed(3.0)} if self.starts else {}
        return Revolute(n=(0, 1, 2), use_axis_flange=True, **start)

    def graph(self):
        yield from self.path(self.joint)
        yield from self.drive()

    def drive(self):
        yield connect(self.joint.axis, self.through(self.it)[0])


class WithRotor(Shaft):
    rotor = rotational.Inertia(J=0.05, phi=fixed(0.1), w=fixed(-1.0))

    def drive(self):
        first, second = self.through(self.it)
        yield connect(self.joint.axis, first)
        yield connect(second, self.rotor.flange_a)


class OnShaftSpring(WithRotor):
    @part
    def it(self):
        return rotational.Spring(c=8.0, phi_rel0=-0.3 if self.turned else 0.3)


class OnShaftDamper(WithRotor):
    it = rotational.Damper(d=0.3)


class OnShaftSpringDamper(WithRotor):
    @part
    def it(self):
        return rotational.SpringDamper(c=8.0, d=0.3, phi_rel0=-0.3 if self.turned else 0.3)


class OnShaftFriction(WithRotor):
    it = rotational.Friction(tau_sliding=0.05, tau_static=0.1)


class OnShaftClutch(WithRotor):
    it = rotational.Clutch(tau_max=0.1, f_normalized=0.5)


class OnShaftFixed(Shaft):
    it = rotational.Fixed(phi0=0.2)
    spring = rotational.Spring(c=8.0)

    def drive(self):
        yield chain(self.joint.axis, self.spring, self.it.flange)


class OnShaftInertia(Shaft):
    it = rotational.Inertia(J=0.05)
    torque = rotational.Torque(tau=sin(3 * time))

    def drive(self):
        first, second = self.through(self.it)
        yield connect(self.joint.axis, first)
        yield connect(second, self.torque.flange)


class OnShaftTorque(Shaft):
    it = rotational.Torque(tau=2 * sin(3 * time))


class Prescribed(Shaft):
    """A drive that prescribes the motion, and a rotor on a spring that answers."""

    starts = structural("whether the joint has values at the start", default=False)
    spring = rotational.Spring(c=8.0)
    rotor = rotational.Inertia(J=0.05, phi=fixed(0.1), w=fixed(-1.0))

    def drive(self):
        yield from super().drive()
        yield chain(self.joint.axis, self.spring, self.rotor)


class OnShaftPosition(Prescribed):
    it = rotational.Position(phi_ref=0.4 + 0.5 * sin(3 * time))


class OnShaftSpeed(Prescribed):
    it = rotational.Speed(w_ref=2 * cos(3 * time), phi=fixed(0.4))


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
    "Spherical": OnSphericalJoint,
    "Spring": OnSpring,
    "Damper": OnDamper,
    "SpringDamperParallel": OnSpringDamper,
    "Force": OnForce,
    "Torque": OnTorque,
    "WorldForce": OnWorldForce,
    "WorldTorque": OnWorldTorque,
    "FlexibleBeam": OnBeam,
    "SubstructuredBeam": OnSubstructuredBeam,
    "rotational.Spring": OnShaftSpring,
    "rotational.Damper": OnShaftDamper,
    "rotational.SpringDamper": OnShaftSpringDamper,
    "rotational.Friction": OnShaftFriction,
    "rotational.Clutch": OnShaftClutch,
    "rotational.Fixed": OnShaftFixed,
    "rotational.Inertia": OnShaftInertia,
    "rotational.Torque": OnShaftTorque,
    "rotational.Position": OnShaftPosition,
    "rotational.Speed": OnShaftSpeed,
}
TURNED = SCENES | {"Prismatic": OnPrismatic}
BASES = {
    "DrivenJoint",
    "LineForce",
    "TwoFrameBody",
    "TwoFrames",
    "TwoFlanges",
    "rotational.Compliant",
    "rotational.OneFlange",
}
BASES |= {"rotational.TwoFlanges", "rotational.Slipping"}


def exported() -> dict[str, type]:
    """All component, connector and record classes that components and components.rotational export."""
    found = {name: getattr(components, name) for name in components.__all__}
    found |= {f"rotational.{name}": getattr(rotational, name) for name in rotational.__all__}
    return {name: c for name, c in found.items() if inspect.isclass(c) and issubclass(c, Component)}


EXPORTED = exported()
SIDED = [name for name in SCENES if issubclass(EXPORTED[name], TwoFrames | TwoFlanges)]
DISSIPATING = {"Damper", "SpringDamperParallel", "Revolute", "Prismatic", "FlexibleBeam", "SubstructuredBeam"}
DISSIPATING |= {"rotational.Damper", "rotational.SpringDamper", "rotational.Friction", "rotational.Clutch"}
SUPPLYING = {"Force", "Torque", "WorldForce", "WorldTorque", "Prismatic", "rotational.Inertia", "rotational.Torque"}
SUPPLYING |= {"rotational.Position", "rotational.Speed"}


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
            model(moved=moved, turned=turned), stop_time=0.5, tolerance=1e-9, intervals=10, energy=True
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
def test_scene_holds_the_component(name):
    tree = ac.compile(SCENES[name]()).tree
    part = {"World": "world", "Body": "tip"}.get(name, "it")
    assert type(getattr(tree, part)) is EXPORTED[name]


@every(SCENES)
def test_compiles_without_surplus(name):
    compiled = ac.compile(SCENES[name]())
    report = compiled.report
    assert report["redundant_constraints"] == []
    assert report["redundant"] == 0
    assert len(compiled.states) + len(compiled.algebraic) == report["equations_reduced"]


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
    same(run(SCENES[name]), run(SCENES[name], moved=True))


@every(SIDED)
def test_turned_round(name):
    same(run(TURNED[name]), run(TURNED[name], turned=True))


@every(EXPORTED)
def test_documented(name):
    """The docstring of the class names every field of the constructor, with its unit and what it is."""
    cls = EXPORTED[name]
    text = inspect.getdoc(cls) or ""
    assert text.strip()
    section = "".join(re.findall(r"Parameters\n\s*-+\n(.*?)(?:\n\s*\n|\Z)", text, re.S))
    given = {n for n, d in cls.fields.items() if isinstance(d, f.Structural | f.Parameter)}
    given |= {n for n, d in cls.fields.items() if isinstance(d, f.Variable) and d.causality == "input"}
    missing = [n for n in given if not re.search(rf"(?<!\w){re.escape(n)}(?!\w)", section)]
    assert missing == [], text
    for n in given:
        d = cls.fields[n]
        head, said = re.search(rf"^{n} : (.*)\n((?:    .*\n?)+)", section, re.M).groups()
        assert isinstance(d.unit, str) is False or d.unit == "1" or f"in {d.unit}" in head
        assert d.description.lower() in " ".join(said.split()).lower()
    for n, d in cls.fields.items():
        assert (
            isinstance(d, f.Outer)
            or (getattr(d, "description", "") or "").strip()
            or isinstance(d, f.Part | f.Observed)
        ), n


DIMENSIONLESS = {
    ("Orientation", "T"),
    ("Frame", "Q"),
    ("Spherical", "Q"),
    ("Friction", "mode"),
    ("Slipping", "mode"),
    ("Clutch", "mode"),
    ("Clutch", "f_normalized"),
    ("Clutch", "peak"),
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
