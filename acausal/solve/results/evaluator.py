"""Values of any expression of a model along a run."""

from __future__ import annotations

import casadi as ca
import numpy as np

from acausal.compiler.vectorized import Vectorized
from acausal.errors import caution
from acausal.flatten.opaque_calls import refuse_undeclared
from acausal.language.functions import time as time_symbol
from acausal.solve.diagnosis.not_finite import undefined_equations
from acausal.solve.integrate.consistent import Consistent
from acausal.solve.point import Rows
from acausal.solve.results.prescribed import Prescribed

REMEDY = "State what holds there: piecewise((value, condition), ..., otherwise)."


class Evaluator:
    """Values of expressions of the model along a run; they satisfy the equations to round-off.

    Parameters
    ----------
    rows : Rows
        Rows of the run; algebraic unknowns are solved for again from the states when first needed.
    solver : Consistent
        Solver for these.
    prescribed : Prescribed, optional
        Values computed by other means, at the same times.
    """

    def __init__(self, rows: Rows, solver: Consistent, prescribed: Prescribed | None = None) -> None:
        self.solver, self.rows, self.prescribed = solver, rows, prescribed
        self._from_integrator = rows
        self._solved: set[int] = set()

    def at(self, places: np.ndarray) -> Evaluator:
        """Return an evaluator of some of the rows, with the solutions so far."""
        some = Evaluator(self._from_integrator[places], self.solver)
        some.rows, some._solved = self.rows[places], set(self._solved)
        return some

    @property
    def evaluations(self) -> int:
        """Evaluations of the equations so far."""
        return self.solver.evaluations

    def __call__(self, expression: ca.SX) -> np.ndarray:
        """Return one row for each time, one column for each entry of a column of expressions."""
        c = self.solver.compiled
        resolve = self.prescribed.resolve if self.prescribed else c.reduced.running.resolve
        resolved = resolve(ca.densify(expression))
        wanted = c.dependence.inside(resolved)
        # Loops couple nearly all equations: solving for all at once makes values independent of the order of reading.
        self._solve((set(range(c.nz)) if wanted and c.constraints.size else wanted) - self._solved)
        arguments = [c.reduced.x, c.reduced.z, c.reduced.p, time_symbol.sx, c.reduced.constants]
        arguments += [self.prescribed.symbols] if self.prescribed else []
        rows, n = self.rows, len(self.rows)
        if not n:
            return np.empty((0, resolved.numel()))
        try:
            function = ca.Function("observe", arguments, [resolved])
        except RuntimeError:
            refuse_undeclared(resolved, arguments)
            raise
        own = [self.prescribed.values] if self.prescribed else []
        return Vectorized(function)(rows.x, rows.z, self.solver.problem.p, rows.times[:, None], rows.constants, *own)

    def why(self, row: int) -> str:
        """Return the message on equations that are not finite at a row, "" if all are finite."""
        problem = self.solver.problem
        return undefined_equations(problem, problem.point(self.rows, row), remedy=REMEDY, timed=False)

    def _solve(self, wanted: set[int]) -> None:
        """Solve for some algebraic unknowns and those they depend on."""
        if not wanted:
            return
        compiled = self.solver.compiled
        unknowns = compiled.dependence.needed(wanted)[0]
        solved, lost = self.solver(self._from_integrator, wanted)
        z = self.rows.z.copy()
        z[:, unknowns] = solved.z[:, unknowns]
        if self.prescribed is not None and lost:
            z[np.ix_(np.isin(self.rows.times, lost), unknowns)] = np.nan  # no integrator has an approximation
        self.rows = self.rows.with_z(z)
        self._solved.update(unknowns.tolist())
        if lost:
            near = " near the values of the integrator, which are returned there" if self.prescribed is None else ""
            names = ", ".join(f"`{compiled.algebraic[k]}`" for k in sorted(wanted)[:3])
            caution(
                f"at t = {min(lost):.6g} s, and at {len(lost)} output times in all, the equations of {names} have no unique "
                f"solution{near}: a configuration is singular, or a law is undefined."
            )
