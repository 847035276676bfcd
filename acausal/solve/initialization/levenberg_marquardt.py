"""Levenberg-Marquardt iteration for underdetermined nonlinear least squares, dense or sparse."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
import scipy

from acausal.policy import POLICY

LOOPS = POLICY.loops

Matrix: TypeAlias = "np.ndarray | scipy.sparse.csc_matrix"
Residuals = Callable[[np.ndarray], tuple[np.ndarray, Matrix]]


def levenberg_marquardt(evaluate: Residuals, u: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """Return the minimizer of the residuals near a guess (Madsen, Nielsen and Tingleff 2004, algorithm 3.16).

    A step h in units of `scale` solves (J'J + m I) h = -J'r, as h = -J'(J J' + m I)^-1 r, because residuals are fewer than
    unknowns; m falls if the gain is as predicted, and rises if there is none.

    Parameters
    ----------
    evaluate : callable
        Returns residuals r, shape (m,), and their Jacobian by the unknowns, dense or sparse.
    u : array, shape (n,)
        The guess.
    scale : array, shape (n,)
        Scales of the unknowns.
    """
    r, J = evaluate(u)
    J, damping, growth = _scaled(J, scale), 0.0, 2.0
    for _ in range(LOOPS.evaluations):
        square = J @ J.T
        damping = damping or LOOPS.damping * float(np.max(square.diagonal()))
        try:
            h = -(J.T @ _solved(square, damping, r))
        except (RuntimeError, np.linalg.LinAlgError):  # J vanishes
            return u
        if not np.linalg.norm(h) > LOOPS.ends * np.linalg.norm(u / scale):
            return u
        new, slope = evaluate(u + scale * h)
        gain = float((r @ r - new @ new) / (h @ (damping * h - J.T @ r)))
        if gain > 0:
            u, r, J = u + scale * h, new, _scaled(slope, scale)
            damping *= max(1 / 3, 1 - (2 * gain - 1) ** 3)
            growth = 2.0
        else:
            damping *= growth
            growth *= 2
    return u


def _scaled(J: Matrix, scale: np.ndarray) -> Matrix:
    return J * scale if isinstance(J, np.ndarray) else (J @ scipy.sparse.diags(scale)).tocsc()


def _solved(square: Matrix, damping: float, r: np.ndarray) -> np.ndarray:
    if isinstance(square, np.ndarray):
        return np.linalg.solve(square + damping * np.eye(len(r)), r)
    return scipy.sparse.linalg.splu((square + damping * scipy.sparse.identity(len(r))).tocsc()).solve(r)
