"""Runs of the hybrid loop of the core: integration, events and rows at outputs, in slices."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from ctypes import Structure, byref, c_double, c_int32, c_int64, c_void_p
from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from acausal.core.library import CALL, address
from acausal.core.unit import Unit
from acausal.locks import locked, unlocked


class Back(IntEnum):
    """Reason why a slice ended.

    The run is at its end; the row buffer is full; the slice took its steps; the iteration of an event failed; the loop cannot
    decide what happens next; or other independent constraints are to be selected.
    """

    END = 0
    FULL = 1
    PAUSED = 2
    EVENT = 3
    DOUBT = 4
    UNFIT = 5


class MethodData(Structure):
    """Method of a run, see `ac_run_method` and `ac_multistep` in the core."""

    _fields_ = (
        *((name, c_int32) for name in ("method", "damps", "blind")),
        *(("tolerance", c_double), ("step", c_double), ("size", c_void_p)),
        *((name, c_double) for name in ("test_tolerance", "newton")),
        ("order", c_int32),
    )


class RequestData(Structure):
    """Request for a slice, see `ac_run_request` in hybrid.h."""

    _fields_ = (
        ("end", c_double),
        ("steps", c_int64),
        ("longest", c_int64),
        ("outputs", c_int32),
        ("room", c_int32),
        *((name, c_void_p) for name in ("time", "row_time", "row_x", "row_z", "row_c", "row_work", "event_time")),
    )


class RunState(Structure):
    """Progress of a run since it began, see `ac_run_state` in hybrid.h."""

    _fields_ = (
        ("time", c_double),
        ("step", c_double),
        ("supplied", c_double),
        ("dissipated", c_double),
        *((name, c_int64) for name in ("steps", "refused", "factors", "values", "evaluations", "begun", "since")),
        *((name, c_int32) for name in ("rows", "events", "hasty", "why", "weak")),
    )


@dataclass(frozen=True)
class Multistep:
    """Settings of IDAS.

    Attributes
    ----------
    size : array, shape (nx + nz,)
        Sizes of states and algebraic unknowns in the error test and in Newton iterations.
    tolerance : float
        Relative tolerance of the error test.
    order : int
        Highest order.
    newton : float
        Part of the tolerance that Newton iterations may leave.
    """

    size: np.ndarray
    tolerance: float
    order: int
    newton: float


@dataclass(frozen=True)
class Rows:
    """Rows and events of one slice.

    Attributes
    ----------
    back : Back
        Why the slice ended.
    times, x, z, c : arrays, shapes (n,), (n, nx), (n, nz), (n, nc)
        Rows at outputs, after events and at the end; algebraic unknowns nearly right.
    work : array, shape (n, 2)
        Supplied and dissipated energy in J since the run began.
    events : array, shape (m,)
        Times of events in s.
    """

    back: Back
    times: np.ndarray
    x: np.ndarray
    z: np.ndarray
    c: np.ndarray
    work: np.ndarray
    events: np.ndarray


@dataclass(frozen=True, eq=False)
class Happened:
    """Outcome of an event iteration.

    Attributes
    ----------
    changed, failed : bool
        Whether anything changed, and whether the iteration failed.
    why : int
        Reason why it failed, see `Doubt`; 0 where the equations have no solution.
    acts : array of bool
        Conditions to blame where it failed, watched ones and those of time alone.
    """

    changed: bool
    failed: bool
    why: int
    acts: np.ndarray


class Run:
    """Instance of a model in the core, used by one thread at a time.

    Parameters
    ----------
    unit : Unit
        The model.
    sizes : (int, int, int, int, int)
        Numbers of states, algebraic unknowns, constants of a segment, watched conditions and conditions of time alone.
    room : int
        Rows of a slice at most.
    """

    def __init__(self, unit: Unit, sizes: tuple[int, int, int, int, int], room: int) -> None:
        self._library, self._sizes, self._unit, self._memory = unit.library, sizes, unit, None
        self.shares = False  # functions of other libraries with other runs, which then wait
        self._memory = self._library.ac_instance_make(unit.memory)
        if not self._memory:
            raise MemoryError
        nx, nz, nc, _, _ = sizes
        self._rows = [np.empty((room, n)) for n in (1, nx, nz, nc, 2)]
        self._events, self._room, self.state = np.empty(room), room, RunState()

    def __del__(self) -> None:
        if getattr(self, "_memory", None):
            self._library.ac_instance_free(self._memory)

    def calls(self, function: Callable[[int, float], int], arguments: np.ndarray, results: np.ndarray) -> None:
        """Take what calls functions at events, by the number of a call and the time; it returns whether that fails.

        The arguments and results of all calls stand in the arrays. Without it, functions keep their results.
        """
        self._function = CALL(function), arguments, results  # the library keeps their addresses
        self._library.ac_run_functions(self._memory, self._function[0], address(arguments), address(results))

    def tell_steps(self, functions: Sequence[int]) -> None:
        """Take addresses of functions of other libraries that are told of accepted steps."""
        self._externals = np.array(functions, dtype=np.uintp)  # the library keeps its address
        self._library.ac_run_externals(self._memory, len(functions), address(self._externals))

    def begin(
        self,
        time: float,
        x: np.ndarray,
        z: np.ndarray,
        p: np.ndarray,
        c: np.ndarray,
        mode: np.ndarray,
        *,
        step: float,
        tolerance: float,
        damps: bool = False,
        multistep: Multistep | None = None,
        events: bool = True,
    ) -> None:
        """Begin at a consistent point.

        Parameters
        ----------
        time : float
            In s.
        x, z, p, c : arrays
            States, algebraic unknowns, parameters and constants of the segment.
        mode : array of bool
            Which watched conditions hold.
        step : float
            First step in s, of IDAS the longest one; chosen if 0.
        tolerance : float
            Relative tolerance.
        damps : bool, optional
            Whether Rodas5P damps vibrations that coordinates do not show.
        multistep : Multistep, optional
            Settings of IDAS, if it integrates in place of Rodas5P.
        events : bool, optional
            Whether events happen.
        """
        given = [np.ascontiguousarray(a, dtype=float) for a in (x, z, p, c, mode)]
        self.state, method = RunState(time=time, step=step), MethodData(0, damps, not events, tolerance, step)
        if multistep:
            self._size = np.ascontiguousarray(multistep.size, dtype=float)  # the library keeps its address
            method = MethodData(
                *(1, False, not events, tolerance, step, address(self._size)),
                *(multistep.tolerance, multistep.newton, multistep.order),
            )
        if self._library.ac_run_begin(self._memory, byref(method), time, *map(address, given)):
            raise MemoryError

    def go(self, outputs: np.ndarray, end: float, *, steps: int, longest: int = 2**62) -> Rows:
        """Run one slice towards an end; the interpreter lock is released meanwhile.

        Parameters
        ----------
        outputs : array
            Output times in s, ascending.
        end : float
            End of the run in s.
        steps : int
            Steps after which the slice ends, rejected steps included.
        longest : int
            Steps between two outputs or events at most.
        """
        outputs = np.ascontiguousarray(outputs, dtype=float)
        request = RequestData(
            *(end, steps, longest, len(outputs), self._room, address(outputs)),
            *map(address, (*self._rows, self._events)),
        )
        call = self._library.ac_run_go
        carry = locked if self.shares else unlocked
        back = Back(carry(lambda: call(self._memory, byref(request), byref(self.state))))
        n, m = self.state.rows, self.state.events
        times, x, z, c, work = (rows[:n].copy() for rows in self._rows)
        return Rows(back, times[:, 0], x, z, c, work, self._events[:m].copy())

    def happen(self, c: np.ndarray, fires: np.ndarray, crossed: np.ndarray) -> Happened:
        """Let happen what happens where the run begins.

        Parameters
        ----------
        c : array
            Constants by the clock from then on.
        fires : array of bool
            Conditions of time alone that become true.
        crossed : array of int
            Watched conditions that change now: 1 where values tell how, 2 whatever the values.
        """
        given = [np.ascontiguousarray(a, dtype=float) for a in (c, fires, crossed)]
        acts, why = np.zeros(sum(self._sizes[3:])), c_int32()
        changed = self._library.ac_run_happen(self._memory, *map(address, (*given, acts)), byref(why))
        return Happened(changed > 0, changed < 0, why.value, acts > 0)

    def redundant(self, laws: int) -> np.ndarray:
        """Return which of the set-valued laws are redundant at rest, in the first decision that found some."""
        found = np.zeros(laws)
        self._library.ac_redundant_laws(self._memory, address(found))
        return np.flatnonzero(found)

    @property
    def message(self) -> str:
        """Message of the core after `Back.DOUBT`."""
        return self._library.ac_message(self._memory).decode()

    def values(self) -> tuple[np.ndarray, ...]:
        """Return states, algebraic unknowns, constants, watched conditions that hold, and those that change now."""
        nx, nz, nc, watched, _ = self._sizes
        found = [np.empty(n) for n in (nx, nz, nc, watched, watched)]
        self._library.ac_run_values(self._memory, *map(address, found))
        x, z, c, mode, crossed = found
        return x, z, c, mode > 0, crossed > 0

    def undefined(self) -> tuple[float, np.ndarray, np.ndarray]:
        """Return the time in s at which a condition has no value, with states and algebraic unknowns there."""
        x, z = (np.empty(n) for n in self._sizes[:2])
        return self._library.ac_run_undefined(self._memory, address(x), address(z)), x, z
