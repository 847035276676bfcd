"""Linear systems whose matrices are known in closed form."""

from __future__ import annotations

import numpy as np

import acausal as ac
from acausal import Model, Scalar, Vector3, connect, der, fixed, input, output, parameter
from components import Body, World, WorldForce

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
