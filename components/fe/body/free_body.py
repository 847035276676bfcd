"""Check that a reduced body is free: mean axes and modes without rigid motion."""

from __future__ import annotations

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array
from components.fe.reduction.reduced_body import ReducedBody

# Momentum and angular momentum of a mode relative to its largest possible value: above the round-off that `reduce_body`
# leaves in its integrals.
ORTHOGONAL = 1e-7
# Eigenvalue of a mode without stiffness, relative to the largest one: soft bodies with stiff parts reach 1e-8.
LOOSE = 1e-12
REMEDY = 'reduce_body(M, K, nodes, frames=..., hold="mean-axis", modes=...)'


def check_free(body: ReducedBody, what: str = "steps in inertial frames need") -> None:
    """Check that the modes contain no rigid motion and the reference frame is at the centre of mass.

    Parameters
    ----------
    body : ReducedBody
        The body.
    what : str
        Subject and verb of the message: the feature that needs a free body.

    Raises
    ------
    DeclarationError
        If the body is not free, with the call that makes a free one.
    """
    if not isinstance(body, ReducedBody):
        raise DeclarationError(f"the body must be a ReducedBody, such as {REMEDY}, not {body!r}")
    if body.mass <= 0 or np.linalg.matrix_rank(_inertia(body), hermitian=True) < 3:
        raise DeclarationError(
            "the body has no mass, or no moment of inertia about some axis: its rotation is undetermined"
        )
    length = np.sqrt(np.trace(body.second_moment) / body.mass)
    off = np.linalg.norm(body.first_moment) / (body.mass * length)
    size = np.sqrt(body.mass * np.diag(body.M))
    moves = (np.linalg.norm(body.modal_first, axis=0) / size).max(initial=0.0)
    A = body.modal_second
    turns = (np.linalg.norm(A - A.transpose(0, 2, 1), axis=(1, 2)) / (size * length)).max(initial=0.0)
    if max(off, moves, turns) > ORTHOGONAL:
        wrong = (
            "its reference frame is not at its centre of mass" if off > ORTHOGONAL else "its modes contain rigid motion"
        )
        raise DeclarationError(f"{what} the modes of a free body, but {wrong}: {REMEDY}")
    squares = np.linalg.eigvals(np.linalg.solve(body.M, body.K)).real if body.n else np.ones(1)
    if squares.min() <= LOOSE * squares.max():
        raise DeclarationError(
            f"a mode at {np.sqrt(max(squares.min(), 0.0)) / (2 * np.pi):.4g} Hz is a rigid-body motion, which must not be among "
            f"the modes: {REMEDY}"
        )


def _inertia(body: ReducedBody) -> Array:
    P = body.second_moment
    return np.trace(P) * np.eye(3) - P
