"""w_0_start: the angular velocity at the start, resolved in the world."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Model, chain, fixed
from components import Body, BodyBox, BodyCylinder, BodyRod, BodyShape, Spherical, World

ANGLES, W = (0.3, -0.2, 0.5), (1.0, 2.0, 3.0)
START = {"angles_start": ANGLES, "w_0_start": W, "w_0_fixed": True}
INERTIA = np.diag([0.1, 0.2, 0.25])


def in_world(result):
    return np.einsum("kji,kj->ki", result["body.frame_a.R.T"], result["body.w_a"])


class Free(Model):
    world = World(gravity=None)
    body = Body(m=1, I=INERTIA, **START, angles_fixed=True, r_0=fixed((1, 2, 3)), v_0=fixed((0, 0, 0)))


class Held(Model):
    """On a ball joint, which tells the orientation."""

    world, joint = World(gravity=None), Spherical(angles_start=ANGLES, angles_fixed=True)
    body = Body(m=1, r_CM=(0.2, 0, 0), I=INERTIA, w_0_start=W, w_0_fixed=True)

    def connections(self):
        yield chain(self.world, self.joint, self.body)


@pytest.mark.parametrize("model", [Free, Held])
def test_the_angular_velocity_in_the_world(model):
    """And the angular momentum in the world is kept, of the free body."""
    result = ac.simulate(model(), stop_time=1, tolerance=1e-9)
    np.testing.assert_allclose(in_world(result)[0], W, atol=1e-9)
    if model is Free:
        momentum = np.einsum("kji,kj->ki", result["body.frame_a.R.T"], result["body.w_a"] @ INERTIA)
        T = Rotation.from_euler("XYZ", ANGLES).as_matrix()
        np.testing.assert_allclose(momentum, np.tile(T @ INERTIA @ T.T @ W, (len(result.time), 1)), atol=1e-6)


@pytest.mark.parametrize("kind", [BodyShape, BodyBox, BodyCylinder, BodyRod])
def test_shapes_pass_it_on(kind):
    sizes = {
        BodyShape: {"m": 1, "I": INERTIA},
        BodyBox: {"width": 0.1, "height": 0.2},
        BodyCylinder: {"diameter": 0.1},
        BodyRod: {"m": 1, "I": INERTIA},
    }
    body = kind(r=(1, 0, 0), **sizes[kind], **START, angles_fixed=True, r_0=fixed((0, 0, 0)), v_0=fixed((0, 0, 0)))
    np.testing.assert_allclose(in_world(ac.simulate(Free(body=body), stop_time=0.01))[0], W, atol=1e-9)


def test_a_guess_unless_fixed():
    body = Body(m=1, I=INERTIA, angles_start=ANGLES, w_0_start=W)
    with pytest.raises(ac.InitializationError, match="12 start values are missing"):
        ac.simulate(Free(body=body), stop_time=0.01)
    np.testing.assert_allclose(in_world(ac.simulate(Free(body=body), stop_time=0.01, initial="guesses"))[0], W)


def test_two_values_that_contradict_each_other_are_refused():
    body = Body(m=1, I=INERTIA, **START, angles_fixed=True, w_a=fixed((0, 0, 1)))
    with pytest.raises(ac.InitializationError, match="More values are fixed than there are degrees of freedom"):
        ac.simulate(Free(body=body), stop_time=0.01, initial="guesses")
