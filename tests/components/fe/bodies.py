"""Bodies that tests of FE bodies share, and what is known of them without a reduction."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
from scipy.linalg import eigh, null_space

from components.fe import box, read_npz

FILES = Path(__file__).parents[2] / "reference/fe"
HINGE, TIP = (0, 2, 4), 50


@cache
def rod():
    """The pendulum of Vlasenko and Kasper 2008, section XI."""
    return read_npz(FILES / "rod_qm6_8x2x1.npz")


@cache
def plate():
    return read_npz(FILES / "plate_fe_h25.npz", length=1e-3, mass=1e3)


@cache
def block(counts=(3, 1, 2), size=(0.3, 0.1, 0.17)):
    """A small block of steel without equal frequencies."""
    return box(size, counts, "hex8", E=2.1e11, nu=0.3, rho=7850.0)


def face(nodes, axis, end):
    """Nodes of a face of a box: axis 0 to 2, end 0 or -1."""
    return np.flatnonzero(np.isclose(nodes[:, axis], np.unique(nodes[:, axis])[end]))


def rigid(nodes, about=(0, 0, 0)):
    """Translations and turns of 1 rad, shape (3 N, 6)."""
    moves = np.tile(np.eye(3), (len(nodes), 1))
    turns = [np.cross(axis, nodes - about).ravel() for axis in np.eye(3)]
    return np.column_stack([moves, *turns])


def constrained(M, K, rows):
    """Eigenvalues and modes with rows @ u = 0, by a dense null space."""
    Z = null_space(rows) if len(rows) else np.eye(M.shape[0])
    squares, vectors = eigh(Z.T @ K.toarray() @ Z, Z.T @ M.toarray() @ Z)
    return squares, Z @ vectors


def units(equations, count):
    """Rows that hold equations."""
    return np.eye(count)[np.asarray(equations)]


def hertz(squares):
    return np.sqrt(np.maximum(squares, 0)) / (2 * np.pi)
