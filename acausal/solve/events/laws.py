"""Decide which set-valued laws at rest stick, and which slide."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy

from acausal.compiler.constants import Constants
from acausal.compiler.set_valued_laws import MODE, OFFSET, SHARE, SHARED, SLIP, LawValues
from acausal.core.shares import shares
from acausal.errors import InitializationError, caution
from acausal.policy import POLICY
from acausal.solve.initialization.newton import algebraic
from acausal.solve.point import Point
from acausal.solve.problem import Problem

LAWS = POLICY.laws
NOISE = POLICY.newton.terms * np.finfo(float).eps


class Laws:
    """Decides the modes of set-valued laws at an event.

    Parameters
    ----------
    problem : Problem
        The model.
    tolerance : float
        Relative tolerance of the run.
    nominal : array
        Typical sizes of states and algebraic unknowns.
    """

    def __init__(self, problem: Problem, tolerance: float, nominal: np.ndarray) -> None:
        self.problem, self.tolerance, self.nominal = problem, tolerance, nominal
        self.laws = problem.compiled.guards.laws
        self._named = False

    def undecided(self, constants: Constants) -> bool:
        """True if a law at rest is not decided yet."""
        mode, _, _, _, slip = self._read(constants)
        return bool(np.any((mode == 0) & (slip == 0)))

    def parted(self, at: Point) -> Point:
        """Return the point after jumps with laws sliding that rest while their speed is not 0."""
        if not len(self.laws):
            return at
        found = self.laws(self.nominal, at.x, at.z, self.problem.p, at.time, at.constants.vector)
        far = np.abs(found.speed) > LAWS.moves * self.tolerance * found.size
        # Prescribed speeds, whose size is 0, do not jump.
        moves = np.flatnonzero((self._read(at.constants)[MODE] == 0) & far & (found.size > 0))
        given = {MODE: np.sign(found.speed[moves]), OFFSET: 0.0, SHARED: 0.0, SHARE: 0.0}
        return replace(at, constants=self._with(at.constants, moves, given)) if moves.size else at

    def decided(self, before: Constants, at: Point) -> Point:
        """Return the point with its laws at rest decided.

        This happens if a law comes to rest or leaves it, and at any event where redundant laws rest: they take new shares.
        """
        was, mode = self._read(before), self._read(at.constants)[MODE]
        left = (was[MODE] == 0) & (mode != 0)
        resting = np.flatnonzero((mode == 0) | (left & (was[SHARED] == 0)))  # a shared one slips
        shared = (mode == 0) & (was[SHARED] > 0)
        if not resting.size or not (left.any() or shared.any() or self.undecided(at.constants)):
            return at
        trial = self._with(at.constants, resting, {MODE: 0.0, SHARED: 1.0, SHARE: 0.0})
        try:
            free = algebraic(self.problem, replace(at, constants=trial))
        except InitializationError:
            return self._as_stated(at)
        reached = np.where(left, mode, np.where(np.abs(was[SHARE]) == 1, was[SHARE], 0.0))
        constants = self._chosen(free, resting, reached[resting])
        return self._as_stated(at) if constants is None else replace(free, constants=constants)

    def _as_stated(self, at: Point) -> Point:
        """Return the point with the modes that the components stated, as decided."""
        rest = np.flatnonzero(self._read(at.constants)[MODE] == 0)
        return replace(at, constants=self._with(at.constants, rest, {SLIP: np.finfo(float).tiny}))

    def _chosen(self, at: Point, resting: np.ndarray, reached: np.ndarray) -> Constants | None:
        """Return the constants with the laws `resting` decided, given the point without their forces; None if not finite."""
        found = self.laws(self.nominal, at.x, at.z, self.problem.p, at.time, at.constants.vector)
        response, certain, noise = self._responses(at, found)
        limit, rate = np.abs(found.limit), found.rate
        if not all(np.all(np.isfinite(a)) for a in (response, noise, limit, rate)):
            return None
        A, b = -(limit[:, None] * response)[np.ix_(resting, resting)], (limit * rate)[resting]
        answers = certain[resting] & (np.diag(A) > 0)
        share, sense = np.zeros(len(resting)), np.zeros(len(resting))
        sticks = np.zeros(len(resting), dtype=bool)
        if answers.any():
            own = A[np.ix_(answers, answers)]
            solved = shares((own + own.T) / 2, b[answers], reached[answers])
            share[answers], sense[answers], sticks[answers] = solved.share, solved.sense, solved.sticks
        # A speed that does not respond to its own force follows the rest of the machine.
        carried, own = resting[~answers], response[np.ix_(resting[~answers], resting)]
        rate, noise = rate[carried] + own @ share, noise[carried] + LAWS.independent * (np.abs(own) @ np.abs(share))
        sense[~answers] = np.where(np.abs(rate) > noise, np.sign(rate), 0.0)
        rests = sense == 0
        self.name(resting[answers & rests & ~sticks])
        band = np.maximum(self.tolerance * found.size[resting], np.finfo(float).tiny)
        given = {
            MODE: sense,
            OFFSET: found.speed[resting],
            SHARED: (rests & ~sticks).astype(float),
            SHARE: np.where(rests & ~sticks, share, 0.0),
            SLIP: np.where(rests, band, 0.0),
        }
        return self._with(at.constants, resting, given)

    def _responses(self, at: Point, found: LawValues) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the derivatives of the rates by the shares, which rates respond to their own share, and round-off of the rates.

        With the Jacobian J of the algebraic equations, the response of a rate is G J^-1 S = y' J z, where J z = S and y' J = G.
        Its size over |y|' |J| |z| does not change if rows or columns of J are scaled (Skeel 1979).
        """
        problem, own = self.problem, slice(self.problem.nx, self.problem.nx + self.problem.nz)
        local = problem.local(at)
        J = local.jacobian.tocsr()[own].tocsc()[:, own]
        G, S = found.by_unknown, found.equations
        try:
            factors = scipy.sparse.linalg.splu(J)
        except RuntimeError:
            nothing = np.full(len(self.laws), np.nan)
            return found.by_share, nothing > 0, nothing
        change = -factors.solve(S.toarray())
        influence = factors.solve(G.T.toarray(), "T")
        response = found.by_share + G @ change
        terms = np.abs(np.diag(found.by_share)) + np.sum(np.abs(influence) * (abs(J) @ np.abs(change)), axis=0)
        certain = np.abs(np.diag(response)) > LAWS.responds * terms
        sizes = local.magnitudes(np.abs(at.y))[own]
        noise = NOISE * (np.abs(influence).T @ sizes + abs(G) @ np.abs(at.z))
        return response, certain, noise

    def name(self, redundant: np.ndarray) -> None:
        """Warn once of redundant laws, whose forces the equations do not determine."""
        if self._named or not redundant.size:
            return
        self._named = True
        names = ", ".join(f"`{self.laws.origins[k].path}`" for k in redundant.tolist())
        caution(
            f"more joints stick at once than the machine has freedoms: the friction of {names} is redundant, and nothing "
            "determines how it shares the load with that of the others. The torques are those of least norm; the motion does "
            "not depend on them. Make a part of the loop elastic where they matter."
        )

    def _read(self, constants: Constants) -> np.ndarray:
        """Discrete variables of the laws, one row of each kind."""
        return constants.discretes[self.laws.places].T

    def _with(self, constants: Constants, laws: np.ndarray, given: dict[int, np.ndarray | float]) -> Constants:
        """Return the constants with new values of discrete variables of some laws."""
        discretes = constants.discretes.copy()
        for kind, value in given.items():
            discretes[self.laws.places[laws, kind]] = value
        return replace(constants, discretes=discretes)
