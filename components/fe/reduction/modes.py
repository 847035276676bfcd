"""Modes of a body under conditions: one factorisation of its stiffness, and inverse iteration with it."""

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

# Freedoms up to which, or share of modes from which on, all modes are computed at once.
DENSE, SHARE = 600, 0.25
# A motion has no stiffness that has so many times what rounding leaves of the rigid ones, or less than the last digit of
# the largest eigenvalue. (Pieces on a hinge: 0.01 to 0.2 of that digit; a rod of aspect 2000: 20.)
NOTHING = 100.0
# Frequencies that differ by less are one, whose modes are any turned among themselves.
EQUAL = 1e-7
# Modes beyond those asked for, so that a pair of equal frequencies is complete before it is cut.
MORE = 2


class System:
    """Freedoms v of a body of which some are held, and some nodes move as rigid frames: u = expand @ v.

    Parameters
    ----------
    body : Solid
        The body.
    held : array of int
        Equations whose displacement is 0.
    frames : list of Frame
        Rigid ones; those whose nodes are all held do not count.

    Raises
    ------
    DeclarationError
        If two rigid frames, or a rigid frame and what is held, share a node.
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
                    f"rigid frame {frame.name!r} shares nodes with another rigid frame or with what is held"
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
        """Factors of the stiffness without as many freedoms as there are rigid motions, and the freedoms that are left."""
        from scipy.linalg import qr
        from scipy.sparse.linalg import splu

        kept = np.ones(len(self.rigid), dtype=bool)
        if self.rigid.shape[1]:
            _, pivots = qr(self.rigid.T, mode="r", pivoting=True)  # pyright: ignore
            kept[pivots[: self.rigid.shape[1]]] = False
        left = np.flatnonzero(kept)
        left = left[np.argsort(self._ranks()[self._nodes[left]], kind="stable")]
        reduced = self.stiffness[left][:, left].tocsc()
        # A definite matrix needs no pivots, and its pattern is symmetric.
        options = {"SymmetricMode": True}
        try:
            return splu(reduced, permc_spec="NATURAL", diag_pivot_thresh=0.0, options=options), left
        except RuntimeError:
            raise _mechanism() from None

    def _ranks(self) -> Array:
        """Rank of each node in the order of elimination; freedoms of rigid frames, which many nodes join, come last."""
        from scipy.sparse import csr_array

        count = len(self.body.nodes)
        own = self._nodes < count
        pattern = csr_array((np.ones(own.sum()), (np.flatnonzero(own), self._nodes[own])), shape=(len(own), count))
        ranks = np.full(count + 1, count)
        ranks[dissection(csr_array(pattern.T @ abs(self.stiffness) @ pattern), self.body.nodes)] = np.arange(count)
        return ranks

    def solve(self, forces: Array) -> Array:
        """Displacements under forces that are in balance, with the freedoms left out of the factors at rest."""
        factor, left = self._factor
        found = np.zeros_like(forces)
        found[left] = factor.solve(np.ascontiguousarray(forces[left]))
        return found

    @cached_property
    def nothing(self) -> float:
        """Eigenvalue in 1/s2 of a motion without stiffness, at most: rounding, also that of files with few digits."""
        stiffest = self.stiffness.diagonal().max() / self.mass.diagonal().mean()
        motions, body = self.body.rigid, self.body
        rigid = np.sum(motions * (body.stiffness @ motions), axis=0) / np.sum(motions * body.weigh(motions), axis=0)
        return max(np.finfo(float).eps * float(stiffest), NOTHING * float(np.abs(rigid).max()))


def _moves(frame: Frame, body: Solid) -> Array:
    """Displacements of the nodes of a rigid frame from its freedoms, shape (3 k, 3 + r)."""
    arms = (body.nodes[frame.nodes] - frame.place) / frame.radius
    turns = np.cross(frame.axes.T[None], arms[:, None, :]).transpose(0, 2, 1)
    return np.concatenate([np.broadcast_to(np.eye(3), (len(arms), 3, 3)), turns], axis=2).reshape(3 * len(arms), -1)


def _mechanism() -> DeclarationError:
    return DeclarationError(
        "more than six rigid motions: parts of the body move without stiffness beyond rounding, as pieces that only a hinge "
        "or a node joins"
    )


class Flexibility:
    """Inverse of the stiffness among motions that fulfil conditions: rows @ v = 0.

    The forces of the conditions, lambda, balance the load: x = G (b - rows' lambda) + R xi with the inverse G of the
    stiffness without six freedoms, rigid motions R, rows @ x = 0 and R' (b - rows' lambda) = 0.

    Parameters
    ----------
    system : System
        Freedoms and stiffness.
    rows : array, shape (k, freedoms)
        Independent conditions that leave no rigid motion free.
    """

    def __init__(self, system: System, rows: Array) -> None:
        size = np.linalg.norm(rows, axis=1, keepdims=True)
        self.system, self.rows = system, rows / np.where(size > 0, size, 1.0)
        self.answers = system.solve(np.ascontiguousarray(self.rows.T))
        soft, self._held = self.rows @ self.answers, self.rows @ system.rigid
        k, d = self._held.shape
        # Displacements and forces in one size.
        self._scale = np.abs(np.diag(soft)).mean() if k else 1.0
        self._saddle = np.zeros((k + d, k + d))
        self._saddle[:k, :k], self._saddle[:k, k:], self._saddle[k:, :k] = soft / self._scale, -self._held, self._held.T

    def apply(self, forces: Array) -> Array:
        """Displacements under forces, shape (freedoms,) or (freedoms, k)."""
        system, k = self.system, len(self.rows)
        if not self._saddle.size:
            return system.solve(forces)
        known = np.concatenate([self.answers.T @ forces / self._scale, system.rigid.T @ forces])
        found = np.linalg.solve(self._saddle, known)
        return system.solve(forces - self.rows.T @ found[:k]) + system.rigid @ (found[k:] * self._scale)

    def relative(self, shapes: Array) -> Array:
        """Shapes that fulfil the conditions to the last digit, where these say no more than what a rigid motion is."""
        if self._held.shape[0] != self._held.shape[1]:
            return shapes
        return shapes - self.system.rigid @ np.linalg.solve(self._held, self.rows @ shapes)

    def static(self, values: Array) -> Array:
        """Displacements without load where rows @ x = values, shape (k, any), for the rows as they were given in size 1."""
        k = len(self.rows)
        known = np.zeros((len(self._saddle), values.shape[1]))
        known[:k] = -values / self._scale
        found = np.linalg.solve(self._saddle, known)
        return -self.answers @ found[:k] + self.system.rigid @ (found[k:] * self._scale)


def orthogonal(system: System, shapes: Array) -> tuple[Array, Array]:
    """Combinations of shapes that are orthonormal in mass and orthogonal in stiffness, and their eigenvalues in 1/s2.

    Shapes that depend on the others, or have no mass, drop out.
    """
    from scipy.linalg import eigh

    basis = shapes
    for _ in range(2):  # the first leaves the rounding of shapes that are nearly dependent
        mass = basis.T @ (system.mass @ basis)
        size = np.sqrt(np.maximum(np.diag(mass), np.finfo(float).tiny))
        values, mix = eigh(mass / np.outer(size, size))
        keep = values > 1e-12 * len(values)
        basis = basis / size @ (mix[:, keep] / np.sqrt(values[keep]))
    squares, turned = eigh(basis.T @ (system.stiffness @ basis))
    return _settled(system, basis @ turned, squares), squares


def _settled(system: System, shapes: Array, squares: Array) -> Array:
    """Modes of one sign, and of equal frequencies those along the axes: the same in every run, with the fewest terms."""
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
    # Among entries that differ by rounding alone the first decides.
    top = np.argmax(np.abs(moved) > (1 - 1e-6) * np.abs(moved).max(axis=0), axis=0)
    return shapes * np.sign(moved[top, range(len(squares))])


def lowest(flexibility: Flexibility, count: int) -> tuple[Array, Array]:
    """The modes of lowest frequency, and their eigenvalues in 1/s2, lowest first; fewer where there are no more.

    Parameters
    ----------
    flexibility : Flexibility
        Stiffness and conditions.
    count : int
        How many are wanted; some more may be returned.

    Raises
    ------
    DeclarationError
        If a motion has no stiffness, or a negative one.
    """
    system, count = flexibility.system, count + MORE
    size = system.stiffness.shape[0]
    found = _all(flexibility, count) if size <= DENSE or count > SHARE * size else _some(flexibility, count)
    # Once more, so that what has no mass, and what rounding left of the conditions, is gone.
    shapes, squares = orthogonal(system, flexibility.relative(flexibility.apply(system.mass @ found)))
    if len(squares) and squares[0] < system.nothing:
        if squares[0] > -system.nothing:
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
    # In the range of the operator, and the same in every run.
    start = flexibility.apply(system.mass @ np.random.default_rng(0).normal(size=shape[0]))
    inverse = LinearOperator(shape, matvec=flexibility.apply, dtype=float)  # pyright: ignore
    try:
        return eigsh(system.stiffness, count, M=system.mass, sigma=0.0, OPinv=inverse, v0=start, tol=1e-12)[1]  # pyright: ignore
    except ArpackNoConvergence as error:
        raise DeclarationError(f"only {len(error.eigenvalues)} of {count} modes were found; ask for fewer") from None
