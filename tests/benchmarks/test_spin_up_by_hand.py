"""The hand-derived spin-up against known deflections and against the work of its hub torque."""

import casadi as ca
import numpy as np
import pytest

from tests.benchmarks.spin_up_by_hand import HandModel, build, simulate


def energy(model: HandModel, times: np.ndarray, states: np.ndarray) -> np.ndarray:
    """Kinetic and elastic energy from points in the inertial frame: shapes and frames, no equation of motion."""
    beam, l = model.beam, model.beam.length / model.volumes
    xi, weight = np.polynomial.legendre.leggauss(5)  # exact up to degree 9; r' is cubic
    xi, weight = (xi[:, None] + 1) / 2, weight[:, None] * l / 2
    hermite = np.array([3 * xi**2 - 2 * xi**3, l * (xi**3 - xi**2)])
    bend = np.array([6 - 12 * xi, l * (6 * xi - 2)]) / l**2
    angle, w, _ = (np.asarray(level).ravel() for level in model.theta(times[None, :]))
    velocity = np.zeros(len(times), dtype=complex)  # of the frame's origin; complex numbers are vectors of the plane
    total = np.zeros(len(times))
    for q1, q2, q3, v1, v2, v3 in states.reshape(model.volumes, 6, -1):
        r = xi * (l + q1) + 1j * (hermite[0] * q2 + hermite[1] * q3)
        r_dot = xi * v1 + 1j * (hermite[0] * v2 + hermite[1] * v3)
        v = velocity + np.exp(1j * angle) * (1j * w * r + r_dot)
        total += (weight * beam.rho * beam.A / 2 * abs(v) ** 2).sum(axis=0)
        strain, curvature = q1 / l, bend[0] * q2 + bend[1] * q3
        total += (weight * beam.E / 2 * (beam.A * strain**2 + beam.J * curvature**2)).sum(axis=0)
        velocity = velocity + np.exp(1j * angle) * (1j * w * (l + q1 + 1j * q2) + v1 + 1j * v2)
        angle, w = angle + q3, w + v3
    return total


@pytest.mark.parametrize(("volumes", "deflection"), [(5, -0.54748), (20, -0.53502)])
def test_deflection(volumes: int, deflection: float) -> None:
    run = simulate(build(volumes, omega=4.0), tolerance=1e-8)
    assert run.tip_deflection.min() == pytest.approx(deflection, abs=3e-4)


def test_unknowns_and_order() -> None:
    model = build(10, omega=10.0)
    assert (model.n_states, model.n_algebraic) == (60, 96)
    jacobian = ca.jacobian(model.dae["alg"], model.dae["z"])
    assert max(abs(row - column) for row, column in zip(*jacobian.sparsity().get_triplet(), strict=True)) <= 13


@pytest.mark.parametrize("volumes", [3, 5])
def test_work_of_the_hub_is_energy(volumes: int) -> None:
    model = build(volumes, omega=4.0)
    dae = model.dae
    power = model.theta(dae["t"])[1] * dae["z"][model.hub_torque]
    times = np.linspace(0.0, 20.0, 41)
    options = {"reltol": 1e-10, "abstol": 1e-10, "max_multistep_order": 2, "suppress_algebraic": True}
    options |= {"quad_err_con": True, "max_num_steps": 200_000}
    end = ca.integrator("energy", "idas", dae | {"quad": power}, 0.0, list(times), options)(x0=0, z0=0)
    stored = energy(model, times, np.asarray(end["xf"]))
    assert stored.max() > 200.0
    # bending and stretching carry 2 J of 276 J, so a wrong inertia term cannot hide in the rigid motion
    assert np.abs(np.asarray(end["qf"]).ravel() - stored).max() < 1e-6 * stored.max()
