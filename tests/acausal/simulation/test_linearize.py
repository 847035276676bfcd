"""Linear systems whose matrices are known in closed form."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Model,
    Scalar,
    Vector3,
    chain,
    connect,
    der,
    fixed,
    guess,
    input,
    output,
    parameter,
    piecewise,
    reinit,
    structural,
    time,
    variable,
    when,
)
from components import Body, BodyRod, Fixed, Revolute, World, WorldForce, rotational

NOTHING = fixed((0, 0, 0))


class Oscillator(Model):
    """x'' = -4 x - 0.4 x' + u."""

    k: Scalar = parameter("stiffness over mass", unit="1/s2", default=4)
    d: Scalar = parameter("damping over mass", unit="1/s", default=0.4)

    u: Scalar = input("force over mass", unit="m/s2")
    x: Scalar = output("position", unit="m")
    v: Scalar = output("speed", unit="m/s")

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == -self.k * self.x - self.d * self.v + self.u


def test_matrices_of_an_oscillator():
    found = ac.linearize(Oscillator(x=fixed(0.1), v=fixed(0)))
    np.testing.assert_allclose(found.A, [[0, 1], [-4, -0.4]])
    np.testing.assert_allclose(found.B, [[0], [1]])
    np.testing.assert_allclose(found.C, np.eye(2))
    np.testing.assert_allclose(found.D, np.zeros((2, 1)))
    assert (found.states, found.inputs, found.outputs) == (("x", "v"), ("u",), ("x", "v"))
    np.testing.assert_allclose(found.frequencies_hz, np.sqrt(4 - 0.04) / (2 * np.pi))
    np.testing.assert_allclose(found.damping_ratios, 0.1)


class Floating(Model):
    """A body that nothing holds, at rest."""

    world = World(gravity=None)
    body = Body(m=2.0, I=np.diag([1.0, 2.0, 3.0]), angles_fixed=True, r_0=NOTHING, v_0=NOTHING, w_a=NOTHING)
    force = WorldForce()
    f: Vector3 = input("force, resolved in the world", unit="N")
    r: Vector3 = output("position", unit="m")

    def connections(self):
        yield connect(self.force.frame_b, self.body.frame_a)

    def equations(self):
        yield self.force.force == self.f
        yield self.r == self.body.r_0


def test_norm_of_a_quaternion_is_neither_moved_nor_seen():
    """It returns with -2 1/s; all else is free: a double integrator for each of the 6 coordinates."""
    found = ac.linearize(Floating())
    values, vectors = np.linalg.eig(found.A)
    np.testing.assert_allclose(np.sort(values.real), [-2, *[0] * 12], atol=1e-12)
    np.testing.assert_allclose(found.C @ vectors[:, np.argmin(values.real)], 0, atol=1e-12)
    turned = [np.linalg.matrix_power(found.A, k) @ found.B for k in range(13)]
    left = np.linalg.eig(found.A.T)[1][:, np.argmin(np.linalg.eig(found.A.T)[0].real)]
    np.testing.assert_allclose(left @ np.hstack(turned), 0, atol=1e-12)


class Spinning(Floating):
    """The same, turning about an axis; what it shows of its rotation depends on the quaternion."""

    shown: Scalar = output("an entry of the rotation matrix")

    def equations(self):
        yield from super().equations()
        yield self.shown == self.body.frame_a.R.T[0, 1]


@pytest.mark.parametrize("w", [(0, 0, 1.0), (0, 0, 5.0), (0.3, -2.0, 1.0)])
def test_a_free_body_that_turns_has_no_damped_modes(w):
    found = ac.linearize(
        Spinning(body=Body(m=2.0, I=np.eye(3), angles_fixed=True, r_0=NOTHING, v_0=NOTHING, w_a=fixed(w)))
    )
    np.testing.assert_allclose(found.eigenvalues.real, 0, atol=1e-6)


class AtStart(Model):
    """What holds at the start alone: by the clock, by a state that just leaves where it was, by a jump."""

    x: Scalar = variable("by the clock", fixed=True, start=1)
    s: Scalar = variable("gap", fixed=True)
    v: Scalar = variable("speed", fixed=True, start=-1)
    y: Scalar = variable("jumps", fixed=True, start=1)

    def equations(self):
        yield der(self.x) == piecewise((-5 * self.x, time > 1), -self.x)
        yield der(self.s) == self.v
        yield der(self.v) == piecewise((-1e4 * self.s - 5 * self.v, self.s < 0), 0)
        yield der(self.y) == -(self.y**3)
        yield when(time >= 1, reinit(self.y, 3.0), at_start=True)


@pytest.mark.parametrize(("begin", "rates"), [(0.0, [-1, -3]), (1.0, [-5, -27])])
def test_the_point_is_the_one_after_what_happens_at_the_start(begin, rates):
    found = ac.linearize(AtStart(), time=begin)
    np.testing.assert_allclose(np.diag(found.A)[[0, 3]], rates)
    np.testing.assert_allclose(found.A[1:3, 1:3], [[0, 1], [-1e4, -5]])
    run = ac.simulate(AtStart(), start_time=begin, stop_time=begin + 1e-6, intervals=1, tolerance=1e-10)
    np.testing.assert_allclose((run["x"][1] - run["x"][0]) / 1e-6, found.A[0, 0] * run["x"][0], rtol=1e-4)


def test_a_brake_that_does_not_hold_slides():
    class Brake(Model):
        world = World()
        hinge = Revolute(phi=fixed(0.3), w=fixed(0), use_axis_flange=True)
        rod = BodyRod(r=(1, 0, 0), m=2.0)
        brake = rotational.Friction(tau_sliding=1.0, tau_static=2.0)

        def connections(self):
            yield chain(self.world, self.hinge, self.rod)
            yield chain(self.hinge.support, self.brake, self.hinge.axis)

    found = ac.linearize(Brake())
    np.testing.assert_allclose(found.A, [[0, 1], [9.80665 * np.sin(0.3) * 1.5, 0]], atol=1e-9)


class FreeTrain(Model):
    """Three rotors on two shafts, free to turn together."""

    k = parameter("stiffness", unit="N.m/rad", shape=(2,), default=(2.0, 3.0))
    J: Vector3 = parameter("inertia", unit="kg.m2", default=(1.0, 2.0, 0.5))
    phi: Vector3 = variable("angles", unit="rad", fixed=True)
    w: Vector3 = variable("speeds", unit="rad/s", fixed=True)

    def equations(self):
        one, two = (self.k[i] * (self.phi[i + 1] - self.phi[i]) for i in range(2))
        yield der(self.phi) == self.w
        for i, torque in enumerate((one, two - one, -two)):
            yield self.J[i] * der(self.w[i]) == torque


def test_a_free_coordinate_is_no_vibration():
    compiled = ac.compile(FreeTrain())
    for seed in range(50):
        random = np.random.default_rng(seed)
        k, J = 10.0 ** random.uniform(-2, 2, 2), 10.0 ** random.uniform(-1, 1, 3)
        stiffness = np.array([[k[0], -k[0], 0], [-k[0], k.sum(), -k[1]], [0, -k[1], k[1]]])
        squares = np.sort(np.linalg.eigvals(stiffness / J[:, None]).real)[1:]
        found = ac.linearize(compiled, parameters={"k": tuple(k), "J": tuple(J)})
        np.testing.assert_allclose(found.frequencies_hz, np.sqrt(squares) / (2 * np.pi), rtol=1e-6)


class Shown(Model):
    """A matrix that is shown."""

    u: Vector3 = input("first row", start=(1.0, 2, 3))
    x: Scalar = variable("factor of the second row", fixed=True, start=1)
    table = output("matrix", shape=(2, 3))

    def equations(self):
        yield der(self.x) == -self.x
        rows = [[self.u[0], self.u[1], self.u[2]], [self.x, 2 * self.x, 3 * self.x]]
        yield self.table == rows


def test_entries_of_matrices_are_named_as_in_results():
    found = ac.linearize(Shown())
    assert found.inputs == ("u[0]", "u[1]", "u[2]")
    by_name = {name: (c, d.tolist()) for name, (c,), d in zip(found.outputs, found.C, found.D, strict=True)}
    assert set(by_name) == {series.name for series in ac.simulate(Shown(), stop_time=1.0).series()}
    assert by_name["table[0,2]"] == (0, [0, 0, 1])
    assert by_name["table[1,2]"] == (3, [0, 0, 0])


class Hanging(Model):
    """A parallelogram whose pivots are above one another: it rests flat."""

    angle: Any = structural("first guess of the bars", default=-1.3)
    world = World(g=9.81)
    low = Fixed(r=(0, -1, 0))
    j1, j2, j3, j4 = Revolute(phi=guess(angle)), Revolute(phi=guess(-angle)), Revolute(phi=guess(angle)), Revolute()
    left, coupler, right = BodyRod(r=(0.5, 0, 0), m=1), BodyRod(r=(0, -1, 0), m=2), BodyRod(r=(0.5, 0, 0), m=1)

    def connections(self):
        yield chain(self.world, self.j1, self.left, self.j2, self.coupler, self.j3, self.right.frame_b)
        yield chain(self.low, self.j4, self.right)


@pytest.mark.parametrize("angle", [-1.3, -0.5, -2.2])
def test_a_rest_in_a_flat_position_is_not_linearised(angle):
    """Forces of rigid parts are not determined there; eigenvalues would be rounding, other ones for each guess."""
    with pytest.raises(ac.InitializationError, match="rest in a singular configuration"):
        ac.linearize(Hanging(angle=angle), initial="steady")
