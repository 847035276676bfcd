"""Values of a model along a run."""

from __future__ import annotations

import casadi as ca
import numpy as np

from acausal.compiler.rowwise import Rowwise
from acausal.errors import caution
from acausal.flatten.foreign import refuse_undeclared
from acausal.language.functions import time as time_symbol
from acausal.solve.diagnosis.not_finite import undefined_equations
from acausal.solve.integrate.consistent import Consistent
from acausal.solve.point import Rows
from acausal.solve.results.prescribed import Known

REMEDY = "State what holds there: piecewise((value, condition), ..., otherwise)."


class Evaluator:
    """Values of expressions of the model along a run; each satisfies its equations at its time to rounding.

    Parameters
    ----------
    rows : Rows
        Where to evaluate; what of the algebraic unknowns a value needs is solved for again from the states when it is read
        first.
    solver : Consistent
        Solves for it, and counts.
    known : Known, optional
        Values that are not computed, at the same times.
    """

    def __init__(self, rows: Rows, solver: Consistent, known: Known | None = None) -> None:
        self.solver, self.rows, self.known = solver, rows, known
        self._given = rows
        self._solved: set[int] = set()

    def at(self, places: np.ndarray) -> Evaluator:
        """Return one for some of the rows, which knows what was solved for already."""
        some = Evaluator(self._given[places], self.solver)
        some.rows, some._solved = self.rows[places], set(self._solved)
        return some

    @property
    def evaluations(self) -> int:
        """Evaluations of the equations so far."""
        return self.solver.evaluations

    def __call__(self, expression: ca.SX) -> np.ndarray:
        """Return one row for each time, one column for each entry of a column of expressions."""
        c = self.solver.compiled
        resolve = self.known.resolve if self.known else c.reduced.running.resolve
        resolved = resolve(ca.densify(expression))
        wanted = c.dependence.inside(resolved)
        # What closes a loop is in nearly all equations: all at once, and the order of reading makes no difference.
        self._solve((set(range(c.nz)) if wanted and c.constraints.size else wanted) - self._solved)
        arguments = [c.reduced.x, c.reduced.z, c.reduced.p, time_symbol.sx, c.reduced.constants]
        arguments += [self.known.symbols] if self.known else []
        rows, n = self.rows, len(self.rows)
        if not n:
            return np.empty((0, resolved.numel()))
        try:
            function = ca.Function("observe", arguments, [resolved])
        except RuntimeError:
            refuse_undeclared(resolved, arguments)
            raise
        own = [self.known.values] if self.known else []
        return Rowwise(function)(rows.x, rows.z, self.solver.problem.p, rows.times[:, None], rows.constants, *own)

    def why(self, row: int) -> str:
        """Say which equations have no value at one of the times, "" if all have one."""
        problem = self.solver.problem
        return undefined_equations(problem, problem.point(self.rows, row), remedy=REMEDY, timed=False)

    def _solve(self, wanted: set[int]) -> None:
        """Solve for some algebraic unknowns, and all that they need."""
        if not wanted:
            return
        compiled = self.solver.compiled
        unknowns = compiled.dependence.needed(wanted)[0]
        solved, lost = self.solver(self._given, wanted)
        z = self.rows.z.copy()
        z[:, unknowns] = solved.z[:, unknowns]
        if self.known is not None and lost:
            z[np.ix_(np.isin(self.rows.times, lost), unknowns)] = np.nan  # there is no integrator that had come near
        self.rows = self.rows.with_z(z)
        self._solved.update(unknowns.tolist())
        if lost:
            rest = (
                "near that of the integrator, whose values are returned there"
                if self.known is None
                else "that is found"
            )
            names = ", ".join(f"`{compiled.algebraic[k]}`" for k in sorted(wanted)[:3])
            caution(
                f"at t = {min(lost):.6g} s, and at {len(lost)} output times in all, the equations of {names} have no unique "
                f"solution {rest}: a position is singular, or a law has no value."
            )
