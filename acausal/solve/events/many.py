"""Warn early of a run that will take long because conditions change very often in it."""

from __future__ import annotations

import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import caution
from acausal.policy import POLICY
from acausal.solve.initialization.initial_modes import origins_text

INSTANTS = POLICY.instants


def warn_of_many(compiled: CompiledModel, time: float, times: np.ndarray, guards: list[int]) -> None:
    """Warn if as many events as there were up to a time will be too many in the whole run.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    time : float
        Of event number `INSTANTS.many`, in s.
    times : array
        Output times in s.
    guards : list of int
        Conditions that change there.
    """
    part = (time - float(times[0])) / float(times[-1] - times[0])
    if part * INSTANTS.dear < INSTANTS.many:
        pace = "without end" if part <= 0 else f"about {float(f'{INSTANTS.many / part:.2g}'):,.0f} in the whole run"
        caution(
            f"{INSTANTS.many} events up to t = {time:.6g} s, {pace} if it goes on like that, and the integration begins anew "
            f"after each: it will take long. What changes so often:\n{origins_text(compiled, guards)}\n"
            "If only the mean effect matters, use that instead of the switching; else simulate a shorter time, stop_time=.... "
            "Ctrl-C keeps what was computed, in the `result` of the KeyboardInterrupt."
        )
