"""Residuals and Jacobian of constraints at several levels of differentiation, such as positions and velocities of loops."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import casadi as ca
import numpy as np
import scipy

from acausal.compiler.call import Call
from acausal.compiler.linearization import with_entries
from acausal.compiler.rounding import terms
from acausal.compiler.vectorized import vectorized
from acausal.language.functions import time
from acausal.reduce import ReducedModel
from acausal.symbols import scalars, stacked


class Constraints:
    """Residuals and Jacobian of the constraints by the states, and the layout of the projection.

    Parameters
    ----------
    reduced : ReducedModel
        The model.

    Attributes
    ----------
    rows : list of tuple of int
        Positions of the residuals of each constraint, lowest level first.
    multipliers : array of int
        Position of the multiplier of each residual among the algebraic unknowns.
    lowest : array of int
        Position of the residual of each constraint at its lowest level.
    is_lowest : array of bool
        Whether a residual is at the lowest level of its constraint.
    closures : list of int
        Constraint of each closure.
    of_loops : list of int
        Constraints that close loops.
    kinds : array of int
        Number of the vector equation, and its time derivative, to which a residual belongs.
    places : list of int
        State of each projected coordinate.
    coordinates : Call
        Function of x, z, p, time and constants: the projected coordinates on the constraints.
    entries : array of int, shape (2, n)
        Residual and state of each entry of D.
    kept : array of int, shape (2, n)
        Projected coordinates among the algebraic unknowns, and the states from which they are projected.
    pattern : csc_matrix, shape (size, nx)
        Sparsity pattern of the Jacobian, with all entries 0.
    """

    def __init__(self, reduced: ReducedModel) -> None:
        constrained, plan = reduced.plan.constrained, reduced.plan
        states = {v: k for k, v in enumerate(plan.states)}
        algebraic = {v: k for k, v in enumerate(plan.algebraic)}
        multipliers = [m for c in constrained.constraints for m in c.multipliers]
        residual = {m: k for k, m in enumerate(multipliers)}
        self.rows = [tuple(residual[m] for m in c.multipliers) for c in constrained.constraints]
        self.multipliers = np.array([algebraic[m] for m in multipliers], dtype=int)
        self.lowest = np.array([own[0] for own in self.rows], dtype=int)
        place = {c.base: k for k, c in enumerate(constrained.constraints)}
        # Without projections there are no constraints here: the loop closures stay equations of the DAE.
        self.closures = [place[c.row] for c in reduced.flat.loops.closures if place]
        self.of_loops = [k for k, c in zip(self.closures, reduced.flat.loops.closures, strict=False) if c.loop >= 0]
        statements = {place[c.row]: c.statement for c in reduced.flat.loops.closures if place}
        kinds = [(statements.get(k, -1 - k), level) for k, rows in enumerate(self.rows) for level in range(len(rows))]
        self.kinds = np.unique(np.array(kinds).reshape(-1, 2), axis=0, return_inverse=True)[1].ravel()
        pairs = [(residual[m], states[p.state]) for p in constrained.projections for m in p.multipliers]
        self.entries = np.array(pairs, dtype=int).reshape(-1, 2).T
        self.size = len(multipliers)
        self.is_lowest = np.isin(np.arange(self.size), self.lowest)
        self.states = np.array(sorted({k for _, k in pairs}), dtype=int)
        self._reduced = reduced
        column = reduced.running.constraints
        r = reduced
        arguments = [r.x, r.p, time.sx, r.constants]
        J = ca.jacobian(column, r.x)
        pattern = [np.array(k, dtype=np.int32) for k in (J.sparsity().row(), J.sparsity().colind())]
        self.pattern = scipy.sparse.csc_matrix((np.zeros(J.nnz()), *pattern), shape=J.shape)
        nonzero = dict(zip(zip(*J.sparsity().get_triplet(), strict=True), scalars(J.nz[:]), strict=True))
        held = stacked([nonzero.get(pair, ca.SX(0)) for pair in pairs])
        self._held = ca.Function("held", arguments, [ca.densify(held)])
        self.function = ca.Function("constraints", arguments, [ca.densify(column), J])
        self._call = Call(self.function)
        coordinates = r.resolve(r.projections.coordinates)
        self.coordinates = Call(ca.Function("coordinates", [r.x, r.z, *arguments[1:]], [ca.densify(coordinates)]))
        found = [(algebraic[v], k) for k, (v, _) in enumerate(constrained.following) if v in algebraic]
        self._follows = np.array([place for place, _ in found], dtype=int)
        following = stacked([r.running.following[k] for _, k in found])
        self._following = Call(ca.Function("following", arguments, [ca.densify(following)]))
        same = [
            (algebraic[q.coordinate], states[q.state]) for q in constrained.projections if q.coordinate in algebraic
        ]
        self.kept = np.array(same, dtype=int).reshape(-1, 2).T
        self.places = [states[p.state] for p in constrained.projections]

    def __call__(
        self, x: np.ndarray, p: np.ndarray, t: float, constants: np.ndarray
    ) -> tuple[np.ndarray, scipy.sparse.csc_matrix]:
        """Return residuals, shape (size,), and their Jacobian by the states, shape (size, nx)."""
        value, entries = self.values(x, p, t, constants)
        return value, with_entries(self.pattern, entries)

    def values(self, x: np.ndarray, p: np.ndarray, t: float, constants: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return residuals, and the entries of their Jacobian in the order of `pattern`."""
        value, entries = self._call(x, p, t, constants)
        return value.copy(), entries.copy()

    def terms(self, x: np.ndarray, p: np.ndarray, t: float, constants: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return round-off scales of the results of `values`, see `rounding.terms`."""
        value, entries = self._terms(x, p, t, constants)
        return value.copy(), entries.copy()

    @cached_property
    def _terms(self) -> Call:
        r = self._reduced
        arguments = [r.x, r.p, time.sx, r.constants]
        value, J = self.function.call(arguments)
        sizes = [terms(arguments, column) for column in (value, stacked(scalars(J.nz[:])))]
        return Call(ca.Function("terms", arguments, sizes))

    def held(self, x: np.ndarray, p: np.ndarray, t: np.ndarray, constants: np.ndarray) -> np.ndarray:
        """Return the Jacobian of each constraint by the coordinates of its own level, in the order of `entries`, at n points.

        Parameters
        ----------
        x : array, shape (n, nx)
            States.
        p, constants : arrays
            Parameters and constants of the segment.
        t : array, shape (n,)
            Times.

        Returns
        -------
        array, shape (n, entries)
        """
        return self._many(x, p, t[:, None], constants)

    @cached_property
    def _many(self) -> Callable[..., np.ndarray]:
        return vectorized(self._held)

    def counting(self, closures: np.ndarray) -> np.ndarray:
        """Return which residuals are independent, from the flags of the closures, see `Constants`."""
        counts = np.ones(self.size, dtype=bool)
        for constraint, closure in zip(self.closures, closures, strict=True):
            counts[list(self.rows[constraint])] = closure > 0
        return counts

    def project(self, x: np.ndarray, z: np.ndarray, p: np.ndarray, t: float, constants: np.ndarray) -> np.ndarray:
        """Return the states with all projected coordinates on the constraints."""
        projected = x.copy()
        if self.size:
            projected[self.places] = self.coordinates(x, z, p, t, constants)[0]
        return projected

    def complete(self, x: np.ndarray, z: np.ndarray, p: np.ndarray, t: float, constants: np.ndarray) -> np.ndarray:
        """Return the algebraic unknowns with those that follow explicitly from the states updated."""
        z = z.copy()
        z[self._follows] = self._following(x, p, t, constants)[0]
        z[self.kept[0]] = x[self.kept[1]]
        return z
