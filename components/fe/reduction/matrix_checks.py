"""Checks of the mass and stiffness matrices and the nodes of a free body."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array
from components.fe.nodes import named
from components.fe.reduction.solid import Solid, rigid_motions
from components.fe.user_warning import warn

# Asymmetry relative to the largest entry: files have 13 digits or more.
SYMMETRY = 1e-8
# Deviation of a mass block from a multiple of the unit matrix, relative to the masses of its two nodes: an error of the
# same relative size in the equations.
BLOCKS = 1e-7
# Force on a node in a rigid translation and rotation, relative to the forces of its neighbours. Rotations suffer from
# the six or seven digits of coordinates, amplified by a lever of up to a hundred elements.
MOVE, TURN = 1e-7, 1e-4
# Negative eigenvalue relative to the largest one of the scaled matrix: above round-off of the Lanczos steps. Smaller
# ones appear as negative eigenvalues of the modes.
INDEFINITE = 1e-9
LANCZOS = 80  # steps
# Plausible density in kg/m3: from foam to osmium, thin shells by their enclosed volume. Plausible speed of sound in
# m/s: from gel to diamond. Units that are off by 1e3 leave these ranges.
DENSITY = (10.0, 3e4)
SPEED = (20.0, 3e4)


def checked_solid(M: Any, K: Any, nodes: Any) -> Solid:
    """Check the matrices of a free body.

    Parameters
    ----------
    M, K : sparse matrix or array, shape (3 N, 3 N)
        Mass in kg, stiffness in N/m; equations in the order x, y, z of each node.
    nodes : array_like, shape (N, 3)
        Positions in m.

    Returns
    -------
    Solid
        The body, with exactly symmetric matrices.

    Raises
    ------
    DeclarationError
        If shapes are inconsistent, entries are not finite, a matrix is asymmetric or indefinite beyond round-off, nodes
        have rotational degrees of freedom, a block of M is not a multiple of the unit matrix, or K is not the stiffness
        of one free body with six rigid-body motions.
    """
    places = _places(nodes)
    M, K = (_matrix(A, name, len(places)) for A, name in ((M, "mass"), (K, "stiffness")))
    mass = _masses(M)
    stiff, heavy = K.diagonal().reshape(-1, 3), mass.diagonal()
    empty = (stiff == 0).all(axis=1)
    _rigid(K, nodes, places, empty)
    soft = np.flatnonzero((empty & (heavy > 0)) | (~empty & (stiff == 0).any(axis=1)))
    if len(soft):
        raise DeclarationError(
            f"node {named(nodes, soft[:1])} has mass or neighbours, but lacks stiffness in some direction"
        )
    _one_piece(K, nodes, places, empty)
    for A, name in ((K, "stiffness"), (mass, "mass")):
        if _lowest_share(A) < -INDEFINITE:
            raise DeclarationError(f"the {name} matrix is indefinite: it has a negative eigenvalue beyond round-off")
    made = Solid(mass, K, places, empty)
    if made.total <= 0:
        raise DeclarationError(f"the total mass is {made.total:g} kg; it must be positive")
    _plausible(made)
    return made


def _places(nodes: Any) -> Array:
    places = np.asarray(nodes)
    if places.ndim != 2 or places.shape[1] != 3 or len(places) < 3 or not np.issubdtype(places.dtype, np.number):
        raise DeclarationError(f"nodes must be an array of at least 3 positions in m, shape (N, 3), not {places.shape}")
    if not np.isfinite(places).all():
        raise DeclarationError(
            f"the position of node {np.flatnonzero(~np.isfinite(places).all(axis=1))[0]} is not finite"
        )
    return places.astype(float)


def _matrix(matrix: Any, name: str, count: int) -> Any:
    from scipy.sparse import csr_array, issparse

    given = matrix if issparse(matrix) else np.asarray(matrix)
    if given.shape == (6 * count, 6 * count):
        raise DeclarationError(
            f"the {name} matrix has 6 equations for each of the {count} nodes: rotational degrees of freedom (beams, shells) "
            "are not supported; export a body of solid elements"
        )
    if given.shape != (3 * count, 3 * count):
        raise DeclarationError(
            f"the {name} matrix has shape {given.shape}, but {count} nodes need {3 * count} equations: x, y, z of each node"
        )
    if np.iscomplexobj(given) or not np.issubdtype(given.dtype, np.number):
        raise DeclarationError(f"the {name} matrix must be real, not {given.dtype}")
    A = csr_array(given, dtype=float)
    if not np.isfinite(A.data).all():
        raise DeclarationError(f"the {name} matrix contains numbers that are not finite")
    if not A.nnz:
        raise DeclarationError(f"the {name} matrix is empty")
    skew = abs(A - A.T).tocoo()
    if skew.nnz and skew.data.max() > SYMMETRY * abs(A.data).max():
        k = int(np.argmax(skew.data))
        triangle = "; it may be one triangle of a symmetric matrix" if _triangular(A) else ""
        raise DeclarationError(
            f"the {name} matrix is not symmetric in row {skew.row[k]}, column {skew.col[k]}{triangle}"
        )
    half = (A + A.T) / 2
    half.eliminate_zeros()
    return half


def _triangular(A: Any) -> bool:
    entries = A.tocoo()
    return bool((entries.row >= entries.col).all() or (entries.row <= entries.col).all())


def _masses(M: Any) -> Any:
    """Reduce the mass matrix to one scalar for each pair of nodes."""
    parts = [[M[a::3, b::3] for b in range(3)] for a in range(3)]
    mean = (parts[0][0] + parts[1][1] + parts[2][2]) / 3
    heavy = np.sqrt(np.maximum(mean.diagonal(), 0.0))
    least = BLOCKS * heavy.max()
    for a in range(3):
        for b in range(3):
            rest = (parts[a][b] - mean if a == b else parts[a][b]).tocoo()
            wrong = abs(rest.data) > BLOCKS * np.maximum(heavy[rest.row], least) * np.maximum(heavy[rest.col], least)
            if wrong.any():
                k = int(np.flatnonzero(wrong)[0])
                raise DeclarationError(
                    f"the block of the mass matrix for nodes {rest.row[k]} and {rest.col[k]} is not a multiple of the unit "
                    "matrix: the mass depends on the direction, nodes have rotations, or equations are in another order"
                )
    mean.eliminate_zeros()
    return mean


def _rigid(K: Any, nodes: Any, places: Array, empty: Array) -> None:
    """Check that K exerts no force in the six rigid-body motions."""
    entries = K.tocoo()
    row, column = entries.row // 3, entries.col // 3
    size = np.abs(places - places.mean(axis=0)).max()
    arms = np.linalg.norm(places[column] - places[row], axis=1) / size
    forces = np.abs(entries.data)
    pushes = np.bincount(entries.row, forces, K.shape[0])
    turns = np.bincount(entries.row, forces * arms, K.shape[0])
    motions = rigid_motions(places, places.mean(axis=0), size)
    done = (K @ motions.reshape(-1, 6)).reshape(-1, 3, 6)
    # Rotation about the node itself: about the centre, less the translation of the node.
    shift = motions[:, :, 3:]
    done[:, :, 3:] -= np.einsum("nda,nat->ndt", done[:, :, :3], shift)
    move, turn = np.abs(done[:, :, :3]).max(axis=2).ravel(), np.abs(done[:, :, 3:]).max(axis=2).ravel()
    bad = ((move > MOVE * pushes) | (turn > TURN * turns)).reshape(-1, 3).any(axis=1)
    if not bad.any():
        return
    missing = np.flatnonzero(empty)
    if len(missing):
        raise DeclarationError(
            f"rigid-body motions are missing: the matrices lack the equations of nodes {named(nodes, missing)}, as if these "
            "were fixed; export the matrices of the free body"
        )
    raise DeclarationError(
        f"rigid-body motions are missing: the stiffness matrix resists them at nodes {named(nodes, np.flatnonzero(bad))}; "
        "remove supports and springs to ground there, or bring nodes and equations into the same order"
    )


def _one_piece(K: Any, nodes: Any, places: Array, empty: Array) -> None:
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    entries = K.tocoo()
    graph = coo_array((np.ones(entries.nnz), (entries.row // 3, entries.col // 3)), shape=(len(places),) * 2)
    _, label = connected_components(graph, directed=False)
    used = np.flatnonzero(~empty)
    kinds, first = np.unique(label[used], return_index=True)
    if len(kinds) > 1:
        _, counts = np.unique(np.round(places[used] / (1e-9 * np.abs(places).max())), axis=0, return_counts=True)
        double = (
            f"; {(counts > 1).sum()} positions have two nodes, which may have to be merged"
            if (counts > 1).any()
            else ""
        )
        raise DeclarationError(
            f"more than six rigid-body motions: the body consists of {len(kinds)} disconnected pieces, with nodes "
            f"{named(nodes, used[first])}{double}"
        )


def _lowest_share(A: Any) -> float:
    """Return the lowest Lanczos eigenvalue relative to the largest, of the matrix scaled to a unit diagonal."""
    diagonal = A.diagonal()
    if (diagonal < 0).any() or abs(A[np.flatnonzero(diagonal == 0)]).sum() > 0:
        return -1.0
    scale = 1 / np.sqrt(np.where(diagonal > 0, diagonal, np.inf))
    rng, count = np.random.default_rng(0), min(LANCZOS, A.shape[0])
    Q, images = np.zeros((count, A.shape[0])), np.zeros((count, A.shape[0]))
    step, k = rng.normal(size=A.shape[0]), 0
    while k < count and (length := np.linalg.norm(step)) > 1e-12:
        Q[k] = step / length
        images[k] = scale * (A @ (scale * Q[k]))
        k += 1
        step = images[k - 1]
        for _ in range(2):
            step = step - Q[:k].T @ (Q[:k] @ step)
    values = np.linalg.eigvalsh(Q[:k] @ images[:k].T)
    return float(values[0] / max(values[-1], np.finfo(float).tiny))


def _plausible(body: Solid) -> None:
    """Warn if density or speed of sound are implausible, as with units that are off by 1e3."""
    arms = body.nodes - body.centre
    # Volume of the homogeneous box with the same second moments.
    volume = np.sqrt(max(np.linalg.det(12 / body.total * arms.T @ (body.mass @ arms)), 0.0))
    density = body.total / volume if volume else np.inf
    # The energy of a uniform stretch gives the P-wave modulus of a body of any shape.
    stretch = np.zeros((len(arms), 3, 3))
    stretch[:, range(3), range(3)] = arms
    flat = stretch.reshape(-1, 3)
    speed = float(np.sqrt(max(np.mean(np.sum(flat * (body.stiffness @ flat), axis=0)), 0.0) / body.total))
    implausible = []
    if not DENSITY[0] <= density <= DENSITY[1]:
        implausible.append(f"a density of about {density:.2g} kg/m3")
    if not SPEED[0] <= speed <= SPEED[1]:
        implausible.append(f"a speed of sound of about {speed:.2g} m/s")
    if implausible:
        warn(
            f"the body has {' and '.join(implausible)}, unlike any solid: nodes must be in m, masses in kg, stiffness in N/m. "
            "Do this: pass the units to the reader, such as length=1e-3, mass=1e3 for mm, N and Mg."
        )
