"""Any mesh, frames, reference frame and basis: what must hold for all of them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import event, given
from hypothesis import strategies as some
from scipy.linalg import eigh

import acausal as ac
from components.fe import Nodes, ReducedBody, assemble, average, reduce_body, rigid
from components.fe.elements.box import mesh
from tests.components.fe import bodies
from tests.components.fe.bodies import hertz
from tests.components.fe.reduction.test_reduction import linear
from tests.fuzz.settings import effort

SPIDERS = {"plain": list, "average": average, "rigid": rigid}


@some.composite
def cases(draw):
    """A bent box of any shape and place, two frames of any nodes, and how to reduce it."""
    element = draw(some.sampled_from(["hex8", "tet10", "hex20"]))
    counts = draw(some.tuples(*[some.integers(1, 3 if element == "hex8" else 2)] * 3))
    size = [draw(some.floats(0.05, 1.0)) for _ in range(3)]
    points, cells = mesh(size, counts, element)
    rng = np.random.default_rng(draw(some.integers(0, 2**32 - 1)))
    linear_map = np.eye(3) + 0.2 * rng.uniform(-1, 1, (3, 3))
    bend = 0.05 * np.sin(points / size @ rng.uniform(0.5, 1.5, (3, 3))) * size
    points = (points + bend) @ linear_map.T + rng.uniform(-3, 3, 3) * draw(some.sampled_from([0, 1]))
    material = {
        "E": 10 ** draw(some.floats(6, 12)),
        "nu": draw(some.floats(0, 0.45)),
        "rho": draw(some.floats(50, 2e4)),
    }
    order = rng.permutation(len(points))
    first = draw(some.integers(3, max(3, len(points) // 4)))
    second = draw(some.integers(1, max(1, len(points) // 4)))
    kinds = [draw(some.sampled_from(list(SPIDERS))) for _ in range(2)]
    frames = {
        "root": SPIDERS[kinds[0]](order[:first].tolist()),
        "tip": SPIDERS[kinds[1]](order[first : first + second].tolist()),
    }
    hold = draw(some.sampled_from(["root", "mean-axis", tuple(order[:3].tolist()), {"root": "xyz"}]))
    basis = draw(some.sampled_from(["held", "free", "craig-bampton"]))
    modes = draw(some.integers(9, 14))
    return points, cells, material, frames, hold, basis, modes


@pytest.mark.filterwarnings("ignore:the body has a")
@effort(8)
@given(cases())
def test_any_body(case):
    points, cells, material, frames, hold, basis, modes = case
    M, K, nodes = assemble(points, cells, **material)
    try:
        body = reduce_body(M, K, nodes, frames=frames, hold=hold, basis=basis, modes=modes)
    except ac.DeclarationError as error:
        # Nodes at random may lie on a line, or leave nothing that moves.
        said = ("collinear", "modes with mass", "static modes", "rigid-body motions free")
        if not any(words in str(error) for words in said):
            raise
        event("refused")
        return
    n, u = body.n, body.nodal.modes.reshape(-1, body.n)
    assert n == modes
    np.testing.assert_allclose(u.T @ (M @ u), np.eye(n), atol=1e-9)
    stiffness = u.T @ (K @ u)
    np.testing.assert_allclose(stiffness, body.K, atol=1e-8 * stiffness.max())
    np.testing.assert_allclose(np.trace(body.modal_products, axis1=2, axis2=3), np.eye(n), atol=1e-8)
    np.testing.assert_allclose(body.modal_products, body.modal_products.transpose(1, 0, 3, 2), atol=0)
    mass = M[0::3, 0::3]
    r = nodes - body.origin
    np.testing.assert_allclose(body.second_moment, r.T @ (mass @ r), atol=1e-8 * np.abs(body.second_moment).max())
    exact = hertz(eigh(K.toarray(), M.toarray(), eigvals_only=True))
    plain = all(getattr(spider, "kind", "") != "rigid" for spider in frames.values())
    found, _ = linear(body)
    assert (found >= exact[6 : 6 + n] * (1 - 1e-6)).all()
    if basis == "free" and plain:
        np.testing.assert_allclose(found, exact[6 : 6 + n], rtol=1e-6)
    for frame, spider in zip(body.interfaces, frames.values(), strict=True):
        chosen = list(getattr(spider, "nodes", spider))
        arms = nodes[chosen] - nodes[chosen].mean(axis=0)
        np.testing.assert_allclose(frame.place + body.origin, nodes[chosen].mean(axis=0), atol=1e-8)
        moved = body.nodal.modes[chosen].mean(axis=0)
        np.testing.assert_allclose(frame.displacement, moved, atol=1e-7 * np.abs(u).max())
        if frame.turns and frame.rotation.any():
            motions = bodies.rigid(arms)
            fit = np.linalg.lstsq(motions, body.nodal.modes[chosen].reshape(-1, n), rcond=None)[0]
            np.testing.assert_allclose(
                frame.rotation, fit[3:], atol=1e-6 * np.abs(fit[3:]).max() + 1e-9 * np.abs(u).max()
            )
        if getattr(spider, "kind", "") == "rigid" and frame.turns:
            whole = frame.displacement + np.cross(frame.rotation.T[:, None], arms).transpose(1, 2, 0)
            np.testing.assert_allclose(body.nodal.modes[chosen], whole, atol=1e-6 * np.abs(u).max())
    if hold in ("root", "mean-axis"):
        still = body.interfaces[0] if hold == "root" else None
        assert still is None or not (still.displacement.any() or still.rotation.any())


@pytest.mark.parametrize("basis", ["held", "free", "craig-bampton"])
@pytest.mark.parametrize("hold", ["left", "mean-axis", (0, 17, 8)])
def test_a_body_does_not_know_where_it_was_drawn(hold, basis):
    """Moved coordinates change the origin alone; turned ones turn everything."""
    M, K, nodes = bodies.block()
    frames = {"left": bodies.face(nodes, 0, 0), "tip": [23]}
    shift = np.array([5.0, -3.0, 2.0])
    first = reduce_body(M, K, nodes, frames=frames, hold=hold, basis=basis, modes=9)
    moved = reduce_body(M, K, Nodes(nodes + shift, cells=nodes.cells), frames=frames, hold=hold, basis=basis, modes=9)
    np.testing.assert_allclose(moved.origin - first.origin, shift, atol=1e-12)
    for name in ("first_moment", "second_moment", "K"):
        np.testing.assert_allclose(getattr(moved, name), getattr(first, name), rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(np.abs(moved.modal_products), np.abs(first.modal_products), atol=1e-8)
    T = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    T = T * np.linalg.det(T)
    big = np.kron(np.eye(len(nodes)), T)
    away = Nodes(nodes @ T.T, cells=nodes.cells)
    turned = reduce_body(M, big @ K.toarray() @ big.T, away, frames=frames, hold=hold, basis=basis, modes=9)
    np.testing.assert_allclose(turned.frequencies, first.frequencies, rtol=1e-9)
    np.testing.assert_allclose(turned.second_moment, T @ first.second_moment @ T.T, atol=1e-9)
    products = np.einsum("ij,bcjk,lk->bcil", T, first.modal_products, T)
    np.testing.assert_allclose(np.abs(np.trace(turned.modal_products, axis1=2, axis2=3)), np.eye(9), atol=1e-9)
    np.testing.assert_allclose(
        np.einsum("bbij->bij", turned.modal_products), np.einsum("bbij->bij", products), atol=1e-7
    )


def test_the_file_is_the_body(tmp_path):
    M, K, nodes = bodies.block()
    body = reduce_body(M, K, nodes, frames={"tip": [23]}, modes=9)
    body.save(tmp_path / "block.npz")
    assert ReducedBody.load(tmp_path / "block.npz") == body


def test_free_modes_can_meet_six_conditions():
    M, K, nodes = bodies.block()
    frames = {"left": bodies.face(nodes, 0, 0), "tip": [23]}
    with pytest.raises(
        ac.DeclarationError,
        match="hold imposes 7 constraints on the reference frame, but free modes can satisfy only six",
    ):
        reduce_body(M, K, nodes, frames=frames, hold={"left": "xyz", "tip": "z"}, basis="free", modes=9)
