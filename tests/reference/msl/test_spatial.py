"""Pendulums and rods in space, whose angles leave the range of Cardan angles: ModelicaTest.MultiBody."""

from __future__ import annotations

from math import pi

import casadi as ca
import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Model, chain, connect, fixed, guess
from components import (
    Body,
    BodyBox,
    BodyCylinder,
    Fixed,
    FixedTranslation,
    Prismatic,
    Spherical,
    Universal,
    UniversalSpherical,
    World,
    WorldTorque,
)
from components.assemblies import JointUSR
from components.rotational import Damper
from tests.reference.msl.published import compare, published

ROD = np.array([-1, 0.3, -0.1])
JOINTS = "ModelicaTest.MultiBody.Joints."


def quaternion(result, frame):
    """Quaternion of a frame at all times, without jumps of sign."""
    Q = Rotation.from_matrix(np.swapaxes(result[f"{frame}.R.T"], 1, 2)).as_quat()
    flips = np.sign(np.sum(Q[1:] * Q[:-1], axis=1))
    return Q * np.cumprod([np.sign(Q[0, 3]), *flips])[:, None]


def cardan(result, joint):
    """Angles of a ball joint about x, y, z, and their rates."""
    phi = np.unwrap(Rotation.from_quat(result[f"{joint}.Q"]).as_euler("XYZ"), axis=0)
    (c2, c3), (s2, s3) = np.cos(phi[:, 1:]).T, np.sin(phi[:, 1:]).T
    zero = np.zeros_like(c2)
    # w resolved in frame_b: the first axis turned by the second and third angle, the second by the third, the third.
    axes = np.array([[c2 * c3, s3, zero], [-c2 * s3, c3, zero], [s2, zero, zero + 1]])
    return phi, np.linalg.solve(np.moveaxis(axes, 2, 0), result[f"{joint}.w_rel"][:, :, None])[:, :, 0]


def columns(name, values):
    """Published names of the columns of a function of the result."""
    return {f"{name}[{k + 1}]": (lambda r, k=k: values(r)[:, k]) for k in range(4)}


class DoublePendulum(Model):
    """Two boxes on ball joints."""

    world = World()
    ball1 = Spherical(angles_fixed=True, w_rel_a=fixed((0.05235987755982989, 0.03490658503988659, 0.0174532925199433)))
    ball2 = Spherical(angles_fixed=True, w_rel_a=fixed((0, 0, 0)))
    box1, box2 = BodyBox(r=(0.4, 0, -0.3), width=0.06), BodyBox(r=(0.3, -0.4, 0), width=0.06)

    def connections(self):
        yield chain(self.world, self.ball1, self.box1, self.ball2, self.box2)


def test_spherical_double_pendulum():
    """Published three times: by Cardan angles, by quaternions of the joints and by those of the bodies."""
    names = {}
    for k in (1, 2):
        names |= columns(f"Spherical{k}.phi", lambda r, k=k: cardan(r, f"ball{k}")[0])
        names |= columns(f"Spherical{k}.phi_d", lambda r, k=k: cardan(r, f"ball{k}")[1])
        names |= {f"Spherical{k + 2}.{v}[{i}]": f"ball{k}.{v}[{i}]" for v in ("Q", "w_rel") for i in (1, 2, 3, 4)}
        names |= columns(f"boxBody{k + 4}.body.Q", lambda r, k=k: quaternion(r, f"box{k}.frame_a"))
        names |= {f"boxBody{k + 4}.body.w_a[{i}]": f"box{k}.w_a[{i}]" for i in (1, 2, 3)}
    compare("ModelicaTest.MultiBody.SphericalDoublePendulum", DoublePendulum(), names, run=1e-9)


class Twisted(Model):
    """A bar on a universal joint, under a torque."""

    world, universal = World(), Universal(phi_a=fixed(0), phi_b=fixed(0), w_a=fixed(0), w_b=fixed(0))
    bar, torque = BodyCylinder(r=(1, 0, 0)), WorldTorque(torque=(2, 3, 4))

    def connections(self):
        yield chain(self.world, self.universal, self.bar)
        yield connect(self.universal.frame_b, self.torque.frame_b)


def test_torque_on_a_universal_joint():
    compare(JOINTS + "CheckConstaintTorqueUniversalJoint", Twisted())


class Held(Model):
    """An assembly between two points that stand still."""

    world, ground = World(), Fixed(r=(1.5, 0.1, 0))
    joint = JointUSR(r_rod1_ia=(1, 0.3, 0), r_rod2_ib=(-0.5, 0.2, 0))

    def connections(self):
        yield connect(self.world.frame_b, self.joint.frame_a)
        yield connect(self.joint.frame_b, self.ground.frame_b)


def test_assembly_at_rest():
    name = JOINTS + "JointUSR"
    names = {v: v.replace("Fixed1", "ground").replace("jointUSR", "joint") for v in published()[name]}
    names |= columns("rRod1_ia", lambda r: r["joint.rod1.r_rod_0"])  # turned by nothing
    internals = tuple(
        v for v in names if v.startswith(("jointUSR.relativePosition", "jointUSR.position_b", "rRod2_ib"))
    )
    compare(name, Held(), names, internals, tolerance=1e-6, most_left_out=24)


class FourBar(Model):
    """A slide along x drives a crank with a damper through a rod, each with a body."""

    world, b3, j2 = World(), FixedTranslation(r=(1, 0, 0)), Prismatic(n=(1, 0, 0), s=fixed(0), v=fixed(-0.4))
    b2, damper = BodyCylinder(r=(0, 0.2, 0), diameter=0.05), Damper(d=0.1)
    joint = JointUSR(n1_a=(0, 1, 0), n_b=(1, 0, 0), r_rod2_ib=(0, 0.5, 0.1), r_rod1_ia=ROD, use_axis_flange=True)
    body1, body2, body3 = (
        Body(m=1, I=0.1 * np.eye(3), r_CM=r) for r in ((0.01, 0, 0), ROD / np.linalg.norm(ROD) / 2, (0, 0, 0))
    )

    def connections(self):
        yield chain(self.world, self.b3, self.j2, self.b2, self.joint)
        yield connect(self.joint.frame_b, self.world.frame_b)
        yield chain(self.joint.support, self.damper, self.joint.axis)
        yield connect(self.joint.frame_ib, self.body1.frame_a)
        yield connect(self.joint.frame_ia, self.body2.frame_a)
        yield connect(self.joint.frame_im, self.body3.frame_a)


def four_bar_by_hand(times):
    """Position and speed of the slide from the equation of the one degree of freedom, the angle phi of the crank."""
    phi, w = ca.SX.sym("phi"), ca.SX.sym("w")
    length, mass = np.linalg.norm(ROD), 7700 * pi * 0.05**2 / 4 * 0.2
    pin = ca.vertcat(0, 0.5 * ca.cos(phi) - 0.1 * ca.sin(phi), 0.5 * ca.sin(phi) + 0.1 * ca.cos(phi))
    s = ca.sqrt(length**2 - (0.2 - pin[1]) ** 2 - pin[2] ** 2) - 1
    end = ca.vertcat(1 + s, 0.2, 0)
    rod = (pin - end) / length
    centre, azimuth, elevation = end + rod / 2, ca.atan2(rod[2], -rod[0]), ca.asin(rod[1])

    def rate(x):
        return ca.jacobian(x, phi)

    moving = (
        rate(pin),
        rate(centre),
        np.sqrt(mass) * rate(s),
        np.sqrt(0.1) * rate(azimuth),
        np.sqrt(0.1) * rate(elevation),
    )
    inertia = sum(ca.sumsqr(r) for r in moving) + 0.2  # of the two bodies on the crank
    potential = 9.80665 * (pin[1] + centre[1])
    a = -(rate(inertia) * w**2 / 2 + rate(potential) + 0.1 * w) / inertia
    motion, slide = ca.Function("motion", [phi, w], [w, a]), ca.Function("slide", [phi, w], [s, rate(s) * w])
    start = (0, -0.4 / float(slide(0, 1)[1]))

    def derivative(_, y):
        return np.array(motion(*y), float).ravel()

    run = solve_ivp(derivative, (0, times[-1]), start, t_eval=times, rtol=1e-10, atol=1e-10, method="DOP853")
    return np.array([[float(x) for x in slide(*y)] for y in run.y.T])


def test_four_bar_of_an_assembly():
    """An independent integration agrees; the published run is 3.6e-3 of the range away from both, a drift in phase."""
    name = "ModelicaTest.MultiBody.FourbarVariants.JointUSR"
    data = published()[name]
    times = np.array(data["time"])
    result = ac.simulate(FourBar(), stop_time=times[-1], intervals=2000, tolerance=1e-9)
    for v, exact in zip(("j2.s", "j2.v"), four_bar_by_hand(times).T, strict=True):
        np.testing.assert_allclose(np.interp(times, result.time, result[v]), exact, atol=1e-5 * data["_range"][v])


class Rods(Model):
    """A box on a rod with a universal and a ball joint, as one part and as two."""

    world = World()
    universalSpherical, universalSpherical1 = UniversalSpherical(), UniversalSpherical()
    universal = Universal(n_a=(0, 0, 1), n_b=(0, 1, 0), phi_a=fixed(0), phi_b=fixed(pi), w_a=fixed(0), w_b=fixed(0))
    bar, ball = (
        FixedTranslation(r=(-1, 0, 0)),
        Spherical(angles_start=(0, pi, 0), angles_fixed=True, w_rel_a=fixed((0, 0, 0))),
    )
    bodyBox1 = BodyBox(r=(0.5, 0, 0), width=0.1, height=0.1)
    bodyBox, bodyBox2 = (
        BodyBox(r=(0.5, 0, 0), width=0.1, height=0.1, r_0=guess((1, 0, 0)), angles_fixed=True, w_a=fixed((0, 0, 0)))
        for _ in range(2)
    )

    def connections(self):
        yield chain(self.world, self.universalSpherical, self.bodyBox)
        yield chain(self.world, self.universal, self.bar, self.ball, self.bodyBox1)
        yield chain(self.world, self.universalSpherical1, self.bodyBox2)

    def initial_equations(self):
        for body in (self.bodyBox, self.bodyBox2):
            for k in (1, 2):
                yield body.r_0[k] == 0
                yield body.v_0[k] == 0


def test_universal_spherical_rods():
    names = {f"universalSpherical.rRod_0[{k}]": f"universalSpherical.r_rod_0[{k}]" for k in (1, 2, 3)}
    for body in ("bodyBox", "bodyBox1", "bodyBox2"):
        names |= columns(f"{body}.body.Q", lambda r, body=body: quaternion(r, f"{body}.frame_a"))
        names |= {f"{body}.body.w_a[{k}]": f"{body}.w_a[{k}]" for k in (1, 2, 3)}
    compare(JOINTS + "UniversalSpherical", Rods(), names)
