"""What may be wrong with matrices of a body: one clear message each."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array
from components.fe.nodes import named
from components.fe.reduction.solid import Solid, rigid_motions
from components.fe.user_warning import warn

# Of the larger entries that an entry stands beside. Files have 13 digits and more.
SYMMETRY = 1e-8
# Blocks of the mass matrix that are so far from multiples of the unit matrix falsify the equations by as much.
BLOCKS = 1e-7
# Rigid motions: force of a node by the forces of its neighbours. Turns know coordinates, which have six or seven digits,
# of a place that may lie a hundred elements away.
MOVE, TURN = 1e-7, 1e-4
# A negative eigenvalue, by the largest; one nearer to 0 shows as a negative mode.
INDEFINITE = 1e-9
LANCZOS = 80
# Solids from foam to osmium, and thin shells by the space that they enclose, in kg/m3; from gel to diamond, in m/s.
DENSITY = (10.0, 3e4)
SPEED = (20.0, 3e4)


def checked_solid(M: Any, K: Any, nodes: Any) -> Solid:
    """Check the matrices of a free body.

    Parameters
    ----------
    M, K : sparse matrix or array, shape (3 N, 3 N)
        Mass in kg, stiffness in N/m; equations in the order x, y, z of each node.
    nodes : array_like, shape (N, 3)
        Places in m.

    Returns
    -------
    Solid
        The body, its matrices made symmetric to the last digit.

    Raises
    ------
    DeclarationError
        If shapes do not fit, entries are not finite, a matrix is not symmetric or is indefinite beyond rounding, rotations
        of nodes are among the equations, the blocks of M are no multiples of the unit matrix, or K does not belong to
        one free body with six rigid motions.
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
            f"node {named(nodes, soft[:1])} has mass or neighbours, but no stiffness in every direction"
        )
    _one_piece(K, nodes, places, empty)
    for A, name in ((K, "stiffness"), (mass, "mass")):
        if _lowest_share(A) < -INDEFINITE:
            raise DeclarationError(f"the {name} matrix is indefinite: it has a negative eigenvalue beyond rounding")
    made = Solid(mass, K, places, empty)
    if made.total <= 0:
        raise DeclarationError(f"the mass matrix holds a mass of {made.total:g} kg")
    _plausible(made)
    return made


def _places(nodes: Any) -> Array:
    places = np.asarray(nodes)
    if places.ndim != 2 or places.shape[1] != 3 or len(places) < 3 or not np.issubdtype(places.dtype, np.number):
        raise DeclarationError(f"nodes are at least 3 places in m, shape (N, 3), not of shape {places.shape}")
    if not np.isfinite(places).all():
        raise DeclarationError(f"the place of node {np.flatnonzero(~np.isfinite(places).all(axis=1))[0]} is not finite")
    return places.astype(float)


def _matrix(matrix: Any, name: str, count: int) -> Any:
    from scipy.sparse import csr_array, issparse

    given = matrix if issparse(matrix) else np.asarray(matrix)
    if given.shape == (6 * count, 6 * count):
        raise DeclarationError(
            f"the {name} matrix has 6 equations for each of the {count} nodes: rotations of nodes (beams, shells) cannot "
            "be taken over; export a body of solid elements"
        )
    if given.shape != (3 * count, 3 * count):
        raise DeclarationError(
            f"the {name} matrix has shape {given.shape}, but {count} nodes need {3 * count} equations: x, y, z of each node"
        )
    if np.iscomplexobj(given) or not np.issubdtype(given.dtype, np.number):
        raise DeclarationError(f"the {name} matrix holds {given.dtype}, not real numbers")
    A = csr_array(given, dtype=float)
    if not np.isfinite(A.data).all():
        raise DeclarationError(f"the {name} matrix holds numbers that are not finite")
    if not A.nnz:
        raise DeclarationError(f"the {name} matrix is empty")
    skew = abs(A - A.T).tocoo()
    if skew.nnz and skew.data.max() > SYMMETRY * abs(A.data).max():
        k = int(np.argmax(skew.data))
        triangle = "; is it one triangle of a symmetric matrix?" if _triangular(A) else ""
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
    """One mass for each pair of nodes."""
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
                    f"the mass matrix couples nodes {rest.row[k]} and {rest.col[k]} by a block that is no multiple of the unit "
                    "matrix: mass that differs by direction, rotations of nodes, or another order of the equations"
                )
    mean.eliminate_zeros()
    return mean


def _rigid(K: Any, nodes: Any, places: Array, empty: Array) -> None:
    """K must leave the six rigid motions free."""
    entries = K.tocoo()
    row, column = entries.row // 3, entries.col // 3
    size = np.abs(places - places.mean(axis=0)).max()
    arms = np.linalg.norm(places[column] - places[row], axis=1) / size
    forces = np.abs(entries.data)
    pushes = np.bincount(entries.row, forces, K.shape[0])
    turns = np.bincount(entries.row, forces * arms, K.shape[0])
    motions = rigid_motions(places, places.mean(axis=0), size)
    done = (K @ motions.reshape(-1, 6)).reshape(-1, 3, 6)
    # About the node itself: a turn about the origin less the translation of the node.
    shift = motions[:, :, 3:]
    done[:, :, 3:] -= np.einsum("nda,nat->ndt", done[:, :, :3], shift)
    move, turn = np.abs(done[:, :, :3]).max(axis=2).ravel(), np.abs(done[:, :, 3:]).max(axis=2).ravel()
    bad = ((move > MOVE * pushes) | (turn > TURN * turns)).reshape(-1, 3).any(axis=1)
    if not bad.any():
        return
    missing = np.flatnonzero(empty)
    if len(missing):
        raise DeclarationError(
            f"rigid motions are missing: equations of nodes {named(nodes, missing)} are not in the matrices, as if "
            "they were held; write the matrices of the free body"
        )
    raise DeclarationError(
        f"rigid motions are missing: the stiffness matrix resists them at nodes {named(nodes, np.flatnonzero(bad))}; is "
        "something held or grounded there, or are nodes and equations in different orders?"
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
            f"; {(counts > 1).sum()} places hold two nodes, which may have to be merged" if (counts > 1).any() else ""
        )
        raise DeclarationError(
            f"more than six rigid motions: the body is {len(kinds)} pieces that nothing joins, with nodes "
            f"{named(nodes, used[first])}{double}"
        )


def _lowest_share(A: Any) -> float:
    """Lowest eigenvalue that some steps of Lanczos find, by the largest, of a matrix scaled to a unit diagonal."""
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
    """Warn where units are off by 1e3: no solid is so light or heavy, or lets sound pass so slowly or fast."""
    arms = body.nodes - body.centre
    # Of the box with these second moments.
    volume = np.sqrt(max(np.linalg.det(12 / body.total * arms.T @ (body.mass @ arms)), 0.0))
    density = body.total / volume if volume else np.inf
    # A uniform stretch has the energy of the modulus of pressure waves, in a body of any shape.
    stretch = np.zeros((len(arms), 3, 3))
    stretch[:, range(3), range(3)] = arms
    flat = stretch.reshape(-1, 3)
    speed = float(np.sqrt(max(np.mean(np.sum(flat * (body.stiffness @ flat), axis=0)), 0.0) / body.total))
    said = []
    if not DENSITY[0] <= density <= DENSITY[1]:
        said.append(f"a density of about {density:.2g} kg/m3")
    if not SPEED[0] <= speed <= SPEED[1]:
        said.append(f"a speed of sound of about {speed:.2g} m/s")
    if said:
        warn(
            f"the body has {' and '.join(said)}, as no solid: are nodes in m, masses in kg, and stiffness in N/m? "
            "The readers take length= and mass=, as length=1e-3, mass=1e3 for mm, N and Mg."
        )
