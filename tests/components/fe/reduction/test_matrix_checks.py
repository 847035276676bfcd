"""Wrong input of a reduction: one clear message each."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from scipy.sparse import block_diag, csr_array, diags_array, lil_array, tril

import acausal as ac
from components.fe import average, box, read_npz, reduce_body, rigid
from tests.components.fe.bodies import FILES, block, face, rod


def changed(A, *entries):
    B = lil_array(A)
    for i, j, value in entries:
        B[i, j] = value
    return csr_array(B)


def mixed(M, K, nodes):
    """Nodes in another order than the equations."""
    return M, K, np.roll(nodes, 1, axis=0)


def joined_at_a_node(M, K, nodes):
    """Two blocks that share one corner."""
    count = len(nodes)
    keep = np.r_[0 : 3 * count, 3 * count + 3 : 6 * count]
    T = np.zeros((6 * count, 6 * count - 3))
    T[keep, np.arange(6 * count - 3)] = 1.0
    last = 3 * count - 3
    T[3 * count : 3 * count + 3, last : last + 3] = np.eye(3)
    T = csr_array(T)
    both = [T.T @ csr_array(block_diag([A, A])) @ T for A in (M, K)]
    return *both, np.vstack([nodes, nodes[1:] + nodes[-1] - nodes[0]])


def two_pieces(M, K, nodes):
    return csr_array(block_diag([M, M])), csr_array(block_diag([K, K])), np.vstack([nodes, nodes])


def grounded(M, K, nodes):
    return M, changed(K, (10, 10, K[10, 10] * 1.5)), nodes


def held(M, K, nodes):
    free = np.ones(3 * len(nodes))
    free[(3 * face(nodes, 0, 0)[:, None] + range(3)).ravel()] = 0
    Z = diags_array(free)
    return csr_array(Z @ M @ Z), csr_array(Z @ K @ Z), nodes


def indefinite(M, K, nodes):
    values, vectors = np.linalg.eigh(K.toarray())
    values[np.abs(values) < 1e-6 * values.max()] = 0.0
    values[30] *= -1
    return M, csr_array((vectors * values) @ vectors.T), nodes


def heavy_indefinite(M, K, nodes):
    values, vectors = np.linalg.eigh(M[0::3, 0::3].toarray())
    values[2] *= -1
    return csr_array(np.kron((vectors * values) @ vectors.T, np.eye(3))), K, nodes


def turned_mass(M, K, nodes):
    return changed(M, (3, 3, M[3, 3] * (1 + 1e-4))), K, nodes


def coupled_mass(M, K, nodes):
    return changed(M, (0, 1, M[0, 0] * 1e-4), (1, 0, M[0, 0] * 1e-4)), K, nodes


def no_stiffness(M, K, nodes):
    row = [(4, int(j), 0.0) for j in K[[4]].nonzero()[1]]
    return M, changed(K, *row, *((j, i, v) for i, j, v in row)), nodes


WRONG = {
    "not symmetric": (
        lambda M, K, x: (M, changed(K, (3, 7, K[3, 7] + 1e-5 * K[3, 3])), x),
        "stiffness matrix is not symmetric in row 3, column 7",
    ),
    "one triangle": (lambda M, K, x: (M, csr_array(tril(K)), x), "it may be one triangle of a symmetric matrix"),
    "mass not symmetric": (
        lambda M, K, x: (changed(M, (3, 6, 0.9 * M[3, 6] + 1e-4)), K, x),
        "mass matrix is not symmetric",
    ),
    "not finite": (
        lambda M, K, x: (M, changed(K, (5, 5, np.nan)), x),
        "stiffness matrix contains numbers that are not finite",
    ),
    "complex": (lambda M, K, x: (M, K * 1j, x), "must be real, not complex128"),
    "empty": (lambda M, K, x: (M, csr_array(K.shape), x), "stiffness matrix is empty"),
    "shapes": (lambda M, K, x: (M, K[:-3][:, :-3], x), r"stiffness matrix has shape \(69, 69\), but 24 nodes need 72"),
    "swapped": (lambda M, K, x: (x, K, M), "array of at least 3 positions"),
    "nodes": (lambda M, K, x: (M, K, x[:-1]), "mass matrix has shape"),
    "flat nodes": (lambda M, K, x: (M, K, x.ravel()), r"shape \(N, 3\)"),
    "a node not finite": (
        lambda M, K, x: (M, K, np.where(np.arange(24)[:, None] == 7, np.inf, x)),
        "position of node 7 is not finite",
    ),
    "rotations": (
        lambda M, K, x: (M, K, x[::2]),
        "6 equations for each of the 12 nodes: rotational degrees of freedom",
    ),
    "mass by direction": (
        turned_mass,
        "block of the mass matrix for nodes 1 and 1 is not a multiple of the unit matrix",
    ),
    "mass across directions": (coupled_mass, "block of the mass matrix for nodes 0 and 0"),
    "grounded": (grounded, "rigid-body motions are missing: the stiffness matrix resists them at nodes 3;"),
    "held": (held, "rigid-body motions are missing: the matrices lack the equations of nodes 0, 1, 2, 3, 4, 5"),
    "another order": (mixed, "rigid-body motions are missing: the stiffness matrix resists them at nodes"),
    "two pieces": (
        two_pieces,
        "six rigid-body motions: the body consists of 2 disconnected pieces, with nodes 0, 24; 24 positions have two nodes",
    ),
    "a hinge": (joined_at_a_node, "more than six rigid-body motions: parts of the body move without stiffness"),
    "indefinite": (indefinite, "indefinite"),
    "negative": (lambda M, K, x: (M, -K, x), "stiffness matrix is indefinite"),
    "mass indefinite": (heavy_indefinite, "the mass matrix is indefinite"),
    "without stiffness": (no_stiffness, "rigid-body motions are missing"),
}


@pytest.mark.parametrize("name", WRONG)
def test_matrices_that_cannot_be(name):
    change, message = WRONG[name]
    with pytest.raises(ac.DeclarationError, match=message):
        reduce_body(*change(*block()), frames={}, modes=3)


FRAMES = {
    "no mapping": ([1, 2], "frames must map names to nodes"),
    "no name": ({"a b": [1]}, "the name of a frame must be a Python identifier, not 'a b'"),
    "keyword": ({"in": [1]}, "the name of a frame must be a Python identifier, not 'in'"),
    "number": ({3: [1]}, "the name of a frame must be a Python identifier, not 3"),
    "not there": ({"tip": [24]}, "frame 'tip' refers to node 24, but nodes are numbered 0 to 23"),
    "negative": ({"tip": [-1]}, "frame 'tip' refers to node -1"),
    "twice": ({"tip": [3, 4, 3]}, "frame 'tip' contains node 3 twice"),
    "none": ({"tip": []}, "nodes of a frame must be indices counted from 0"),
    "places": ({"tip": [0.5, 1.0]}, "nodes of a frame must be indices counted from 0"),
    "mask": ({"tip": np.ones(24, dtype=bool)}, "nodes of a frame must be indices counted from 0"),
    "rigid and shared": ({"a": rigid([0, 1, 2, 3]), "b": rigid([3, 4, 5, 9])}, "rigid frame 'b' shares nodes"),
}


@pytest.mark.parametrize("name", FRAMES)
def test_frames_that_cannot_be(name):
    frames, message = FRAMES[name]
    with pytest.raises(ac.DeclarationError, match=message):
        reduce_body(*block(), frames=frames, modes=3)


@pytest.mark.parametrize("weights", [[1, 2], [1, 0, 1], [1, np.nan, 1], [1, -1, 1]])
def test_weights_that_cannot_be(weights):
    with pytest.raises(ac.DeclarationError, match="one positive number for each of the 3 nodes"):
        average([0, 1, 2], weights)


HOLDS = {
    "no frame": ("hinge", "hold refers to 'hinge', but the frames are tip, left, line"),
    "a point": ("tip", "leaves 3 of the six rigid-body motions free"),
    "collinear": ((0, 1, 0), "collinear"),
    "on a line": ((0, 6, 12), "the nodes 0, 6, 12 of the reference frame are collinear"),
    "two nodes": ((0, 1), "hold must be a frame"),
    "four nodes": ((0, 1, 2, 3), "hold must be a frame"),
    "not there": ((0, 1, 24), "hold refers to node 24, but nodes are numbered 0 to 23"),
    "directions": ({"left": "xw"}, "letters of \"xyz\", not 'xw'"),
    "no directions": ({"left": ""}, 'letters of "xyz"'),
    "too few": ({"left": "xy"}, "leaves 1 of the six rigid-body motions free"),
    "nothing": ({}, "leaves 6 of the six rigid-body motions"),
    "a node": ({0: "xyz", "line": "z"}, "rigid-body motions free"),
    "a number": (5, "hold must be a frame"),
    "none": (None, "hold must be a frame"),
    "fractions": ((0.0, 1.0, 2.0), "hold must be a frame"),
}


@pytest.mark.parametrize("name", HOLDS)
def test_reference_frames_that_cannot_be(name):
    M, K, nodes = block()
    hold, message = HOLDS[name]
    frames = {"tip": [23], "left": face(nodes, 0, 0), "line": [0, 6]}
    with pytest.raises(ac.DeclarationError, match=message):
        reduce_body(M, K, nodes, frames=frames, hold=hold, modes=3)


def test_a_line_alone_is_no_reference_frame():
    M, K, nodes = rod()
    with pytest.raises(
        ac.DeclarationError,
        match=r'leaves 1 of the six rigid-body motions free: .* hold more directions, such as \{"hinge": "xyz", "tip": "z"\}',
    ):
        reduce_body(M, K, nodes, frames={"hinge": [0, 2, 4]}, hold="hinge")


NUMBERS = {
    "none": ({"modes": 0}, "positive integer, not 0"),
    "half": ({"modes": 2.5}, "positive integer, not 2.5"),
    "true": ({"modes": True}, "positive integer, not True"),
    "too many": ({"modes": 67}, "the body has only 66 modes with mass, but modes=67"),
    "basis": ({"basis": "guyan"}, "'held', 'free', 'craig-bampton', not 'guyan'"),
    "damping": ({"damping": -0.1}, "must be a damping ratio"),
    "dampings": ({"damping": [0.1, 0.2]}, "for each of the 10 modes"),
    "damping in words": ({"damping": "little"}, "must be a damping ratio"),
    "frequency": ({"frequency": -3.0}, "positive bound in Hz"),
    "static": (
        {"basis": "craig-bampton", "modes": 2},
        "6 static modes, but modes=2; use modes=6 or more",
    ),
}


@pytest.mark.parametrize("name", NUMBERS)
def test_numbers_that_cannot_be(name):
    M, K, nodes = block()
    change, message = NUMBERS[name]
    frames = {"left": face(nodes, 0, 0), "right": face(nodes, 0, -1)}
    with pytest.raises(ac.DeclarationError, match=message):
        reduce_body(M, K, nodes, frames=frames, hold="mean-axis", **change)


def test_nodes_that_carry_nothing():
    """A reference point of the FE program, without mass and stiffness, is no part of the body."""
    M, K, nodes = block()
    more = [csr_array(block_diag([A, csr_array((3, 3))])) for A in (M, K)]
    places = np.vstack([nodes, [9.0, 9.0, 9.0]])
    body, plain = reduce_body(*more, places, frames={}, modes=5), reduce_body(M, K, nodes, frames={}, modes=5)
    np.testing.assert_allclose(body.frequencies, plain.frequencies, rtol=1e-9)
    assert not body.nodal.modes[24].any()
    with pytest.raises(ac.DeclarationError, match="node 24 of frame 'tip' has no stiffness"):
        reduce_body(*more, places, frames={"tip": [24]}, modes=5)
    with pytest.raises(ac.DeclarationError, match="node 24 of hold has no stiffness"):
        reduce_body(*more, places, frames={}, hold=(0, 1, 24), modes=5)
    heavy = csr_array(block_diag([M, csr_array(np.eye(3))]))
    with pytest.raises(ac.DeclarationError, match="node 24 has mass or neighbours, but lacks stiffness"):
        reduce_body(heavy, more[1], places, frames={}, modes=5)


@pytest.mark.parametrize(
    ("scale", "said"),
    [
        (
            (1e-3, 1, 1),
            r"a density of about 7\.[89] kg/m3 and a speed of sound of about 1\.9e\+05 m/s, unlike any solid",
        ),  # Mg
        ((1, 1, 1e3), r"a density of about 7\.[89]e-06 kg/m3 and a speed of sound of about 6e\+06 m/s"),  # mm
        ((1, 1e-3, 1e3), r"a density of about 7\.[89]e-06 kg/m3 and a speed"),  # mm, N/mm
        ((1e-3, 1e-3, 1e3), r"a density of about 7\.[89]e-09 kg/m3 and a speed"),  # mm, N/mm, Mg
        ((1e3, 1, 1), r"a density of about 7\.[89]e\+06 kg/m3, unlike any solid"),  # g
        ((1, 1e3, 1), r"the body has a speed of sound of about 1\.9e\+05 m/s, unlike any solid"),  # N/mm for N/m
    ],
)
def test_units_off_by_a_thousand(scale, said):
    M, K, nodes = block()
    mass, stiffness, length = scale
    with pytest.warns(ac.AcausalWarning, match=said) as caught:
        reduce_body(mass * M, stiffness * K, length * nodes, frames={}, modes=2)
    assert len(caught) == 1
    assert caught[0].filename == __file__


def test_bodies_of_the_references_pass_without_a_word():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for name in ("rod_qm6_8x2x1.npz", "rod_ccx_c3d8_8x2x1.npz"):
            reduce_body(*read_npz(FILES / name), frames={}, modes=2)
        reduce_body(*read_npz(FILES / "plate_fe_h25.npz", length=1e-3, mass=1e3), frames={}, modes=2)
        reduce_body(*box((8, 0.036, 0.06), (10, 1, 1), "hex8", E=2.3e9, nu=0.0, rho=91), frames={}, modes=2)


def test_dense_matrices_and_lists_will_do():
    M, K, nodes = block()
    dense = reduce_body(M.toarray(), K.toarray().tolist(), nodes.tolist(), frames={"a": np.int64(3)}, modes=3)
    assert dense == reduce_body(M, K, nodes, frames={"a": [3]}, modes=np.int64(3))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ({}, "has no nodes"),
        ({"nodes": np.zeros((3, 3))}, r"has no stiffness \(K\)"),
        ({"nodes": np.zeros((3, 3)), "K": np.eye(9)}, r"has no mass \(M or mscalar\)"),
        ({"nodes": np.zeros((3, 3)), "K_data": np.ones(3)}, "an invalid sparse matrix K"),
        (
            {
                "nodes": np.zeros((3, 3)),
                "K_data": np.ones(3),
                "K_indices": np.array([0, 1, 9]),
                "K_indptr": np.arange(4),
            },
            "an invalid sparse matrix K",
        ),
    ],
)
def test_npz_files_that_cannot_be(tmp_path, content, message):
    path = tmp_path / "body.npz"
    np.savez(path, **content)
    with pytest.raises(ac.DeclarationError, match=message):
        read_npz(path)


def test_npz_files_that_are_none(tmp_path):
    with pytest.raises(ac.DeclarationError, match="there is no file"):
        read_npz(tmp_path / "none.npz")
    whole = (FILES / "rod_qm6_8x2x1.npz").read_bytes()
    for part in (0, 100, len(whole) // 2, len(whole) - 10):
        (tmp_path / "cut.npz").write_bytes(whole[:part])
        with pytest.raises(ac.DeclarationError, match=r"not a \.npz file, or is damaged"):
            read_npz(tmp_path / "cut.npz")
    (tmp_path / "text.npz").write_text("hello")
    with pytest.raises(ac.DeclarationError, match=r"not a \.npz file, or is damaged$"):
        read_npz(tmp_path / "text.npz")
    M, K, nodes = block()
    reduce_body(M, K, nodes, frames={"a": [0]}, modes=1).save(tmp_path / "reduced.npz")
    with pytest.raises(ac.DeclarationError, match="is a reduced body"):
        read_npz(tmp_path / "reduced.npz")


def test_npz_triangles_and_scales(tmp_path):
    M, K, nodes = block()
    np.savez(tmp_path / "b.npz", nodes=nodes * 1e3, M=np.tril(M.toarray()) / 1e3, K=np.triu(K.toarray()) / 1e3)
    again = read_npz(tmp_path / "b.npz", length=1e-3, mass=1e3)
    np.testing.assert_allclose(again[0].toarray(), M.toarray(), rtol=1e-14)
    np.testing.assert_allclose(again[1].toarray(), K.toarray(), rtol=1e-14)
    np.testing.assert_allclose(again[2], nodes, rtol=1e-14)
