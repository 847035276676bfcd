"""march(): fixed-step integration by a compiled step function of the user, in blocks of steps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal.errors import DeclarationError
from acausal.language.call_arguments import checked_arguments
from acausal.locks import exclusive
from acausal.policy import POLICY
from acausal.simulation.compiled_step import CompiledStep, Step
from acausal.solve.integrate.settings import Progress


@dataclass(frozen=True, eq=False)
class March:
    """The trajectory of a fixed-step integration.

    Parameters
    ----------
    states : array, shape (k + 1, n)
        States at the start and after each of the k steps that were taken.
    outputs : array, shape (k, m)
        Other values of each step.
    diverged : bool
        Whether the run ended early because the next state exceeds its bounds or is not a number.
    operations : int
        Operations of one step.
    building, seconds : float
        Seconds spent on compiling the step, and on taking steps.
    """

    states: np.ndarray
    outputs: np.ndarray
    diverged: bool
    operations: int
    building: float
    seconds: float


@checked_arguments
@exclusive
def march(
    step: Step,
    start: Any,
    inputs: Any,
    *,
    bounds: Any = np.inf,
    progress: Progress | None = None,
) -> March:
    """Take one step for each row of inputs, without Python between steps.

    Parameters
    ----------
    step : callable
        Function from symbols of the state, shape (n,), and of a row of the inputs, shape (u,), to the state after the step and
        to a vector of other values, of any length. It is called once and must be a pure function of its arguments.
    start : array_like, shape (n,)
        State at the start.
    inputs : array_like, shape (steps, u)
        Inputs of the steps, one row each.
    bounds : array_like, shape (n,)
        The run ends if the absolute value of a state exceeds its bound.
    progress : callable, optional
        Called after each block with the fraction done, from 0 to 1, and the number of steps.

    Returns
    -------
    March
        States and outputs, up to the last state within its bounds.

    Raises
    ------
    DeclarationError
        If the step returns another number of states, or depends on other symbols.
    KeyboardInterrupt
        Its attribute `result` holds the steps taken so far.

    Examples
    --------
    >>> march(lambda x, u: (0.5 * x + u, x), [1.0], [[0.0], [0.0]]).states.ravel().tolist()
    [1.0, 0.5, 0.25]
    """
    x, u = np.array(start, dtype=float), np.array(inputs, dtype=float)
    if x.ndim != 1 or u.ndim != 2:
        raise DeclarationError(
            f"march() needs a vector of states and a row of inputs for each step, not shapes {x.shape} and {u.shape}."
        )
    one = CompiledStep(step, x.size, u.shape[1])
    states, outputs = np.empty((len(u) + 1, x.size)), np.empty((len(u), one.outputs))
    states[0], done, diverged = x, 0, False
    limits = np.broadcast_to(np.asarray(bounds, dtype=float), x.shape)

    def found(diverged: bool) -> March:
        return March(states[: done + 1], outputs[:done], diverged, one.operations, one.building, one.seconds)

    try:
        while done < len(u) and not diverged:
            count = min(POLICY.calls.steps_of_a_block, len(u) - done)
            after, values = one(states[done], u[done : done + count])
            inside = (np.abs(after) <= limits).all(axis=1)  # false for NaN
            count, diverged = (count, False) if inside.all() else (int(np.argmin(inside)), True)
            states[done + 1 : done + 1 + count], outputs[done : done + count] = after[:count], values[:count]
            done += count
            if progress is not None:
                progress(done / len(u), done)
    except KeyboardInterrupt as interrupt:
        interrupt.result = found(False)  # type: ignore[attr-defined]
        raise
    return found(diverged)
