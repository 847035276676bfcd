"""Quaternions of rotation matrices against those of scipy."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from acausal.animation.rotations import quaternions, rotation_angles


def matrices(rotations: Rotation) -> np.ndarray:
    """Matrices T from the world to frames that are turned by some rotations."""
    return rotations.as_matrix().transpose(0, 2, 1)


def test_quaternions_turn_vectors_into_the_world() -> None:
    four = np.random.default_rng(1).standard_normal((2000, 4))
    rotations = Rotation.from_quat(four)
    w, x, y, z = quaternions(matrices(rotations)).T
    again = Rotation.from_quat(np.stack([x, y, z, w], axis=1))
    assert np.max((again * rotations.inv()).magnitude()) < 1e-14
    transposed = Rotation.from_quat(np.stack([-x, -y, -z, w], axis=1))
    assert np.median((transposed * rotations.inv()).magnitude()) > 1


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (1, -1, 1), (0, 1e-9, 1)])
@pytest.mark.parametrize("off", [0.0, 1e-16, 1e-12, 1e-8, 1e-4])
def test_half_turns_are_as_exact_as_others(axis: tuple[float, ...], off: float) -> None:
    n = np.array(axis) / np.linalg.norm(axis)
    q = quaternions(matrices(Rotation.from_rotvec([n * (np.pi - off)])))[0]
    assert q @ q == pytest.approx(1, abs=1e-15)
    assert abs(q[1:] @ n) == pytest.approx(np.cos(off / 2), abs=1e-15)
    assert abs(q[0]) == pytest.approx(np.sin(off / 2), abs=1e-15)


def test_signs_are_continuous_over_many_turns() -> None:
    angle = np.linspace(0, 50, 1001)
    q = quaternions(matrices(Rotation.from_rotvec(np.outer(angle, [0, 0.6, 0.8]))))
    # Half the angle, which the shortest way alone would not tell.
    assert q[:, 0] == pytest.approx(np.cos(angle / 2), abs=1e-14)
    assert q[:, 1:] == pytest.approx(np.outer(np.sin(angle / 2), [0, 0.6, 0.8]), abs=1e-14)
    assert rotation_angles(q) == pytest.approx(np.full(1000, 0.05), rel=1e-6)


@pytest.mark.parametrize("wrong", [np.diag([1.0, 1.0, -1.0]), 1.1 * np.eye(3), np.zeros((3, 3))])
def test_what_is_no_rotation_is_refused(wrong: np.ndarray) -> None:
    with pytest.raises(ValueError, match="not a rotation"):
        quaternions(np.array([np.eye(3), wrong]))
