"""Growth across: whether a disturbance of unknowns that stay 0 would grow.

Their equations depend on them alone to first order, so that their linear system at the start tells. With derivatives as
unknowns of their own it is J v = 0 and der(v[k]) = v[up[k]]. On a basis N of the null space of J, v = N y, this is the
pencil B der(y) = C y. If B is singular, as with closures of loops, Wong sequences deflate it: V = {v in V: C v in B V}
until V stays (Berger, Ilchmann & Trenn 2012).
"""

from __future__ import annotations

from typing import NamedTuple

import casadi as ca
import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.compiler.call import Call
from acausal.compiler.memo import memoized, memoized_latest
from acausal.policy import POLICY
from acausal.solve.point import Point
from acausal.solve.problem import Problem

REST, RANK = POLICY.rest, POLICY.ranks.rank
NAMED = 3  # unknowns in the message


class Growth(NamedTuple):
    """Largest growth rate in 1/s, 0 for none, and the unknowns that grow most."""

    rate: float
    names: tuple[str, ...] = ()


def growth_warnings(problem: Problem, at: Point, span: float) -> list[str]:
    """Return a warning if unknowns that stay 0 would grow by more than e in a run.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        The start.
    span : float
        Length of the run in s.
    """
    if problem.compiled.reduced.flat.zero_block is None:
        return []
    numbers = np.concatenate([at.x, at.z, problem.p, [at.time], at.constants.vector])
    rate, names = _growth(problem.compiled, numbers.tobytes())
    if rate * span <= 1:
        return []
    stays = "stays" if len(names) == 1 else "stay"
    return [
        f"{', '.join(f'`{name}`' for name in names)} {stays} 0 in this run, but the motion is unstable at t = {at.time:g} s: a "
        f"disturbance across grows e-fold in {1 / rate:.3g} s. Do this: give a small start value or a force across, if the "
        "machine may leave its plane."
    ]


@memoized_latest(1)
def _growth(compiled: CompiledModel, numbers: bytes) -> Growth:
    sizes = (compiled.nx, compiled.nz, compiled.reduced.p.numel(), 1)
    x, z, p, t, constants = np.split(np.frombuffer(numbers), np.cumsum(sizes))
    call, (rows, columns, shape), names, derivative = _block(compiled)
    entries = call(x, z, p, float(t[0]), constants, 0.0)[0]
    if not np.all(np.isfinite(entries)):
        return Growth(0.0)
    J = np.zeros(shape)
    J[rows, columns] = entries
    rate, shares = growth_rate(J, derivative)
    lowest = np.setdiff1d(np.flatnonzero(derivative >= 0), derivative)
    largest = lowest[np.argsort(-shares[lowest])][:NAMED]
    return Growth(rate, tuple(names[k] for k in largest if shares[k] >= REST.push * shares[largest[0]]))


@memoized
def _block(compiled: CompiledModel) -> tuple[Call, tuple, tuple[str, ...], np.ndarray]:
    """Return the Jacobian of the equations by their unknowns, its pattern, names, and places of derivatives."""
    form = compiled.reduced.flat.zero_block
    assert form is not None
    block = form()
    J = compiled.reduced.running.resolve(ca.jacobian(block.residuals, block.symbols))
    rows, columns = (np.array(k, dtype=int) for k in J.sparsity().get_triplet())
    entries = Call(ca.Function("zero_block", compiled.arguments, [J]))
    return entries, (rows, columns, J.shape), block.names, np.array(block.derivative)


def growth_rate(J: np.ndarray, derivative: np.ndarray) -> tuple[float, np.ndarray]:
    """Return the largest growth rate of solutions of J v = 0, der(v[k]) = v[derivative[k]], and the shares of v in it.

    Parameters
    ----------
    J : array, shape (m, n)
        Equations.
    derivative : array of int, shape (n,)
        Place of the derivative of each entry of v, or -1.

    Returns
    -------
    float
        In 1/s; 0 if none grows, or if the equations do not determine the motion.
    array, shape (n,)
        Relative to the typical sizes that the equations themselves give.
    """
    n, still = J.shape[1], np.zeros(J.shape[1])
    lower = np.flatnonzero(derivative >= 0)
    upper = derivative[lower]
    J, size = _equilibrated(J)
    Q, R, _ = scipy.linalg.qr(J.T, pivoting=True)
    rank = int(np.sum(np.abs(np.diag(R)) > RANK * abs(R[0, 0]))) if J.size else 0
    if rank < len(J) or n - rank != len(lower):
        return 0.0, still
    N = Q[:, rank:]
    B, C = N[lower], N[upper] * (size[upper] / size[lower])[:, None]
    length = np.maximum(np.linalg.norm(B, axis=1), np.linalg.norm(C, axis=1))[:, None]
    V = _consistent(B := B / length, C := C / length)
    if not V.shape[1]:
        return 0.0, still
    A = np.linalg.solve(B, C) if V.shape[1] == len(B) else np.linalg.lstsq(B @ V, C @ V, rcond=None)[0]
    values = np.linalg.eigvals(A)
    # Double zero eigenvalues, of free motions, split by the square root of round-off.
    floor = REST.split * np.sqrt(np.finfo(float).eps) * np.max(np.abs(values))
    rates = np.where(np.real(values) > np.maximum(floor, REST.grows * np.abs(values)), np.real(values), 0.0)
    k = int(np.argmax(rates))
    if rates[k] == 0:
        return 0.0, still
    values, vectors = np.linalg.eig(A)
    return float(rates[k]), np.abs(N @ (V @ vectors[:, int(np.argmax(np.real(values)))]))


def _equilibrated(J: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return a matrix with rows and columns of maximum about 1 (Ruiz 2001), and the factors of the columns."""
    size = np.ones(J.shape[1])
    for _ in range(POLICY.causes.balancing):
        for axis in (1, 0):
            most = np.sqrt(np.max(np.abs(J), axis=axis, keepdims=True, initial=0.0))
            factor = 1 / np.where(most > 0, most, 1.0)
            J = J * factor
            if axis == 0:
                size *= factor[0]
    return J, size


def _consistent(B: np.ndarray, C: np.ndarray) -> np.ndarray:
    """Return a basis of the consistent values of a pencil B der(y) = C y."""
    V = np.eye(B.shape[1])
    while V.shape[1]:
        Q, R, _ = scipy.linalg.qr(B @ V, mode="economic", pivoting=True)
        Q = Q[:, np.abs(np.diag(R)) > RANK * abs(R[0, 0])]
        if Q.shape[1] == len(B):
            break
        CV = C @ V
        _, s, W = np.linalg.svd(CV - Q @ (Q.T @ CV))
        kept = W[int(np.sum(s > RANK * max(1.0, np.max(np.abs(CV))))) :].T
        if kept.shape[1] == V.shape[1]:
            break
        V = V @ kept
    return V
