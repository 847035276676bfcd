"""The past of a signal, which the core records in a run."""

from __future__ import annotations

import weakref
from collections.abc import Sequence
from typing import Any

import casadi as ca

from acausal.core.externals import ExternalData
from acausal.core.library import loaded
from acausal.language.external import External

DELAYED, END, SIGNAL = range(3)


class History(External):
    """Function of the number of a run, a piece, time, the signal at the start, the signal, and the delay in s.

    Its values are the delayed signal, the time in s at which the piece ends, and the signal itself. A piece ends where the signal
    jumps; the condition of its end takes None for time and signal, as the delayed signal takes None for the signal.
    """

    kind = "delay"
    completes = True

    def __init__(self, path: str) -> None:
        library = loaded(runs=False)
        self._memory = library.ac_history_make()
        if not self._memory:
            raise MemoryError
        data = ExternalData.from_address(self._memory)
        super().__init__(path, ("the delayed signal", "the end of a piece", "the signal"), data)
        weakref.finalize(self, library.ac_history_free, self._memory)

    def __deepcopy__(self, memo: dict[int, Any]) -> History:
        return self

    def next_kink(self, arguments: ca.SX, places: Sequence[int]) -> ca.SX | None:
        """Return the time until which the past is known: at the start of a step, that plus the delay."""
        return arguments[2] + arguments[-1] if DELAYED in places else None

    def begin(self, time: float, signal: float) -> int:
        """Begin a run; return its number."""
        number = loaded(runs=False).ac_history_begin(self._memory, time, signal)
        if number < 0:
            raise MemoryError
        return number
