"""Check that a reduced body is free: mean axes and modes without rigid motion."""

from __future__ import annotations

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array
from components.fe.reduction.reduced_body import ReducedBody

# Of the size that an integral can have: what is rounding, as of the integrals that `reduce_body` cuts.
ORTHOGONAL = 1e-7
# Of the square of the highest frequency: below it a mode has no stiffness; soft bodies with stiff parts come to 1e-8.
LOOSE = 1e-12
MEND = 'reduce_body(M, K, nodes, frames=..., hold="mean-axis", modes=...)'


def check_free(body: ReducedBody, what: str = "steps in inertial frames need") -> None:
    """Refuse a body whose modes hold rigid motion, or whose reference frame is not at its centre of mass.

    Parameters
    ----------
    body : ReducedBody
        The body.
    what : str
        What needs a free one, for the message.

    Raises
    ------
    DeclarationError
        With the call that makes one that is free.
    """
    if not isinstance(body, ReducedBody):
        raise DeclarationError(f"the body is a ReducedBody, as of {MEND}, not {body!r}")
    if body.mass <= 0 or np.linalg.matrix_rank(_inertia(body), hermitian=True) < 3:
        raise DeclarationError(
            "the body has no mass, or no moment of inertia about one of its axes: it cannot turn freely"
        )
    length = np.sqrt(np.trace(body.second_moment) / body.mass)
    off = np.linalg.norm(body.first_moment) / (body.mass * length)
    size = np.sqrt(body.mass * np.diag(body.M))
    moves = (np.linalg.norm(body.modal_first, axis=0) / size).max(initial=0.0)
    A = body.modal_second
    turns = (np.linalg.norm(A - A.transpose(0, 2, 1), axis=(1, 2)) / (size * length)).max(initial=0.0)
    if max(off, moves, turns) > ORTHOGONAL:
        wrong = (
            "its reference frame is not at its centre of mass" if off > ORTHOGONAL else "its modes hold rigid motion"
        )
        raise DeclarationError(f"{what} the modes of a free body, but {wrong}: {MEND}")
    squares = np.linalg.eigvals(np.linalg.solve(body.M, body.K)).real if body.n else np.ones(1)
    if squares.min() <= LOOSE * squares.max():
        raise DeclarationError(
            f"a mode at {np.sqrt(max(squares.min(), 0.0)) / (2 * np.pi):.4g} Hz stands for a rigid motion: the exact ones come "
            f"from the mass of the body, and the others are made by {MEND}"
        )


def _inertia(body: ReducedBody) -> Array:
    P = body.second_moment
    return np.trace(P) * np.eye(3) - P
