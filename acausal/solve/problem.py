"""A model with parameter values: its functions at points of a run."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.compiler.core_equations import core_motion, core_square
from acausal.compiler.full_residuals import full_residuals
from acausal.compiler.linearization import PointLinearization, with_entries
from acausal.compiler.memo import memoized
from acausal.compiler.vectorized import Vectorized
from acausal.core import Settler
from acausal.policy import POLICY
from acausal.solve.coordinate_scaling import loop_scales
from acausal.solve.point import Point, Rows


@dataclass(frozen=True, eq=False)
class Problem:
    """A compiled model with the values of its parameters.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    p : array
        Values of its free parameters.
    feedback : float
        Decay rate of errors of invariants, in 1/s.
    runs : bool
        Whether the model is integrated, so that the core has the equations of the algebraic unknowns anyway.
    """

    compiled: CompiledModel
    p: np.ndarray
    feedback: float = 1.0
    runs: bool = False

    @property
    def nx(self) -> int:
        """Number of states."""
        return self.compiled.nx

    @property
    def nz(self) -> int:
        """Number of algebraic unknowns."""
        return self.compiled.nz

    @property
    def nominal(self) -> np.ndarray:
        """Nominal values of states and algebraic unknowns."""
        return self.compiled.nominal

    @property
    def loop_scales(self) -> np.ndarray:
        """Scales of the states in closed loops, see `coordinate_scaling`."""
        return loop_scales(self.compiled, self.p)

    @property
    def rates(self) -> list[tuple[int, int]]:
        """Pairs (coordinate, rate) among the states."""
        return rates_of(self.compiled)

    def values(self, at: Point, flag: float = 0.0) -> np.ndarray:
        """Return ode, alg and conditions; `flag` is 1 for the initial system. The next call overwrites the array."""
        return self.compiled.values(at.x, at.z, self.p, at.time, at.constants.vector, flag)[0]

    def local(self, at: Point, flag: float = 0.0) -> PointLinearization:
        """Return `values` with their Jacobian by states and algebraic unknowns."""
        return self.compiled.at(at.x, at.z, self.p, at.time, at.constants.vector, flag)

    def unknowns(self, at: Point, flag: float = 0.0) -> np.ndarray:
        """Return all unknowns of the model, including those that are solved explicitly."""
        return full_residuals(self.compiled).unknowns(at.x, at.z, self.p, at.time, at.constants.vector, flag)[0].copy()

    def constraints(self, at: Point) -> tuple[np.ndarray, scipy.sparse.csc_matrix]:
        """Return the residuals of the constraints and their Jacobian by the states."""
        return self.compiled.constraints(at.x, self.p, at.time, at.constants.vector)

    def scaled_gradients(self, at: Point) -> scipy.sparse.csc_matrix:
        """Return the Jacobian of the constraints by the scaled states.

        Rows at round-off level, relative to other rows of their equation or to their own terms, are 0.
        """
        J = by_columns(self.constraints(at)[1], self.loop_scales)
        length = lengths(J)
        largest = self._largest_of_equation(length)
        faint = (largest > 0) & (largest <= POLICY.ranks.faint * max(1.0, np.max(length, initial=0.0)))
        if faint.any():
            entries = with_entries(self.compiled.constraints.pattern, self._terms(at)[1])
            adds_up = self._largest_of_equation(lengths(by_columns(entries, self.loop_scales)))
            largest = np.where(faint, np.maximum(largest, adds_up), largest)
        J.data[(length <= POLICY.ranks.rank * largest)[J.indices]] = 0.0
        return J

    def _terms(self, at: Point) -> tuple[np.ndarray, np.ndarray]:
        """Size of the terms of the residuals of the constraints, and of the entries of their Jacobian."""
        return self.compiled.constraints.terms(at.x, self.p, at.time, at.constants.vector)

    def scaled_entries(self, x: np.ndarray, times: np.ndarray, constants: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return Jacobians of the constraints by the scaled states, at n points, and the scales.

        Parameters
        ----------
        x, times : arrays, shapes (n, nx), (n,)
            States, and times in s.
        constants : array
            Those of the segment, or of each point.

        Returns
        -------
        J : array, shape (n, entries)
            In the order of `Constraints.entries`.
        sizes : array, shape (entries,)
        """
        c = self.compiled.constraints
        sizes = self.loop_scales[c.entries[1]]
        return c.held(x, self.p, times, constants) * sizes, sizes

    def closure_errors(self, at: Point) -> np.ndarray:
        """Return the residuals of the constraints, relative to their changes with the scales of the states.

        Entries of one equation have a common scale, because at a dead centre one of them has no gradient. Residuals that no
        state changes, such as those of parts welded to a loop, are relative to their terms.
        """
        return self.constraints(at)[0] / self.residual_scales(at)

    def residual_scales(self, at: Point) -> np.ndarray:
        """Return the scale of each residual of the constraints, see `closure_errors`."""
        return self.residual_scales_and_rigid(at)[0]

    def residual_scales_and_rigid(self, at: Point) -> tuple[np.ndarray, np.ndarray]:
        """Return the scales of the residuals, and which of them no state changes by more than round-off."""
        own, c = lengths(self.scaled_gradients(at)), self.compiled.constraints
        forces = [row for k, rows in enumerate(c.rows) if k not in c.of_loops for row in rows]
        if forces:
            # Where the direction of a force is undefined its gradient is very large, but not next to that point.
            away = np.random.default_rng(0).standard_normal(self.nx) * self.loop_scales
            beside = self.scaled_gradients(replace(at, x=at.x + POLICY.ranks.away * away))[forces]
            own[forces] = np.minimum(own[forces], np.nan_to_num(lengths(beside)))
        sizes = self._largest_of_equation(own)
        rigid = sizes == 0
        if np.any(self.constraints(at)[0][rigid]):
            sizes = np.where(rigid, self._largest_of_equation(self._terms(at)[0]), sizes)
        return np.where(sizes > 0, sizes, np.max(sizes, initial=0.0) or 1.0), rigid

    def _largest_of_equation(self, own: np.ndarray) -> np.ndarray:
        """Largest value among the residuals of the same equation, for each residual of the constraints."""
        kinds = self.compiled.constraints.kinds
        most = np.zeros(len(kinds))
        np.maximum.at(most, kinds, own)
        return most[kinds]

    def projected(self, at: Point) -> Point:
        """Return the point with coordinates projected on the constraints, multipliers 0."""
        c, z = self.compiled.constraints, at.z.copy()
        z[c.multipliers] = 0.0
        return replace(at, x=c.project(at.x, at.z, self.p, at.time, at.constants.vector), z=z)

    def solved(self, at: Point, most: int) -> Point | None:
        """Return the point with all algebraic unknowns solved for by the core, in at most so many evaluations.

        None if it takes more, or if the model is not integrated.
        """
        settler, z = self._solved_by_core(at)
        return replace(at, z=z) if settler and z is not None and settler.evaluations <= most else None

    def least_pivot(self, at: Point) -> float:
        """Return the least pivot of the algebraic equations relative to its terms; 0 if the core does not solve them."""
        settler, z = self._solved_by_core(at)
        return settler.least if settler and z is not None else 0.0

    def _solved_by_core(self, at: Point) -> tuple[Settler | None, np.ndarray | None]:
        """Solve for all algebraic unknowns by the core, if it has the equations; None if that does not converge."""
        if not (self.runs and self.nz):
            return None, None
        settler = Settler(core_square(self.compiled, tuple(range(self.nz))))
        z, settled = settler(
            *(self.p, at.constants.vector, at.x, at.z, np.array([[at.time]])),
            size=self.nominal[self.nx :],
            enough=POLICY.consistent.settled,
        )
        return settler, z[0] if settled[0] else None

    def completed(self, at: Point) -> Point:
        """Return the point with all algebraic unknowns that follow from the states alone, multipliers 0."""
        z = self.compiled.constraints.complete(at.x, at.z, self.p, at.time, at.constants.vector)
        z[self.compiled.constraints.multipliers] = 0.0
        return replace(at, z=z)

    def indicators(self, rows: Rows) -> tuple[np.ndarray, np.ndarray]:
        """Return the event indicators and their time derivatives, one row for each time."""
        found = self._motion(rows)
        n = found.shape[1] // 2
        return found[:, :n], np.where(np.isfinite(found[:, n:]), found[:, n:], 0.0)

    def _motion(self, rows: Rows) -> np.ndarray:
        tape = core_motion(self.compiled)[1]
        given = self.p, rows.constants, rows.x, rows.z, rows.times[:, None]
        rates = np.zeros(tape.sizes[-1])
        if self._rate_solver:  # linear equations: one step suffices
            rates, solved = self._rate_solver(*given, rates, size=np.ones(len(rates)), enough=np.inf)
            rates[~solved] = np.nan
        return tape.rows(*given, rates)

    @cached_property
    def _rate_solver(self) -> Settler | None:
        square = core_motion(self.compiled)[0]
        return Settler(square) if square else None

    def each(self, function: Vectorized, rows: Rows) -> np.ndarray:
        """Return the values of a function, one row for each time."""
        return function(rows.x, rows.z, self.p, rows.times[:, None], rows.constants)

    def stored(self, at: Point) -> float:
        """Return the stored energy in J."""
        return float(self.compiled.stored(at.x, at.z, self.p, at.time, at.constants.vector)[0][0])

    def point(self, rows: Rows, k: int) -> Point:
        """Return a row as a point."""
        constants = self.compiled.layout.constants(rows.constants[k])
        return Point(float(rows.times[k]), rows.x[k], rows.z[k], constants)


@memoized
def rates_of(compiled: CompiledModel) -> list[tuple[int, int]]:
    """Return pairs (coordinate, rate) among the states."""
    plan = compiled.reduced.plan
    projected = {p.coordinate: p.state for p in plan.constrained.projections}
    place = {v: k for k, v in enumerate(plan.states)}
    pairs = [(p.state, p.rate) for p in plan.constrained.projections]
    pairs += [(v, plan.system.derivative[v]) for v in plan.states]
    found = ((v, projected.get(rate, rate)) for v, rate in pairs)
    return [(place[v], place[rate]) for v, rate in found if rate in place]


def by_columns(J: scipy.sparse.csc_matrix, factors: np.ndarray) -> scipy.sparse.csc_matrix:
    """Return a matrix with every column times a factor."""
    return with_entries(J, J.data * np.repeat(factors, np.diff(J.indptr)))


def lengths(rows: scipy.sparse.csc_matrix) -> np.ndarray:
    """Length of each row."""
    return np.sqrt(np.bincount(rows.indices, rows.data**2, minlength=rows.shape[0]))
