"""Values of a model along a run."""

from __future__ import annotations

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.call import Call
from acausal.errors import caution
from acausal.flatten.foreign import refuse_undeclared
from acausal.language.functions import time as time_symbol
from acausal.solve.integrate.consistent import Consistent


class Evaluator:
    """Values of expressions of the model along a run; each satisfies its equations at its time to rounding.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    t : array, shape (n,)
        Times in s.
    x, z, constants : arrays, shape (n, ...)
        States, algebraic unknowns and constants of segments at these times; what of z a value needs is solved for again
        from the states when it is read first.
    solver : Consistent
        Solves for it, and counts.
    """

    def __init__(
        self,
        compiled: CompiledModel,
        t: np.ndarray,
        x: np.ndarray,
        z: np.ndarray,
        constants: np.ndarray,
        solver: Consistent,
    ) -> None:
        self.compiled, self.solver = compiled, solver
        self.t, self.x, self.z, self.constants = t, x, z, constants
        self._given = z
        self._solved: set[int] = set()

    @property
    def evaluations(self) -> int:
        """Evaluations of the equations so far."""
        return self.solver.evaluations

    def __call__(self, expression: ca.SX) -> np.ndarray:
        """Return one row for each time, one column for each entry of a column of expressions."""
        c = self.compiled
        resolved = c.reduced.running.resolve(ca.densify(expression))
        wanted = c.dependence.inside(resolved)
        # What closes a loop is in nearly all equations: all at once, and the order of reading makes no difference.
        self._solve((set(range(c.nz)) if wanted and c.constraints.size else wanted) - self._solved)
        arguments = [c.reduced.x, c.reduced.z, c.reduced.p, time_symbol.sx, c.reduced.constants]
        n = len(self.t)
        try:
            call = Call(ca.Function("observe", arguments, [resolved]).map(n))
        except RuntimeError:
            refuse_undeclared(resolved, arguments)
            raise
        values = [self.x.ravel(), self.z.ravel(), np.tile(self.solver.p, n), self.t, self.constants.ravel()]
        return call(*values)[0].reshape(n, -1).copy()

    def _solve(self, wanted: set[int]) -> None:
        """Solve for some algebraic unknowns, and all that they need."""
        if not wanted:
            return
        unknowns = self.compiled.dependence.needed(wanted)[0]
        solved = self.solver(self.x, self._given, self.t, self.constants, wanted)
        self.z = self.z.copy()
        self.z[:, unknowns] = solved[:, unknowns]
        self._solved.update(unknowns.tolist())
        if self.solver.unsolved:
            names = ", ".join(f"`{self.compiled.algebraic[k]}`" for k in sorted(wanted)[:3])
            caution(
                f"at t = {min(self.solver.unsolved):.6g} s, and at {len(self.solver.unsolved)} output times in all, the "
                f"equations of {names} have no unique solution near that of the integrator, whose values are returned "
                "there: a position is singular, or a law has no value."
            )
            self.solver.unsolved.clear()
