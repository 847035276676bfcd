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
    stays, it = ("stays", "it") if len(names) == 1 else ("stay", "one of them")
    return [
        f"{', '.join(f'`{name}`' for name in names)} {stays} 0 in this run, but that is unstable at t = {at.time:g} s: a "
        f"disturbance would grow e-fold in {1 / rate:.3g} s. Do this: give {it} a small start value, or apply a force across, "
        "unless the motion shall stay as it is."
    ]


@memoized_latest(1)
def _growth(compiled: CompiledModel, numbers: bytes) -> Growth:
    sizes = (compiled.nx, compiled.nz, compiled.reduced.p.numel(), 1)
    x, z, p, t, constants = np.split(np.frombuffer(numbers), np.cumsum(sizes))
    call, (rows, columns, shape), names, derivative = _block(compiled)
    entries = call(x, z, p, float(t[0]), constants, 0.0)[0]
    if not np.all(np.isfinite(entries)):
        return Growth(0.0)
    J = scipy.sparse.csc_matrix((entries, (rows, columns)), shape=shape)
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


def growth_rate(J: scipy.sparse.csc_matrix, derivative: np.ndarray) -> tuple[float, np.ndarray]:
    """Return the largest growth rate of solutions of J v = 0, der(v[k]) = v[derivative[k]], and the shares of v in it.

    Parameters
    ----------
    J : sparse matrix, shape (m, n)
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
    still, lower = np.zeros(J.shape[1]), np.flatnonzero(derivative >= 0)
    upper = derivative[lower]
    J, size = _equilibrated(J)
    N = _solutions(J, lower)
    if N is None or not len(lower):
        return 0.0, still
    B, C = N[lower], N[upper] * (size[upper] / size[lower])[:, None]
    length = np.maximum(np.linalg.norm(B, axis=1), np.linalg.norm(C, axis=1))[:, None]
    V = _consistent(B := B / length, C := C / length)
    if not V.shape[1] or np.linalg.cond(B @ V) > 1 / RANK:
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


def _equilibrated(J: scipy.sparse.csc_matrix) -> tuple[scipy.sparse.csc_matrix, np.ndarray]:
    """Return a matrix with rows and columns of maximum about 1 (Ruiz 2001), and the factors of the columns."""
    rows, columns, size = J.indices, np.repeat(np.arange(J.shape[1]), np.diff(J.indptr)), np.ones(J.shape[1])
    entries = J.data.copy()
    for _ in range(POLICY.causes.balancing):
        for places, n in ((rows, J.shape[0]), (columns, J.shape[1])):
            most = np.zeros(n)
            np.maximum.at(most, places, np.abs(entries))
            factor = 1 / np.sqrt(np.where(most > 0, most, 1.0))
            entries *= factor[places]
            if places is columns:
                size *= factor
    return scipy.sparse.csc_matrix((entries, J.indices, J.indptr), shape=J.shape), size


def _solutions(J: scipy.sparse.csc_matrix, lower: np.ndarray) -> np.ndarray | None:
    """Return a basis of the solutions of J v = 0, as many as entries have a derivative; None if there are more.

    Highest derivatives and algebraic entries follow from the others, if no equation is a constraint on the others alone.
    """
    (m, n), highest = J.shape, np.setdiff1d(np.arange(J.shape[1]), lower)
    if m != len(highest):
        return None
    try:
        factors = scipy.sparse.linalg.splu(J[:, highest])
        pivots = np.abs(factors.U.diagonal())
    except RuntimeError:
        pivots = np.zeros(1)
    if np.min(pivots) > RANK * np.max(pivots):
        N = np.zeros((n, len(lower)))
        N[lower], N[highest] = np.eye(len(lower)), -factors.solve(J[:, lower].toarray())
        return N
    Q, R, _ = scipy.linalg.qr(J.toarray().T, pivoting=True)
    pivots = np.abs(np.diag(R))
    return Q[:, m:] if np.min(pivots) > RANK * np.max(pivots) else None


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
