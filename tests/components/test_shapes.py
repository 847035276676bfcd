"""What components look like: kinds of geometry that stand where the motion is, on every component and scene."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any, get_args

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Model, as_expr, chain, connect, fixed, geometry, part, time
from acausal.flatten.component_tree import walk
from components import (
    Body,
    BodyBox,
    BodyCylinder,
    BodyRod,
    Revolute,
    Spherical,
    TwoFrames,
    World,
    WorldForce,
    move,
    null_rotation,
    rotational,
)
from models import SCENES as MODELS
from tests.components.scenes.bodies import OnBodyBox, OnBodyCylinder, OnBodyRod, OnBodyShape
from tests.components.scenes.scene import R_CM
from tests.components.test_properties import SCENES
from tests.shared import compiled

KINDS = get_args(geometry.Shape)
EVERY = {f"scene {name}": make for name, make in SCENES.items()} | {f"model {name}": m for name, m in MODELS.items()}
# Reading positions a second way sums in another order: a few units in the last place of the extent of a scene.
ROUNDING = 1e-13


def collected(component: Component) -> Iterator[tuple[Component, Any]]:
    """Shapes with the parts that yield them."""
    for item in component.shapes():
        if isinstance(item, Component):
            yield from collected(item)
        else:
            yield component, item


@cache
def ran(make: Any, **values: Any) -> ac.Result:
    """A short run: long enough that everything has moved."""
    model = compiled(make, **values)
    return ac.simulate(model, stop_time=min(0.2, getattr(model.tree, "stop_time", 0.2) / 10), intervals=4)


def read(result: ac.Result, value: Any) -> np.ndarray:
    """Values over time, of expressions and numbers alike."""
    return result[as_expr(value)]


def shapes_of(result: ac.Result, path: str, kind: type | None = None) -> list[Any]:
    owner = next(c for c in walk(result.tree) if c._path == path)
    return [shape for _, shape in collected(owner) if kind is None or isinstance(shape, kind)]


def entries(shape: Any) -> Iterator[tuple[str, Any]]:
    """All that a shape holds and that is not None, with that of its pose and its values."""
    for field in fields(shape):
        value = getattr(shape, field.name)
        if field.name == "values":
            yield from ((v.name, v.entries() if callable(v.entries) else v.entries) for v in value)
        elif is_dataclass(value):
            yield from entries(value)
        elif value is not None and not isinstance(value, str):
            yield field.name, value


SIZES = {"r": (3,), "T": (3, 3), "center": (3,), "axes": (3, 3), "axis": (3,), "at": (3,), "vector": (3,)}
NAMED = ("up", "bending moment", "bending moment y", "torque", "axial force", "deflection", "deflection z")
SIZES |= {"diameter": (), "length": (), "to": (3,)}


@pytest.mark.filterwarnings("ignore:.*linear frames:acausal.AcausalWarning")
@pytest.mark.parametrize("name", EVERY)
def test_shapes_are_kinds_of_geometry(name):
    """Every entry can be read, has its shape and is finite; something is there to be seen."""
    result = ran(EVERY[name])
    found = [shape for _, shape in collected(result.tree)]
    assert all(isinstance(shape, KINDS) for shape in found)
    assert any(not isinstance(shape, geometry.Ground | geometry.Arrow) for shape in found)
    for shape in found:
        for field, value in entries(shape):
            if field in ("vertices", "triangles", "modes"):
                assert np.isfinite(value).all()
                continue
            values = read(result, value)
            assert np.isfinite(values).all(), (shape, field)
            assert values.shape[1:] == SIZES.get(field, values.shape[1:])
            if field == "T":
                np.testing.assert_allclose(
                    values @ values.transpose(0, 2, 1), np.broadcast_to(np.eye(3), values.shape), atol=1e-6
                )
        if isinstance(shape, geometry.Curve):
            n = shape.points.shape[0]
            several = [
                shape.points,
                shape.tangents,
                shape.rest_points,
                *(value for name, value in entries(shape) if name in NAMED),
            ]
            assert all(value.shape[0] == n for value in several)
            assert np.shape(shape.section) in ((2,), (n, 2))


# Parts in one dimension, sensors, and what joins drive trains or guides nothing.
PLACELESS = [name for name in SCENES if name.startswith(("rotational.", "translational.", "thermal.", "sensors."))]
PLACELESS += ["Mounting1D", "BevelGear1D", "FreeMotion", "FreeMotionScalarInit"]


@pytest.mark.parametrize("name", PLACELESS)
def test_parts_of_drives_have_no_place(name):
    assert list(collected(ran(SCENES[name]).tree.it)) == []


@pytest.mark.filterwarnings("ignore:.*linear frames:acausal.AcausalWarning")
@pytest.mark.parametrize("name", [name for name in SCENES if name not in (*PLACELESS, "World")])
def test_every_component_shows_something(name):
    tree = ran(SCENES[name]).tree
    assert list(collected(tree.it if hasattr(tree, "it") else tree.tip))


def test_no_shape_is_asked_for_before_a_picture_is(monkeypatch):
    """Neither compiling, running nor reading asks what a part looks like."""

    def refuse(self: Any) -> Any:
        raise AssertionError("asked")

    for cls in {type(c) for make in EVERY.values() for c in walk(compiled(make).tree)}:
        if "shapes" in vars(cls):
            monkeypatch.setattr(cls, "shapes", refuse)
    monkeypatch.setattr(Component, "shapes", refuse)
    result = ac.simulate(ac.compile(MODELS["slider-crank"]()), stop_time=0.01)
    assert np.isfinite(result.to_dataframe()).all(axis=None)


# Rods, joints and rigid bodies.


@pytest.mark.parametrize("name", ["Spring", "Damper", "SpringDamperParallel", "SpringDamperSeries"])
def test_spans_go_from_frame_to_frame(name):
    result = ran(SCENES[name])
    spans = shapes_of(result, "it", geometry.Span)
    styles = {"Spring": ["coil"], "Damper": ["damper"], "SpringDamperParallel": ["damper", "coil"]}
    assert [span.style for span in spans] == styles.get(name, ["damper", "coil"])
    ends = [read(result, end) for span in spans for end in (span.start, span.end)]
    np.testing.assert_array_equal(ends[0], result["it.frame_a.r_0"])
    np.testing.assert_array_equal(ends[-1], result["it.frame_b.r_0"])


@pytest.mark.parametrize("name", ["FixedTranslation", "FixedRotation"])
def test_links_end_in_the_frames(name):
    result = ran(SCENES[name])
    (link,) = shapes_of(result, "it", geometry.Cylinder)
    for end, frame in zip((link.start, link.end), "ab", strict=True):
        np.testing.assert_allclose(placed(result, link.pose, end), result[f"it.frame_{frame}.r_0"], atol=ROUNDING)


@pytest.mark.parametrize("name", ["Prismatic", "Cylindrical", "ScrewJoint"])
def test_rails_lead_frame_b(name):
    result = ran(SCENES[name])
    (rail,) = shapes_of(result, "it", geometry.Rail)
    along = read(result, rail.to) - read(result, rail.pose.r)
    expected = result["it.s"][:, None] * np.einsum("ti,tij->tj", read(result, rail.axis), read(result, rail.pose.T))
    np.testing.assert_allclose(along, expected, atol=1e-6 * np.abs(expected).max())
    (block,) = shapes_of(result, "it", geometry.Axle)
    np.testing.assert_allclose(read(result, block.pose.r), read(result, rail.to), atol=ROUNDING)


@pytest.mark.parametrize("name", ["Revolute", "RevolutePlanarLoopConstraint"])
def test_pins_have_one_axis_in_both_frames(name):
    result = ran(SCENES[name])
    (pin,) = shapes_of(result, "it", geometry.Axle)
    axis = read(result, pin.axis)[0]
    at_b = np.einsum("i,tij->tj", axis, result["it.frame_b.R.T"])
    np.testing.assert_allclose(np.einsum("i,tij->tj", axis, read(result, pin.pose.T)), at_b, atol=1e-6)
    assert np.linalg.norm(axis) == pytest.approx(1)
    np.testing.assert_allclose(read(result, pin.pose.r), result["it.frame_b.r_0"], atol=1e-6)


def test_body_is_a_sphere_at_the_centre_of_mass():
    result = ran(SCENES["Body"])
    (link,), (ball,) = shapes_of(result, "tip", geometry.Cylinder), shapes_of(result, "tip", geometry.Sphere)
    centre = result["tip.frame_a.r_0"] + np.einsum("i,tij->tj", R_CM, result["tip.frame_a.R.T"])
    drawn = read(result, ball.pose.r) + np.einsum("ti,tij->tj", read(result, ball.center), read(result, ball.pose.T))
    np.testing.assert_allclose(drawn, centre, atol=ROUNDING)
    np.testing.assert_allclose(placed(result, link.pose, link.end), centre, atol=ROUNDING)
    np.testing.assert_array_equal(placed(result, link.pose, link.start), result["tip.frame_a.r_0"])


def test_body_at_its_frame_needs_no_rod():
    assert [type(s) for s in shapes_of(ran(MODELS["simple-pendulum"]), "mass")] == [geometry.Sphere]


def placed(result: ac.Result, pose: geometry.Pose, point: Any) -> np.ndarray:
    return read(result, pose.r) + np.einsum("ti,tij->tj", read(result, point), read(result, pose.T))


@pytest.mark.parametrize(
    ("make", "kind"), [(OnBodyBox, geometry.Box), (OnBodyCylinder, geometry.Cylinder), (OnBodyRod, geometry.Cylinder)]
)
def test_solid_bodies_reach_from_frame_to_frame(make, kind):
    result = ran(make)
    (shape,) = shapes_of(result, "it")
    assert type(shape) is kind
    if kind is geometry.Box:
        half = shape.axes[0] * shape.size[0] / 2
        ends = shape.center - half, shape.center + half
    else:
        ends = shape.start, shape.end
    for end, frame in zip(ends, "ab", strict=True):
        expected = result[f"it.frame_{frame}.r_0"]
        np.testing.assert_allclose(placed(result, shape.pose, end), expected, atol=ROUNDING)


def test_drawn_box_has_the_inertia_of_the_body():
    """Its mass by its volume, its inertia by m / 12 (l^2 E - l l') summed over its edges."""
    result = ran(OnBodyBox)
    (box,) = shapes_of(result, "it")
    size, axes = read(result, box.size)[0], read(result, box.axes)[0]
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-14)
    assert np.linalg.det(axes) > 0
    m = 7700 * size.prod()
    P = axes.T @ np.diag(size**2) @ axes * m / 12
    np.testing.assert_allclose(result["it.m"][0], m)
    np.testing.assert_allclose(result["it.I"][0], np.trace(P) * np.eye(3) - P, rtol=1e-12, atol=1e-12 * np.trace(P))


def test_drawn_cylinder_has_the_volume_of_the_body():
    result = ran(OnBodyCylinder)
    (pipe,) = shapes_of(result, "it")
    length = np.linalg.norm(read(result, pipe.end)[0])
    section = np.pi / 4 * (read(result, pipe.diameter)[0] ** 2 - 0.05**2)
    assert result["it.m"][0] == pytest.approx(7700 * length * section)


def test_body_of_two_frames_shows_its_rod_and_its_centre():
    result = ran(OnBodyShape)
    found = list(collected(result.tree.it))
    assert {owner._path for owner, _ in found} == {"it"}
    to_b, to_centre = (shape for _, shape in found if isinstance(shape, geometry.Cylinder))
    np.testing.assert_allclose(placed(result, to_b.pose, to_b.end), result["it.frame_b.r_0"], atol=ROUNDING)
    np.testing.assert_allclose(np.linalg.norm(read(result, to_centre.end), axis=1), 6**0.5 / 10)


def test_ground_is_normal_to_gravity():
    def up(**values: Any) -> Any:
        class Scene(Model):
            world = World(**values)
            body = Body(m=1, I=np.eye(3), r_0=fixed((1, 0, 0)))

        (ground,) = ac.compile(Scene()).tree.world.shapes()
        return None if ground.up is None else list(ground.up)

    assert up() == [0, 1, 0]
    assert up(n=(0, 0, -2)) == [0, 0, 1]
    assert up(gravity="point", mu=1) is None
    assert up(gravity=None) is None


# Forces and torques.


@pytest.mark.parametrize(
    ("name", "frames"), [("Force", "baa"), ("Torque", "ba"), ("WorldForce", "b"), ("WorldTorque", "b")]
)
def test_arrows_do_the_work_of_the_load(name, frames):
    """Forces at the velocity of where they act, torques at the angular velocity of the frame, both resolved in the world."""
    result, power, size = ran(SCENES[name]), 0.0, 0.0
    it = result.tree.it
    for arrow, end in zip(shapes_of(result, "it", geometry.Arrow), frames, strict=True):
        frame = getattr(it, f"frame_{end}")
        np.testing.assert_array_equal(read(result, arrow.at), result[frame.r_0])
        moved = result[frame.v if arrow.quantity == "force" else frame.R.w]
        one = np.einsum("ti,ti->t", read(result, arrow.vector), np.einsum("ti,tij->tj", moved, result[frame.R.T]))
        power, size = power + one, size + np.abs(one).max()
    assert size > 0.1
    np.testing.assert_allclose(power, result[it.supplied_power()], atol=1e-12 * size)


def test_arrow_of_a_force_is_the_force():
    """Resolved in the world, at the frame, in the direction in which it pushes."""

    class Pushed(Model):
        world = World(gravity=None)
        body = Body(
            m=2, r_0=fixed((1, 2, 3)), w_a=fixed((1, 2, 3)), v_0=fixed((0, 0, 0)), I=np.eye(3), angles_fixed=True
        )
        push = WorldForce(force=(1 + time, -2, 3))

        def connections(self):
            yield connect(self.push.frame_b, self.body.frame_a)

    result = ac.simulate(Pushed(), stop_time=1, intervals=4)
    (arrow,) = shapes_of(result, "push")
    expected = np.stack([1 + result.time, 0 * result.time - 2, 0 * result.time + 3], axis=1)
    np.testing.assert_allclose(read(result, arrow.vector), expected, atol=1e-12)
    np.testing.assert_allclose(2 * result["body.a_0"], expected, atol=1e-9)
    np.testing.assert_array_equal(read(result, arrow.at), result["body.frame_a.r_0"])


class Driven(Model):
    """A rod on a driven revolute, and on it a slide that is pushed."""

    world = World(gravity=None)
    joint = Revolute(n=(1, 2, 2), use_axis_flange=True, phi=fixed(0.3), w=fixed(0.5))
    motor = rotational.Torque(tau=2 + time)
    rod = BodyRod(r=(0.5, 0.1, 0), m=1)

    def connections(self):
        yield chain(self.world, self.joint, self.rod)
        yield connect(self.motor.flange, self.joint.axis)


def test_arrow_of_a_drive_does_its_work():
    result = ac.simulate(Driven(), stop_time=0.5, intervals=5)
    (arrow,) = shapes_of(result, "joint", geometry.Arrow)
    w = np.einsum("ti,tij->tj", result["rod.frame_a.R.w"], result["rod.frame_a.R.T"])
    power = np.einsum("ti,ti->t", read(result, arrow.vector), w)
    np.testing.assert_allclose(power, (2 + result.time) * result["joint.w"], rtol=1e-9)
    assert (power > 0).all()
    assert arrow.quantity == "torque"


def test_arrow_of_a_drive_rod_pushes_the_slide():
    result = ran(SCENES["Prismatic"], use_axis_flange=True)
    (arrow,) = shapes_of(result, "it", geometry.Arrow)
    n = np.array([1, 2, 2]) / 3 @ result["it.frame_a.R.T"]
    np.testing.assert_allclose(
        np.einsum("ti,ti->t", read(result, arrow.vector), n), result["it.f"], rtol=1e-9, atol=1e-9
    )
    assert arrow.quantity == "force"
    np.testing.assert_array_equal(read(result, arrow.at), result["it.frame_b.r_0"])


# Parts of the user's own.


class Link(TwoFrames):
    """A part of the user's own, without shapes()."""

    r = ac.parameter("from frame to frame", unit="m", shape=(3,), default=(0, 1, 0))

    def connections(self):
        yield ac.branch(self.frame_a, self.frame_b)

    def equations(self):
        yield from move(self.frame_a, self.frame_b, self.r, null_rotation())
        yield self.frame_a.f + self.frame_b.f == (0, 0, 0)
        yield self.frame_a.t + self.frame_b.t + ac.cross(self.r, self.frame_b.f) == (0, 0, 0)


class Leg(TwoFrames):
    """A part of parts, which show themselves."""

    hip, shin = Spherical(angles_fixed=True), BodyBox(r=(0, -1, 0), width=0.1)

    def connections(self):
        yield chain(self.frame_a, self.hip, self.shin, self.frame_b)


class Shod(Leg):
    def shapes(self):
        yield from super().shapes()
        yield geometry.Sphere(geometry.Pose(self.frame_b.r_0, self.frame_b.R.T), diameter=0.1)


class Hidden(Leg):
    def shapes(self):
        yield self.shin


class Walker(Model):
    world, link, leg, shod, hidden = World(), Link(), Leg(), Shod(), Hidden()

    def connections(self):
        yield chain(self.world, self.link, self.leg)
        yield connect(self.world.frame_b, self.shod.frame_a)
        yield connect(self.world.frame_b, self.hidden.frame_a)

    def shapes(self):
        yield from super().shapes()
        yield geometry.Box(geometry.Pose((0, 0, 0), np.eye(3)), (0, -2, 0), (3, 0.1, 3))


def test_own_parts_appear_by_themselves():
    found = [(owner._path, type(shape).__name__) for owner, shape in collected(ac.compile(Walker()).tree)]
    assert found == [
        ("world", "Ground"),
        ("world", "Axle"),
        ("link", "Span"),
        ("leg.hip", "Axle"),
        ("leg.shin", "Box"),
        ("shod.hip", "Axle"),
        ("shod.shin", "Box"),
        ("shod", "Sphere"),
        ("hidden.shin", "Box"),
        ("", "Box"),
    ]


def test_lists_of_parts_and_absent_ones():
    class Comb(Model):
        world = World()

        @ac.parts
        def teeth(self):
            return [BodyCylinder(r=(0, -1, 0), diameter=0.1, r_0=fixed((k, 0, 0))) for k in range(3)]

        @part
        def absent(self) -> Any:
            if self.world is None:
                return Body(m=1)
            return None

    found = [owner._path for owner, _ in collected(ac.compile(Comb()).tree)]
    assert found == ["world", "teeth[0]", "teeth[1]", "teeth[2]"]


def test_a_field_cannot_have_the_name():
    with pytest.raises(ac.DeclarationError, match="every component has a method of this name, `def shapes"):

        class Wrong(Component):
            shapes = ac.parameter("number of shapes", default=1)
