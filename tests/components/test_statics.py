"""Forces, cut forces, inertia tensors and connections of rigid components where the numbers are known by hand."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import DeclarationError, Model, chain, connect, fixed, structural, time
from acausal.flatten import flatten
from components import (
    Body,
    BodyBox,
    BodyCylinder,
    BodyRod,
    BodyShape,
    Fixed,
    FixedRotation,
    FixedTranslation,
    Force,
    Prismatic,
    Revolute,
    Spring,
    Torque,
    World,
    WorldForce,
    WorldTorque,
)
from components import rotational as rot

G = 9.81


def start(model, **options):
    """Return the values at the start, as a function of the path."""
    result = ac.simulate(model, stop_time=1e-3, intervals=1, tolerance=1e-8, **options)
    return lambda path: result[path][0]


class Bracket(Model):
    """A load on a bent arm; a slide that carries nothing makes it a model with states."""

    world = World(g=G)
    arm = FixedRotation(r=(1, 0, 0), n=(0, 0, 2), angle=np.pi / 2)
    rod = FixedTranslation(r=(2, 0, 0))
    slide = Prismatic(n=(0, 0, 1), s=fixed(0), v=fixed(0))
    load = Body(m=3.0)

    def connections(self):
        yield chain(self.world, self.arm, self.rod, self.slide, self.load)


def test_fixed_rotation_turns_position_and_cut_forces():
    value = start(Bracket())
    np.testing.assert_allclose(value("load.r_0"), [1, 2, 0], atol=1e-12)
    np.testing.assert_allclose(value("load.frame_a.R.T"), [[0, 1, 0], [-1, 0, 0], [0, 0, 1]], atol=1e-12)
    np.testing.assert_allclose(value("arm.frame_b.f"), [-3 * G, 0, 0], atol=1e-9)
    np.testing.assert_allclose(value("arm.frame_a.f"), [0, 3 * G, 0], atol=1e-9)
    np.testing.assert_allclose(value("arm.frame_a.t"), [0, 0, 3 * G * 1], atol=1e-9)


class Loads(Model):
    """External force and torque at the end of an arm that hangs on a light joint."""

    where: str = structural("frame", default="world", choices=("world", "frame_b"))
    world = World(gravity=None)
    turn = FixedRotation(n=(0, 0, 1), angle=np.pi / 2)
    joint = Revolute(n=(0, 0, 1), phi=fixed(0), w=fixed(0))
    rod = FixedTranslation(r=(2, 0, 0))
    body = Body(m=1.0, I=np.eye(3))
    force = WorldForce(force=(1, 2, 3), resolve_in_frame=where)
    torque = WorldTorque(torque=(4, 5, 6), resolve_in_frame=where)

    def connections(self):
        yield chain(self.world, self.turn, self.joint, self.rod, self.body)
        yield connect(self.rod.frame_b, self.force.frame_b)
        yield connect(self.rod.frame_b, self.torque.frame_b)


def test_external_loads_in_both_frames():
    T = np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]])
    for where, turned in (("world", T), ("frame_b", np.eye(3))):
        value = start(Loads(where=where))
        force, torque = turned @ [1, 2, 3], turned @ [4, 5, 6]
        np.testing.assert_allclose(value("force.frame_b.f"), -force, atol=1e-12)
        np.testing.assert_allclose(value("torque.frame_b.t"), -torque, atol=1e-12)
        assert value("joint.a") == pytest.approx((torque[2] + 2 * force[1]) / (1 + 1 * 2**2))


class Pair(Model):
    """Two free bodies with a force and a torque between them."""

    where: str = structural("frame", default="frame_b", choices=("world", "frame_a", "frame_b"))
    world = World(gravity=None)
    one = Body(
        m=2.0,
        r_CM=(0.1, 0, 0),
        I=np.diag([1, 2, 3]),
        r_0=fixed((0, 0, 0)),
        v_0=fixed((0, 0, 0)),
        w_a=fixed((0, 0, 0)),
        angles_fixed=True,
        angles_start=(0.3, 0.4, 0.5),
    )
    two = Body(
        m=1.0,
        I=np.diag([1, 2, 2]),
        r_0=fixed((1, 2, 3)),
        v_0=fixed((0, 0, 0)),
        w_a=fixed((0, 0, 0)),
        angles_fixed=True,
        angles_start=(-0.7, 0.2, 0.1),
    )
    force = Force(force=(1.0, -2.0, 0.5), resolve_in_frame=where)
    torque = Torque(torque=(0.3, 0.2, 0.1 + 0.1 * time), resolve_in_frame=where)

    def connections(self):
        for between in (self.force, self.torque):
            yield chain(self.one.frame_a, between, self.two)


@pytest.mark.parametrize("where", ["world", "frame_a", "frame_b"])
def test_inner_forces_create_nothing(where):
    result = ac.simulate(Pair(where=where), stop_time=2.0, tolerance=1e-9, intervals=20, energy=True)
    turned = {"one": [0.1, 0, 0], "two": [0, 0, 0]}
    inertia, mass = {"one": np.array([1, 2, 3]), "two": np.array([1, 2, 2])}, {"one": 2.0, "two": 1.0}
    momentum, spin = np.zeros((21, 3)), np.zeros((21, 3))
    for name, r in turned.items():
        T, w = result[f"{name}.frame_a.R.T"], result[f"{name}.w_a"]
        centre = result[f"{name}.r_0"] + np.einsum("tji,j->ti", T, r)
        velocity = result[f"{name}.v_0"] + np.einsum("tji,tj->ti", T, np.cross(w, r))
        momentum += mass[name] * velocity
        spin += np.cross(centre, mass[name] * velocity) + np.einsum("tji,tj->ti", T, inertia[name] * w)
    np.testing.assert_allclose(momentum, 0, atol=1e-5)
    np.testing.assert_allclose(spin, 0, atol=1e-5)
    assert result.stats["energy_supplied"] > 1e-2
    assert abs(result.stats["energy_method"]) < 1e-5 * result.stats["energy_supplied"] + 1e-5
    frame = {"world": np.eye(3), "frame_a": result["one.frame_a.R.T"][0], "frame_b": result["two.frame_a.R.T"][0]}
    T_b = result["two.frame_a.R.T"][0]
    np.testing.assert_allclose(result["force.frame_b.f"][0], -T_b @ frame[where].T @ [1, -2, 0.5], atol=1e-9)
    np.testing.assert_allclose(result["torque.frame_b.t"][0], -T_b @ frame[where].T @ [0.3, 0.2, 0.1], atol=1e-9)


class Slung(Model):
    """A body on two springs, at rest where they bear the weight; Fixed holds one of them."""

    world = World(g=G)
    hook = Fixed(r=(1.0, 2.0, 0.0))
    left = Spring(c=100.0, s_unstretched=1.0)
    right = Spring(c=100.0, s_unstretched=1.0)
    slide = Prismatic(n=(0, -1, 0), s=fixed(1.0), v=fixed(0))
    post = Fixed(r=(0.0, 2.0, 0.0))
    body = Body(m=2.0)

    def connections(self):
        yield chain(self.post, self.slide, self.body)
        yield chain(self.hook, self.left, self.body)
        yield connect(self.right.frame_b, self.post.frame_b)
        yield connect(self.right.frame_a, self.body.frame_a)


def test_springs_pull_together():
    value = start(Slung())
    force = 100 * (np.sqrt(2) - 1)
    assert value("left.f") == pytest.approx(force)
    assert value("left.s") == pytest.approx(np.sqrt(2))
    np.testing.assert_allclose(value("left.frame_a.f"), [force / np.sqrt(2), force / np.sqrt(2), 0], atol=1e-9)
    np.testing.assert_allclose(value("left.frame_b.f"), [-force / np.sqrt(2), -force / np.sqrt(2), 0], atol=1e-9)
    assert value("right.f") == pytest.approx(0, abs=1e-9)
    assert value("slide.a") == pytest.approx(G - force / np.sqrt(2) / 2)


class Swinging(Model):
    """A body of the given shape on a hinge."""

    world = World(g=G)
    hinge = Revolute(phi=fixed(0), w=fixed(0))
    body = BodyShape(r=(1, 0, 0), m=1.0, r_CM=(1, 0, 0))

    def connections(self):
        yield chain(self.world, self.hinge, self.body)


def box_inertia(r, width, height, width_direction):
    """Mass and inertia tensor of a box by its second moments, turned into frame_a."""
    length = np.linalg.norm(r)
    x = np.asarray(r) / length
    y = width_direction - np.dot(width_direction, x) * x
    y /= np.linalg.norm(y)
    axes = np.array([x, y, np.cross(x, y)])
    mass = 7700 * length * width * height
    second = axes.T @ np.diag([length**2, width**2, height**2]) @ axes / 12
    return mass, mass * (np.trace(second) * np.eye(3) - second)


@pytest.mark.parametrize(
    ("r", "direction"),
    [((1, 0, 0), (0, 1, 0)), ((0, 2, 0), (1, 0, 0)), ((1, 2, -1), (0, 1, 0)), ((0, 0, -0.5), (0, 1, 0))],
)
def test_inertia_of_a_box(r, direction):
    value = start(Swinging(body=BodyBox(r=r, width=0.1, height=0.04)))
    mass, inertia = box_inertia(r, 0.1, 0.04, np.array(direction, dtype=float))
    assert value("body.body.m") == pytest.approx(mass)
    np.testing.assert_allclose(value("body.body.r_CM"), np.array(r) / 2)
    np.testing.assert_allclose(value("body.body.I"), inertia, atol=1e-12 * mass)


def test_square_box_is_the_default():
    value = start(Swinging(body=BodyBox(r=(1, 0, 0), width=0.1, density=1000)))
    assert value("body.m") == pytest.approx(10.0)
    np.testing.assert_allclose(value("body.I"), np.diag([2, 101, 101]) * 10 * 0.01 / 12)


@pytest.mark.parametrize("r", [(1, 0, 0), (0, -2, 0), (1, 2, -1)])
def test_inertia_of_a_pipe(r):
    value = start(Swinging(body=BodyCylinder(r=r, diameter=0.2, inner_diameter=0.1)))
    l2, e = np.dot(r, r), np.array(r) / np.linalg.norm(r)
    mass = 7700 * np.pi * (0.1**2 - 0.05**2) * np.sqrt(l2)
    along, across = mass * (0.1**2 + 0.05**2) / 2, mass * (3 * (0.1**2 + 0.05**2) + l2) / 12
    assert value("body.m") == pytest.approx(mass)
    np.testing.assert_allclose(
        value("body.I"), across * np.eye(3) + (along - across) * np.outer(e, e), rtol=1e-9, atol=1e-12 * mass
    )


@pytest.mark.parametrize("r", [(1, 0, 0), (1, 2, -1)])
def test_inertia_of_a_rod(r):
    value = start(Swinging(body=BodyRod(r=r, m=3.0)))
    np.testing.assert_allclose(value("body.body.r_CM"), np.array(r) / 2)
    np.testing.assert_allclose(value("body.I"), 3 / 12 * (np.dot(r, r) * np.eye(3) - np.outer(r, r)), atol=1e-15)


@pytest.mark.parametrize("make", [BodyBox, BodyCylinder])
@pytest.mark.parametrize("r", [(1, 0, 0), (0, 1, 0), (0, 0, 1)])
def test_inertia_along_an_axis_is_structurally_diagonal(make, r):
    size = {"width": 0.1} if make is BodyBox else {"diameter": 0.1}
    tree = flatten(Swinging(hinge=Revolute(n=(1, 2, 3)), body=make(r=r, **size))).tree
    inertia = tree.body.body.I.sx
    for i in range(3):
        for j in range(3):
            assert inertia[i, j].is_zero() == (i != j)


def test_planar_shapes_stay_planar():
    for body in (BodyBox(r=(1, 0, 0), width=0.1), BodyCylinder(r=(1, 1, 0), diameter=0.1), Swinging.body):
        flat = flatten(Swinging(body=body))
        outside = [
            n for n in flat.unknowns.names if n.endswith((".r_0[2]", ".v[2]", ".a[2]", ".f[2]", ".R.w[0]", ".R.w[1]"))
        ]
        assert outside == []
        # Axis, inertia and weight: angle, speed, acceleration and the motion and cut forces in the plane.
        assert len(flat.unknowns.names) - sum(d >= 0 for d in flat.unknowns.derivative) == len(flat.equations.origins)


def test_start_values_of_a_body_with_two_frames():
    free = BodyBox(
        r=(1, 0, 0),
        width=0.1,
        r_0=fixed((1, 2, 3)),
        v_0=fixed((0.1, 0.2, 0.3)),
        w_a=fixed((1, 2, 3)),
        angles_fixed=True,
        angles_start=(0, 0, np.pi / 2),
    )

    class Free(Model):
        world = World(gravity=None)
        body = free

    value = start(Free())
    np.testing.assert_allclose(value("body.frame_b.r_0"), [1, 3, 3], atol=1e-12)
    np.testing.assert_allclose(value("body.body.v_0"), [0.1, 0.2, 0.3], atol=1e-12)
    np.testing.assert_allclose(value("body.frame_a.R.w"), [1, 2, 3], atol=1e-12)


class DrivenSlide(Model):
    """A slide with its drive rod held by a spring law written in the model."""

    world = World(g=G, n=(-1, 0, 0))
    slide = Prismatic(n=(1, 0, 0), use_axis_flange=True, s=fixed(0.1), v=fixed(0))
    body = Body(m=2.0)

    def connections(self):
        yield chain(self.world, self.slide, self.body)

    def equations(self):
        yield self.slide.axis.f == 50 - ac.quantity(100, "N/m") * self.slide.s


def test_a_law_on_a_drive_rod_drives():
    """2 s'' = 50 - 100 s - 2 G, from 0.1."""
    result = ac.simulate(DrivenSlide(), stop_time=1.0, tolerance=1e-8)
    rest = 0.5 - 2 * G / 100
    np.testing.assert_allclose(result["slide.s"], rest + (0.1 - rest) * np.cos(50**0.5 * result.time), atol=1e-6)


def test_undriven_axis_is_free():
    class Loose(DrivenSlide):
        def equations(self):
            yield from ()

    value = start(Loose())
    assert value("slide.a") == pytest.approx(-G)


class Spindle(Model):
    drive = rot.Torque(tau=2.0)
    rotor = rot.Inertia(J=4.0, phi=fixed(0), w=fixed(0))

    def connections(self):
        yield chain(self.drive, self.rotor)


def test_torque_accelerates():
    assert start(Spindle())("rotor.a") == pytest.approx(0.5)


def test_parameters_are_checked():
    for wrong in (
        Spring(c=-1.0),
        BodyBox(r=(1, 0, 0), width=-0.1),
        BodyBox(r=(0, 0, 0), width=0.1),
        BodyCylinder(r=(0, 0, 0), diameter=0.1),
        FixedRotation(n=(0, 0, 0)),
        Prismatic(n=(0, 0, 0)),
    ):

        class Wrong(Model):
            world = World()
            part = wrong
            body = Body(m=1.0, I=np.eye(3))

            def connections(self):
                yield chain(self.world, self.part, self.body)

        with pytest.raises(DeclarationError):
            ac.compile(Wrong())
