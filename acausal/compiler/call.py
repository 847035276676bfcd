"""CasADi functions evaluated in place on arrays: the conversions of a plain call often cost more than the function."""

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
    """A stream that captures what this thread writes and passes on the output of other threads."""

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
    """Capture the messages of solvers, and defer interrupts, which solvers would report as failures."""
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

    def succeeds(self) -> bool:
        """Evaluate in place; return whether the evaluation succeeded."""
        try:
            self.evaluate()
        except RuntimeError:
            return False
        return not self.buffer.ret()
