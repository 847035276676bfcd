"""Gimbals that pass their singular angle, against the same body on a joint with quaternions."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Model, chain, fixed, guess, structural
from components import Body, Revolute, Spherical, World
from tests.hard.measure import within
from tests.reference import free_body

INERTIA = (0.5, 1.0, 1.2)
AXES = {"x-y-z": "XYZ", "z-y-z": "ZYZ"}
UNIT = {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1)}


class Gimbal(Model):
    """Three revolutes with axes that meet, and a body behind them whose centre of mass is there."""

    order: str = structural("axes from the world on", default="XYZ")
    angles: tuple[float, float, float] = structural("angles at the start", default=(0.0, 0.0, 0.0), shape=(3,))
    rates: tuple[float, float, float] = structural(
        "rates of the angles at the start", default=(0.0, 0.0, 0.0), shape=(3,)
    )
    ring: float = structural("moment of inertia of each ring about each axis", default=0.0)
    world = World(gravity=None)

    @ac.parts
    def joint(self):
        """The revolutes."""
        start = zip(self.order, self.angles, self.rates, strict=True)
        return [Revolute(n=UNIT[axis], phi=fixed(angle), w=fixed(rate)) for axis, angle, rate in start]

    @ac.parts
    def rings(self):
        """Rings behind the first two joints."""
        return [Body(m=0, I=self.ring * np.eye(3)) for _ in range(2)]

    body = Body(m=1, I=np.diag(INERTIA))

    def connections(self):
        yield chain(self.world, *self.joint, self.body)
        for joint, ring in zip(self.joint, self.rings, strict=False):
            yield chain(joint, ring)


class Free(Model):
    """The same body on a spherical joint, whose states are a quaternion."""

    Q: tuple[float, ...] = structural("quaternion at the start", default=(0, 0, 0, 1), shape=(4,))
    spin: tuple[float, float, float] = structural(
        "angular velocity in the body at the start", default=(0, 0, 0), shape=(3,)
    )
    world = World(gravity=None)

    @ac.part
    def joint(self):
        """The joint."""
        return Spherical(Q_start=self.Q, angles_fixed=True, w_rel=fixed(self.spin))

    body = Body(m=1, I=np.diag(INERTIA))

    def connections(self):
        yield chain(self.world, self.joint, self.body)


def start_of(order: str, angles: tuple[float, ...], rates: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Orientation from body to world (3, 3) and angular velocity on body axes of a gimbal."""
    first, second, third = (
        Rotation.from_rotvec(a * np.array(UNIT[axis])) for axis, a in zip(order, angles, strict=True)
    )
    e1, e2, e3 = (np.array(UNIT[axis], dtype=float) for axis in order)
    spin = rates[0] * e1 + first.apply(rates[1] * e2) + (first * second).apply(rates[2] * e3)
    turned = first * second * third
    return turned.as_matrix(), turned.inv().apply(spin)


def free_run(order: str, angles: tuple[float, ...], rates: tuple[float, ...], times: int, stop: float) -> ac.Result:
    """The free body with the start of the gimbal."""
    matrix, spin = start_of(order, angles, rates)
    model = Free(Q=tuple(Rotation.from_matrix(matrix).as_quat()), spin=tuple(spin))
    return ac.simulate(model, stop_time=stop, tolerance=1e-9, intervals=times)


# The middle angle starts 1 rad before its singular value and passes it at a distance of about the second rate.
SINGULAR = {"XYZ": np.pi / 2, "ZYZ": 0.0}


@pytest.mark.parametrize("order", ["XYZ", "ZYZ"])
@pytest.mark.parametrize("side", [0.1, 1e-2, 1e-3])
def test_massless_gimbal_passes_near_its_singular_angle(order, side):
    """Near the singular angle the outer and the inner ring turn by half a turn within about `side` seconds."""
    angles, rates = (0.3, SINGULAR[order] - 1.0, 0.2), (side, 1.0, -side)
    result = ac.simulate(Gimbal(order=order, angles=angles, rates=rates), stop_time=2.0, tolerance=1e-9, intervals=40)
    free = free_run(order, angles, rates, 40, 2.0)
    matrix, spin = start_of(order, angles, rates)
    w, Q = free_body.torque_free(INERTIA, spin, result.time, np.roll(Rotation.from_matrix(matrix).as_quat(), 1))
    exact = np.array([free_body.rotation_matrix(q) for q in Q])
    for name, run in (("quaternion", free), ("gimbal", result)):
        T = run["body.frame_a.R.T"].transpose(0, 2, 1)
        # The rates of the rings rise to 1 / side of that of the body.
        bound = 1e-6 if name == "quaternion" else 1e-6 / side
        within(f"orientation, {name}, rad", np.abs(T - exact).max(), bound)
        within(f"angular velocity, {name}, rad/s", np.abs(run["body.w_a"] - w).max(), bound)
    # Nothing but the body has mass: no torque acts on it.
    within("torque of the gimbal, N.m", np.abs(result["body.frame_a.t"]).max(), 1e-6 / side)


@pytest.mark.parametrize("order", ["XYZ", "ZYZ"])
def test_gimbal_passes_exactly_through_its_singular_angle(order):
    """A turn about the middle axis alone: the outer and the inner axis are parallel at one instant."""
    angles, rates = (0.0, SINGULAR[order] - 1.0, 0.0), (0.0, 1.0, 0.0)
    result = ac.simulate(Gimbal(order=order, angles=angles, rates=rates), stop_time=2.0, tolerance=1e-8, intervals=40)
    within("middle angle, rad", np.abs(result["joint[1].phi"] - angles[1] - result.time).max(), 1e-6)
    within("outer and inner angle, rad", np.abs([result["joint[0].phi"], result["joint[2].phi"]]).max(), 1e-6)
    within("torque, N.m", np.abs(result["body.frame_a.t"]).max(), 1e-6)


@pytest.mark.parametrize("order", ["XYZ", "ZYZ"])
def test_gimbal_with_heavy_rings_has_no_singular_angle(order):
    """Rings with inertia make the passage regular: energy and, about the outer axis, angular momentum stay."""
    angles, rates = (0.3, SINGULAR[order] - 1.0, 0.2), (0.5, 1.0, -0.7)
    model = Gimbal(order=order, angles=angles, rates=rates, ring=0.1)
    result = ac.simulate(model, stop_time=10.0, tolerance=1e-9, intervals=100, energy=True)
    within("energy lost, J", abs(result.stats["energy_method"]), 1e-6)
    axis = "XYZ".index(order[0])
    total = np.zeros(len(result.time))
    for name, I in (("body", np.array(INERTIA)), ("rings[0]", np.full(3, 0.1)), ("rings[1]", np.full(3, 0.1))):
        T = result[f"{name}.frame_a.R.T"]
        total += np.einsum("kji,kj->ki", T, result[f"{name}.w_a"] * I)[:, axis]
    within("angular momentum about the outer axis, N.m.s", np.abs(total - total[0]).max(), 1e-6)


class SingularStart(Gimbal):
    """A start in which the outer and the inner axis are one, as guesses."""

    @ac.parts
    def joint(self):
        """The revolutes."""
        return [Revolute(n=UNIT[a], phi=fixed(q), w=guess(0)) for a, q in zip(self.order, self.angles, strict=True)]


def test_start_in_the_singular_angle_with_rings():
    """With inertia in the rings a start in the singular angle is like any other."""
    model = Gimbal(angles=(0.0, np.pi / 2, 0.0), rates=(0.4, 0.2, 0.1), ring=0.1)
    result = ac.simulate(model, stop_time=5.0, tolerance=1e-9, intervals=20, energy=True)
    within("energy lost, J", abs(result.stats["energy_method"]), 1e-6)
