"""A run of an FMU for Co-Simulation, as a function that is called at each communication point."""

from __future__ import annotations

import os
import shutil
import tempfile
from contextlib import suppress
from functools import cache
from typing import Any

import numpy as np

from components.fmu.interface import CONTINUOUS, Interface, Signal


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
            self._begin(time, u, p)
        else:
            self._step(step)
            self._set(self.interface.inputs, u)
        y = np.array([self._get(signal) for signal in self.interface.outputs])
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

    def _begin(self, time: float, u: Any, p: Any) -> None:
        from fmpy.simulation import instantiate_fmu

        own = self.interface
        folder, description = _unpacked(own.path, os.stat(own.path).st_mtime_ns)
        self._fmu, self._time = instantiate_fmu(folder, description, "CoSimulation"), time
        self._set(own.parameters, p)
        start = {"startTime": time}
        if own.version == "2.0":
            self._fmu.setupExperiment(**start)
        self._fmu.enterInitializationMode(**({} if own.version == "2.0" else start))
        self._set(own.inputs, u)
        self._fmu.exitInitializationMode()

    def _set(self, signals: tuple[Signal, ...], values: Any) -> None:
        for signal, value in zip(signals, values, strict=True):
            number = (float(value) - signal.offset) / signal.factor
            given = number > 0.5 if signal.kind == "Boolean" else number if signal.kind in CONTINUOUS else round(number)
            getattr(self._fmu, f"set{signal.kind}")([signal.reference], [given])

    def _get(self, signal: Signal) -> float:
        return signal.factor * float(getattr(self._fmu, f"get{signal.kind}")([signal.reference])[0]) + signal.offset

    def __del__(self) -> None:
        if fmu := getattr(self, "_fmu", None):
            with suppress(Exception):  # an FMU that fails at its end has done its work
                fmu.terminate()
                fmu.freeInstance()


@cache
def _unpacked(path: str, changed: int) -> tuple[str, Any]:
    """Return the folder of an FMU, removed at the end of the process, and its description; anew where the file has changed."""
    import atexit

    from fmpy import extract, read_model_description

    folder = tempfile.mkdtemp()
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    extract(path, unzipdir=folder)
    return folder, read_model_description(folder, validate=False)
