"""Elements: constant strain in any shape, closed forms, rates of convergence, and matrices of other programs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.optimize import brentq

import acausal as ac
from components.fe import assemble, box, read_npz, reduce_body
from components.fe.elements.box import KINDS, mesh
from components.fe.elements.material import Material
from components.fe.elements.stress import operator

FILES = Path(__file__).parents[3] / "reference/fe"
ROD = {"E": 1e7, "nu": 0.49, "rho": 0.26 / (0.1 * 0.015 * 0.01)}
STEEL = {"E": 210e9, "nu": 0.3, "rho": 7850.0}
# CalculiX 2.20, C3D20, box of steel 0.1 x 0.015 x 0.01 m, 4 x 1 x 1 elements, free: Hz.
C3D20 = [5219.493, 7507.519, 14285.04, 14812.26, 19281.23, 25836.8, 28816.98, 29757.1, 36122.99, 44571.62]


def frequencies(M, K, count):
    """Dense, without anything of the project."""
    squares = eigh(K.toarray(), M.toarray(), eigvals_only=True)
    return np.sqrt(np.abs(squares[6 : 6 + count])) / (2 * np.pi)


def test_bricks_are_those_of_an_independent_program():
    M, K, nodes = read_npz(FILES / "rod_qm6_8x2x1.npz")
    own = box((0.1, 0.015, 0.01), (8, 2, 1), "hex8", **ROD)
    np.testing.assert_allclose(own[2], nodes, atol=1e-16)
    assert abs(own[0] - M).max() < 1e-14 * abs(M).max()
    assert abs(own[1] - K).max() < 1e-14 * abs(K).max()


def test_bricks_of_20_nodes_are_those_of_calculix():
    M, K, _ = box((0.1, 0.015, 0.01), (4, 1, 1), "hex20", **STEEL)
    np.testing.assert_allclose(frequencies(M, K, 10), C3D20, rtol=1e-6)


@pytest.mark.parametrize("element", KINDS)
def test_constant_strain_in_any_shape(element):
    """A linear displacement has the energy of its strain, and no force on a node inside."""
    points, cells = mesh((2.0, 1.5, 1.0), (2, 2, 2), element)
    edge = (points == 0) | (points == [2.0, 1.5, 1.0])
    inside = ~edge.any(axis=1)
    rng = np.random.default_rng(3)
    if element == "hex8":
        points = points + 0.12 * rng.uniform(-1, 1, points.shape) * ~edge
    else:  # quadratic: a curved mesh, whose faces stay planes
        bend = np.prod(points * ([2.0, 1.5, 1.0] - points), axis=1)[:, None]
        points = points + 0.1 * bend * np.array([1.0, -2.0, 1.5])
    M, K, _ = assemble(points, cells, E=3.0, nu=0.3, rho=2.0)
    gradient = rng.normal(size=(3, 3))
    strain = (gradient + gradient.T) / 2
    first, second = 3.0 * 0.3 / (1.3 * 0.4), 3.0 / 2.6
    stress = first * np.trace(strain) * np.eye(3) + 2 * second * strain
    u = (points @ gradient.T).ravel()
    forces = (K @ u).reshape(-1, 3)
    assert u @ forces.ravel() == pytest.approx(3.0 * np.sum(stress * strain), rel=1e-12)
    assert np.abs(forces[inside]).max() < 1e-12 * np.abs(forces).max()
    ones = np.tile(np.eye(3), (len(points), 1))
    np.testing.assert_allclose(ones.T @ (M @ ones), 6.0 * np.eye(3), rtol=1e-12, atol=1e-12)


def corners_alone(size, counts):
    """A box of tetrahedra of 4 nodes."""
    points, cells = mesh(size, counts, "tet10")
    used, rows = np.unique(cells["tetra10"][:, :4], return_inverse=True)
    return points[used], {"tetra": rows.reshape(-1, 4)}


def test_linear_tetrahedra():
    """Energy and stress of constant strain in any shape, and masses: second moments of a box, exact in linear functions."""
    size = np.array([2.0, 1.5, 1.0])
    points, cells = corners_alone(size, (2, 2, 2))
    _, K0, _ = assemble(points, cells, E=3.0, nu=0.3, rho=2.0)
    inside = ~((points == 0) | (points == size)).any(axis=1)
    rng = np.random.default_rng(3)
    points = points + 0.12 * rng.uniform(-1, 1, points.shape) * inside[:, None]
    M, K, nodes = assemble(points, cells, E=3.0, nu=0.3, rho=2.0)
    assert abs(K - K0).max() > 0.1  # another shape
    gradient = rng.normal(size=(3, 3))
    strain = (gradient + gradient.T) / 2
    stress = 3.0 * 0.3 / (1.3 * 0.4) * np.trace(strain) * np.eye(3) + 3.0 / 1.3 * strain
    u = points @ gradient.T
    forces = (K @ u.ravel()).reshape(-1, 3)
    assert u.ravel() @ forces.ravel() == pytest.approx(3.0 * np.sum(stress * strain), rel=1e-12)
    assert np.abs(forces[inside]).max() < 1e-12 * np.abs(forces).max()
    moments = 6.0 * (np.outer(size, size) / 4 + np.diag(size**2) / 12)
    np.testing.assert_allclose(points.T @ (M[0::3, 0::3] @ points), moments, rtol=1e-13)
    found = np.einsum(
        "epsic,eic->eps",
        operator("tetra", points, nodes.cells["tetra"], Material(3.0, 0.3, 2.0)),
        u[nodes.cells["tetra"]],
    )
    np.testing.assert_allclose(
        found, np.broadcast_to(stress[[0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]], found.shape), rtol=1e-11
    )


def test_linear_tetrahedra_converge_from_above():
    """Frequencies of the free box go with h^2 to those of bricks of 20 nodes."""
    M, K, _ = box((2.0, 1.5, 1.0), (4, 3, 2), "hex20", **STEEL)
    exact = frequencies(M, K, 3)
    errors = []
    for k in (2, 4):
        M, K, _ = assemble(*corners_alone((2.0, 1.5, 1.0), (2 * k, 3 * k // 2, k)), **STEEL)
        errors.append(frequencies(M, K, 3) / exact - 1)
    assert (errors[1] > 0.01).all()
    assert np.abs(errors[0] / errors[1] - 3.5).max() < 1


@pytest.mark.parametrize("element", KINDS)
def test_masses_integrate_what_the_elements_hold(element):
    """Second moments of a box: the places are among the shape functions."""
    size = np.array([0.3, 0.2, 0.1])
    M, _, nodes = box(size, (2, 1, 2), element, **STEEL)
    mass = M[0::3, 0::3]
    total = 7850 * size.prod()
    moments = total * (np.outer(size, size) / 4 + np.diag(size**2) / 12)
    np.testing.assert_allclose(nodes.T @ (mass @ nodes), moments, rtol=1e-13)
    np.testing.assert_allclose(mass.sum(), total, rtol=1e-13)


@pytest.mark.parametrize(("element", "order"), [("hex8", 2), ("hex20", 4), ("tet10", 4)])
def test_order_of_frequencies(element, order):
    """Bar with nu = 0, free: stretches at c k / (2 L)."""

    def error(n):
        M, K, _ = box((1.0, 0.02, 0.02), (n, 1, 1), element, E=4.0, nu=0.0, rho=1.0)
        found = frequencies(M, K, 8 * n)
        return min(abs(found - 2.0)) / 2.0  # the second one: c = 2

    rate = np.log2(error(4) / error(8))
    assert rate == pytest.approx(order, abs=0.35)


@pytest.mark.parametrize(("count", "worst"), [(40, 1.5e-3), (80, 5e-5)])
def test_beam_of_the_spin_up(count, worst):
    """In-plane frequencies of the clamped beam of section 5.4 of the beam paper against Euler and Bernoulli's."""
    E, A, J, rho, length = 6.895e10, 7.299e-5, 8.214e-9, 2767, 8.0
    width, height = 0.03675, 0.06
    second = height * width**3 / 12
    M, K, nodes = box(
        (length, width, height), (count, 1, 1), "hex20", E=E * J / second, nu=0.0, rho=rho * A / (width * height)
    )
    root = np.flatnonzero(nodes[:, 0] == 0)
    body = reduce_body(M, K, nodes, frames={"root": root}, hold="root", modes=8)
    plane = np.einsum("bbii->bi", body.modal_products)[:, 1] > 0.5
    roots = [brentq(lambda x: np.cos(x) * np.cosh(x) + 1, *ends) for ends in ((1.5, 2.2), (4.5, 5), (7.5, 8))]
    exact = np.square(roots) * np.sqrt(E * J / (rho * A * length**4)) / (2 * np.pi)
    np.testing.assert_allclose(body.frequencies[plane][:3], exact, rtol=worst)


def test_a_mesh_of_two_kinds_and_an_inverted_mesh():
    points, cells = mesh((1.0, 1.0, 1.0), (1, 1, 1), "hex8")
    with pytest.raises(ac.DeclarationError, match=r"the brick of nodes \[.*\] is inverted"):
        assemble(points, {"hexahedron": cells["hexahedron"][:, [4, 5, 6, 7, 0, 1, 2, 3]]}, **STEEL)
    points, cells = mesh((1.0, 1.0, 1.0), (1, 1, 1), "tet10")
    order = [1, 0, 2, 3, 4, 6, 5, 8, 7, 9]
    with pytest.raises(ac.DeclarationError, match=r"the tetra10 of nodes \[.*\] is inverted"):
        assemble(points, {"tetra10": cells["tetra10"][:, order]}, **STEEL)
    flat = {"triangle6": np.zeros((2, 6), dtype=int), "vertex": np.zeros((1, 1), dtype=int)}
    M, *_ = assemble(points, {**cells, **flat}, **STEEL)
    assert M.sum() == pytest.approx(3 * 7850)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"size": (1, 1)}, "three positive lengths"),
        ({"size": (1, 0, 1)}, "three positive lengths"),
        ({"counts": (1, 1.5, 1)}, "three positive integers"),
        ({"counts": (0, 1, 1)}, "three positive integers"),
        ({"element": "hex27"}, "hex8, hex20, tet10, not 'hex27'"),
        ({"E": 0}, "E must be positive"),
        ({"rho": float("nan")}, "rho must be positive"),
        ({"nu": 0.5}, "between -1 and 0.5"),
    ],
)
def test_boxes_that_cannot_be(change, message):
    with pytest.raises(ac.DeclarationError, match=message):
        box(**{"size": (1, 1, 1), "counts": (1, 1, 1), "element": "hex8", **STEEL, **change})


@pytest.mark.parametrize(
    ("cells", "message"),
    [
        ({"tetra": [[0, 1, 2, 3]]}, r"the tetra of nodes \[0, 1, 2, 3\] is inverted"),
        (
            {"wedge": [[0, 1, 2, 3]]},
            "unknown element type 'wedge'; known types are hexahedron, hexahedron20, tetra10, tetra",
        ),
        ({"hexahedron": [[0, 1, 2, 3]]}, "8 integer node indices"),
        ({"hexahedron": [[0, 1, 2, 3, 4, 5, 6, 9]]}, "outside 0 to 7"),
        ({}, "no solid elements"),
        ({"triangle": [[0, 1, 2]]}, "no solid elements"),
    ],
)
def test_meshes_that_cannot_be(cells, message):
    points, _ = mesh((1.0, 1.0, 1.0), (1, 1, 1), "hex8")
    with pytest.raises(ac.DeclarationError, match=message):
        assemble(points, cells, **STEEL)


def test_bricks_in_batches(monkeypatch):
    from components.fe.elements import assembly

    whole = box((3.0, 2.0, 1.0), (3, 2, 2), "hex8", **STEEL)
    monkeypatch.setattr(assembly, "BATCH", 5)
    parts = box((3.0, 2.0, 1.0), (3, 2, 2), "hex8", **STEEL)
    assert abs(whole[0] - parts[0]).max() == 0
    assert abs(whole[1] - parts[1]).max() == 0


def test_two_elements_with_an_edge_but_not_the_node_on_it():
    points, cells = mesh((2.0, 1.0, 1.0), (2, 1, 1), "hex20")
    torn = cells["hexahedron20"].copy()
    shared = np.intersect1d(*torn)
    middle = next(k for k in shared if k in torn[1][8:])
    torn[1][torn[1] == middle] = len(points)
    with pytest.raises(ac.DeclarationError, match="shares an edge with another element, but not its mid-edge node"):
        assemble(np.vstack([points, points[middle]]), {"hexahedron20": torn}, **STEEL)


def test_nodes_of_no_element_are_named():
    points, cells = mesh((1.0, 1.0, 1.0), (1, 1, 1), "hex8")
    with pytest.raises(ac.DeclarationError, match=r"1 nodes belong to no solid element, the first are \[8\]"):
        assemble(np.vstack([points, [0, 0, 5]]), cells, **STEEL)
