"""The plate of the paper on reconfigured inertial frames from own meshes, beside its table 1."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse.linalg import spsolve

from components.fe import box
from components.fe.reconfigured.free_modes import FreeModes
from models.fe_plate import plate
from tests.components.fe import bodies

# Modes 7 to 16 in Hz.
TABLE = (24.5282, 85.8433, 93.2656, 117.3671, 206.1601, 359.8918, 387.63, 534.3499, 544.946, 579.7381)
NARROW = [0, 2, 3, 4, 5]  # modes 7, 9 to 12
# What was found, so that a change of the elements shows.
FOUND = {
    "hex20": (24.528, 86.031, 93.268, 117.409, 206.179, 359.979, 390.308, 545.178, 553.754, 581.969),
    "tet10": (24.529, 86.567, 93.283, 117.435, 206.280, 360.591, 391.897, 549.123, 566.898, 586.443),
}


@pytest.mark.parametrize(("element", "bound"), [("hex20", 0.021), pytest.param("tet10", 0.041, marks=pytest.mark.slow)])
def test_frequencies_of_the_paper(element, bound):
    """100 x 5 x 1 bricks, or the same boxes of six tetrahedra: the table is of a mesh of 10 mm as well."""
    body = plate(element, 10)
    off = np.abs(body.frequencies / TABLE - 1)
    assert off[NARROW].max() < 0.002
    assert off.max() < bound
    np.testing.assert_allclose(body.frequencies, FOUND[element], atol=6e-4)


@pytest.mark.parametrize("element", ["hex20", "tet10"])
def test_mass_and_moments_of_inertia(element):
    """Of any mesh: box and corners, 9.35e-3 Mg and 5.49250, 2112.71125, 2117.78125 Mg.mm2."""
    body = plate(element, 10)
    assert body.mass == pytest.approx(9.35, rel=1e-12)
    inertia = FreeModes(body, np.zeros(10)).inertia
    np.testing.assert_allclose(inertia, np.diag((5.4925e-3, 2.11271125, 2.11778125)), atol=1e-12)


def test_a_point_load_on_a_vertex_has_no_mesh_limit():
    """What a force on the corner of a cube pushes it in by goes with one over the size of the elements, without bound."""
    E, pushed = 1e9, []
    for count in (2, 4, 8):
        M, K, nodes = box((1, 1, 1), (count,) * 3, "hex8", E=E, nu=0.3, rho=1000)
        shift = 1e-4 * E / 1000  # far below the first frequency: the body is free, its rigid motion is taken off
        force = np.zeros(M.shape[0])
        force[3 * int(((nodes - 1) ** 2).sum(axis=1).argmin())] = 1.0
        R = bodies.rigid(nodes)
        carried = R @ np.linalg.solve(R.T @ (M @ R), R.T @ force)
        balanced = force - M @ carried
        moved = spsolve((K + shift * M).tocsc(), balanced)
        pushed.append(E * float(moved @ balanced))
    growth = np.diff(pushed) / pushed[:-1]
    assert (growth > 0.9).all()  # at least twice as far where the elements halve
