"""Bodies, shapes and springs that cannot be are refused, when compiled and when a parameter is changed."""

import numpy as np
import pytest

import acausal as ac
from acausal import (
    DeclarationError,
    InitializationError,
    Model,
    Scalar,
    chain,
    fixed,
    parameter,
    require,
)
from components import (
    Body,
    BodyBox,
    BodyCylinder,
    BodyRod,
    Damper,
    FixedTranslation,
    FlexibleBeam,
    Prismatic,
    Revolute,
    Spring,
    SpringDamperParallel,
    World,
    rotational,
)


class Held(Model):
    world = World(gravity=None)
    hinge = Revolute(n=(1, 2, 3), phi=fixed(0), w=fixed(1))
    it = Body(m=1)

    def connections(self):
        yield chain(self.world, self.hinge, self.it)


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (BodyBox(r=(1, 0, 0), width=0.1, width_direction=(1, 0, 0)), "`width_direction` of it is parallel to `r`"),
        (BodyBox(r=(1, 2, 3), width=0.1, width_direction=(-2, -4, -6)), "`width_direction` of it is parallel to `r`"),
        (BodyBox(r=(1, 0, 0), width=0.1, width_direction=(0, 0, 0)), "has length 0"),
        (BodyBox(r=(1, 0, 0), width=0.1, width_direction="y"), "three numbers"),
        (BodyBox(r=(1, 0, 0), width=0.1, width_direction=(0, np.nan, 1)), "three numbers"),
        (BodyBox(r=(0, 0, 0), width=0.1), "has length 0"),
        (BodyBox(r=(1, 0, 0), width=-0.1), "greater than 0"),
        (BodyBox(r=(1, 0, 0), width=0.1, height=0), "greater than 0"),
        (BodyBox(r=(1, 0, 0), width=0.1, density=-1), "at least 0"),
        (BodyCylinder(r=(0, 0, 0), diameter=0.1), "has length 0"),
        (BodyCylinder(r=(1, 0, 0), diameter=0.1, inner_diameter=0.2), "`inner_diameter` of it is not less"),
        (BodyCylinder(r=(1, 0, 0), diameter=0.1, inner_diameter=0.1), "`inner_diameter` of it is not less"),
        (BodyRod(r=(1, 0, 0), m=-1), "at least 0"),
        (FlexibleBeam(length=1, E=1e9, rho=1e3, A=-1e-4, J=1e-9), "greater than 0"),
        (FlexibleBeam(length=0, E=1e9, rho=1e3, A=1e-4, J=1e-9), "greater than 0"),
        (FlexibleBeam(length=1, E=1e9, rho=0, A=1e-4, J=1e-9), "greater than 0"),
    ],
)
def test_impossible_shapes(body, message):
    with pytest.raises(DeclarationError, match=message):
        ac.compile(Held(it=body))


@pytest.mark.parametrize(
    ("body", "changes", "message"),
    [
        (BodyBox(r=(1, 1, 0), width=0.1, width_direction=(1, 0, 0)), {"it.r": (1, 1e-9, 0)}, "is parallel to `r`"),
        (BodyCylinder(r=(1, 0, 0), diameter=0.1, inner_diameter=0.05), {"it.diameter": 0.04}, "`inner_diameter`"),
        (BodyCylinder(r=(1, 0, 0), diameter=0.1), {"it.r": (0, 0, 0)}, "length 0"),
    ],
)
def test_shapes_that_are_changed(body, changes, message):
    compiled = ac.compile(Held(it=body))
    with pytest.raises(DeclarationError, match=message):
        ac.simulate(compiled, stop_time=0.1, parameters=changes)


def test_box_of_any_axis_is_right():
    for r in ((1, 0, 0), (0, 2, 0), (0, 0, 3), (1, 2, 3)):
        I = ac.compile(Held(it=BodyBox(r=r, width=0.1))).parameter_values(None)
        assert np.all(np.isfinite(I))


class Slung(Model):
    """A mass on a slide, and a spring from the world to it."""

    at: Scalar = parameter("position at the start", unit="m", default=0.1)
    world = World(gravity=None)
    slide = Prismatic(s=fixed(at), v=fixed(0))
    mass = Body(m=1)
    spring = Spring(c=10)

    def connections(self):
        yield chain(self.world, self.slide, self.mass)
        yield chain(self.world, self.spring, self.mass.frame_a)


@pytest.mark.parametrize(
    "spring", [Spring(c=10), Spring(c=10, s_unstretched=0.3), Damper(d=1), SpringDamperParallel(c=1, d=1)]
)
def test_spring_whose_ends_coincide(spring):
    compiled = ac.compile(Slung(spring=spring))
    ac.simulate(compiled, stop_time=0.01)
    with pytest.raises(
        InitializationError, match=r"spring \(\w+\), .*test_requirements.py.*the ends of spring coincide"
    ):
        ac.simulate(compiled, stop_time=0.01, parameters={"at": 1e-12})


def test_spring_between_points_of_one_place():
    class Folded(Slung):
        arm = FixedTranslation(r=(0.1, 0, 0))

        def connections(self):
            yield chain(self.world, self.slide, self.mass)
            yield chain(self.world, self.arm, self.spring, self.mass.frame_a)

    with pytest.raises(InitializationError, match="the ends of spring coincide"):
        ac.simulate(Folded(), stop_time=0.01)


def test_users_own_requirement():
    class Pipe(Model):
        inner: Scalar = parameter("inner", unit="m", default=1.0)
        outer: Scalar = parameter("outer", unit="m", default=2.0)
        v: Scalar = ac.variable("speed", unit="m/s", start=3.0, fixed=True)

        def equations(self):
            yield ac.der(self.v) == 0

        def requirements(self):
            yield require(self.inner < self.outer, "`inner` is too large")
            yield require(self.v > 2, "`v` is too slow")
            yield require(self.outer, lambda outer: "is odd" if round(float(outer)) % 2 else "")

    compiled = ac.compile(Pipe())
    ac.simulate(compiled, stop_time=1.0)
    for changes, message in (({"inner": 2.5}, "`inner` is too large"), ({"outer": 3.0}, "`outer` is odd")):
        with pytest.raises(DeclarationError, match=message):
            ac.simulate(compiled, stop_time=1.0, parameters=changes)
    with pytest.raises(InitializationError, match="`v` is too slow"):
        ac.simulate(Pipe(v=fixed(1.0)), stop_time=1.0)


def test_requirement_must_be_a_condition():
    class Wrong(Model):
        x: Scalar = parameter("x", default=1.0)

        def requirements(self):
            yield require(self.x, "no function")

    with pytest.raises(DeclarationError, match="require needs a condition"):
        ac.compile(Wrong())


def test_friction_that_slides_with_more_than_it_sticks_is_refused():
    class Braked(Model):
        shaft = rotational.Inertia(J=1, phi=fixed(0), w=fixed(1))
        brake = rotational.Friction(tau_sliding=1, tau_static=1.3)
        wall = rotational.Fixed()

        def connections(self):
            yield chain(self.wall.flange, self.brake, self.shaft.flange_a)

    with pytest.raises(DeclarationError, match=r"`tau_sliding` of brake exceeds `tau_static`"):
        ac.simulate(Braked(), stop_time=0.1, parameters={"brake.tau_sliding": 2.0})
    assert ac.simulate(Braked(), stop_time=0.1, parameters={"brake.tau_sliding": 1.3}).time[-1] == 0.1
