"""The start and the events of an FMU for Model Exchange, as functions."""

from __future__ import annotations

import weakref
from typing import Any

import numpy as np

from acausal import External
from acausal.core.externals import VALUE, external_data
from components.fmu.exchange_function import ExchangeFunction
from components.fmu.instance import get_values, set_values

STEP = 1e-6  # of an input: for differences of start values
EPS = float(np.finfo(float).eps)
NUDGES = 10  # times, tenfold each, that a point is moved for an indicator to change its sign


class StartFunction(External):
    """Start values of the states, of time, inputs, discrete inputs and parameters.

    Parameters
    ----------
    function : ExchangeFunction
        The FMU.
    """

    def __init__(self, function: ExchangeFunction) -> None:
        self.function, self._last = function, (b"", np.zeros(0))
        self.argument = np.zeros(len(function.argument) - 1 - function.nx)
        find = weakref.WeakMethod(self._find)  # no cycle
        self._value = VALUE(lambda own, place: find()(own, place))  # type: ignore[misc]
        data = external_data(self.argument, self._value)
        super().__init__(f"the start of {function.path}", [s.name for s in function.dynamics.states], data)

    def _find(self, own: int, place: int) -> float:
        try:
            column, k = divmod(place, self.function.nx)
            given = self.argument.copy()
            if not column:
                found, self.error = float(self._states(given)[k]), None
                return found
            if not 1 <= column - 1 <= self.function.nu:
                return 0.0
            size = STEP * max(1.0, abs(given[column - 1]))
            ends = [self._states(given + side * size * (np.arange(len(given)) == column - 1))[k] for side in (1, -1)]
            self._states(given)
            return float(ends[0] - ends[1]) / (2 * size)
        except Exception as error:  # none passes the core
            self.error = error
            return np.nan

    def _states(self, given: np.ndarray) -> np.ndarray:
        f = self.function
        if self._last[0] != bytes(given):
            u, d, p = np.split(given[1:], np.cumsum([f.nu, len(f.dynamics.discrete_inputs)]))
            self._last = bytes(given), f.begin(given[0], u, d, p)
        return self._last[1]


class Event:
    """Event mode of an FMU, as a function that is called at its events; at the start it saves its state alone.

    Parameters
    ----------
    function : ExchangeFunction
        The FMU.
    """

    pure = True  # of the event mode among its arguments

    def __init__(self, function: ExchangeFunction) -> None:
        self.function = function

    def __deepcopy__(self, memo: dict[int, Any]) -> Event:
        return self

    def __call__(self, time: float, arguments: Any, sides: Any = ()) -> tuple[Any, ...]:
        """Let an event happen.

        Parameters
        ----------
        time : float
            Time in s.
        arguments : array
            Of the function.
        sides : array
            Of each event indicator, 1 where it is positive.

        Returns the event mode, the next time event in s, and where there are any, an array of the states, the discrete outputs,
        the sides and the discrete inputs.
        """
        f = self.function
        mode, _, x, u, d, p = f.parts(np.array(arguments))
        if mode < 0:
            f.begin(time, u, d, p)
        elif f.dynamics.saves:
            x = self._happen(np.array(arguments), np.asarray(sides), d)
        else:
            raise ValueError(f"{f.path} has an event, and cannot save its state (canGetAndSetFMUstate)")
        y = get_values(f.fmu, f.dynamics.discrete_outputs)
        f.data.wanted = 0
        kept = np.concatenate([x, y, sides, d])
        return (f.save() if f.dynamics.saves else 0.0), f.next_event, *([kept] if kept.size else [])

    def _happen(self, arguments: np.ndarray, sides: np.ndarray, d: np.ndarray) -> np.ndarray:
        """Enter the event mode at arguments, and leave it; return the states."""
        f = self.function
        f.argument[:] = arguments
        for k in np.flatnonzero(sides != self._sides()):
            self._nudge(f.nx + f.ny + int(k), 1 if sides[k] else -1)
        x = f.parts(f.argument)[2].copy()
        if not np.isfinite(f.at(0)):
            raise f.error or ValueError(f"{f.path} has no value there")
        f.fmu.enterEventMode()
        set_values(
            f.fmu,
            f.dynamics.discrete_inputs,
            [s.factor * v + s.offset for s, v in zip(f.dynamics.discrete_inputs, d, strict=True)],
        )
        changed = f.iterate()
        f.fmu.enterContinuousTimeMode()
        return f.states() if changed else x

    def _sides(self) -> np.ndarray:
        f = self.function
        first = f.nx + f.ny
        return np.array([float(f.at(k) > 0) for k in range(first, first + f.dynamics.indicators)])

    def _nudge(self, place: int, side: int) -> None:
        """Move the arguments, along the gradient of an indicator, to the side on which an event has found it.

        An event lies within rounding of where its indicator is 0; the FMU decides by the sign.
        """
        f = self.function
        z, at = f.at(place), f.argument[1 : 2 + f.nx + f.nu]
        sizes = np.array([1.0, *(s.nominal for s in (*f.dynamics.states, *f.dynamics.inputs))])
        slope = np.array([f.at(place + len(f.names) * (2 + k)) for k in range(len(at))])
        change = np.sqrt(np.sum((slope * sizes) ** 2))
        if not (np.isfinite(change) and change > 0):
            return
        way = slope * sizes**2 / change**2
        begin = at.copy()
        for k in range(NUDGES):
            at[:] = begin + way * (side * change * EPS * 10**k - z)
            if (f.at(place) > 0) == (side > 0):
                return
