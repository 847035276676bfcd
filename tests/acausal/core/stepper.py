"""Steppers of the core, without events."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import POINTER, Structure, byref, c_double, c_int32, c_int64, c_void_p, pointer
from dataclasses import dataclass, replace
from functools import cache

import casadi as ca
import numpy as np

from acausal.core import End, Equations, make_tape, why_no_idas
from acausal.core.library import TapeData, address, loaded
from acausal.instructions import READABLE
from acausal.locks import unlocked
from acausal.signals import Signals
from acausal.symbols import dense

# Rows of coefficients of the interpolant of each method.
ROWS = {"rodas": 3, "ida": 4}


class EquationsData(Structure):
    """What the library takes as equations, see `core.h`."""

    _fields_ = (
        *((name, c_int32) for name in ("nx", "nz", "np", "nc")),
        *((name, POINTER(TapeData)) for name in ("values", "slopes", "powers", "kinks")),
        *((name, c_void_p) for name in ("start", "row", "diagonal")),
    )


class RequestData(Structure):
    """What the library takes as the request for an integration, see `stepper.h`."""

    _fields_ = (
        ("tolerance", c_double),
        ("first_step", c_double),
        ("size", c_void_p),
        ("rate", c_void_p),
        ("smooth", c_int32),
        ("largest", c_int32),
        ("singular", c_int32),
        ("most", c_int64),
        ("share", c_int32),
        ("outputs", c_int32),
        *((name, c_void_p) for name in ("time", "x", "z", "integral", "taken")),
        ("room", c_int32),
        *((name, c_void_p) for name in ("step_time", "step_y", "step_dense")),
        ("order", c_int32),
        ("newton", c_double),
    )


class Progress(Structure):
    """Counts of an integration, written outputs, kept steps, and the time that was reached, see `stepper.h`."""

    _fields_ = (
        *((name, c_int64) for name in ("steps", "refused", "slopes", "values", "pivots")),
        ("written", c_int32),
        ("kept", c_int32),
        ("time", c_double),
        ("turned", c_int64),
        ("factors", c_int64),
    )


FUNCTIONS = {
    "ac_rodas_make": (c_void_p, (POINTER(EquationsData),)),
    "ac_ida_make": (c_void_p, (POINTER(EquationsData),)),
    "ac_stepper_begin": (None, (c_void_p, POINTER(RequestData), *[c_void_p] * 4)),
    "ac_stepper_move": (None, (c_void_p, c_void_p, c_void_p)),
    "ac_stepper_allow": (None, (c_void_p, c_int64)),
    "ac_stepper_go": (c_int32, (c_void_p, c_int64, POINTER(Progress))),
    "ac_stepper_renew": (None, (c_void_p,)),
    "ac_stepper_free": (None, (c_void_p,)),
}


@cache
def library() -> ctypes.CDLL:
    """Return the library with the types of its steppers."""
    core = loaded()
    for name, (result, arguments) in FUNCTIONS.items():
        function = getattr(core, name)
        function.restype, function.argtypes = result, arguments
    return core


def with_powers(equations: Equations, arguments: Sequence[ca.SX], powers: ca.SX) -> Equations:
    """Return equations with at most two expressions in x, z, t, p, c that are integrated besides."""
    tape = make_tape(ca.Function("powers", list(arguments), [dense(powers)], READABLE), early=(3, 4))
    return replace(equations, powers=tape)


def idas(equations: Equations) -> Stepper:
    """Return IDAS as an integrator of some equations, whose library has to be loaded."""
    assert not why_no_idas()
    return Stepper(equations, "ida")


def data_of(e: Equations) -> EquationsData:
    """Return what the library takes; it holds addresses of the arrays of these equations."""
    tapes = (e.values.data, e.slopes.data, *(t.data if t else None for t in (e.powers, e.kinks)))
    return EquationsData(
        *(e.nx, e.nz, e.np, e.nc),
        *(None if tape is None else pointer(tape) for tape in tapes),
        *(array.ctypes.data for array in (e.start, e.row, e.diagonal)),
    )


@dataclass(frozen=True, eq=False)
class Curve:
    """Interpolants of steps in a row.

    Attributes
    ----------
    times : array, shape (m + 1,)
        Ends of the steps, ascending.
    y : array, shape (m + 1, n)
        Values there.
    dense : array, shape (m, rows, n)
        Coefficients of each step, as the library has them.
    """

    times: np.ndarray
    y: np.ndarray
    dense: np.ndarray

    def __call__(self, times: np.ndarray) -> np.ndarray:
        """Values at times in these steps, shape (k, n)."""
        k = np.clip(np.searchsorted(self.times, times) - 1, 0, len(self.dense) - 1)
        s = ((times - self.times[k]) / (self.times[k + 1] - self.times[k]))[:, None]
        *rest, d = np.moveaxis(self.dense[k], 1, 0)
        for row in reversed(rest):
            d = row + s * d
        return (1 - s) * self.y[k] + s * (self.y[k + 1] + (1 - s) * d)


@dataclass(frozen=True)
class Outputs:
    """Values at the outputs of an integration; those that it has not reached are nan.

    Attributes
    ----------
    x, z, integral : arrays, shapes (n, nx), (n, nz), (n, 2)
        States, algebraic unknowns as they are interpolated, integrals of the powers.
    taken : array, shape (n,)
        Steps up to each output, with the part of the one in which it lies.
    """

    x: np.ndarray
    z: np.ndarray
    integral: np.ndarray
    taken: np.ndarray


class Stepper:
    """An integrator with memory of its own, for one thread at a time.

    Parameters
    ----------
    equations : Equations
        What is integrated.
    method : str, optional
        "rodas" for Rodas5P, or "ida" for IDAS, whose library has to be loaded, see `sundials`.

    Attributes
    ----------
    progress : Progress
        Counts since it began, and the time that was reached.
    """

    def __init__(self, equations: Equations, method: str = "rodas") -> None:
        self._library, self.equations, self.method = library(), equations, method
        self._data = data_of(equations)
        self._memory = getattr(self._library, f"ac_{method}_make")(byref(self._data))
        self.progress = Progress()
        self._request: tuple[object, ...] = ()
        self._steps = np.empty(0), np.empty((0, 0)), None

    def __del__(self) -> None:
        if getattr(self, "_memory", None):
            self._library.ac_stepper_free(self._memory)

    def begin(
        self,
        times: np.ndarray,
        x: np.ndarray,
        z: np.ndarray,
        p: np.ndarray,
        c: np.ndarray,
        *,
        size: np.ndarray,
        tolerance: float,
        first_step: float = 0.0,
        rate: np.ndarray | None = None,
        smooth: bool = False,
        largest: bool = False,
        singular: bool = False,
        most: int = 2**62,
        share: int = 1,
        room: int = 0,
        curves: bool = False,
        order: int = 5,
        newton: float = 0.05,
    ) -> Outputs:
        """Prepare an integration from the first of some times to the last, from consistent values; return what `go` fills.

        Arguments are those of `ac_request`. `share` outputs share `most` steps; `room` steps are kept, see `steps`, and with
        `curves` their interpolants in place of outputs, see `curve`.
        """
        e, n = self.equations, len(times) - 1
        rows = 0 if curves else n
        found = Outputs(*(np.full((rows, *shape), np.nan) for shape in ((e.nx,), (e.nz,), (2,), ())))
        times, x, z, p, c, size = (np.ascontiguousarray(a, dtype=float) for a in (times, x, z, p, c, size))
        sizes = e.nx if self.method == "rodas" else e.nx + e.nz
        if (len(x), len(z), len(p), len(c), len(size)) != (e.nx, e.nz, e.np, e.nc, sizes):
            raise ValueError("the arguments do not fit the equations")
        chosen = None if rate is None else np.ascontiguousarray(rate, dtype=np.int32)
        ends = np.empty(room), np.empty((room, e.nx + e.nz))
        self._steps = *ends, np.empty((room, ROWS[self.method], e.nx + e.nz)) if curves else None
        self._last = times[0], np.concatenate([x, z])
        written = (None,) * 4 if curves else (found.x, found.z, found.integral, found.taken)
        places = map(address, (times, *written))
        kept = map(address, self._steps)
        request = RequestData(
            *(tolerance, first_step, address(size), address(chosen), smooth, largest, singular, most, share, n),
            *(*places, room, *kept, order, newton),
        )
        # The library keeps the addresses of these, too.
        self._request = (times, size, chosen, found)
        self.progress = Progress()
        self._library.ac_stepper_begin(self._memory, byref(request), *map(address, (x, z, p, c)))
        return found

    def go(self, steps: int, at_once: int = 2**62) -> End:
        """Take some steps at most, refused ones among them, while other threads may go on.

        Parameters
        ----------
        steps : int
            How many.
        at_once : int, optional
            How many of them an interrupt waits for.

        Returns
        -------
        End
            `MORE` where outputs are left.
        """
        times, y, _ = self._steps
        if kept := self.progress.kept:
            self._last = times[kept - 1], y[kept - 1].copy()
        end = unlocked(lambda: self._go(steps, at_once))
        if end == End.MEMORY:
            raise MemoryError
        return end

    def _go(self, steps: int, at_once: int) -> End:
        while True:
            end = End(self._library.ac_stepper_go(self._memory, min(steps, at_once), byref(self.progress)))
            steps -= at_once
            if end != End.MORE or steps <= 0:
                return end
            Signals.raise_lost()

    @property
    def last(self) -> tuple[float, np.ndarray, np.ndarray]:
        """Time, states and algebraic unknowns after the last step, which was kept."""
        times, y = self.steps
        return float(times[-1]), y[-1, : self.equations.nx], y[-1, self.equations.nx :]

    def move(self, x: np.ndarray, z: np.ndarray) -> None:
        """Go on from other states and algebraic unknowns, near those after the last step."""
        self._library.ac_stepper_move(self._memory, *map(address, (x, z)))

    def allow(self, most: int) -> None:
        """Take so many steps between two outputs at most from now on, as after `End.MANY`."""
        self._library.ac_stepper_allow(self._memory, most)

    @property
    def steps(self) -> tuple[np.ndarray, np.ndarray]:
        """Times and values, of which the states come first, before and after each step since it was last told to go on.

        Only as many steps as there is room for.
        """
        kept, (times, y, _), (time, first) = self.progress.kept, self._steps, self._last
        return np.append(time, times[:kept]), np.vstack([first, y[:kept]])

    @property
    def curve(self) -> Curve:
        """The interpolants of these steps, if they are kept."""
        kept, dense = self.progress.kept, self._steps[2]
        return Curve(*self.steps, np.empty((0, 1, 0)) if dense is None else dense[:kept].copy())
