"""A run of an FMU for Co-Simulation, as a function that is called at each communication point."""

from __future__ import annotations

from typing import Any

import numpy as np

from components.fmu.instance import end, get_values, initialized, set_values
from components.fmu.interface import Interface


class Slave:
    """Function of time, inputs and parameters that returns the outputs; it advances the FMU from call to call.

    Each copy is a run of its own, which begins at its first call.

    Parameters
    ----------
    interface : Interface
        The FMU.
    powers : tuple of (str, str)
        Pairs of inputs and outputs whose product is a power.
    """

    def __init__(self, interface: Interface, powers: tuple[tuple[str, str], ...]) -> None:
        self.interface, self.powers = interface, powers
        self._fmu: Any = None
        self._time = self._error = 0.0
        self._last: tuple[np.ndarray, np.ndarray] | None = None  # inputs and outputs of the last point that make powers
        fields = ([signal.field for signal in part] for part in (interface.inputs, interface.outputs))
        self._pairs = [[own.index(pair[k]) for pair in powers] for k, own in enumerate(fields)]

    def __deepcopy__(self, memo: dict[int, Any]) -> Slave:
        if self._fmu is not None:
            raise TypeError("an FMU in a run has no copy")
        return Slave(self.interface, self.powers)

    def __reduce__(self) -> Any:
        return Slave, (self.interface, self.powers)

    def __call__(self, time: float, u: Any, p: Any, step: float) -> tuple[Any, float]:
        """Advance to a time with the inputs of the last call, and take new ones.

        Returns the outputs, shape (n,), and the error of the coupling in J.
        """
        if self._fmu is None:
            self._fmu, self._time = initialized(self.interface, "CoSimulation", time, p, u), time
        else:
            self._step(step)
            set_values(self._fmu, self.interface.inputs, u)
        y = get_values(self._fmu, self.interface.outputs)
        now = np.asarray(u)[self._pairs[0]], y[self._pairs[1]]
        if self._last is not None:
            self._error += step / 2 * float(np.sum(np.abs(self._last[1] * now[0] - self._last[0] * now[1])))
        self._last = now
        return y, self._error

    def _step(self, step: float) -> None:
        try:
            self._fmu.doStep(currentCommunicationPoint=self._time, communicationStepSize=step)
        except Exception:
            self._fmu = None  # after an error FMI allows no other calls, after a fatal one not even the end
            raise
        self._time += step

    def __del__(self) -> None:
        end(getattr(self, "_fmu", None))
