"""Machines of ModelicaTest.MultiBody.Joints, and of the elementary examples."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest

from acausal import Model, Scalar, chain, connect, der, fixed, guess, sine, variable
from components import (
    Body,
    BodyShape,
    Cylindrical,
    Fixed,
    FixedTranslation,
    FreeMotion,
    FreeMotionScalarInit,
    LineForce,
    Planar,
    Prismatic,
    Revolute,
    Spring,
    Universal,
    World,
    rotational,
    translational,
)
from tests.reference.msl.published import compare

JOINTS = "ModelicaTest.MultiBody.Joints."
ELEMENTARY = "Modelica.Mechanics.MultiBody.Examples.Elementary."


class OnJoint(Model):
    """A body on one joint."""

    world, body = World(), Body(m=1)

    def connections(self):
        yield chain(self.world, self.joint, self.body)


class OnCylindrical(OnJoint):
    joint = Cylindrical(n=(0, 0, 1), phi=fixed(pi / 4), s=fixed(0.3), v=fixed(0), w=fixed(0))
    body = Body(m=1, I=np.diag([0, 0, 1e-3]))  # without inertia nothing determines its angle


class OnPlanar(OnJoint):
    joint = Planar(
        n=(0, 1, 0),
        n_x=(0, 0, 1),
        phi=fixed(pi / 4),
        s_x=fixed(0.5),
        s_y=fixed(0.5),
        v_x=fixed(0),
        v_y=fixed(0),
        w=fixed(0),
    )
    body = Body(m=1, I=np.diag([0, 1e-3, 0]))


class OnPrismatic(OnJoint):
    joint = Prismatic(n=(1, 1, 0), s=fixed(0.3), v=fixed(0))


class OnUniversal(OnJoint):
    joint = Universal(n_a=(0, 0, 1), phi_a=fixed(pi / 2), phi_b=fixed(pi / 4), w_a=fixed(0), w_b=fixed(0))
    body = Body(m=1, r_CM=(0.5, 0, 0), I=1e-3 * np.eye(3))


@pytest.mark.parametrize("model", [OnCylindrical, OnPlanar, OnPrismatic])
def test_one_joint(model):
    kind = model.__name__[2:]
    variables = {"Cylindrical": "phi s v w", "Planar": "phi s_x s_y v_x v_y w", "Prismatic": "s v"}[kind].split()
    compare(JOINTS + kind, model(), {f"{kind.lower()}.{v}": f"joint.{v}" for v in variables})


class FreelyMoving(OnJoint):
    joint = FreeMotion(
        angles_start=(pi / 4,) * 3,
        angles_fixed=True,
        r_rel_a=fixed((0.5, 0.4, 0)),
        v_rel_a=fixed((0, 0, 0)),
        w_rel_a=fixed((0, 0, 0)),
    )
    body = Body(m=1, I=1e-3 * np.eye(3))


def test_free_motion():
    names = {f"freeMotion.{v}[{k}]": f"joint.{v}[{k}]" for v in ("r_rel_a", "v_rel_a", "Q") for k in (1, 2, 3, 4)}
    names |= {f"freeMotion.w_rel_b[{k}]": f"joint.w_rel[{k}]" for k in (1, 2, 3)}
    compare(JOINTS + "FreeMotion", FreelyMoving(), names)


def scalar(**values):
    """Joint whose acceleration and speeds vanish at the start, which is sought below the spring."""
    rest = {f"{name}_{k}": fixed(0) for name in ("v_rel_a", "a_rel_a", "angle_d") for k in (1, 2, 3)}
    return FreeMotionScalarInit(use_angle=True, r_rel_a_2=guess(-0.4), **rest, **values)


class AtRest(OnJoint):
    joint = scalar(**{f"angle_{k}": fixed(pi / 4) for k in (1, 2, 3)})
    body, spring = Body(m=1, I=1e-3 * np.eye(3)), Spring(c=100)

    def connections(self):
        yield from super().connections()
        yield chain(self.world, self.spring, self.body)


class AtAnyAngle(AtRest):
    joint = scalar(**{f"angle_{k}": guess(pi / 4) for k in (1, 2, 3)}, **{f"angle_dd_{k}": fixed(0) for k in (1, 2, 3)})


@pytest.mark.parametrize("number", [3, 4])
def test_free_motion_scalar_init(number):
    """In the fourth, the angular accelerations vanish at any angles: those of the guess remain."""
    values = [f"{v}_{k}" for v in ("angle", "r_rel_a", "v_rel_a") for k in (1, 2, 3)]
    names = {f"freeMotionScalarInit.{v}": f"joint.{v}" for v in values}
    names |= {f"freeMotionScalarInit.derdd[{k}].u": f"joint.angle_d_{k}" for k in (1, 2, 3)}
    model, initial = (AtRest(), "fixed") if number == 3 else (AtAnyAngle(), "guesses")
    compare(JOINTS + f"FreeMotionScalarInit{number}", model, names, initial=initial)


class UnknownSpring(LineForce):
    """A spring whose constant follows from the start."""

    c: Scalar = variable("spring constant", unit="N/m", start=20, nominal=20)
    s_unstretched: Scalar = variable("unstretched length", unit="m")

    def law(self):
        yield der(self.c) == 0
        yield self.s_unstretched == 0.1
        yield self.f == self.c * (self.s - self.s_unstretched)


class PrismaticInit(Model):
    """The constant of the spring is the one at which the body stays where it starts."""

    world, body, spring = World(), Body(m=1), UnknownSpring(c=guess(20))
    prismatic = Prismatic(n=(1, -1, 0), s=fixed(0.3), v=fixed(0), a=fixed(0))
    bar = FixedTranslation(r=(sqrt(0.045), 0, 0))

    def connections(self):
        yield chain(self.world, self.prismatic, self.body)
        yield chain(self.world, self.bar, self.spring, self.body)


def test_prismatic_init():
    compare(JOINTS + "PrismaticInit", PrismaticInit())


class RevoluteInitialization(Model):
    world, rev = World(), Revolute(use_axis_flange=True, phi=fixed(0), w=fixed(0), a=fixed(0))
    damper, body = rotational.Damper(d=0.1), BodyShape(r=(1, 0, 0), r_CM=(0.5, 0, 0), m=1)
    ceiling, spring = Fixed(r=(1, 0.2, 0)), UnknownSpring(c=guess(100))

    def connections(self):
        yield chain(self.world, self.rev, self.body)
        yield chain(self.rev.support, self.damper, self.rev.axis)
        yield chain(self.ceiling, self.spring, self.body.frame_b)


def test_revolute_initialization():
    compare(JOINTS + "RevoluteInitialization", RevoluteInitialization())


class SpringMassSystem(Model):
    world, body1, body2 = World(), Body(m=1), Body(m=1)
    p1 = Prismatic(n=(0, -1, 0), use_axis_flange=True, s=fixed(0.1), v=fixed(0))
    p2 = Prismatic(n=(0, -1, 0), s=fixed(0.1), v=fixed(0))
    bar1, bar2 = FixedTranslation(r=(0.3, 0, 0)), FixedTranslation(r=(0.3, 0, 0))
    spring1, spring2 = translational.Spring(c=30, s_rel0=0.1), Spring(c=30, s_unstretched=0.1)

    def connections(self):
        yield chain(self.world, self.bar1, self.p1, self.body1)
        yield chain(self.bar1, self.bar2, self.p2, self.body2)
        yield chain(self.p1.support, self.spring1, self.p1.axis)
        yield chain(self.bar2, self.spring2, self.body2)


def test_spring_mass_system():
    compare(ELEMENTARY + "SpringMassSystem", SpringMassSystem())


class Surfaces(Model):
    world, prismatic = World(n=(0, 0, -1)), Prismatic(use_axis_flange=True)
    position = translational.Position(s_ref=sine(amplitude=2, f=0.5), exact=False)

    def connections(self):
        yield connect(self.world.frame_b, self.prismatic.frame_a)
        yield connect(self.position.flange, self.prismatic.axis)


def test_surfaces():
    compare(ELEMENTARY + "Surfaces", Surfaces())


def test_universal():
    compare(
        JOINTS + "Universal", OnUniversal(), {f"universal.{v}": f"joint.{v}" for v in ("phi_a", "phi_b", "w_a", "w_b")}
    )
