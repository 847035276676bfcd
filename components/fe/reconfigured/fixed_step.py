"""Integration with a fixed step size."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from acausal import March, SimulationError, march
from components.fe.arrays import Array
from components.fe.reconfigured.free_modes import FreeModes
from components.fe.reconfigured.motion import FrameMotion
from components.fe.reconfigured.step_inputs import Inputs
from components.fe.reconfigured.step_limits import bounds, diverged
from components.fe.reconfigured.steps import Loads, Readings, State, corrected, printed


def fixed(
    modes: FreeModes,
    inputs: Inputs,
    start: Array,
    dt: float,
    count: int,
    readings: Readings | None,
    progress: Any,
) -> FrameMotion:
    """Move a body by steps of a fixed size.

    Parameters
    ----------
    modes : FreeModes
        The body.
    inputs : Inputs
        Loads and gravity.
    start : array, shape (15 + 2 N,)
        State at the start.
    dt : float
        Step in s.
    count : int
        Number of steps.
    readings : Readings or None
        Readings of the variant "paper"; None for the corrected variant.
    progress : callable or None
        Called with the completed fraction of the run and the number of steps.

    Raises
    ------
    SimulationError
        If the motion diverges; `result` holds the motion until then.
    KeyboardInterrupt
        With the motion until then as attribute `result`.
    """
    take = partial(printed, dt=dt, readings=readings) if readings else partial(corrected, dt=dt)
    times = dt * np.arange(count + 1)

    def motion(found: March) -> FrameMotion:
        done = len(found.outputs)
        variant = "paper" if readings else "corrected"
        return FrameMotion(modes, times[:done], found.states[:done], found.outputs, variant, found, max(done - 1, 0))

    # One additional step gives the accelerations at the stop time; its end is ignored.
    rows = inputs.steps(dt, count, readings.middle if readings else "middle")
    try:
        found = march(
            lambda x, u: take(modes, Loads(*inputs.maps, u), State.of(x)),
            start,
            rows,
            bounds=bounds(modes),
            progress=progress,
        )
    except KeyboardInterrupt as interrupt:
        if hasattr(interrupt, "result"):
            interrupt.result = motion(interrupt.result)  # type: ignore[attr-defined]
        raise
    run = motion(found)
    if found.diverged:
        step = len(run.time) + 1
        raise SimulationError(diverged(modes, run.w, step, step * dt, dt), run)
    return run
