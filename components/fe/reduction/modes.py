"""Modes of a constrained body, by inverse iteration with one factorisation of its stiffness."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array
from components.fe.reduction.nested_dissection import dissection
from components.fe.reduction.node_frames import Frame
from components.fe.reduction.reference_frame import null_space
from components.fe.reduction.solid import Solid

# All modes are computed by a dense solver up to this number of degrees of freedom, or from this share of modes on:
# sparse iteration saves no time there.
DENSE, SHARE = 600, 0.25
# Largest eigenvalue of a mechanism, relative to the round-off in the eigenvalues of rigid-body motions. One below the
# last digit of the largest eigenvalue counts as 0, too: hinged pieces have 0.01 to 0.2 of that digit, a rod of aspect
# ratio 2000 has 20.
ZERO_STIFFNESS = 100.0
# Relative difference of frequencies that count as equal: their modes are any basis of a common subspace.
EQUAL = 1e-7
# Modes computed in excess, so that a pair of equal frequencies is complete before it is truncated.
MORE = 2


class System:
    """Degrees of freedom v of a body with fixed equations and rigid frames: u = expand @ v.

    Parameters
    ----------
    body : Solid
        The body.
    held : array of int
        Equations whose displacement is 0.
    frames : list of Frame
        Rigid frames; those whose nodes are all fixed are ignored.

    Raises
    ------
    DeclarationError
        If two rigid frames, or a rigid frame and the fixed equations, share a node.
    """

    def __init__(self, body: Solid, held: Array, frames: list[Frame]) -> None:
        from scipy.sparse import coo_array, csr_array, eye_array, hstack, kron, vstack

        self.body, count = body, 3 * len(body.nodes)
        alone = ~np.repeat(body.empty, 3)
        alone[held] = False
        stiff = [frame for frame in frames if not np.isin(frame.equations, held).all()]
        for frame in stiff:
            if not alone[frame.equations].all():
                raise DeclarationError(
                    f"rigid frame {frame.name!r} shares nodes with another rigid frame or with `hold`"
                )
            alone[frame.equations] = False
        own = csr_array(eye_array(count))[np.flatnonzero(alone)]
        expand, contract = [own.T], [own]
        for frame in stiff:
            rows, columns = (
                np.repeat(frame.equations, len(frame.freedoms)),
                np.tile(np.arange(len(frame.freedoms)), 3 * len(frame.nodes)),
            )
            moves = _moves(frame, body)
            expand.append(coo_array((moves.ravel(), (rows, columns)), shape=(count, moves.shape[1])))
            contract.append(coo_array((frame.freedoms.T.ravel(), (columns, rows)), shape=(moves.shape[1], count)))
        self._nodes = np.concatenate(
            [np.flatnonzero(alone) // 3, np.full(sum(len(f.freedoms) for f in stiff), len(body.nodes))]
        )
        self.expand: Any = csr_array(hstack(expand))
        self.contract: Any = csr_array(vstack(contract))
        self.stiffness: Any = csr_array(self.expand.T @ body.stiffness @ self.expand)
        self.mass: Any = csr_array(self.expand.T @ kron(body.mass, np.eye(3), format="csr") @ self.expand)
        free = null_space(body.rigid[held]) if len(held) else np.eye(6)
        self.rigid = self.contract @ (body.rigid @ free)

    @cached_property
    def _factor(self) -> tuple[Any, Array]:
        """Factors of the stiffness with a degree of freedom fixed for each rigid-body motion, and the free ones."""
        from scipy.linalg import qr
        from scipy.sparse.linalg import splu

        kept = np.ones(len(self.rigid), dtype=bool)
        if self.rigid.shape[1]:
            _, pivots = qr(self.rigid.T, mode="r", pivoting=True)  # pyright: ignore
            kept[pivots[: self.rigid.shape[1]]] = False
        left = np.flatnonzero(kept)
        left = left[np.argsort(self._ranks()[self._nodes[left]], kind="stable")]
        reduced = self.stiffness[left][:, left].tocsc()
        # A definite matrix needs no pivoting, and its pattern is symmetric.
        options = {"SymmetricMode": True}
        try:
            return splu(reduced, permc_spec="NATURAL", diag_pivot_thresh=0.0, options=options), left
        except RuntimeError:
            raise _mechanism() from None

    def _ranks(self) -> Array:
        """Return the elimination rank of each node; rigid frames, which are coupled to many nodes, come last."""
        from scipy.sparse import csr_array

        count = len(self.body.nodes)
        own = self._nodes < count
        pattern = csr_array((np.ones(own.sum()), (np.flatnonzero(own), self._nodes[own])), shape=(len(own), count))
        ranks = np.full(count + 1, count)
        ranks[dissection(csr_array(pattern.T @ abs(self.stiffness) @ pattern), self.body.nodes)] = np.arange(count)
        return ranks

    def solve(self, forces: Array) -> Array:
        """Solve for displacements under forces in equilibrium, with the degrees of freedom of `_factor` fixed."""
        factor, left = self._factor
        found = np.zeros_like(forces)
        found[left] = factor.solve(np.ascontiguousarray(forces[left]))
        return found

    @cached_property
    def zero(self) -> float:
        """Largest eigenvalue in 1/s2 that counts as 0: round-off of arithmetic and of files with few digits."""
        stiffest = self.stiffness.diagonal().max() / self.mass.diagonal().mean()
        motions, body = self.body.rigid, self.body
        rigid = np.sum(motions * (body.stiffness @ motions), axis=0) / np.sum(motions * body.weigh(motions), axis=0)
        return max(np.finfo(float).eps * float(stiffest), ZERO_STIFFNESS * float(np.abs(rigid).max()))


def _moves(frame: Frame, body: Solid) -> Array:
    """Return the displacements of the nodes of a rigid frame by its degrees of freedom, shape (3 k, 3 + r)."""
    arms = (body.nodes[frame.nodes] - frame.place) / frame.radius
    turns = np.cross(frame.axes.T[None], arms[:, None, :]).transpose(0, 2, 1)
    return np.concatenate([np.broadcast_to(np.eye(3), (len(arms), 3, 3)), turns], axis=2).reshape(3 * len(arms), -1)


def _mechanism() -> DeclarationError:
    return DeclarationError(
        "more than six rigid-body motions: parts of the body move without stiffness beyond round-off, such as pieces that "
        "are joined by a hinge or a single node"
    )


class Flexibility:
    """Inverse of the stiffness under the constraints rows @ x = 0.

    The constraint forces lambda balance the load b: x = G (b - rows' lambda) + R xi, with the inverse G of the
    stiffness with six degrees of freedom fixed, the rigid-body motions R, rows @ x = 0 and R' (b - rows' lambda) = 0.

    Parameters
    ----------
    system : System
        Degrees of freedom and stiffness.
    rows : array, shape (k, freedoms)
        Independent constraints that leave no rigid-body motion free.
    """

    def __init__(self, system: System, rows: Array) -> None:
        size = np.linalg.norm(rows, axis=1, keepdims=True)
        self.system, self.rows = system, rows / np.where(size > 0, size, 1.0)
        self.responses = system.solve(np.ascontiguousarray(self.rows.T))
        soft, self._held = self.rows @ self.responses, self.rows @ system.rigid
        k, d = self._held.shape
        # Scale displacements to the size of forces.
        self._scale = np.abs(np.diag(soft)).mean() if k else 1.0
        self._saddle = np.zeros((k + d, k + d))
        self._saddle[:k, :k], self._saddle[:k, k:], self._saddle[k:, :k] = soft / self._scale, -self._held, self._held.T

    def apply(self, forces: Array) -> Array:
        """Return the displacements under forces, shape (freedoms,) or (freedoms, k)."""
        system, k = self.system, len(self.rows)
        if not self._saddle.size:
            return system.solve(forces)
        known = np.concatenate([self.responses.T @ forces / self._scale, system.rigid.T @ forces])
        found = np.linalg.solve(self._saddle, known)
        return system.solve(forces - self.rows.T @ found[:k]) + system.rigid @ (found[k:] * self._scale)

    def relative(self, shapes: Array) -> Array:
        """Subtract rigid motions so that shapes satisfy six constraints to round-off; other numbers change nothing."""
        if self._held.shape[0] != self._held.shape[1]:
            return shapes
        return shapes - self.system.rigid @ np.linalg.solve(self._held, self.rows @ shapes)

    def static(self, values: Array) -> Array:
        """Return the displacements of the unloaded body for values of the unit rows, shape (k, any)."""
        k = len(self.rows)
        known = np.zeros((len(self._saddle), values.shape[1]))
        known[:k] = -values / self._scale
        found = np.linalg.solve(self._saddle, known)
        return -self.responses @ found[:k] + self.system.rigid @ (found[k:] * self._scale)


def orthogonal(system: System, shapes: Array) -> tuple[Array, Array]:
    """Rayleigh-Ritz: mass-orthonormal, stiffness-orthogonal combinations of shapes, and eigenvalues in 1/s2.

    Linearly dependent and massless shapes are dropped.
    """
    from scipy.linalg import eigh

    basis = shapes
    for _ in range(2):  # once more, as nearly dependent shapes leave round-off
        mass = basis.T @ (system.mass @ basis)
        size = np.sqrt(np.maximum(np.diag(mass), np.finfo(float).tiny))
        values, mix = eigh(mass / np.outer(size, size))
        keep = values > 1e-12 * len(values)
        basis = basis / size @ (mix[:, keep] / np.sqrt(values[keep]))
    squares, turned = eigh(basis.T @ (system.stiffness @ basis))
    return _settled(system, basis @ turned, squares), squares


def _settled(system: System, shapes: Array, squares: Array) -> Array:
    """Make modes reproducible: fix their sign, and align modes of equal frequency with the axes."""
    moved, first = system.expand @ shapes, 0
    for k in range(1, len(squares) + 1):
        if k == len(squares) or squares[k] > squares[first] * (1 + 2 * EQUAL):
            if k - first > 1:
                group = moved[:, first:k]
                weights = np.tile([1.0, 2.0, 3.0], len(system.body.nodes))[:, None]
                form = group.T @ (weights * system.body.weigh(group))
                turned = np.linalg.eigh((form + form.T) / 2)[1]
                shapes[:, first:k], moved[:, first:k] = shapes[:, first:k] @ turned, group @ turned
            first = k
    # The first of the entries that are equal up to round-off determines the sign.
    top = np.argmax(np.abs(moved) > (1 - 1e-6) * np.abs(moved).max(axis=0), axis=0)
    return shapes * np.sign(moved[top, range(len(squares))])


def lowest(flexibility: Flexibility, count: int) -> tuple[Array, Array]:
    """Compute the modes of lowest frequency and their eigenvalues in 1/s2, in ascending order.

    Parameters
    ----------
    flexibility : Flexibility
        Stiffness and constraints.
    count : int
        Number of modes requested; a few more, or fewer if there are no more, are returned.

    Raises
    ------
    DeclarationError
        If a motion has zero or negative stiffness.
    """
    system, count = flexibility.system, count + MORE
    size = system.stiffness.shape[0]
    found = _all(flexibility, count) if size <= DENSE or count > SHARE * size else _some(flexibility, count)
    # One more inverse iteration removes massless shapes and round-off in the constraints.
    shapes, squares = orthogonal(system, flexibility.relative(flexibility.apply(system.mass @ found)))
    if len(squares) and squares[0] < system.zero:
        if squares[0] > -system.zero:
            raise _mechanism()
        raise DeclarationError(f"the stiffness matrix is indefinite: a mode has omega^2 = {squares[0]:.3g} 1/s2")
    return shapes, squares


def _all(flexibility: Flexibility, count: int) -> Array:
    from scipy.linalg import eigh

    system = flexibility.system
    inverse = flexibility.apply(np.eye(system.stiffness.shape[0]))
    values, vectors = eigh((inverse + inverse.T) / 2)
    rounding = len(values) * np.finfo(float).eps
    keep = values > rounding * values[-1]
    halves = vectors[:, keep] * np.sqrt(values[keep])
    values, vectors = eigh(halves.T @ (system.mass @ halves))
    finite = np.flatnonzero(values > rounding * values[-1])[::-1][:count]
    return halves @ (vectors[:, finite] / np.sqrt(values[finite]))


def _some(flexibility: Flexibility, count: int) -> Array:
    from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigsh

    system = flexibility.system
    shape = system.stiffness.shape
    # Start vector in the range of the operator, the same in every run.
    start = flexibility.apply(system.mass @ np.random.default_rng(0).normal(size=shape[0]))
    inverse = LinearOperator(shape, matvec=flexibility.apply, dtype=float)  # pyright: ignore
    try:
        return eigsh(system.stiffness, count, M=system.mass, sigma=0.0, OPinv=inverse, v0=start, tol=1e-12)[1]  # pyright: ignore
    except ArpackNoConvergence as error:
        raise DeclarationError(f"only {len(error.eigenvalues)} of {count} modes converged; request fewer") from None
