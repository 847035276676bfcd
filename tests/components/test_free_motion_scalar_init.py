"""FreeMotionScalarInit: each coordinate of a free motion takes a start value of its own."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Model, chain, fixed, guess
from components import Body, FixedRotation, FreeMotion, FreeMotionScalarInit, Revolute, World

INERTIA = np.diag([0.1, 0.2, 0.3])
ANGLES = (0.3, -0.2, 0.5)
W = np.array([1.0, 2.0, 1.5])
R, V = (0.1, 0.2, -0.1), (0.5, 1.0, 0.3)


def numbered(name, values):
    return {f"{name}_{k}": fixed(float(x)) for k, x in enumerate(values, 1)}


class Tumbling(Model):
    """A body that moves freely relative to an arm that turns."""

    world, arm = World(), Revolute(n=(1, 2, 3), phi=fixed(0.4), w=fixed(3))
    base = FixedRotation(r=(0.3, 0.1, 0), n=(0, 1, 1), angle=0.7)
    hub = Body(m=1, I=np.diag([0.3, 0.2, 0.4]))
    joint = FreeMotion(
        angles_start=ANGLES, angles_fixed=True, w_rel=fixed(tuple(W)), r_rel_a=fixed(R), v_rel_a=fixed(V)
    )
    body = Body(m=1, I=INERTIA)

    def connections(self):
        yield chain(self.world, self.arm, self.base, self.joint, self.body)
        yield chain(self.base, self.hub)


def rates(w):
    """Rates of the angles about the axes 1, 2 and 3 from the angular velocity resolved in frame_b."""
    _, b, c = ANGLES
    columns = [Rotation.from_euler("XYZ", (0, b, c)), Rotation.from_euler("YZ", (0, c)), Rotation.from_euler("Z", 0)]
    G = np.array([turn.inv().apply(axis) for turn, axis in zip(columns, np.eye(3), strict=True)]).T
    return np.linalg.solve(G, w)


POSITION = numbered("r_rel_a", R) | numbered("v_rel_a", V)
STARTS = {
    "angles and their rates": numbered("angle", ANGLES) | numbered("angle_d", rates(W)),
    "angles and angular velocity": numbered("angle", ANGLES) | numbered("w_rel_b", W),
}


@pytest.mark.parametrize("use_angle", [True, False])
@pytest.mark.parametrize("start", STARTS)
def test_the_motion_is_that_of_a_free_joint(start, use_angle):
    """Relative to a frame that turns, from either set of coordinates."""
    expected = ac.simulate(Tumbling(), stop_time=0.6, tolerance=1e-9)
    joint = FreeMotionScalarInit(use_angle=use_angle, **POSITION, **STARTS[start])
    result = ac.simulate(Tumbling(joint=joint), stop_time=0.6, tolerance=1e-9)
    np.testing.assert_allclose(result["body.r_0"], expected["body.r_0"], atol=1e-6)
    np.testing.assert_allclose(result["body.frame_a.R.T"], expected["body.frame_a.R.T"], atol=1e-6)
    T = expected["body.frame_a.R.T"] @ expected["base.frame_b.R.T"].transpose(0, 2, 1)
    angles = Rotation.from_matrix(T.transpose(0, 2, 1)).as_euler("XYZ")
    found = np.column_stack([result[f"joint.angle_{k}"] for k in (1, 2, 3)])
    np.testing.assert_allclose(found, angles, atol=1e-6)
    for k in range(3):
        np.testing.assert_allclose(result[f"joint.r_rel_a_{k + 1}"], expected["joint.r_rel_a"][:, k], atol=1e-6)
        np.testing.assert_allclose(result[f"joint.v_rel_a_{k + 1}"], expected["joint.v_rel_a"][:, k], atol=1e-5)
        np.testing.assert_allclose(result[f"joint.a_rel_a_{k + 1}"], expected["joint.a_rel_a"][:, k], atol=1e-4)
        np.testing.assert_allclose(result[f"joint.w_rel_b_{k + 1}"], expected["joint.w_rel"][:, k], atol=1e-5)
        np.testing.assert_allclose(result[f"joint.z_rel_b_{k + 1}"], expected["joint.z_rel"][:, k], atol=1e-4)


class Alone(Model):
    world, joint, body = World(gravity=None), FreeMotionScalarInit(), Body(m=1, I=INERTIA)

    def connections(self):
        yield chain(self.world, self.joint, self.body)


@pytest.mark.parametrize("sequence", [(1, 2, 3), (3, 1, 3)])
def test_the_sequence_of_the_axes(sequence):
    """Angles and their rates give orientation and angular velocity; a turn past a full one is no other orientation."""
    start = numbered("angle", ANGLES) | numbered("angle_d", (1, 2, 3)) | numbered("r_rel_a", R) | numbered("v_rel_a", V)
    joint = FreeMotionScalarInit(use_angle=True, sequence_start=sequence, **start)
    result = ac.simulate(Alone(joint=joint), stop_time=1e-3, tolerance=1e-9)
    turn = Rotation.from_euler("".join("XYZ"[k - 1] for k in sequence), ANGLES)
    np.testing.assert_allclose(result["body.frame_a.R.T"][0], turn.as_matrix().T, atol=1e-9)
    later = Rotation.from_matrix(result["body.frame_a.R.T"][-1].T)
    np.testing.assert_allclose((turn.inv() * later).as_rotvec() / 1e-3, result["body.w_a"][0], atol=1e-2)


def test_angular_velocity_without_angles_starts_a_body_that_takes_its_own():
    """The rates hold beside the orientation that the body is given."""
    body = Body(m=1, I=INERTIA, angles_start=ANGLES, angles_fixed=True, r_0=fixed(R), v_0=fixed(V))
    joint = FreeMotionScalarInit(w_rel_b_1=fixed(1), w_rel_b_2=fixed(2), angle_d_3=fixed(0.5), w_rel_b_3=guess(1))
    result = ac.simulate(Alone(joint=joint, body=body), stop_time=0.1)
    np.testing.assert_allclose(result["body.w_a"][0, :2], [1, 2], atol=1e-9)
    assert result["joint.angle_d_3"][0] == pytest.approx(0.5)
