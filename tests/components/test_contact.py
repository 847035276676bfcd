"""Contacts: restitution, duration of impact, friction, geometry and singular configurations against closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import (
    AcausalWarning,
    DeclarationError,
    InitializationError,
    Model,
    SimulationError,
    chain,
    connect,
    fixed,
    part,
    sin,
    structural,
)
from components import Body, Fixed, Revolute, World
from components.contact import PointOnPlane, PointOnProfile, RimOnPlane, SphereOnPlane, SphereOnProfile, SphereOnSphere
from tests.shared import compiled

MASS, RADIUS = 1.0, 0.05
BALL = 0.4 * MASS * RADIUS**2
IMPACTS: dict[str, Any] = {
    "point": (PointOnPlane, {"k": 1e6}, 0.0),
    "sphere": (SphereOnPlane, {"k": 1e8, "radius": RADIUS}, RADIUS),
    "rim": (RimOnPlane, {"k": 1e6, "radius": RADIUS}, RADIUS),
    "two spheres": (SphereOnSphere, {"k": 1e8, "radius_a": 0.1, "radius_b": RADIUS}, 0.1 + RADIUS),
    "sphere on a profile": (SphereOnProfile, {"k": 1e8, "radius": RADIUS, "height": lambda r: 0.3 * r[0] ** 2}, RADIUS),
    "profile": (PointOnProfile, {"k": 1e6, "height": lambda r: 0.3 * r[0] ** 2}, 0.0),
}


class Ball(Model):
    """A free body above a contact with the ground."""

    r, v, w = (structural("start", default=(0, 0, 0), shape=(3,)) for _ in range(3))
    g = structural("gravity in m/s2", default=0.0)
    n = structural("direction of gravity", default=(0, -1, 0), shape=(3,))
    angles = structural("angles at the start in rad", default=(0, 0, 0), shape=(3,))
    I = structural("moments of inertia", default=(BALL, BALL, BALL), shape=(3,))
    it = PointOnPlane(k=1)

    @part
    def world(self):
        return World(g=self.g, n=self.n)

    @part
    def body(self):
        start = {"r_0": fixed(self.r), "v_0": fixed(self.v), "w_a": fixed(self.w), "angles_start": self.angles}
        return Body(m=MASS, I=np.diag(self.I), angles_fixed=True, **start)

    def connections(self):
        yield chain(self.world, self.it, self.body)


@pytest.mark.parametrize("e", [0.1, 0.5, 0.9])
def test_dropped_ball(e):
    """From 1 m: the speed after the first bounce; at no time has the ball more energy than at any before."""
    model = compiled(Ball, g=9.81, r=(0, 1 + RADIUS, 0), it=SphereOnPlane(k=1e8, radius=RADIUS, e=0.5))
    result = ac.simulate(model, stop_time=2.0, intervals=4000, tolerance=1e-7, parameters={"it.e": e})
    x, v, h = result["it.x"], result["body.v_0"][:, 1], result["body.r_0"][:, 1] - RADIUS
    touch = np.flatnonzero(x > 0)[0]
    free = touch + np.flatnonzero(x[touch:] < 0)[0]
    energy = v**2 / 2 + 9.81 * h
    assert np.sqrt(energy[free] / energy[0]) == pytest.approx(e, abs=0.003)
    elastic = 1e8 * np.maximum(x, 0) ** 2.5 / 2.5 / MASS
    assert np.max(np.diff(energy + elastic)) < 1e-6 * energy[0]


@pytest.mark.parametrize("name", IMPACTS)
@pytest.mark.parametrize("e", [0.2, 0.7])
def test_restitution_is_exact_without_other_forces(name, e):
    kind, values, distance = IMPACTS[name]
    speed = 3.0
    model = Ball(it=kind(e=e, **values), r=(0, distance + 0.01, 0), v=(0, -speed, 0))
    result = ac.simulate(model, stop_time=0.05, tolerance=1e-9, energy=True)
    assert result["it.x"][-1] < 0
    np.testing.assert_allclose(result["body.v_0"][-1], (0, e * speed, 0), atol=1e-5 * speed)
    assert result["it.v_touch"][-1] == pytest.approx(speed, rel=1e-9)
    lost = MASS * speed**2 / 2 * (1 - e**2)
    assert result.stats["energy_dissipated"] == pytest.approx(lost, rel=1e-5)


def test_dissipation_lets_restitution_fall_with_the_speed():
    """z (1 + e) = log((1 + z) / (1 - e z)) with z = chi v, at two speeds."""
    chi = 0.4
    for speed in (1.0, 4.0):
        it = SphereOnPlane(k=1e8, radius=RADIUS, dissipation=chi)
        result = ac.simulate(Ball(it=it, r=(0, 2 * RADIUS, 0), v=(0, -speed, 0)), stop_time=0.1, tolerance=1e-9)
        e, z = result["body.v_0"][-1, 1] / speed, chi * speed
        assert 0.2 < e < 0.8
        assert z * (1 + e) == pytest.approx(np.log((1 + z) / (1 - e * z)), rel=1e-5)


def test_elastic_impact_of_a_sphere():
    """Hertz: greatest penetration (5 m v^2 / 4 k)^(2/5), duration 2.94327 x / v."""
    k, speed = 1e8, 2.0
    model = Ball(it=SphereOnPlane(k=k, radius=RADIUS), r=(0, RADIUS, 0), v=(0, -speed, 0))
    result = ac.simulate(model, stop_time=0.005, tolerance=1e-9, intervals=5000)
    deepest = (5 * MASS * speed**2 / (4 * k)) ** 0.4
    assert np.max(result["it.x"]) == pytest.approx(deepest, rel=1e-5)
    assert np.sum(result["it.x"] > 0) * 1e-6 == pytest.approx(2.94327 * deepest / speed, abs=3e-6)
    assert result["body.v_0"][-1, 1] == pytest.approx(speed, rel=1e-7)


def test_friction_slows_a_sliding_point_and_creeps_on_a_slope():
    k, mu, g = 1e6, 0.5, 10.0
    sunk = MASS * g / k
    slides = Ball(it=PointOnPlane(k=k, mu=mu), g=g, r=(0, -sunk, 0), v=(3, 0, 4))
    result = ac.simulate(slides, stop_time=0.5, tolerance=1e-8)
    np.testing.assert_allclose(result["body.v_0"][-1], (5 - mu * g * 0.5) * np.array([0.6, 0, 0.8]), atol=1e-4)
    slope, n = 0.2, np.array([0.2, -1, 0]) / np.hypot(1, 0.2)
    rests = Ball(it=PointOnPlane(k=k, mu=mu, dissipation=0.1), g=g, n=tuple(n), r=(0, -sunk * -n[1], 0))
    result = ac.simulate(rests, stop_time=1.0, tolerance=1e-8)
    q = slope / mu
    np.testing.assert_allclose(result["body.v_0"][-1], (1e-3 * q / np.sqrt(1 - q**2), 0, 0), atol=1e-9)


def test_a_sliding_ball_begins_to_roll():
    """At 5/7 of its speed, whatever the friction."""
    k, g = 1e9, 10.0
    sunk = (MASS * g / k) ** (2 / 3)
    model = Ball(it=SphereOnPlane(k=k, radius=RADIUS, mu=0.4), g=g, r=(0, RADIUS - sunk, 0), v=(2, 0, 1))
    result = ac.simulate(model, stop_time=0.5, tolerance=1e-8)
    np.testing.assert_allclose(result["body.v_0"][-1], np.array([2, 0, 1]) * 5 / 7, atol=1e-3)
    w_0 = result["body.frame_a.R.T"][-1].T @ result["body.w_a"][-1]
    np.testing.assert_allclose(np.cross(w_0, (0, RADIUS - sunk, 0)), result["body.v_0"][-1], atol=1e-6)


def test_a_rim_touches_at_its_lowest_point():
    """A tumbling hoop: penetration and its rate from many points of the circle, energy without losses."""
    R, g = 0.3, 9.81
    axis = np.array([0.2, 0.3, 1.0]) / np.linalg.norm([0.2, 0.3, 1.0])
    model = Ball(
        it=RimOnPlane(k=2e4, radius=R, n_b=tuple(axis)),
        g=g,
        r=(0, 0.5, 0),
        w=(3, 1, 5),
        angles=(0.4, 0.2, 0.1),
        I=(0.05, 0.06, 0.08),
    )
    result = ac.simulate(model, stop_time=1.0, tolerance=1e-9, intervals=500)
    u = np.cross(axis, (1, 0, 0)) / np.linalg.norm(np.cross(axis, (1, 0, 0)))
    phi = np.linspace(0, 2 * np.pi, 20001)
    circle = R * (np.outer(np.cos(phi), u) + np.outer(np.sin(phi), np.cross(axis, u)))
    heights = result["body.r_0"][:, 1:2] + result["body.frame_a.R.T"][:, :, 1] @ circle.T
    np.testing.assert_allclose(result["it.x"], -np.min(heights, axis=1), atol=2e-8)
    x, v = result["it.x"], result["it.v"]
    assert np.sum(np.diff(x > 0)) >= 2
    smooth = np.abs(np.gradient(np.gradient(x))) < 1e-4
    np.testing.assert_allclose(np.gradient(x, result.time)[smooth], v[smooth], atol=0.03)
    kinetic = (np.sum(result["body.v_0"] ** 2, axis=1) + result["body.w_a"] ** 2 @ (0.05, 0.06, 0.08)) / 2
    energy = kinetic + g * result["body.r_0"][:, 1] + 2e4 * np.maximum(x, 0) ** 2 / 2
    np.testing.assert_allclose(energy, energy[0], rtol=1e-6)


BETWEEN: dict[str, Any] = {
    "point": PointOnPlane(k=2e4, n_a=(1, 0, 0), mu=0.3, e=0.6),
    "sphere": SphereOnPlane(k=1e7, radius=0.3, n_a=(1, 0, 0), mu=0.3, e=0.6),
    "rim": RimOnPlane(k=2e4, radius=0.3, n_a=(1, 0, 0), mu=0.3, dissipation=0.2),
    "two spheres": SphereOnSphere(k=1e7, radius_a=0.1, radius_b=0.2, mu=0.3, e=0.6),
    "profile": PointOnProfile(k=2e4, n_a=(1, 0, 0), height=lambda r: 0.1 * sin(20 * r[1]), mu=0.3, e=0.6),
    "sphere on a profile": SphereOnProfile(
        k=1e7, radius=0.2, n_a=(1, 0, 0), height=lambda r: 0.02 * sin(5 * r[1]) + 0.1 * r[2], mu=0.3, e=0.6
    ),
}


class Colliding(Model):
    """Two free bodies, which turn."""

    it = PointOnPlane(k=1)
    world = World(gravity=None)
    one = Body(
        m=1, I=0.004 * np.eye(3), angles_fixed=True, r_0=fixed((0, 0, 0)), v_0=fixed((2, 0, 0)), w_a=fixed((0, 0, 5))
    )
    other = Body(
        m=3,
        I=0.05 * np.eye(3),
        angles_fixed=True,
        r_0=fixed((0.4, 0.1, 0.05)),
        v_0=fixed((-1, 0, 0.5)),
        w_a=fixed((1, 2, 3)),
    )

    def connections(self):
        yield chain(self.one.frame_a, self.it, self.other)


@pytest.mark.parametrize("name", BETWEEN)
def test_momentum_and_energy_between_two_bodies(name):
    """On planes and profiles that move as well; v is the derivative of x."""
    result = ac.simulate(Colliding(it=BETWEEN[name]), stop_time=0.2, tolerance=1e-9, intervals=2000, energy=True)
    linear, angular = 0, 0
    for body, m, moment in (("one", 1, 0.004), ("other", 3, 0.05)):
        r, v, w, T = (result[f"{body}.{k}"] for k in ("r_0", "v_0", "w_a", "frame_a.R.T"))
        linear = linear + m * v
        angular = angular + np.cross(r, m * v) + moment * np.einsum("kji,kj->ki", T, w)
    assert np.linalg.norm(result["one.v_0"][-1] - result["one.v_0"][0]) > 0.1
    np.testing.assert_allclose(linear, np.broadcast_to(linear[0], np.shape(linear)), atol=1e-7)
    np.testing.assert_allclose(angular, np.broadcast_to(angular[0], np.shape(angular)), atol=1e-7)
    assert result.stats["energy_dissipated"] > 0.1
    assert abs(result.stats["energy_method"]) < 1e-6
    x, v = result["it.x"], result["it.v"]
    assert np.max(x) > 0
    np.testing.assert_allclose(np.cumsum((v[1:] + v[:-1]) / 2 * 1e-4), x[1:] - x[0], atol=1e-5)


class Rolling(Model):
    """A rim that is pressed flat on the ground, by an axis in its plane."""

    world, it = World(g=9.81), RimOnPlane(k=1e4, radius=0.3)
    joint, body = Revolute(n=(1, 0, 0), phi=fixed(0.3), w=fixed(4.0)), Body(m=1, I=np.eye(3))
    post = Fixed(r=(0, -0.05, 0))

    def connections(self):
        yield chain(self.post, self.joint, self.body)
        yield connect(self.world.frame_b, self.it.frame_a)
        yield connect(self.body.frame_a, self.it.frame_b)


def test_singular_positions():
    with pytest.raises(SimulationError, match="rim is parallel to the plane and has no lowest point"):
        ac.simulate(Rolling(it=RimOnPlane(k=5, radius=0.3)), stop_time=2.0)
    with pytest.raises(InitializationError, match="is parallel to the plane at the start"):
        ac.simulate(Ball(it=RimOnPlane(k=1, radius=0.3, n_b=(0, 1, 0)), r=(0, 1, 0)), stop_time=0.1)
    spheres = SphereOnSphere(k=10, radius_a=0.3, radius_b=0.3)
    with pytest.raises(InitializationError, match="are concentric at the start"):
        ac.simulate(Ball(it=spheres), stop_time=0.1)
    with pytest.warns(AcausalWarning), pytest.raises(SimulationError, match="spheres are concentric"):
        ac.simulate(Ball(it=spheres, r=(0, 0.7, 0), v=(0, -5, 0)), stop_time=1.0)


def test_doubtful_penetrations():
    with pytest.warns(AcausalWarning, match="exceeds a tenth of its radius"):
        ac.simulate(Ball(it=SphereOnPlane(k=1e4, radius=RADIUS), r=(0, 0.1, 0), v=(0, -2, 0)), stop_time=0.1)
    it = PointOnProfile(k=1e4, height=lambda r: 20 * r[0] ** 2)
    tight = SphereOnProfile(k=1e7, radius=RADIUS, height=lambda r: 11 * r[0] ** 2)
    with pytest.warns(AcausalWarning, match="smaller than that of the sphere"):
        ac.simulate(Ball(it=tight, r=(0, 0.1, 0), v=(0, -2, 0)), stop_time=0.1)
    with pytest.warns(AcausalWarning, match="tenth of the radius of curvature"):
        ac.simulate(Ball(it=it, r=(0, 0.1, 0), v=(0, -2, 0)), stop_time=0.1)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"e": 1.2}, "`e` of it is greater than 1"),
        ({"e": 0.0}, "greater than 0"),
        ({"e": 0.5, "dissipation": 0.1}, "both `dissipation` and `e`"),
        ({"n_a": (0, 0, 0)}, "has length 0"),
        ({"mu": -1}, "at least 0"),
    ],
)
def test_wrong_input(values, message):
    with pytest.raises(DeclarationError, match=message):
        ac.compile(Ball(it=PointOnPlane(**{"k": 1e4, **values})))


@pytest.mark.parametrize("length", [1e-6, 1e6])
def test_scales(length):
    """A ball that falls by its own radius, from a micrometre to 1000 km."""
    g, m = 9.81, 1000 * length**3
    speed = np.sqrt(2 * g * length)
    k = 1.25 * m * speed**2 / (1e-3 * length) ** 2.5
    world = World(g=g)
    start = {"r_0": fixed((0, 2 * length, 0)), "v_0": fixed((0, 0, 0)), "w_a": fixed((0, 0, 0))}
    body = Body(m=m, I=0.4 * m * length**2 * np.eye(3), angles_fixed=True, **start)
    model = Ball(world=world, body=body, it=SphereOnPlane(k=k, radius=length, e=0.5, v_e=1e-3 * speed))
    result = ac.simulate(model, stop_time=1.3 * np.sqrt(2 * length / g), intervals=800)
    height, v = result["body.r_0"][-1, 1] - length, result["body.v_0"][-1, 1]
    assert np.sqrt((v**2 + 2 * g * height) / speed**2) == pytest.approx(0.5, abs=0.003)
