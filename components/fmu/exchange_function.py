"""The equations of an FMU for Model Exchange, as a function of event mode, time, states, inputs and parameters."""

from __future__ import annotations

import ctypes
import os
import weakref
from typing import Any

import numpy as np

from acausal import External
from acausal.core.externals import FMI_FUNCTIONS, PREPARE, FmuData, external_data
from acausal.core.library import address, loaded
from components.fmu.instance import end, initialized
from components.fmu.interface import Interface

NEVER = 1e300  # no time event: finite, as a condition compares it
MOST_ITERATIONS = 100  # of an event: FMUs that need more switch back and forth
NAMES = {
    "2.0": (
        *("SetTime", "SetContinuousStates", "GetDerivatives", "GetEventIndicators"),
        *("SetReal", "GetReal", "CompletedIntegratorStep", "GetDirectionalDerivative"),
    ),
    "3.0": (
        *("SetTime", "SetContinuousStates", "GetContinuousStateDerivatives", "GetEventIndicators"),
        *("SetFloat64", "GetFloat64", "CompletedIntegratorStep", "GetDirectionalDerivative"),
    ),
}


class ExchangeFunction(External):
    """Function of an event mode, time, states, inputs, discrete inputs and parameters.

    Its values are the derivatives of the states, the continuous outputs, the event indicators, and, of an FMU that is told of
    steps, whether it asks for an event. An event mode is the number of a state of the FMU that was saved; -1 is that after its
    initialization, 0 the only one of an FMU that saves none.

    Parameters
    ----------
    interface : Interface
        The FMU.
    """

    def __init__(self, interface: Interface) -> None:
        own = interface.dynamics
        assert own is not None
        self.interface, self.dynamics = interface, own
        self.nx, self.nu, self.ny = len(own.states), len(own.inputs), len(own.outputs)
        self.argument = np.zeros(2 + self.nx + self.nu + len(own.discrete_inputs) + len(interface.parameters))
        names = [f"the derivative of {s.name}" for s in own.states] + [f"the output {s.name}" for s in own.outputs]
        names += [f"event indicator {k + 1}" for k in range(own.indicators)] + ["the wish for an event"] * own.completes
        self.data, self._arrays = self._core_data(len(names))
        super().__init__(os.path.basename(interface.path), names, self.data)
        self.completes = own.completes
        self.fmu: Any = None
        self._begun: bytes | None = None  # parameters of the last initialization
        self._saved, self._next, self._mode = dict[int, Any](), 0, -1
        self.next_event = NEVER

    def _core_data(self, m: int) -> tuple[FmuData, dict[str, np.ndarray]]:
        """Return what the core takes, and arrays whose addresses it holds."""
        own, n = self.dynamics, 1 + self.nx + self.nu
        arrays = {
            "known_ref": np.array([s.reference for s in (*own.states, *own.inputs)], dtype=np.uint32),
            "unknown_ref": np.array([*own.derivatives, *(s.reference for s in own.outputs)], dtype=np.uint32),
            "nominal": np.array([s.nominal for s in (*own.states, *own.inputs)], dtype=float),
            "now": np.zeros(len(self.argument)),
            "values": np.zeros(m),
            "before": np.zeros(m),
            "slopes": np.zeros(m * n),
            "known_slope": np.zeros(n, dtype=np.int32),
        }
        arrays["now"][2 : n + 1] = [s.raw for s in (*own.states, *own.inputs)]
        ready = weakref.WeakMethod(self._ready)  # no cycle, so that the FMU ends with its last use
        self._prepare = PREPARE(lambda: ready()())  # type: ignore[misc]
        library = loaded(runs=False)
        data = FmuData(external_data(self.argument, library.ac_fmu_value, library.ac_fmu_completed))
        data.version, data.completes, data.prepare = int(self.interface.version[0]), own.completes, self._prepare
        data.states, data.inputs, data.outputs, data.indicators = self.nx, self.nu, self.ny, own.indicators
        for name, array in arrays.items():
            setattr(data, name, address(array) if array.size else None)
        return data, arrays

    def begin(self, time: float, u: Any, d: Any, p: Any) -> np.ndarray:
        """Initialize the FMU; return its states."""
        new = self.fmu is None
        self.fmu = initialized(self.interface, "ModelExchange", time, p, self._inputs(u, d), self.fmu)
        if new:
            self._bind()
        self.iterate()
        self.fmu.enterContinuousTimeMode()
        if self.dynamics.saves:
            self._keep(-1)
        self._begun, self._mode, self.data.ready = bytes(np.asarray(p, dtype=float)), -1, 0
        self.error = None
        return self.states()

    def states(self) -> np.ndarray:
        """Return the continuous states."""
        x = np.zeros(self.nx)
        if self.nx:
            self.fmu.getContinuousStates(x.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), self.nx)
        return x

    def _bind(self) -> None:
        """Tell the core the functions of the FMU."""
        self.data.instance = ctypes.cast(self.fmu.component, ctypes.c_void_p).value
        prefix = f"fmi{self.interface.version[0]}"
        for name, function in zip(FMI_FUNCTIONS, NAMES[self.interface.version], strict=True):
            if name != "directional" or self.dynamics.directional:
                setattr(self.data, name, ctypes.cast(getattr(self.fmu.dll, prefix + function), ctypes.c_void_p).value)

    def __del__(self) -> None:
        end(getattr(self, "fmu", None))

    def parts(self, argument: np.ndarray) -> tuple[Any, ...]:
        """Return event mode, time, states, inputs, discrete inputs and parameters."""
        ends = np.cumsum([2, self.nx, self.nu, len(self.dynamics.discrete_inputs)])
        return argument[0], argument[1], *np.split(argument[2:], ends[1:] - 2)

    def _ready(self) -> int:
        """Bring the FMU into the event mode of the arguments."""
        mode, time, _, u, d, p = self.parts(self.argument)
        try:
            if self._begun != bytes(p) and (mode < 0 or not self.dynamics.saves):
                self.begin(time, u, d, p)
            elif self._mode != mode and self.dynamics.saves:
                self._restore(int(mode))
        except Exception as error:  # none passes the core
            self.error = error
            return 0
        return 1

    def at(self, place: int) -> float:
        """Return a value at the arguments."""
        return loaded(runs=False).ac_fmu_value(ctypes.byref(self.data), place)

    def save(self) -> int:
        """Save the state of the FMU; return the number of its event mode."""
        self._mode, self._next = self._next, self._next + 1
        self._keep(self._mode)
        return self._mode

    def _keep(self, mode: int) -> None:
        old = self._saved.pop(mode, None)
        if old is not None:
            self._of_state("free")(old)
        self._saved[mode] = self._of_state("get")()

    def _restore(self, mode: int) -> None:
        if mode not in self._saved:
            raise ValueError(f"{self.path}: the state of its event mode {mode} is not in this process")
        self._of_state("set")(self._saved[mode])
        self._mode = mode

    def _of_state(self, what: str) -> Any:
        return getattr(self.fmu, f"{what}FMU{'state' if self.interface.version == '2.0' else 'State'}")

    def iterate(self) -> bool:
        """Iterate over the discrete states, to the next event; return whether the states have changed.

        Raises
        ------
        ValueError
            If the FMU ends the run, or the iteration does not.
        """
        changed = False
        for _ in range(MOST_ITERATIONS):
            if self.interface.version == "2.0":
                again, ends, _, moved, known, time = self.fmu.newDiscreteStates()
            else:
                again, ends, _, moved, known, time = self.fmu.updateDiscreteStates()
            changed |= bool(moved)
            if ends:
                raise ValueError(f"{self.path} ends the run")
            if not again:
                self.next_event = time if known else NEVER
                return changed
        raise ValueError(f"{self.path} needs more than {MOST_ITERATIONS} iterations at an event")

    def _inputs(self, u: Any, d: Any) -> list[float]:
        """Return the inputs in SI in the order of the FMU."""
        own = self.dynamics
        values = {
            s.field: s.factor * x + s.offset for s, x in zip((*own.inputs, *own.discrete_inputs), (*u, *d), strict=True)
        }
        return [values[s.field] for s in self.interface.inputs]
