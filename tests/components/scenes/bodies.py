"""Rigid bodies, frames and beams, each in a scene."""

from __future__ import annotations

from functools import cache

import numpy as np
from scipy.spatial.transform import Rotation

from acausal import chain, connect, fixed, part
from components import (
    BodyBox,
    BodyCylinder,
    BodyRod,
    BodyShape,
    Fixed,
    FixedRotation,
    FixedTranslation,
    FlexibleBeam,
    PointMass,
    Spherical,
    Spring,
    SubstructuredBeam,
)
from components.fe import FEBody, ReducedBody, box, reduce_body
from tests.components.scenes.scene import INERTIA, RUBBER, SHIFT, SPIN, OnSpherical, Plain, Scene


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


class OnPointMass(Plain):
    """A point mass on an arm at the tip."""

    arm, it = FixedTranslation(r=(0.3, 0.1, 0.0)), PointMass(m=0.4)

    def graph(self):
        yield from super().graph()
        yield chain(self.tip.frame_a, self.arm, self.it)


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


class OnFEBody(OnSpherical):
    """Turned round, its second end is at the joint, and it lies the other way."""

    @part
    def it(self):
        return FEBody(reduced=rod(self.turned), damping_ratio=0.02)


@cache
def rod(turned: bool) -> ReducedBody:
    """A rubber rod in the frame of its first end; where it is turned round, that is its end far from the origin."""
    size = (0.5, 0.04, 0.03)
    M, K, nodes = box(size, (4, 1, 1), "hex8", E=6e7, nu=0.3, rho=1000.0)
    first, last = (np.flatnonzero(np.isclose(nodes[:, 0], x)) for x in (0, size[0]))
    frames = {"frame_a": last, "frame_b": first} if turned else {"frame_a": first, "frame_b": last}
    return reduce_body(M, K, nodes, frames=frames, hold="frame_b" if turned else "frame_a", modes=4)


class OnSubstructuredBeam(OnBeam):
    @part
    def it(self):
        return SubstructuredBeam(volumes=2, **RUBBER)
