"""Values of a model along a run."""

from __future__ import annotations

from functools import cached_property

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.call import Call
from acausal.language.functions import initial as initial_flag
from acausal.language.functions import time as time_symbol


class Evaluator:
    """Values of expressions of the model along a run.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    t : array, shape (n,)
        Times in s.
    x, z, modes : arrays, shape (n, ...)
        States, algebraic unknowns and constants of segments at these times; with closed loops z is settled when the
        first value is read.
    p : array
        Parameters.
    """

    def __init__(
        self, compiled: CompiledModel, t: np.ndarray, x: np.ndarray, z: np.ndarray, modes: np.ndarray, p: np.ndarray
    ) -> None:
        self.compiled = compiled
        self.t, self.x, self.modes, self.p = t, x, modes, p
        self._z = z

    @cached_property
    def z(self) -> np.ndarray:
        """Algebraic unknowns for which all equations hold."""
        closing = self.compiled.closing
        return closing.settle(self.x, self._z, self.p, self.t, self.modes) if closing.size else self._z

    def __call__(self, expression: ca.SX) -> np.ndarray:
        """Return one row for each time, one column for each entry of a column of expressions."""
        c = self.compiled
        resolved = ca.substitute(c.reduced.resolve(ca.densify(expression)), initial_flag.sx, 0)
        arguments = [c.reduced.x, c.reduced.z, c.reduced.flat.parameters, time_symbol.sx, c.reduced.modes]
        n = len(self.t)
        call = Call(ca.Function("observe", arguments, [resolved]).map(n))
        values = [self.x.ravel(), self.z.ravel(), np.tile(self.p, n), self.t, self.modes.ravel()]
        return call(*values)[0].reshape(n, -1).copy()
