"""Integration of a run: how, from where, and what was integrated so far."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.compiler.constants import Constants
from acausal.policy import POLICY
from acausal.solve.initialization.coordinate_partitioning import (
    choose_projection,
    least_cosine,
    partitioned,
    projection_cosine,
    projection_is_valid,
)
from acausal.solve.initialization.independent_constraints import reselected
from acausal.solve.initialization.minimum_norm_reactions import minimum_norm_reactions
from acausal.solve.initialization.newton import algebraic
from acausal.solve.integrate.consistent import Consistent
from acausal.solve.integrate.ladder import Refusal, Way
from acausal.solve.integrate.limits import Limits
from acausal.solve.integrate.methods import METHODS, rounding
from acausal.solve.integrate.settings import Settings
from acausal.solve.integrate.trace import Trace
from acausal.solve.point import Point, Rows
from acausal.solve.problem import Problem


class Integrator:
    """Integration of one model with one set of parameters.

    Parameters
    ----------
    problem : Problem
        The model.
    settings : Settings
        Tolerance, order limit and what else to compute.
    span : (float, float)
        Start and stop time of the whole run, for the progress.
    before : Trace
        Of an earlier run whose counts continue.
    fresh : Constants, optional
        Those of the start, whose projection was chosen there.
    limits : Limits, optional
        Where the run ends early.
    """

    def __init__(
        self,
        problem: Problem,
        settings: Settings,
        span: tuple[float, float],
        before: Trace,
        fresh: Constants | None = None,
        limits: Limits | None = None,
    ) -> None:
        self._fresh = fresh
        self.problem, self.compiled, self.settings, self.span = problem, problem.compiled, settings, span
        self.trace = before.emptied()
        self.consistent = Consistent(problem)
        self.way = settings.way
        self.limits = limits
        self._floor: np.ndarray | None = None
        self._chosen: tuple[Point, bool, Point] | None = None  # the last choice: where, whether it moves, and what

    def aside(self) -> Integrator:
        """Return an integrator that goes on in the same way, and counts for itself."""
        other = Integrator(self.problem, self.settings, self.span, Trace())
        other.way, other._floor = self.way, self._floor
        return other

    @property
    def tolerance(self) -> float:
        """Relative tolerance of the run."""
        return self.settings.tolerance

    @property
    def order(self) -> int:
        """Highest order of the multistep method in the way of now."""
        return self.settings.order(self.way)

    @property
    def loops(self) -> bool:
        """Whether there are constraints."""
        return bool(self.compiled.constraints.size)

    def rounding(self, at: Point) -> np.ndarray:
        """Absolute errors that rounding causes, computed once a run and only where the tolerance is near them."""
        if self._floor is None:
            near = self.settings.tolerance < POLICY.calls.near_rounding and self.compiled.nz
            c = self.compiled
            self._floor = rounding(self.problem, at) if near else np.zeros(c.nx + c.nz)
        return self._floor

    def take(self, way: Way, refusal: Refusal) -> None:
        """Go on in another way, as the present one was refused."""
        if way.method != self.way.method:
            method = METHODS[way.method]
            damped = ", which damps vibrations that positions do not show" if method.damps else ""
            self.trace.changes.append(f"{method.name} from t = {refusal.time:.6g} s on{damped}: {refusal.kind.value}")
        self.way = way

    def restarted(self, at: Point, moves: bool) -> Point:
        """Return a point where the constraints hold, with a projection that suits the position.

        Raises
        ------
        InitializationError
            If the equations have no solution there with the constraints that are to be kept.
        """
        if not self.loops:
            return at
        if self._chosen is None or self._chosen[0] is not at or self._chosen[1] != moves:
            self._chosen = at, moves, self._suited(self._refitted(self.problem.projected(at)), moves)
        return self._chosen[2]

    def _refitted(self, at: Point) -> Point:
        """Return the point with other constraints kept, where those that are do not suit it."""
        constants = reselected(self.problem, at)
        if np.array_equal(constants.closures, at.constants.closures):
            return at
        self.trace.choices += 1
        there = replace(at, constants=constants)
        there = replace(there, constants=minimum_norm_reactions(self.problem, there))
        there = replace(there, constants=choose_projection(self.problem, there, spare=False, moves=True))
        return algebraic(self.problem, self.problem.completed(there))

    def _suited(self, at: Point, moves: bool) -> Point:
        """Return the point with a projection that suits it: its own, if that moves along."""
        fits = (at.constants is self._fresh and at.time == self.span[0]) or projection_is_valid(self.problem, at)
        if fits and moves:
            return at
        self.trace.choices += 1
        return replace(
            at, constants=partitioned(self.problem, at) if fits else choose_projection(self.problem, at, moves=moves)
        )

    def are_fit(self, at: Point) -> bool:
        """Return whether the states chosen for loops are fit at a point."""
        if not self.loops or at.constants.moves:
            return True
        return bool(projection_cosine(self.problem, Rows.of(at), at.constants)[0] >= least_cosine(self.problem))

    def report(self, time: float) -> None:
        """Report the progress."""
        if self.settings.progress:
            start, stop = self.span
            self.settings.progress((time - start) / (stop - start), self.trace.steps)
