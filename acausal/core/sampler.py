"""Runs over instants that discrete variables plan, such as those of a sampled controller, at one go."""

from __future__ import annotations

from ctypes import POINTER, Structure, byref, c_double, c_int32, c_int64, c_void_p, pointer
from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from acausal.core.library import RequestData, loaded
from acausal.core.sampled import Sampled
from acausal.locks import unlocked


class Back(IntEnum):
    """Why the core came back.

    No more instants in the segment; no room for more rows, or no steps left; something else may happen before the next one.
    """

    NO_INSTANT = 0
    FULL = 1
    DOUBT = 2


THRESHOLDS = (
    "span",
    "tolerance",
    "soon",
    "moves",
    "level",
    "reach",
    "error",
    "shortest",
    "added",
    "crowded",
    "enough",
    "noise",
    "apart",
)


class SamplesData(Structure):
    """What the library takes as the request for a run over instants, see `core.h`."""

    _fields_ = (
        ("steps", POINTER(RequestData)),
        ("end", c_double),
        *((name, c_int64) for name in ("most", "longest", "ringing")),
        ("calm", c_double),
        *((name, c_int32) for name in ("density", "fine", "outputs")),
        *((name, c_double) for name in THRESHOLDS),
        *((name, c_void_p) for name in ("p", "time", "nominal", "declared")),
        ("room", c_int32),
        *((name, c_void_p) for name in ("row_time", "row_x", "row_z", "row_c", "row_event", "row_work", "peak")),
    )


class SampledState(Structure):
    """Where a run over instants is, and its counts so far; `step` is the longer of the last two, 0 for none."""

    _fields_ = (
        *((name, c_double) for name in ("time", "step")),
        *((name, c_int64) for name in ("steps", "refused", "values", "evaluations", "instants")),
        ("rows", c_int32),
    )

    @property
    def counts(self) -> tuple[int, int, int, int]:
        """Steps, factorisations, evaluations of the equations, and instants."""
        return self.steps, self.steps + self.refused, self.values, self.instants


@dataclass(frozen=True)
class Samples:
    """What a run over instants found.

    Attributes
    ----------
    back : Back
        Why it came back.
    times, x, z, c : arrays, shapes (n,), (n, nx), (n, nz), (n, nc)
        Rows: outputs, algebraic unknowns nearly right; and instants, after what happened.
    events : array, shape (n,)
        Time of the instant, nan at outputs.
    work : array, shape (n, 2)
        Supplied and dissipated energy up to each since it began, 0 where energies are not asked for.
    truth : array of bool
        Which conditions hold at the end.
    peak : array
        Greatest excess of each condition on its side.
    state : SampledState
        Counts, and the step to go on with.
    """

    back: Back
    times: np.ndarray
    x: np.ndarray
    z: np.ndarray
    c: np.ndarray
    events: np.ndarray
    work: np.ndarray
    truth: np.ndarray
    peak: np.ndarray
    state: SampledState


class Sampler:
    """A run over instants, with memory of its own, for one thread at a time.

    Parameters
    ----------
    sampled : Sampled
        The model.
    room : int
        Rows that it returns at most.
    thresholds : dict of float
        Those named in `THRESHOLDS`, see acausal/policy/events.py.
    p, times, nominal, declared : arrays
        Parameters; outputs in s; sizes of states and algebraic unknowns in the run; of algebraic unknowns as they were stated.
    size, rate, tolerance, smooth, largest, singular
        As of `Rodas.begin`.
    fine : int
        Parts of a step at whose ends conditions are looked at, at least.
    longest, ringing : int, optional
        Steps from one instant to the next, and where these are further apart than `calm`.
    calm : float, optional
        A time in s.
    """

    def __init__(
        self,
        sampled: Sampled,
        room: int,
        thresholds: dict[str, float],
        *,
        p: np.ndarray,
        times: np.ndarray,
        nominal: np.ndarray,
        declared: np.ndarray,
        size: np.ndarray,
        rate: np.ndarray,
        tolerance: float,
        smooth: bool,
        largest: bool,
        singular: bool,
        fine: int,
        longest: int = 2**62,
        ringing: int = 2**62,
        calm: float = np.inf,
    ) -> None:
        self._library, self.sampled, e = loaded(), sampled, sampled.equations
        self._memory = self._library.ac_sampler_make(byref(sampled.data))
        if not self._memory:
            raise MemoryError
        # The library takes addresses: these arrays live as long as this object.
        self._given = [np.array(a, dtype=float) for a in (p, times, nominal, declared, size)]
        rate, (p, times, nominal, declared, size) = np.array(rate, dtype=np.int32), self._given
        if (len(p), len(nominal), len(declared), len(size), len(rate)) != (e.np, e.nx + e.nz, e.nz, e.nx, e.nx):
            raise ValueError("the arguments do not fit the equations")
        self._rate, self._found = rate, [np.empty((room, n)) for n in (1, e.nx, e.nz, e.nc, 1, 2)]
        self._peak = np.empty(len(sampled.is_switch))
        steps = RequestData(
            tolerance=tolerance,
            size=size.ctypes.data,
            rate=rate.ctypes.data,
            smooth=smooth,
            largest=largest,
            singular=singular,
        )
        found = dict(zip(("row_time", "row_x", "row_z", "row_c", "row_event", "row_work"), self._found, strict=True))
        arrays = {"p": p, "time": times, "nominal": nominal, "declared": declared, "peak": self._peak, **found}
        self._request = SamplesData(
            *(pointer(steps),),
            **{name: array.ctypes.data for name, array in arrays.items()},
            **{name: thresholds[name] for name in THRESHOLDS},
            fine=fine,
            longest=longest,
            ringing=ringing,
            calm=calm,
            outputs=len(times),
            room=room,
        )

    def __del__(self) -> None:
        if getattr(self, "_memory", None):
            self._library.ac_sampler_free(self._memory)

    def go(
        self,
        state: SampledState,
        x: np.ndarray,
        z: np.ndarray,
        c: np.ndarray,
        truth: np.ndarray,
        *,
        end: float,
        steps: int,
        density: int,
    ) -> Samples:
        """Go on over instants before an end, while other threads may go on.

        Parameters
        ----------
        state : SampledState
            Time, and first step, chosen if 0; it is changed, even if an interrupt follows.
        x, z, c : arrays
            Where it is, consistent.
        truth : array of bool
            Which conditions hold there.
        end : float
            Of the segment in s.
        steps : int
            After how many, refused ones among them, it comes back at an instant.
        density : int
            Pairs of looks between two outputs at least.
        """
        e, request = self.sampled.equations, self._request
        x, z, c = (np.array(a, dtype=float) for a in (x, z, c))
        truth = np.array(truth, dtype=np.int32)
        if (len(x), len(z), len(c), len(truth)) != (e.nx, e.nz, e.nc, len(self._peak)):
            raise ValueError("the arguments do not fit the equations")
        self._peak[:] = -np.inf
        request.end, request.most, request.density = end, steps, density
        here = (array.ctypes.data for array in (x, z, c, truth))
        back = unlocked(lambda: self._library.ac_sampler_go(self._memory, byref(request), byref(state), *here))
        times, x, z, c, events, work = (array[: state.rows].copy() for array in self._found)
        return Samples(Back(back), times[:, 0], x, z, c, events[:, 0], work, truth > 0, self._peak.copy(), state)
