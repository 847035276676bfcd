"""Rates and conditions at points where loops are closed, and their Jacobians by the states."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from acausal.policy import POLICY
from acausal.solve.points import Point
from acausal.solve.problem import Problem
from acausal.solve.start.at_rest import kinematic, meters
from acausal.solve.start.loop_states import choose_projection
from acausal.solve.start.loops import close, tighten
from acausal.solve.start.newton import Lost, algebraic
from acausal.solve.start.rank import factored


@dataclass
class Linearized:
    """Rates and conditions at a point, and their Jacobians by the states with the algebraic unknowns eliminated."""

    point: Point
    rates: np.ndarray
    A: np.ndarray
    conditions: np.ndarray
    C: np.ndarray


class Linearizer:
    """Linearise near a guess.

    Parameters
    ----------
    problem : Problem
        The model.
    guess : Point
        A point where loops are closed.
    """

    def __init__(self, problem: Problem, guess: Point) -> None:
        self.problem, self.guess = problem, guess
        compiled, self.nx = problem.compiled, problem.nx
        self.scale = problem.nominal[: self.nx]
        self.rows = np.setdiff1d(np.arange(self.nx), meters(compiled))
        pairs = [coordinate for coordinate, _ in problem.rates]
        self.coordinates = np.array(sorted({*pairs, *kinematic(compiled)}), dtype=int)

    def linearized(self, at: Point) -> Linearized:
        """Solve for the algebraic unknowns, and linearise."""
        nx, nz = self.nx, self.problem.nz
        at = algebraic(self.problem, at)
        local = self.problem.local(at)
        if not (np.all(np.isfinite(local.value)) and np.all(np.isfinite(local.jacobian.data))):
            raise Lost("the equations have no value there", at, 0.0)
        J = local.jacobian.tocsc()
        solve = factored(J[nx : nx + nz, nx:], self.problem.nominal[nx:], POLICY.ranks.rank) if nz else None
        dz = solve(-J[nx : nx + nz, :nx].toarray()) if solve else np.zeros((0, nx))
        A, C = ((J[rows, :nx] + J[rows, nx:] @ dz) for rows in (slice(0, nx), slice(nx + nz, None)))
        return Linearized(at, local.value[:nx], np.asarray(A), local.value[nx + nz :], np.asarray(C))

    def closed(self, at: Point) -> Point:
        """Close the loops, and choose again which states follow from others.

        Only states that follow from others move, if that closes them: moving stiff parts as well would drive the motion.
        """
        c, left = self.problem.compiled.constraints, np.inf
        if not c.size:
            return at
        closed = at
        if not at.constants.moves:
            held = np.setdiff1d(np.arange(self.nx), c.entries[1][at.constants.D != 0])
            closed, left = close(self.problem, at, held)
        if left > POLICY.loops.closed:
            closed = tighten(self.problem, replace(at, constants=self.guess.constants))
        at = replace(closed, constants=choose_projection(self.problem, closed))
        return self.problem.completed(at)

    def size(self, step: np.ndarray) -> float:
        """Largest change of a state in a step, in nominal values."""
        return float(np.max(np.abs(step) / self.scale, initial=0.0))

    def far(self, step: np.ndarray) -> float:
        """How far a step leads, in nominal values of what has a rate among the states, or whose rate is kinematics."""
        return float(np.max(np.abs(step / self.scale)[self.coordinates], initial=0.0))


def moved(at: Point, step: np.ndarray) -> Point:
    """Return a point a step of the states away."""
    return replace(at, x=at.x + step)
