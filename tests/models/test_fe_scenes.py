"""Scenes of bodies from FE matrices against an independent program: own elements, floating frame, explicit Runge-Kutta."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from components.fe import FEBody, read_npz, reduce_body
from models import FEPendulum, FEPlate
from models.fe_pendulum import HINGE, TIP, rod

DATA = Path(__file__).parents[1] / "reference" / "fe"
PLATE = str(DATA / "plate_fe_h25.npz")


@cache
def table(name: str) -> dict[str, np.ndarray]:
    found = np.genfromtxt(DATA / f"{name}.csv", delimiter=",", names=True, deletechars="")
    return {name: found[name] for name in found.dtype.names}


def swing(model: ac.Model, stop_time: float = 0.3, tolerance: float = 1e-9) -> np.ndarray:
    """Height of the tip and its rate every 3 ms."""
    result = ac.simulate(model, stop_time=stop_time, tolerance=tolerance, intervals=round(stop_time / 3e-3))
    return np.stack([result["tip_z"], result["tip_vz"]], axis=1)


@pytest.mark.parametrize(("modes", "rate"), [(9, 1e-5), (40, 3e-4)])
def test_pendulum(modes, rate):
    data = table("pendulum_qm6_8x2x1")
    found = swing(FEPendulum(modes=modes))
    np.testing.assert_allclose(found[:, 0], data[f"ffrf{modes}_z[m]"], rtol=0, atol=2e-7)
    np.testing.assert_allclose(found[:, 1], data[f"ffrf{modes}_vz[m/s]"], rtol=0, atol=rate)


def test_rigid_pendulum():
    """Of the second formulation; the elastic one is 2 mm off."""
    data = table("pendulum_qm6_8x2x1")
    found = swing(FEPendulum(formulation="rigid"))
    np.testing.assert_allclose(found[:, 0], data["rigid_z[m]"], rtol=0, atol=2e-7)
    assert np.abs(found[:, 0] - data["ffrf40_z[m]"]).max() > 1e-3


@pytest.mark.parametrize("modes", [30])
def test_pendulum_of_other_bricks(modes):
    """Full integration, from the matrices of another program, which has computed it with large displacements as well."""

    class Other(FEPendulum):
        @ac.part
        def body(self):
            M, K, nodes = read_npz(DATA / "rod_ccx_c3d8_8x2x1.npz")
            at = {place: int(np.argmin(np.linalg.norm(nodes - place, axis=1))) for place in PLACES}
            frames = {"hinge": [at[place] for place in PLACES[:3]], "tip": [at[PLACES[3]]]}
            hold = {"hinge": "xyz", "tip": "z"}
            reduced = reduce_body(M, K, nodes, frames=frames, hold=hold, modes=modes)
            return FEBody(reduced=reduced, check_range=False)

    data = table("pendulum_c3d8_nlgeom")
    found = swing(Other(), stop_time=0.15)[1:, 0]
    step = np.round(data["t[s]"] * 1e3).astype(int)
    whole = step % 3 == 0
    compared = found[step[whole] // 3 - 1]
    np.testing.assert_allclose(compared, data["ffrf30_z[m]"][whole], rtol=0, atol=2e-7)
    np.testing.assert_allclose(compared, data["ccx_nlgeom_z[m]"][whole], rtol=0, atol=1e-4)


PLACES = ((0.0, 0.0, 0.0), (0.0, 0.0075, 0.0), (0.0, 0.015, 0.0), (0.1, 0.0075, 0.0))


def test_nodes_of_the_pendulum():
    nodes = rod(9).nodal.nodes + rod(9).origin
    np.testing.assert_allclose(nodes[HINGE], PLACES[:3], atol=1e-15)
    np.testing.assert_allclose(nodes[TIP], PLACES[3], atol=1e-15)


def plate(name: str, model: ac.Model, tolerance: float, prefix: str = "") -> np.ndarray:
    """Largest deviation from a table: of the place of P1 in mm, and of the angular velocity in rad/s.

    With four outputs for each time of the table, which show the vibrations, so that IDAS finds the order that follows them.
    """
    data = table(name)
    result = ac.simulate(model, stop_time=0.3, tolerance=tolerance, intervals=300)
    places = [1e3 * result[f"P1_{axis}"][::4] - data[f"{prefix}P1x{k}[mm]"] for k, axis in enumerate("xyz", 1)]
    spins = [result[f"w_{axis}"][::4] - data[f"{prefix}w{k}[rad/s]"] for k, axis in enumerate("xyz", 1)]
    return np.array([np.abs(places).max(), np.abs(spins).max()])


def test_plate_under_the_pulse():
    assert (plate("plate_halfsine_sym", FEPlate(mesh=PLATE), 1e-10, "ffrf_") < (1e-5, 1e-7)).all()


def test_rigid_plate_is_far_off():
    """A thousand times the bounds for the elastic one."""
    assert (plate("plate_halfsine_sym", FEPlate(mesh=PLATE), 1e-6, "rigid_") > (1e-2, 1e-5)).all()


@pytest.mark.parametrize("method", ["auto", "idas"])
def test_tumbling_plate(method):
    class Tumbling(FEPlate):
        spin, load, damping = (2, -6, 3), "none", 0.0

    Tumbling.method = method
    assert (plate("plate_tumbling", Tumbling(mesh=PLATE), 1e-9) < (2e-5, 1e-5)).all()


@pytest.mark.parametrize("mesh", ["hex20", "tet10"])
def test_own_meshes_come_near_the_plate(mesh):
    deviation = plate("plate_halfsine_sym", FEPlate(mesh=mesh), 1e-9, "ffrf_")
    assert (deviation < (1e-4, 3e-6)).all()
