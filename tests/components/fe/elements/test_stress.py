"""Stresses of meshes: constant ones in elements of any shape, bending, and the energy that they hold."""

from __future__ import annotations

import numpy as np
import pytest

from acausal import DeclarationError
from components.fe import assemble, box
from components.fe.elements.box import mesh
from components.fe.elements.material import Material
from components.fe.elements.stress import POINTS, operator, to_nodes

STEEL = Material(2.1e11, 0.3, 7850.0)
SIZE, COUNTS = np.array([1.0, 0.2, 0.1]), (4, 2, 1)


def bent(points: np.ndarray, nu: float = STEEL.nu) -> np.ndarray:
    """Displacements of a beam of constant curvature 1 about y: sigma_xx = -E z about its middle, and nothing else."""
    x, y, z = (points - [0, SIZE[1] / 2, SIZE[2] / 2]).T
    return np.stack([-x * z, nu * y * z, (x**2 + nu * (z**2 - y**2)) / 2], axis=1)


@pytest.mark.parametrize("element", ["hex8", "hex20", "tet10"])
def test_constant_stress(element: str) -> None:
    rng = np.random.default_rng(1)
    points, cells = mesh(SIZE, COUNTS, element)
    points = points + (
        0.01 * rng.normal(size=points.shape) if element == "hex8" else 0.02 * np.sin(3 * points[:, [1, 2, 0]])
    )
    ((kind, members),) = cells.items()
    slope = rng.normal(size=(3, 3))
    strain = (slope + slope.T) / 2
    lam, mu = STEEL.lame
    expected = lam * np.trace(strain) * np.eye(3) + 2 * mu * strain
    found = np.einsum("epsic,eic->eps", operator(kind, points, members, STEEL), (points @ slope.T)[members])
    assert np.abs(found - expected[[0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]]).max() < 1e-13 * np.abs(expected).max()


@pytest.mark.parametrize("element", ["hex8", "hex20", "tet10"])
def test_bending(element: str) -> None:
    """Exact at the points of every element: quadratic displacements, which incompatible modes hold too; and at the nodes."""
    points, cells = mesh(SIZE, COUNTS, element)
    ((kind, members),) = cells.items()
    # The middle planes in y and z bend too; a brick of eight nodes cannot, unless nu is 0.
    material = Material(STEEL.E, 0.0 if element == "hex8" else STEEL.nu, STEEL.rho)
    u = bent(points, material.nu)
    found = np.einsum("epsic,eic->eps", operator(kind, points, members, material), u[members])
    at_nodes = np.einsum("kp,eps->eks", to_nodes(kind), found)
    z = points[members][:, :, 2] - SIZE[2] / 2
    scale = material.E * SIZE[2] / 2
    assert np.abs(at_nodes[:, :, 0] + material.E * z).max() < 1e-11 * scale
    assert np.abs(at_nodes[:, :, 1:]).max() < 1e-11 * scale


def test_energy() -> None:
    """Stress by strain over the volume is the elastic energy of the stiffness matrix: two Gauss points integrate it."""
    points, cells = mesh(SIZE, COUNTS, "hex8")
    _, K, _ = assemble(points, cells, E=STEEL.E, nu=STEEL.nu, rho=STEEL.rho)
    ((kind, members),) = cells.items()
    u = np.random.default_rng(2).normal(size=points.shape)
    stress = np.einsum("epsic,eic->eps", operator(kind, points, members, STEEL), u[members])
    x, y, z, *shear = np.moveaxis(stress, -1, 0)
    E, nu = STEEL.E, STEEL.nu
    density = (x**2 + y**2 + z**2 - 2 * nu * (x * y + y * z + z * x)) / (2 * E)
    density += sum(s**2 for s in shear) * (1 + nu) / E
    volume = np.prod(SIZE) / np.prod(COUNTS) / len(POINTS[kind])
    assert density.sum() * volume == pytest.approx(u.ravel() @ (K @ u.ravel()) / 2, rel=1e-12)


def test_other_elements() -> None:
    points, cells = mesh(SIZE, COUNTS, "hex8")
    with pytest.raises(
        DeclarationError,
        match="stresses are implemented for elements hexahedron, hexahedron20, tetra10, tetra, not for wedge",
    ):
        operator("wedge", points, cells["hexahedron"], STEEL)
    nodes = box(SIZE, COUNTS, "hex8", E=1e9, nu=0.3, rho=1e3)[2]
    assert np.array_equal(nodes.cells["hexahedron"], cells["hexahedron"])
