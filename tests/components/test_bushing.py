"""Bushings: energy in large rotations, an independent integration, small vibrations, limits and wrong input."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import AcausalWarning, DeclarationError, Model, SimulationError, chain, fixed, part, structural
from components import Body, Bushing, FixedTranslation, World

MASS, MOMENTS = 2.0, np.array([1.5, 2.5, 3.0])
SYMMETRIC = np.random.default_rng(3).normal(size=(6, 6))
SYMMETRIC = SYMMETRIC + SYMMETRIC.T
FULL = {
    "c": (80.0, 60.0, 90.0),
    "c_phi": (20.0, 30.0, 40.0),
    "stiffness": SYMMETRIC,
    "r_rel0": (0.3, -0.2, 0.1),
    "f_0": (1.0, 2.0, -3.0),
    "t_0": (0.5, -1.0, 2.0),
}
DAMPED = {"d": (1.0, 2.0, 3.0), "d_phi": (0.5, 0.2, 0.1), "damping": 0.1 * SYMMETRIC @ SYMMETRIC}


class Mounted(Model):
    """A free body on a bushing to the ground."""

    theta = structural("rotation vector at the start in rad", default=(0, 0, 0), shape=(3,))
    r = structural("position at the start in m", default=(0, 0, 0), shape=(3,))
    w = structural("angular velocity at the start in rad/s", default=(0, 0, 0), shape=(3,))
    world, it = World(gravity=None), Bushing()

    @part
    def body(self):
        angles = Rotation.from_rotvec(np.array(self.theta)).as_euler("XYZ")
        start = {"r_0": fixed(self.r), "v_0": fixed((0, 0, 0)), "w_a": fixed(self.w), "angles_start": tuple(angles)}
        return Body(m=MASS, I=np.diag(MOMENTS), angles_fixed=True, **start)

    def connections(self):
        yield chain(self.world, self.it, self.body)


def kinetic(result: ac.Result) -> np.ndarray:
    return MASS * np.sum(result["body.v_0"] ** 2, axis=1) / 2 + result["body.w_a"] ** 2 @ MOMENTS / 2


def test_energy_in_large_rotations():
    c, c_phi = np.array([10.0, 20.0, 30.0]), np.array([1.0, 10.0, 100.0])
    start = {"theta": tuple(1.5 * np.array([0.9993, 0.037, 0.005])), "r": (0.1, 0.05, 0.03)}
    result = ac.simulate(Mounted(it=Bushing(c=c, c_phi=c_phi), **start), stop_time=100.0, tolerance=1e-8)
    elastic = (result["it.r_rel"] ** 2 @ c + result["it.theta"] ** 2 @ c_phi) / 2
    energy = kinetic(result) + elastic
    assert np.ptp(elastic) > 1
    assert np.max(np.linalg.norm(result["it.theta"], axis=1)) == pytest.approx(1.5, abs=0.05)
    np.testing.assert_allclose(energy, energy[0], rtol=1e-6)


def potential(K: np.ndarray, r: np.ndarray, turn: Rotation) -> float:
    x = np.array([*(r - FULL["r_rel0"]), *turn.as_rotvec()])
    return x @ K @ x / 2 + x @ [*FULL["f_0"], *FULL["t_0"]]


def rates(K: np.ndarray, D: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Newton and Euler on (r, v, quaternion, w in the body), with differences of the potential instead of a torque."""
    r, v, turn, w = y[:3], y[3:6], Rotation.from_quat(y[6:10]), y[10:]
    h, each = 1e-5, np.eye(3)
    f = [-(potential(K, r + h * e, turn) - potential(K, r - h * e, turn)) / (2 * h) for e in each]
    turns = [[turn * Rotation.from_rotvec(s * h * e) for s in (1, -1)] for e in each]
    t = [-(potential(K, r, more) - potential(K, r, less)) / (2 * h) for more, less in turns]
    loss = D @ [*v, *turn.apply(w)]
    t = t - turn.inv().apply(loss[3:])
    e, s = y[6:9], y[9]
    quaternion = [*(s * w + np.cross(e, w)) / 2, -e @ w / 2]
    return np.array([*v, *(f - loss[:3]) / MASS, *quaternion, *(t - np.cross(w, MOMENTS * w)) / MOMENTS])


def test_an_independent_integration():
    """All parameters at once: from the potential alone, with rotation vectors of scipy."""
    theta, r, w = (0.6, -1.0, 0.8), (0.5, 0.1, 0.2), (0.4, 0.3, -0.5)
    result = ac.simulate(
        Mounted(it=Bushing(**FULL, **DAMPED), theta=theta, r=r, w=w),
        stop_time=2.0,
        tolerance=1e-9,
        intervals=20,
        energy=True,
    )
    K = np.diag([*FULL["c"], *FULL["c_phi"]]) + SYMMETRIC
    D = np.diag([*DAMPED["d"], *DAMPED["d_phi"]]) + DAMPED["damping"]
    start = [*r, 0, 0, 0, *Rotation.from_rotvec(theta).as_quat(), *w]
    solved = solve_ivp(lambda t, y: rates(K, D, y), (0, 2), start, t_eval=result.time, rtol=1e-9, atol=1e-10)
    np.testing.assert_allclose(result["body.r_0"], solved.y[:3].T, atol=1e-7)
    np.testing.assert_allclose(result["it.theta"], Rotation.from_quat(solved.y[6:10].T).as_rotvec(), atol=1e-7)
    stats = result.stats
    assert stats["energy_dissipated"] > 1
    assert abs(stats["energy_method"]) < 1e-7 * stats["energy_dissipated"]


def test_small_vibrations():
    """From rest without rotation: no division by 0, and the natural frequencies of a mass on springs."""
    linear = ac.linearize(Mounted(it=Bushing(c=(8, 18, 32), c_phi=(1.5, 10, 48))))
    expected = np.sqrt(np.sort([4.0, 9.0, 16.0, 1.0, 4.0, 16.0])) / (2 * np.pi)
    np.testing.assert_allclose(linear.frequencies_hz, expected, rtol=1e-9)
    result = ac.simulate(Mounted(it=Bushing(c=(8, 18, 32), c_phi=(1.5, 10, 48)), w=(1e-9, 0, 0)), stop_time=1.0)
    assert result["it.theta"][-1, 0] == pytest.approx(1e-9 * np.sin(1.0), rel=1e-4)


class Swinging(Model):
    """Two free bodies, a bushing off the axes of both between them."""

    world, arm = World(gravity=None), FixedTranslation(r=(0.3, 0.2, 0.1))
    it = Bushing(c=(500, 400, 300), c_phi=(5, 6, 7), d=(1, 2, 3), d_phi=(0.1, 0.2, 0.3), r_rel0=(0.2, 0, 0))
    bar = Body(
        m=1, I=np.eye(3), angles_fixed=True, r_0=fixed((0, 0, 0)), v_0=fixed((0, 0, 0)), w_a=fixed((0.5, -0.5, 1))
    )
    load = Body(
        m=MASS,
        I=np.diag(MOMENTS),
        angles_fixed=True,
        r_0=fixed((0.5, 0.3, 0.1)),
        v_0=fixed((0, 0, 0)),
        w_a=fixed((1, 2, -1)),
    )

    def connections(self):
        yield chain(self.bar.frame_a, self.arm, self.it, self.load)


def test_momentum_between_moving_bodies():
    """Forces and moments act and react: the balance of energy and that of momentum about the origin hold."""
    result = ac.simulate(Swinging(), stop_time=1.0, tolerance=1e-9, energy=True)
    at = result["it.frame_a.r_0"], result["it.frame_b.r_0"]
    turn = [result[f"it.frame_{k}.R.T"].transpose(0, 2, 1) for k in "ab"]
    f = [np.einsum("kij,kj->ki", T, result[f"it.frame_{k}.f"]) for T, k in zip(turn, "ab", strict=True)]
    t = [np.einsum("kij,kj->ki", T, result[f"it.frame_{k}.t"]) for T, k in zip(turn, "ab", strict=True)]
    assert np.ptp(f[0], axis=0).min() > 1
    np.testing.assert_allclose(f[0] + f[1], 0, atol=1e-9)
    moment = sum(t[k] + np.cross(at[k], f[k]) for k in (0, 1))
    np.testing.assert_allclose(moment, 0, atol=1e-9)
    assert abs(result.stats["energy_method"]) < 1e-6 * result.stats["energy_dissipated"]


def test_limits_of_the_rotation():
    def spun(w):
        return Mounted(it=Bushing(c=(1, 1, 1), c_phi=(1, 1, 1)), w=(w, 0, 0))

    with pytest.warns(AcausalWarning, match=r"rotation exceeds 2\.5 rad"):
        ac.simulate(spun(2.7 / np.sqrt(MOMENTS[0])), stop_time=3.0)
    with pytest.warns(AcausalWarning), pytest.raises(SimulationError, match="reaches half a turn") as stopped:
        ac.simulate(spun(4.0 / np.sqrt(MOMENTS[0])), stop_time=5.0)
    # phi = 4 sin(t / sqrt(I)) reaches pi
    assert f"t = {np.sqrt(MOMENTS[0]) * np.arcsin(np.pi / 4):.4g}" in str(stopped.value)


def test_dampers_alone_may_turn_round():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = ac.simulate(Mounted(it=Bushing(d_phi=(0.1, 0.1, 0.1)), w=(3, 0, 0)), stop_time=5.0, tolerance=1e-8)
    np.testing.assert_allclose(result["body.w_a"][-1], (3 * np.exp(-0.1 * 5 / MOMENTS[0]), 0, 0), atol=1e-6)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"stiffness": np.triu(np.ones((6, 6)))}, "is not symmetric"),
        ({"damping": -np.eye(6)}, "negative eigenvalue"),
        ({"c": (1, -1, 1)}, "at least 0"),
    ],
)
def test_wrong_input(values, message):
    with pytest.raises(DeclarationError, match=message):
        ac.compile(Mounted(it=Bushing(**values)))
