"""Joints, each in a scene."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Component, chain, connect, fixed, guess, part, sin, structural, time
from components import (
    Body,
    BodyRod,
    Cylindrical,
    FixedTranslation,
    FreeMotion,
    FreeMotionScalarInit,
    Planar,
    Prismatic,
    Revolute,
    RevolutePlanarLoopConstraint,
    Spherical,
    SphericalSpherical,
    Spring,
    TranslationalFlange,
    Universal,
    UniversalSpherical,
)
from tests.components.scenes.scene import SPIN, OnSpherical, Scene


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


class OnUniversal(Scene):
    @part
    def it(self):
        a, b = {"n": (1, 2, 0), "phi": 0.3, "w": 2.0}, {"n": (0, 1, 1), "phi": -0.4, "w": -1.5}
        if self.turned:
            a, b = ({**x, "phi": -x["phi"], "w": -x["w"]} for x in (b, a))
        start = {"phi_a": fixed(a["phi"]), "phi_b": fixed(b["phi"]), "w_a": fixed(a["w"]), "w_b": fixed(b["w"])}
        return Universal(n_a=a["n"], n_b=b["n"], **start)

    def graph(self):
        yield from self.path(self.it)


class OnCylindrical(OnSpherical):
    """The joint slides and turns on a body that turns; a spring keeps it near."""

    base = Body(m=2.0, I=np.diag([0.1, 0.2, 0.15]))
    spring = Spring(c=60.0)

    @part
    def it(self):
        sign = -1 if self.turned else 1
        start = {"s": 0.3, "v": 0.5, "phi": 0.4, "w": 3.0}
        return Cylindrical(n=(1, 2, 2), **{name: fixed(sign * value) for name, value in start.items()})

    def graph(self):
        yield from super().graph()
        yield connect(self.joint.frame_b, self.base.frame_a)
        yield connect(self.base.frame_a, self.spring.frame_a)
        yield connect(self.spring.frame_b, self.tip.frame_a)


class OnPlanar(OnCylindrical):
    """Turned round, the directions in the plane turn with the tip; there the start is that of the same motion."""

    @part
    def it(self):
        s_x, s_y, phi, v_x, v_y, w = 0.3, 0.1, 0.4, 0.5, -0.3, 3.0
        if self.turned:
            (s_x, s_y), (v_x, v_y) = seen_from_the_other(phi, w, (s_x, s_y), (v_x, v_y))
            phi, w = -phi, -w
        start = {"s_x": s_x, "s_y": s_y, "phi": phi, "v_x": v_x, "v_y": v_y, "w": w}
        return Planar(n=(1, 2, 2), n_x=(2, -1, 1), **{name: fixed(value) for name, value in start.items()})


def seen_from_the_other(phi: float, w: float, s, v):
    """Position and velocity of frame_a in the axes of frame_b, in a plane: -T s, and its derivative."""
    T = np.array([[np.cos(phi), np.sin(phi)], [-np.sin(phi), np.cos(phi)]])
    rate = w * np.array([[-np.sin(phi), np.cos(phi)], [-np.cos(phi), -np.sin(phi)]])
    return -T @ s, -T @ v - rate @ s


class OnFreeMotion(Scene):
    @part
    def it(self):
        angles, sequence = (0.3, -0.2, 0.5), (1, 2, 3)
        r, v = np.array([0.1, 0.2, -0.1]), np.array([0.5, 1.0, 0.3])
        if self.turned:
            T = Rotation.from_euler("XYZ", angles).as_matrix().T  # from frame_a to frame_b
            start = {"angles_start": tuple(-a for a in angles[::-1]), "sequence_start": sequence[::-1]}
            start |= {"w_rel": fixed(tuple(-SPIN)), "r_rel_a": fixed(tuple(-T @ r))}
            return FreeMotion(**start, v_rel_a=fixed(tuple(-T @ (v - np.cross(SPIN, r)))), angles_fixed=True)
        start = {"angles_start": angles, "sequence_start": sequence, "w_rel_a": fixed(tuple(SPIN))}
        return FreeMotion(**start, r_rel_a=fixed(tuple(r)), v_rel_a=fixed(tuple(v)), angles_fixed=True)

    def graph(self):
        yield from self.path(self.it)


class OnFreeMotionScalarInit(Scene):
    """Turned round, the angles are those of the same motion seen from the tip."""

    @part
    def it(self):
        angles, sequence, w = (0.3, -0.2, 0.5), (1, 2, 3), SPIN
        r, v = np.array([0.1, 0.2, -0.1]), np.array([0.5, 1.0, 0.3])
        if self.turned:
            turn = Rotation.from_euler("XYZ", angles)  # from frame_a to frame_b
            r, v = -turn.inv().apply(r), -turn.inv().apply(v - np.cross(turn.apply(w), r))
            angles, sequence, w = tuple(-a for a in angles[::-1]), (3, 2, 1), -turn.apply(w)
        values = {"r_rel_a": r, "v_rel_a": v, "angle": angles, "w_rel_b": w}
        start = {f"{name}_{k + 1}": fixed(value[k]) for name, value in values.items() for k in range(3)}
        return FreeMotionScalarInit(use_angle=True, sequence_start=sequence, **start)

    def graph(self):
        yield from self.path(self.it)


class OnSphericalSpherical(Scene):
    """A crank that carries the tip drives a slide through the rod."""

    joint, arm = Revolute(n=(1, 0, 0), phi=fixed(0.2), w=fixed(5.0)), FixedTranslation(r=(0, 0.5, 0.1))
    rail, slide = FixedTranslation(r=(1, 0, 0)), Prismatic(n=(1, 0, 0), s=guess(0))
    lever, base = FixedTranslation(r=(0, 0.2, 0)), Body(m=2.0)

    @part
    def it(self):
        return SphericalSpherical(rod_length=1.05, m=0.8)

    def graph(self):
        yield from self.path(self.joint, self.arm)
        yield chain(self.place, self.rail, self.slide, self.lever, self.base)
        first, second = self.through(self.it)
        yield connect(self.arm.frame_b, first)
        yield connect(self.lever.frame_b, second)


class OnUniversalSpherical(OnSphericalSpherical):
    """Turned round, the universal joint is at the other end."""

    @part
    def it(self):
        return UniversalSpherical(n1_a=(0, 1, 0), r_rod_ia=(1.05, 0, 0))
