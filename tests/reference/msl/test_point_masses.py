"""Point masses and gravity of Modelica.Mechanics.MultiBody.Examples.Elementary and ModelicaTest.MultiBody.Parts."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from acausal import Model, chain, connect, fixed, quantity
from components import Body, FixedTranslation, FreeMotion, PointMass, Revolute, Spring, World, rotational
from tests.reference.msl.published import compare

ELEMENTARY = "Modelica.Mechanics.MultiBody.Examples.Elementary."


def thrown(r, v):
    return PointMass(m=1, r_0=fixed(r), v_0=fixed(v))


class Orbits(Model):
    world, spring = World(gravity="point", mu=1), Spring(c=10)
    body1, body2 = thrown((0, 0.6, 0), (1, 0, 0)), thrown((0.6, 0.6, 0), (0.6, 0, 0))
    body3, body4 = thrown((0, 0.8, 0), (0.6, 0, 0)), thrown((0.3, 0.8, 0), (0.6, 0, 0))

    def connections(self):
        yield chain(self.body3.frame_a, self.spring, self.body4)


def test_point_gravity_with_point_masses():
    compare(ELEMENTARY + "PointGravityWithPointMasses", Orbits())


DIRECTIONS = ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))


class Star(Model):
    """Six masses on a star, as point masses on a free joint, and as bodies without inertia."""

    world, joint = (
        World(gravity="point", mu=5),
        FreeMotion(r_rel_a=fixed((2, 0, 0)), v_rel_a=fixed((0, 0, -1)), w_rel_a=fixed((0, 0, 0)), angles_fixed=True),
    )
    arms = tuple(FixedTranslation(r=r) for r in DIRECTIONS)
    masses = tuple(PointMass(m=1) for _ in DIRECTIONS)
    others = tuple(FixedTranslation(r=r) for r in DIRECTIONS)
    first = Body(m=1, r_0=fixed((3, 0, 0)), v_0=fixed((0, 0, -1)), w_a=fixed((0, 0, 0)), angles_fixed=True)
    bodies = tuple(Body(m=1) for _ in DIRECTIONS[1:])

    def connections(self):
        yield chain(self.world, self.joint)
        for arm, mass in zip(self.arms, self.masses, strict=True):
            yield chain(self.joint, arm, mass)
        for other, body in zip(self.others, (self.first, *self.bodies), strict=True):
            yield chain(other, body)
        for other in self.others[1:]:
            yield connect(self.others[0].frame_a, other.frame_a)


def star_by_hand(times):
    """Positions and velocities of the star's centre: Newton and Euler for six masses of 1 kg, whose inertia is 4 kg.m2."""

    def rates(_, y):
        r, v, Q, w = y[:3], y[3:6], Rotation.from_quat(y[6:10]), y[10:]
        arms = Q.apply(DIRECTIONS)
        places = r + arms
        forces = -5 * places / np.linalg.norm(places, axis=1)[:, None] ** 3
        e, s = y[6:9], y[9]
        rate = np.array([*(s * w + np.cross(w, e)), -w @ e]) / 2
        return np.concatenate([v, forces.sum(axis=0) / 6, rate, np.cross(arms, forces).sum(axis=0) / 4])

    start = np.array([2, 0, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, 0], dtype=float)
    return solve_ivp(rates, (0, times[-1]), start, method="DOP853", rtol=1e-11, atol=1e-12, t_eval=times).y[:6].T


def test_point_gravity_with_a_star_of_masses():
    """The published velocities are off by 1.4e-3 of their range, ours by less than 1e-6."""
    names = {f"freeMotion.{v}[{k}]": f"joint.{v}[{k}]" for v in ("r_rel_a", "v_rel_a") for k in (1, 2, 3)}
    for number, body in ((1, "first"), (3, "bodies[1]"), (6, "bodies[4]")):
        names |= {
            f"referenceSystem.pointMass{number}.{v}[{k}]": f"{body}.{v}[{k}]"
            for v in ("w_a", "v_0", "frame_a.r_0")
            for k in (1, 2, 3)
        }
    result = compare(ELEMENTARY + "PointGravityWithPointMasses2", Star(), names, tolerance=1.5e-3, run=1e-11)
    right = star_by_hand(result.time)
    np.testing.assert_allclose(np.hstack([result["joint.r_rel_a"], result["joint.v_rel_a"]]), right, atol=3e-6)


def normal_gravity(r):
    """Normal gravity of the reference ellipsoid of 1984 at the equator, at the height r[1], in m/s2."""
    f, m = 1 / 298.257223563, 7292115e-11**2 * 6378137.0**2 * 6356752.3142 / 3986004.418e8
    height = r[1] / quantity(6378137.0, "m")
    g = quantity(9.7803253359, "m/s2") * (1 - height * (2 * (1 + f + m) + 3 * height))
    return (0, -g, 0)


class Swing(Model):
    world, mast = World(gravity=normal_gravity), FixedTranslation(r=(0, 20, 0))
    rev, damper = Revolute(use_axis_flange=True, phi=fixed(0), w=fixed(0)), rotational.Damper(d=0.1)
    body = Body(m=1000, r_CM=(10, 0, 0), I=1e-3 * np.eye(3))

    def connections(self):
        yield chain(self.world, self.mast, self.rev, self.body)
        yield chain(self.rev.support, self.damper, self.rev.axis)


def test_user_defined_gravity_field():
    compare(ELEMENTARY + "UserDefinedGravityField", Swing())


class Pendulum(Model):
    world, rev = World(), Revolute(phi=fixed(0), w=fixed(0))
    bar, mass = FixedTranslation(r=(1, 0, 0)), PointMass(m=5)

    def connections(self):
        yield chain(self.world, self.rev, self.bar, self.mass)


def test_point_mass():
    compare("ModelicaTest.MultiBody.Parts.PointMass", Pendulum())
