"""FixedDelay: the input some time before."""

from __future__ import annotations

from functools import cached_property
from typing import Any

from acausal import Scalar, call, der, discrete, external, input, parameter, reinit, time, variable, when
from acausal.language.history import DELAYED, END, SIGNAL, History
from components.blocks.siso import SISO


class FixedDelay(SISO):
    """Input some time before: y(t) = u(t - delay_time), before that u at the start.

    The core records the input at several points of each step, to the order of its steps, which are no longer than the delay.
    Where the input jumps, so does the output after the delay. `integral` is that of the input: its error control resolves the
    input.
    """

    delay_time: Scalar = parameter("delay", unit="s", default=1, positive=True)
    u: Scalar = input("input")
    begin: Scalar = discrete("input at the start", start=u)
    run: Scalar = discrete("number of the run", start=-1)
    piece: Scalar = discrete("jumps of the input before the delayed time")
    integral: Scalar = variable("integral of the input", unit="s", start=0, fixed=True)

    def equations(self):
        past = self._past
        delayed, ending = [self.run, self.piece, time, self.begin], [self.run, self.piece, None, None]
        yield self.y == external(past, [*delayed, None, self.delay_time], [DELAYED])[0]
        yield der(self.integral) == external(past, [*delayed, self.u, self.delay_time], [SIGNAL])[0]
        yield when(self.run < 0, call(_Begin(past), [self.u], [self.run, self.begin]), at_start=True)
        end = external(past, [*ending, None, self.delay_time], [END])[0]
        yield when(time >= end, reinit(self.piece, self.piece + 1))

    @cached_property
    def _past(self) -> History:
        """The past of the input, one for each part of a built model."""
        return History(f"the delay of {type(self).__name__}")


class _Begin:
    """Begins to record a run, from the input at the start; returns the number of the run and this input."""

    def __init__(self, past: History) -> None:
        self.past = past

    def __deepcopy__(self, memo: dict[int, Any]) -> _Begin:
        return self

    def __call__(self, time: float, u: float) -> tuple[int, float]:
        return self.past.begin(time, u), u
