"""Bases in every reference frame: frequencies, orthogonality, conditions, integrals, and what they converge to."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import eigh

from components.fe import average, read_npz, reduce_body, rigid
from components.fe.reduction.inertia_invariants import axial, usual
from tests.components.fe import bodies
from tests.components.fe.bodies import FILES, HINGE, TIP, block, face, hertz, plate, rod, units
from tests.shared import pairwise

BASES = ("held", "free", "craig-bampton")
HOLDS = ("left", "mean-axis", (0, 17, 8), {"left": "xyz"}, {0: "xyz", 17: "xy", 8: "z"}, {"right": "xyz", "top": "z"})


def frames_of(nodes, kind="plain"):
    left, right = face(nodes, 0, 0), face(nodes, 0, -1)
    if kind == "rigid":
        return {"left": rigid(left), "right": rigid(right), "top": [int(face(nodes, 2, -1)[3])]}
    if kind == "average":
        return {
            "left": average(left, np.ones(len(left))),
            "right": average(right, np.arange(1, len(right) + 1)),
            "top": [12],
        }
    return {"left": left, "right": right, "top": [int(face(nodes, 2, -1)[3])]}


def reduced(hold, basis, kind="plain", modes=20, **more):
    M, K, nodes = block()
    return reduce_body(M, K, nodes, frames=frames_of(nodes, kind), hold=hold, basis=basis, modes=modes, **more)


def conditions(hold, kind, basis, nodes):
    """Rows that vanish on every mode, written anew; None where the frame is an average."""
    left, count = face(nodes, 0, 0), 3 * len(nodes)
    M, _, _ = block()
    centre = np.asarray(M.sum(axis=0)).reshape(-1, 3)[:, 0] @ nodes / (M.sum() / 3)
    if hold == "mean-axis":
        return (M @ bodies.rigid(nodes, centre)).T
    if hold == (0, 17, 8):
        x = nodes[17] - nodes[0]
        x = x / np.linalg.norm(x)
        z = np.cross(x, nodes[8] - nodes[0])
        y = np.cross(z, x)
        rows = np.zeros((6, count))
        rows[:3, :3] = np.eye(3)
        rows[3, 51:54], rows[4, 51:54], rows[5, 24:27] = y, z, z
        return rows
    if isinstance(hold, dict) and 0 in hold:
        return units([0, 1, 2, 51, 52, 26], count)
    if basis == "free" or kind == "average" or (isinstance(hold, dict) and "right" in hold):
        return None
    return units((3 * left[:, None] + range(3)).ravel(), count)


@pytest.mark.parametrize(("hold", "basis", "kind"), pairwise(range(len(HOLDS)), BASES, ("plain", "rigid", "average")))
def test_modes_are_orthonormal_and_at_rest_in_the_reference_frame(hold, basis, kind):
    M, K, nodes = block()
    name, hold = hold, HOLDS[hold]
    if basis == "free" and name == 5:
        pytest.skip("more than six conditions")
    body = reduced(hold, basis, kind)
    u = body.nodal.modes.reshape(-1, body.n)
    np.testing.assert_allclose(u.T @ (M @ u), np.eye(body.n), atol=1e-11)
    stiffness = u.T @ (K @ u)
    np.testing.assert_allclose(stiffness, body.K, atol=1e-9 * stiffness.max())
    assert (np.diff(np.diag(body.K)) >= 0).all()
    np.testing.assert_array_equal(body.M, np.eye(body.n))
    rows = conditions(hold, kind, basis, nodes)
    if rows is not None:
        assert np.abs(rows @ u).max() <= 1e-10 * np.abs(rows).sum(axis=1).max() * np.abs(u).max()
    for frame in body.interfaces:
        if frame.name == hold or (isinstance(hold, dict) and hold.get(frame.name) == "xyz"):
            assert not frame.displacement.any()
            assert not frame.rotation.any()
            assert frame.turns


@pytest.mark.parametrize(("hold", "basis"), pairwise(range(len(HOLDS) - 1), BASES))
def test_frames_follow_their_nodes(hold, basis):
    """Maps against a fit of a rigid motion to the nodes by least squares, written anew."""
    _, _, nodes = block()
    body = reduced(HOLDS[hold], basis, "average")
    right = face(nodes, 0, -1)
    shares = np.arange(1, len(right) + 1)
    frame = next(f for f in body.interfaces if f.name == "right")
    place = shares @ nodes[right] / shares.sum()
    np.testing.assert_allclose(frame.place + body.origin, place, atol=1e-9)
    motions = bodies.rigid(nodes[right], place)
    weights = np.repeat(np.sqrt(shares), 3)[:, None]
    fit = np.linalg.lstsq(weights * motions, weights * body.nodal.modes[right].reshape(-1, body.n), rcond=None)[0]
    size = np.abs(body.nodal.modes).max()
    np.testing.assert_allclose(frame.displacement, fit[:3], atol=1e-8 * size)
    np.testing.assert_allclose(frame.rotation, fit[3:], atol=1e-7 * size / 0.1)
    top = next(f for f in body.interfaces if f.name == "top")
    np.testing.assert_allclose(top.displacement, body.nodal.modes[12], atol=1e-8 * size)
    assert frame.turns
    assert not top.turns
    assert not top.rotation.any()


@pytest.mark.parametrize("name", ["rod_qm6_8x2x1.npz", "rod_ccx_c3d8_8x2x1.npz"])
def test_frequencies_of_rods(name):
    M, K, nodes = read_npz(FILES / name)
    free = eigh(K.toarray(), M.toarray(), eigvals_only=True)[6:]
    body = reduce_body(M, K, nodes, frames={}, modes=20)
    np.testing.assert_allclose(body.frequencies, hertz(free[:20]), rtol=1e-8)
    held = np.setdiff1d(np.arange(162), [*(3 * k + a for k in HINGE for a in range(3)), 3 * TIP + 2])
    own = eigh(K.toarray()[held][:, held], M.toarray()[held][:, held], eigvals_only=True)
    for hold in ("hinge", {"hinge": "xyz", "tip": "z"}, {0: "xyz", 2: "xyz", 4: "xyz", TIP: "z"}):
        body = reduce_body(M, K, nodes, frames={"hinge": HINGE, "tip": [TIP]}, hold=hold, modes=40)
        np.testing.assert_allclose(body.frequencies, hertz(own[:40]), rtol=1e-8)


def test_frequencies_of_the_plate():
    """Sparse: 5,265 equations; the file's own frequencies."""
    M, K, nodes = plate()
    body = reduce_body(M, K, nodes, frames={"P1": [2]}, hold="mean-axis", modes=12)
    with np.load(FILES / "plate_fe_h25.npz") as file:
        np.testing.assert_allclose(body.frequencies, file["freq_hz"], rtol=1e-7)
    np.testing.assert_allclose(body.origin, [0, 0, 0.005], atol=1e-12)
    P = body.second_moment
    np.testing.assert_allclose(np.trace(P) - np.diag(P), [5.4925e-3, 2.11271125, 2.11778125], rtol=1e-9)
    assert not body.modal_first.any()
    assert not axial(body.modal_second).any()


def test_sparse_and_dense_ways_agree(monkeypatch):
    from components.fe.reduction import modes

    for hold in ("left", "mean-axis", (0, 17, 8)):
        dense = reduced(hold, "held", "rigid", 12)
        monkeypatch.setattr(modes, "DENSE", 0)
        sparse = reduced(hold, "held", "rigid", 12)
        monkeypatch.undo()
        np.testing.assert_allclose(sparse.frequencies, dense.frequencies, rtol=1e-10)
        np.testing.assert_allclose(sparse.modal_products, dense.modal_products, atol=1e-7)


def linear(body):
    """Frequencies of the body free to move: momentum, angular momentum and modes, linear about rest."""
    s, P, n = body.first_moment, body.second_moment, body.n
    skew = np.array([[0, -s[2], s[1]], [s[2], 0, -s[0]], [-s[1], s[0], 0]])
    S, H = body.modal_first, axial(body.modal_second).T
    J = np.trace(P) * np.eye(3) - P
    mass = np.block([[body.mass * np.eye(3), -skew, S], [skew, J, H], [S.T, H.T, body.M]])
    stiffness = np.zeros_like(mass)
    stiffness[6:, 6:] = body.K
    return hertz(eigh(stiffness, mass, eigvals_only=True)[6:]), n


@pytest.mark.parametrize("hold", range(len(HOLDS) - 1))
def test_free_modes_keep_their_frequencies_in_every_reference_frame(hold):
    M, K, _ = block()
    exact = hertz(eigh(K.toarray(), M.toarray(), eigvals_only=True)[6:])
    found, n = linear(reduced(HOLDS[hold], "free", modes=20))
    np.testing.assert_allclose(found, exact[:n], rtol=1e-9)


@pytest.mark.parametrize(("hold", "basis"), pairwise((1, 2, 4), ("held", "craig-bampton")))
def test_all_modes_are_the_whole_body(hold, basis):
    """Where six conditions say what a rigid motion is, all modes hold every deformation."""
    M, K, nodes = block()
    count = 3 * len(nodes) - 6
    exact = hertz(eigh(K.toarray(), M.toarray(), eigvals_only=True)[6:])
    body = reduced(HOLDS[hold], basis, "average", modes=count)
    np.testing.assert_allclose(linear(body)[0], exact, rtol=1e-7)


@pytest.mark.parametrize("basis", ["held", "free"])
def test_frequencies_come_down_with_the_number_of_modes(basis):
    """The free body's first four frequencies, from a basis that is held at one end."""
    M, K, _ = block()
    exact = hertz(eigh(K.toarray(), M.toarray(), eigvals_only=True)[6:])
    errors = np.array([linear(reduced("left", basis, "average", n))[0][:4] / exact[:4] - 1 for n in (6, 12, 24, 48)])
    assert (errors > -1e-9).all()
    assert (np.diff(errors, axis=0) < 1e-9).all()
    assert errors[-1].max() < (2e-2 if basis == "held" else 1e-9)


def test_craig_bampton_is_exact_under_static_loads():
    """Without a single dynamic mode, a load on a frame displaces the frames as it does the whole body."""
    M, K, nodes = block()
    frames = frames_of(nodes, "average")
    body = reduce_body(M, K, nodes, frames=frames, hold="left", basis="craig-bampton", modes=9)
    left, right = face(nodes, 0, 0), face(nodes, 0, -1)
    right_frame = next(f for f in body.interfaces if f.name == "right")
    top = next(f for f in body.interfaces if f.name == "top")
    force, torque = np.array([3.0, -2.0, 5.0]), np.array([0.1, 0.2, -0.3])
    q = np.linalg.solve(body.K, right_frame.displacement.T @ force + right_frame.rotation.T @ torque)
    shares = np.arange(1, len(right) + 1)
    place = shares @ nodes[right] / shares.sum()
    weights = np.repeat(shares / shares.sum(), 3)[:, None]
    motions = bodies.rigid(nodes[right], place)
    fit = np.linalg.solve(motions.T @ (weights * motions), (weights * motions).T)
    load = np.zeros(K.shape[0])
    load[(3 * right[:, None] + range(3)).ravel()] = fit.T @ np.concatenate([force, torque])
    at = nodes[left].mean(axis=0)
    held = np.zeros((6, K.shape[0]))
    held[:, (3 * left[:, None] + range(3)).ravel()] = np.linalg.pinv(bodies.rigid(nodes[left], at))
    saddle = np.block([[K.toarray() / 1e10, held.T], [held, np.zeros((6, 6))]])
    u = np.linalg.solve(saddle, np.concatenate([load, np.zeros(6)]))[: len(load)] / 1e10
    np.testing.assert_allclose(top.displacement @ q, u[36:39], rtol=1e-7, atol=1e-9 * np.abs(u).max())
    moved = fit @ u[(3 * right[:, None] + range(3)).ravel()]
    np.testing.assert_allclose(
        np.concatenate([right_frame.displacement @ q, right_frame.rotation @ q]),
        moved,
        rtol=1e-6,
        atol=1e-8 * abs(moved).max(),
    )


@pytest.mark.parametrize("hold", ["left", "mean-axis"])
def test_craig_bampton_converges(hold):
    M, K, _ = block()
    exact = hertz(eigh(K.toarray(), M.toarray(), eigvals_only=True)[6:])
    errors = [linear(reduced(hold, "craig-bampton", "average", n))[0][:3] / exact[:3] - 1 for n in (9, 15, 30, 60)]
    assert (np.diff(errors, axis=0) < 1e-10).all()
    assert np.max(errors[-1]) < 2e-4


def test_effective_masses_add_up():
    """All modes together: the rigid motion of the base, projected on what can move."""
    M, K, nodes = rod()
    frames, hold = {"hinge": HINGE, "tip": [TIP]}, "hinge"
    held = [*(3 * k + a for k in HINGE for a in range(3)), 3 * TIP + 2]
    left = np.setdiff1d(np.arange(162), held)
    base = (M @ bodies.rigid(nodes, nodes[list(HINGE)].mean(axis=0)))[left]
    whole = np.diag(base.T @ np.linalg.solve(M.toarray()[left][:, left], base))
    body = reduce_body(M, K, nodes, frames=frames, hold=hold, modes=len(left))
    np.testing.assert_allclose(body.effective_mass.sum(axis=0), whole, rtol=1e-8)
    few = reduce_body(M, K, nodes, frames=frames, hold=hold, modes=9)
    np.testing.assert_allclose(few.effective_mass, body.effective_mass[:9], rtol=1e-6, atol=1e-8 * whole.max())
    P = few.second_moment
    total = np.array([few.mass] * 3 + list(np.trace(P) - np.diag(P)))
    np.testing.assert_allclose(few.lost_mass, 1 - few.effective_mass.sum(axis=0) / total)
    assert (np.diff([few.first(n).lost_mass for n in range(10)], axis=0) <= 1e-12).all()
    assert (few.lost_mass >= body.lost_mass - 1e-12).all()
    assert not reduce_body(M, K, nodes, frames={}, modes=9).effective_mass.any()


def test_invariants_by_points():
    """Against sums over Gauss points inside of the bricks, which know nothing of the mass matrix."""
    from components.fe.elements.brick import POINTS, shapes

    M, K, nodes = rod()
    with np.load(FILES / "rod_qm6_8x2x1.npz") as file:
        cells = file["hexes"]
    body = reduce_body(M, K, nodes, frames={"hinge": HINGE, "tip": [TIP]}, hold="hinge", modes=7)
    N = np.array([shapes(at) for at in POINTS])
    dm = 0.26 / len(cells) / len(POINTS)
    r = np.einsum("pi,eia->epa", N, body.nodal.nodes[cells]).reshape(-1, 3)
    phi = np.einsum("pi,eiab->epab", N, body.nodal.modes[cells]).reshape(-1, 3, 7)
    sums = {
        "first_moment": dm * r.sum(axis=0),
        "second_moment": dm * r.T @ r,
        "modal_first": dm * phi.sum(axis=0),
        "modal_second": dm * np.einsum("pi,pjb->bij", r, phi),
        "modal_products": dm * np.einsum("pib,pjc->bcij", phi, phi),
    }
    for name, values in sums.items():
        np.testing.assert_allclose(getattr(body, name), values, atol=1e-9 * np.abs(values).max(), err_msg=name)
    np.testing.assert_allclose(np.trace(body.modal_products, axis1=2, axis2=3), body.M, atol=1e-12)
    nine = usual(body)

    def tilde(v):
        return np.cross(np.eye(3), v[..., None, :]).swapaxes(-1, -2) * -1.0

    R, F = tilde(r), tilde(phi.transpose(0, 2, 1))
    expected = {
        "I4": dm * np.cross(r[:, :, None], phi, axis=1).sum(axis=0),
        "I5": dm * np.einsum("pbij,pjc->bic", F, phi),
        "I6": dm * np.einsum("pib,pic->bc", phi, phi),
        "I7": dm * np.einsum("pji,pjk->ik", R, R),
        "I8": dm * np.einsum("pij,pbjk->bik", R, F),
        "I9": dm * np.einsum("pbij,pcjk->bcik", F, F),
    }
    for name, values in expected.items():
        np.testing.assert_allclose(getattr(nine, name), values, atol=1e-9 * np.abs(values).max(), err_msg=name)


def test_a_thin_plate_keeps_its_thickness():
    """Entries are cut in the size of the fields that they join: a ten-thousandth of the largest is no rounding."""
    from components.fe import box

    M, K, nodes = box((1.0, 0.5, 1e-3), (4, 3, 1), "hex8", E=7e10, nu=0.3, rho=2700.0)
    body = reduce_body(M, K, nodes, frames={}, modes=6)
    np.testing.assert_allclose(body.second_moment[2, 2], 1.35 * 1e-6 / 12, rtol=1e-9)
    assert not body.second_moment[[0, 0, 1], [1, 2, 2]].any()
    # Bending turns the sections: the displacement along x, a thousandth of that along z, times z.
    assert (np.abs(body.modal_second[:, 2, :2]).max(axis=1) > 0).any()


def test_equal_frequencies_are_settled():
    """A square bar: of a pair of bending modes one is along y and one along z, in any order of the nodes."""
    from components.fe import box

    M, K, nodes = box((1.0, 0.1, 0.1), (5, 1, 1), "hex8", E=7e10, nu=0.3, rho=2700.0)
    body = reduce_body(M, K, nodes, frames={}, modes=5)
    assert body.frequencies[0] == pytest.approx(body.frequencies[1], rel=1e-9)
    parts = np.einsum("bbii->bi", body.modal_products)[:2]
    np.testing.assert_allclose(parts[:, 1:], [[parts[0, 1], 0], [0, parts[0, 1]]], atol=1e-4)  # nu widens a little
    # A pair of which only one fits is the same one.
    one = reduce_body(M, K, nodes, frames={}, modes=1)
    np.testing.assert_allclose(one.modal_products[0, 0], body.modal_products[0, 0], atol=1e-9)
    again = reduce_body(M, K, nodes, frames={}, modes=5)
    assert again == body
    order = np.random.default_rng(0).permutation(len(nodes))
    equations = (3 * order[:, None] + range(3)).ravel()
    other = reduce_body(M[equations][:, equations], K[equations][:, equations], nodes[order], frames={}, modes=5)
    np.testing.assert_allclose(np.abs(other.modal_products), np.abs(body.modal_products), atol=1e-8)


def test_masses_may_be_missing():
    """Nodes without mass give no mode, and do not disturb the others."""
    from scipy.sparse import csr_array

    M, K, nodes = block()
    light = np.repeat(np.isin(np.arange(len(nodes)), [5, 9]), 3)
    spread = M.toarray()
    spread[light], spread[:, light] = 0.0, 0.0
    M = csr_array(spread)
    K_aa, K_ab, K_bb = K.toarray()[~light][:, ~light], K.toarray()[~light][:, light], K.toarray()[light][:, light]
    exact = eigh(K_aa - K_ab @ np.linalg.solve(K_bb, K_ab.T), spread[~light][:, ~light], eigvals_only=True)[6:]
    body = reduce_body(M, K, nodes, frames={}, modes=10)
    np.testing.assert_allclose(body.frequencies, hertz(exact[:10]), rtol=1e-9)
    with pytest.raises(Exception, match=f"has only {len(exact)} modes with mass, but modes={len(exact) + 1}"):
        reduce_body(M, K, nodes, frames={}, modes=len(exact) + 1)


def test_a_bound_of_frequency_takes_all_below():
    M, K, nodes = block()
    free = hertz(eigh(K.toarray(), M.toarray(), eigvals_only=True)[6:])
    for k in (3, 30):
        body = reduce_body(M, K, nodes, frames={}, frequency=(free[k] + free[k - 1]) / 2)
        np.testing.assert_allclose(body.frequencies, free[:k], rtol=1e-9)
    fixed = reduced("left", "craig-bampton", "average", frequency=1e3)
    assert fixed.n == 9
    with pytest.raises(Exception, match="no mode is below"):
        reduce_body(M, K, nodes, frames={}, frequency=1.0)


def test_damping_is_modal():
    body = reduced("left", "held", modes=4, damping=0.05)
    w = 2 * np.pi * body.frequencies
    np.testing.assert_allclose(body.D, np.diag(0.1 * w))
    body = reduced("left", "held", modes=4, damping=[0.01, 0, 0.02, 0.03])
    np.testing.assert_allclose(np.diag(body.D), 2 * w * [0.01, 0, 0.02, 0.03])


def test_rigid_frames_stiffen_and_averages_do_not():
    plain, stiff = reduced("mean-axis", "held", "average"), reduced("mean-axis", "held", "rigid")
    M, K, nodes = block()
    np.testing.assert_allclose(plain.frequencies, reduce_body(M, K, nodes, frames={}, modes=20).frequencies, rtol=1e-9)
    assert (stiff.frequencies > plain.frequencies).all()
    for name, end in (("left", 0), ("right", -1)):
        frame = next(f for f in stiff.interfaces if f.name == name)
        at = face(nodes, 0, end)
        arms = nodes[at] - stiff.origin - frame.place
        moved = frame.displacement + np.cross(frame.rotation.T[:, None], arms).transpose(1, 2, 0)
        np.testing.assert_allclose(stiff.nodal.modes[at], moved, atol=1e-7 * np.abs(moved).max())
    M, K, nodes = block()
    rows = []
    for end in (0, -1):
        at = face(nodes, 0, end)
        motions = bodies.rigid(nodes[at], nodes[at].mean(axis=0))
        rows.append(np.zeros((len(motions), 3 * len(nodes))))
        rows[-1][:, (3 * at[:, None] + range(3)).ravel()] = np.eye(len(motions)) - motions @ np.linalg.pinv(motions)
    squares, _ = bodies.constrained(M, K, np.vstack(rows))
    np.testing.assert_allclose(stiff.frequencies, hertz(squares[6:26]), rtol=1e-8)


def test_nodes_on_a_line_and_points():
    M, K, nodes = rod()
    body = reduce_body(
        M, K, nodes, frames={"hinge": HINGE, "edge": [48, 50, 52], "stiff": rigid([49, 51, 53])}, hold="hinge", modes=5
    )
    hinge, edge, stiff = body.interfaces
    assert (hinge.turns, edge.turns, stiff.turns) == (True, False, False)
    np.testing.assert_array_equal(edge.rotation[1], 0)
    assert np.abs(edge.rotation[[0, 2]]).max() > 0
    assert reduce_body(M, K, nodes, frames={"point": [7]}, modes=3).interfaces[0].turns is False


@pytest.mark.parametrize("basis", BASES)
@pytest.mark.parametrize("hold", ["left", "mean-axis", "inner"])
def test_frames_may_share_nodes(hold, basis):
    """A frame inside of another, held or not, adds no condition that is there already."""
    M, K, nodes = block()
    left, right = face(nodes, 0, 0), face(nodes, 0, -1)
    frames = {
        "left": left,
        "right": rigid(right),
        "corner": right[0],
        "line": right[:2],
        "same": right,
        "inner": left[:4],
    }
    body = reduce_body(M, K, nodes, frames=frames, hold=hold, basis=basis, modes=16)
    found = {frame.name: frame for frame in body.interfaces}
    size = np.abs(body.nodal.modes).max()
    np.testing.assert_allclose(found["same"].displacement, found["right"].displacement, atol=1e-9 * size)
    np.testing.assert_allclose(found["same"].rotation, found["right"].rotation, atol=1e-7 * size)
    arm = nodes[right[0]] - nodes[right].mean(axis=0)
    moved = found["right"].displacement + np.cross(found["right"].rotation.T, arm).T
    np.testing.assert_allclose(found["corner"].displacement, moved, atol=1e-7 * size)
    if hold == "left" and basis != "free":
        assert found["inner"].turns
        assert not found["inner"].displacement.any()
        assert not found["inner"].rotation.any()
    u = body.nodal.modes.reshape(-1, 16)
    np.testing.assert_allclose(u.T @ (M @ u), np.eye(16), atol=1e-10)


def test_a_slender_rod_is_no_mechanism():
    """Aspect 2000: clamped and free, against Euler and Bernoulli, to what the last digit of the stiffness leaves.

    omega^2 is 6e-15 of the largest eigenvalue.
    """
    from components.fe import box

    E, rho, h = 7e10, 2700.0, 0.004
    M, K, nodes = box((8.0, h, h), (100, 1, 1), "hex20", E=E, nu=0.0, rho=rho)
    unit = np.sqrt(E * h**2 / 12 / (rho * 8.0**4)) / (2 * np.pi)
    frames = {"root": face(nodes, 0, 0)}
    for hold, root in (("root", 1.8751040687), ("mean-axis", 4.7300407449)):
        body = reduce_body(M, K, nodes, frames=frames, hold=hold, modes=4)
        np.testing.assert_allclose(body.frequencies[:2], root**2 * unit, rtol=1e-2)


@pytest.mark.parametrize("basis", ["held", "craig-bampton"])
def test_a_rigid_frame_may_be_held_in_one_direction(basis):
    """It then slides and turns as a whole."""
    M, K, nodes = block()
    left, right = face(nodes, 0, 0), face(nodes, 0, -1)
    frames = {"left": left, "right": rigid(right)}
    body = reduce_body(M, K, nodes, frames=frames, hold={"left": "xyz", "right": "z"}, basis=basis, modes=8)
    frame = body.interfaces[1]
    size = np.abs(body.nodal.modes).max()
    assert not frame.displacement[2].any()
    assert np.abs(frame.rotation).max(axis=1).min() > 0
    arms = nodes[right] - nodes[right].mean(axis=0)
    moved = frame.displacement + np.cross(frame.rotation.T[:, None], arms).transpose(1, 2, 0)
    np.testing.assert_allclose(body.nodal.modes[right], moved, atol=1e-7 * size)
    motions = bodies.rigid(arms)
    rows = np.zeros((len(motions), 3 * len(nodes)))
    rows[:, (3 * right[:, None] + range(3)).ravel()] = np.eye(len(motions)) - motions @ np.linalg.pinv(motions)
    mean = np.zeros((1, 3 * len(nodes)))
    mean[0, 3 * right + 2] = 1.0
    held = units((3 * left[:, None] + range(3)).ravel(), 3 * len(nodes))
    squares, _ = bodies.constrained(M, K, np.vstack([rows, mean, held]))
    if basis == "held":
        np.testing.assert_allclose(body.frequencies, hertz(squares[:8]), rtol=1e-8)
    else:
        assert (body.frequencies > hertz(squares[:8]) * (1 - 1e-9)).all()
        np.testing.assert_allclose(body.frequencies[0], hertz(squares[0]), rtol=1e-2)
