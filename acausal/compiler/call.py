"""Call a CasADi function on arrays in place: a plain call costs more in Python than the function itself."""

from __future__ import annotations

import contextlib
import io
from typing import Any

import casadi as ca
import numpy as np


class Call:
    """A CasADi function bound to memory of its own.

    Parameters
    ----------
    function : casadi.Function
        Dense inputs; a sparse output gives the values of its nonzeros, in column-major order.
    """

    def __init__(self, function: ca.Function) -> None:
        self.function = function
        self.inputs = [np.zeros(function.nnz_in(i)) for i in range(function.n_in())]
        self.outputs = [np.zeros(function.nnz_out(i)) for i in range(function.n_out())]
        pair: Any = function.buffer()
        self.buffer, self.evaluate = pair
        for i, array in enumerate(self.inputs):
            self.buffer.set_arg(i, memoryview(array))
        for i, array in enumerate(self.outputs):
            self.buffer.set_res(i, memoryview(array))

    def __call__(self, *values: np.ndarray | float) -> list[np.ndarray]:
        """Evaluate and return the outputs; they are overwritten by the next call."""
        for array, value in zip(self.inputs, values, strict=True):
            array[:] = value
        self.evaluate()
        return self.outputs

    def attempt(self) -> tuple[bool, str]:
        """Evaluate in place; return whether that worked, and what the solver complained about."""
        noise = io.StringIO()
        try:
            with contextlib.redirect_stderr(noise):
                self.evaluate()
        except RuntimeError:
            if "KeyboardInterrupt" in noise.getvalue():
                raise KeyboardInterrupt from None
            return False, noise.getvalue()
        return not self.buffer.ret(), noise.getvalue()

    @property
    def stats(self) -> dict:
        """Return the statistics of the last evaluation."""
        return self.buffer.stats()
