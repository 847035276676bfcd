"""Values of a model along a run."""

from __future__ import annotations

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.call import Call
from acausal.language.functions import initial as initial_flag
from acausal.language.functions import time as time_symbol


class Evaluator:
    """Values of expressions of the model along a run."""

    def __init__(
        self, compiled: CompiledModel, t: np.ndarray, x: np.ndarray, z: np.ndarray, modes: np.ndarray, p: np.ndarray
    ) -> None:
        self.compiled = compiled
        self.columns = [x.T, z.T, p, t[None], modes.T]

    def __call__(self, expression: ca.SX) -> np.ndarray:
        """Return one row for each time, one column for each entry of a column of expressions."""
        c = self.compiled
        resolved = ca.substitute(c.reduced.resolve(ca.densify(expression)), initial_flag.sx, 0)
        arguments = [c.reduced.x, c.reduced.z, c.reduced.flat.parameters, time_symbol.sx, c.reduced.modes]
        n = self.columns[3].shape[1]
        function = ca.Function("observe", arguments, [resolved]).map(n)
        x, z, p, t, modes = self.columns
        call = Call(function)
        values = [x.flatten("F"), z.flatten("F"), np.tile(p, n), t[0], modes.flatten("F")]
        return call(*values)[0].reshape(n, -1).copy()
