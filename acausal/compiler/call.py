"""Call a CasADi function on arrays in place: a plain call costs more in Python than the function itself."""

from __future__ import annotations

import contextlib
import io
import sys
from collections.abc import Iterator
from threading import get_ident
from typing import Any

import casadi as ca
import numpy as np

from acausal.signals import Signals


class _Noise(io.StringIO):
    """Captures what this thread writes; the output of other threads passes through."""

    def __init__(self) -> None:
        super().__init__()
        self._thread, self._others = get_ident(), sys.stderr

    def write(self, text: str) -> int:
        """Write a text."""
        if get_ident() == self._thread:
            return super().write(text)
        return self._others.write(text) if self._others else len(text)


@contextlib.contextmanager
def quiet() -> Iterator[io.StringIO]:
    """Hide the output of solvers from the terminal, and from solvers the interrupts that they would take for failures."""
    noise = _Noise()
    Signals.raise_lost()
    with Signals(), contextlib.redirect_stderr(noise):
        yield noise


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
        self._ran = False
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

    def clear(self) -> None:
        """Make all outputs NaN: those that an evaluation does not reach, because of a failure or an interrupt, remain NaN."""
        self._ran = False
        for array in self.outputs:
            array.fill(np.nan)

    def succeeds(self) -> bool:
        """Evaluate in place, and return whether that worked."""
        self._ran = True
        try:
            self.evaluate()
        except RuntimeError:
            return False
        return not self.buffer.ret()

    def attempt(self) -> tuple[bool, str]:
        """Evaluate in place; return whether that worked, and the solver's messages."""
        with quiet() as noise:
            done = self.succeeds()
        return done, noise.getvalue()

    @property
    def stats(self) -> dict:
        """Return the statistics of the last evaluation, none where it was interrupted before it began."""
        try:
            return self.buffer.stats() if self._ran else {}
        except RuntimeError:
            return {}
