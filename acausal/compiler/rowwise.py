"""A function of the model at many times: some of them in one call."""

from __future__ import annotations

import casadi as ca
import numpy as np

from acausal.compiler.call import Call, quiet

# Times in one call.
AT_ONCE = 16


class Rowwise:
    """A function of x, z, parameters, time and constants, with one result.

    Parameters
    ----------
    function : casadi.Function
        The function at one time.
    """

    def __init__(self, function: ca.Function) -> None:
        self.function = function
        self._calls: dict[int, Call] = {}

    def __call__(self, x: np.ndarray, z: np.ndarray, p: np.ndarray, t: np.ndarray, constants: np.ndarray) -> np.ndarray:
        """Return one row for each time; nan where the evaluation failed, and in those evaluated with it.

        Parameters
        ----------
        x, z : arrays, shapes (n, ...)
            States and algebraic unknowns.
        p : array
            Parameters.
        t : array, shape (n,)
            Times in s.
        constants : array, shape (n, m)
            Constants of the segment of each time.
        """
        n, first = len(t), 0
        found = np.full((n, self.function.nnz_out(0)), np.nan)
        with quiet():
            while first < n:
                size = AT_ONCE if n - first >= AT_ONCE else 1
                rows = slice(first, first + size)
                call = self._call(size)
                given = (x[rows], z[rows], p, t[rows, None], constants[rows])
                for array, value in zip(call.inputs, given, strict=True):
                    array.reshape(size, -1)[:] = value
                if call.succeeds():
                    found[rows] = call.outputs[0].reshape(size, -1)
                first += size
        return found

    def _call(self, size: int) -> Call:
        if size not in self._calls:
            self._calls[size] = Call(self.function.map(size))
        return self._calls[size]
