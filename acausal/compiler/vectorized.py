"""A function of the model at many places: some of them in one call."""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
import numpy as np

from acausal.compiler.call import Call, quiet
from acausal.core import library, make_tape

# Places in one call.
AT_ONCE = 16
# Places at which a function was evaluated when a tape, six times as fast, would have paid: making one takes so long (300 to 780,
# eight functions of 2 to 1,548 operations of four scenes).
PAYS = 700


class Vectorized:
    """A function with one result, at many places; if it is one of scalar symbols that is called often, by a tape.

    Parameters
    ----------
    function : casadi.Function
        The function at one place.
    """

    def __init__(self, function: ca.Function) -> None:
        self.function = function
        self._calls: dict[int, Call] = {}
        self._places, self._tape = 0, None

    def __call__(self, *arguments: np.ndarray) -> np.ndarray:
        """Return one row for each place; nan where the evaluation failed, and in those evaluated with it.

        Parameters
        ----------
        *arguments : arrays
            Arguments of the function: of shape (n, size), or (size,) where they are the same everywhere.
        """
        if self._tape:
            return self._tape.rows(*arguments)
        n, first = next(len(a) for a in arguments if a.ndim == 2), 0
        self._places += n
        if self._places > PAYS and library() and self.function.is_a("SXFunction"):
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
    """Return a function at many places, as `Vectorized` takes it, that is called often enough to pay for a tape.

    Parameters
    ----------
    function : casadi.Function
        The function at one place, made from SX.
    """
    return make_tape(function).rows if library() else Vectorized(function)
