"""A step function of the user, compiled and mapped over several steps per call."""

from __future__ import annotations

import time as clock
from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler.call import Call
from acausal.errors import DeclarationError
from acausal.language.call_arguments import checked_arguments
from acausal.language.expression import Expr, as_expr
from acausal.locks import exclusive

Step = Callable[[Expr, Expr], tuple[Any, Any]]


class CompiledStep:
    """A step function that is compiled once, and evaluated for several steps per call without Python in between.

    Use it if inputs depend on earlier steps, as in error control; for a run with known inputs use `march`.

    Parameters
    ----------
    step : callable
        Function from symbols of the state, shape (n,), and of a row of the inputs, shape (u,), to the state after the step and
        to a vector of other values, of any length. It is called once and must be a pure function of its arguments.
    states, inputs : int
        Sizes n and u.

    Attributes
    ----------
    operations : int
        Operations of one step.
    building, seconds : float
        Seconds spent on compiling the step, and on taking steps.

    Raises
    ------
    DeclarationError
        If the step returns another number of states, or depends on other symbols.

    Examples
    --------
    >>> halve = CompiledStep(lambda x, u: (0.5 * x + u, x), 1, 1)
    >>> halve([1.0], [[0.0], [0.0]])[0].ravel().tolist()
    [0.5, 0.25]
    """

    @checked_arguments
    @exclusive
    def __init__(self, step: Step, states: int, inputs: int) -> None:
        began = clock.perf_counter()
        self._step = _compiled(step, states, inputs)
        self._calls: dict[int, Call] = {}
        self.building, self.seconds = clock.perf_counter() - began, 0.0
        self.operations: int = self._step.n_instructions()

    @property
    def outputs(self) -> int:
        """Number of other values that a step returns."""
        return self._step.size1_out(1)

    @exclusive
    def __call__(self, start: Any, inputs: Any) -> tuple[np.ndarray, np.ndarray]:
        """Take one step for each row of inputs.

        Parameters
        ----------
        start : array_like, shape (n,)
            State at the start.
        inputs : array_like, shape (steps, u)
            Inputs of the steps, one row each. The map over a new number of steps is built on its first call.

        Returns
        -------
        states, outputs : array, shape (steps, n) and (steps, outputs)
            States after each step, and its other values.
        """
        began, u = clock.perf_counter(), np.asarray(inputs, dtype=float)
        x = np.asarray(start, dtype=float)
        if x.shape != (self._step.size1_in(0),) or u.ndim != 2 or u.shape[1] != self._step.size1_in(1):
            raise DeclarationError(
                f"a step of {self._step.size1_in(0)} states has {self._step.size1_in(1)} inputs in a row, not shapes {x.shape} "
                f"and {u.shape}."
            )
        count = len(u)
        if not count:
            return np.empty((0, x.size)), np.empty((0, self.outputs))
        if count not in self._calls:
            self._calls[count] = Call(self._step.mapaccum("block", count))
            self.building += clock.perf_counter() - began
            began = clock.perf_counter()
        states, outputs = self._calls[count](x, u.ravel())
        self.seconds += clock.perf_counter() - began
        return states.reshape(count, -1).copy(), outputs.reshape(count, -1).copy()


def _compiled(step: Step, n: int, m: int) -> ca.Function:
    x, u = (Expr(ca.SX.sym(name, size), shape=(size,)) for name, size in (("state", n), ("input", m)))
    after, values = (as_expr(part) for part in step(x, u))
    if after.shape != (n,) or len(values.shape) != 1:
        raise DeclarationError(
            f"a step returns the new state, shape ({n},), and a vector of other values, not shapes {after.shape} and "
            f"{values.shape}."
        )
    try:
        return ca.Function("step", [x.sx, u.sx], [ca.densify(after.sx), ca.densify(values.sx)])
    except RuntimeError as error:
        raise DeclarationError(
            "a step may depend on its state and its inputs alone; pass other values as inputs."
        ) from error
