"""Call a CasADi function on arrays in place: a plain call costs more in Python than the function itself."""

from __future__ import annotations

import contextlib
import io
import sys
from threading import get_ident
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler.signals import Signals


class _Noise(io.StringIO):
    """Keeps what this thread writes; what others write meanwhile goes where it always goes."""

    def __init__(self) -> None:
        super().__init__()
        self._thread, self._others = get_ident(), sys.stderr

    def write(self, text: str) -> int:
        """Write a text."""
        if get_ident() == self._thread:
            return super().write(text)
        return self._others.write(text) if self._others else len(text)


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
        """Evaluate in place; return whether that worked, and what the solver complained about.

        What is not reached, because of a failure or an interrupt, is NaN in the outputs.
        """
        for array in self.outputs:
            array.fill(np.nan)
        noise = _Noise()
        try:
            with Signals(), contextlib.redirect_stderr(noise):
                self.evaluate()
        except RuntimeError:
            return False, noise.getvalue()
        return not self.buffer.ret(), noise.getvalue()

    @property
    def stats(self) -> dict:
        """Return the statistics of the last evaluation."""
        return self.buffer.stats()
