"""A function of the model evaluated at many points."""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
import numpy as np

from acausal.compiler.call import Call, quiet
from acausal.core import make_tape

# Points evaluated in one call of CasADi.
AT_ONCE = 16
# Number of evaluated points after which a function is compiled to a tape: evaluation becomes six times as fast, and building
# the tape costs as much as 300 to 780 evaluations (eight functions of 2 to 1,548 operations of four scenes).
PAYS = 700


class Vectorized:
    """A function with one result, evaluated at many points; by a tape once that pays.

    Parameters
    ----------
    function : casadi.Function
        The function at one point; only functions of scalar symbols (SX) become tapes.
    """

    def __init__(self, function: ca.Function) -> None:
        self.function = function
        self._calls: dict[int, Call] = {}
        self._places, self._tape = 0, None

    def __call__(self, *arguments: np.ndarray) -> np.ndarray:
        """Return one row per point; NaN where the evaluation failed, and in the points evaluated in the same call.

        Parameters
        ----------
        *arguments : arrays
            Arguments of the function: of shape (n, size), or (size,) if they are the same at all points.
        """
        if self._tape:
            return self._tape.rows(*arguments)
        n, first = next(len(a) for a in arguments if a.ndim == 2), 0
        self._places += n
        if self._places > PAYS and self.function.is_a("SXFunction"):
            self._tape = make_tape(self.function)
            return self._tape.rows(*arguments)
        found = np.full((n, self.function.nnz_out(0)), np.nan)
        with quiet():
            while first < n:
                size = AT_ONCE if n - first >= AT_ONCE else 1
                rows = slice(first, first + size)
                call = self._call(size)
                for array, value in zip(call.inputs, arguments, strict=True):
                    array.reshape(size, -1)[:] = value[rows] if value.ndim == 2 else value
                if call.succeeds():
                    found[rows] = call.outputs[0].reshape(size, -1)
                first += size
        return found

    def _call(self, size: int) -> Call:
        if size not in self._calls:
            self._calls[size] = Call(self.function.map(size))
        return self._calls[size]


def vectorized(function: ca.Function) -> Callable[..., np.ndarray]:
    """Return a vectorized function that is called often enough to pay for a tape from the start.

    Parameters
    ----------
    function : casadi.Function
        The function at one point, of scalar symbols (SX).
    """
    return make_tape(function).rows
