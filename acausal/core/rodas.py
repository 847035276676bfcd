"""The one-step method of the core."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import byref, pointer
from dataclasses import dataclass, replace
from enum import IntEnum
from functools import cached_property

import casadi as ca
import numpy as np

from acausal.core.curve import Curve
from acausal.core.library import EquationsData, Pool, Progress, RequestData, address, loaded
from acausal.core.tape import Tape, make_tape
from acausal.instructions import READABLE
from acausal.locks import unlocked
from acausal.signals import Signals
from acausal.symbols import dense


class End(IntEnum):
    """How an integration ended.

    At its last output; after the steps it was given; with too many between two outputs; where no step was short enough,
    for the tolerance (`SHORT`) or for the equations to have a value and a regular Jacobian (`UNSOLVED`); without memory.
    """

    DONE = 0
    MORE = 1
    MANY = 2
    SHORT = 3
    UNSOLVED = 4
    MEMORY = 5


@dataclass(frozen=True, eq=False)
class Equations:
    """Equations x' = f, 0 = g of states and algebraic unknowns, and what is integrated besides, as tapes.

    Attributes
    ----------
    nx, nz, np, nc : int
        Numbers of states, algebraic unknowns, parameters and constants of a segment.
    values, slopes, powers : Tape
        f and g; entries of their Jacobian, and their derivatives by time where they depend on it; at most two powers.
    start, row, diagonal : arrays of int
        Sparsity of the Jacobian in columns, and the places in it of the diagonal of the states.
    """

    nx: int
    nz: int
    np: int
    nc: int
    values: Tape
    slopes: Tape
    powers: Tape | None
    start: np.ndarray
    row: np.ndarray
    diagonal: np.ndarray

    @cached_property
    def data(self) -> EquationsData:
        """What the library takes; it holds addresses of the arrays of these equations."""
        tapes = (self.values.data, self.slopes.data, self.powers.data if self.powers else None)
        return EquationsData(
            *(self.nx, self.nz, self.np, self.nc),
            *(None if tape is None else pointer(tape) for tape in tapes),
            *(array.ctypes.data for array in (self.start, self.row, self.diagonal)),
        )

    @cached_property
    def pool(self) -> Pool:
        """Memory of the method for these equations."""
        return Pool("rodas", self.data)


def make_equations(x: ca.SX, z: ca.SX, t: ca.SX, p: ca.SX, c: ca.SX, ode: ca.SX, alg: ca.SX) -> Equations:
    """Return equations as tapes.

    Parameters
    ----------
    x, z, t, p, c : casadi.SX
        States, algebraic unknowns, time, parameters and constants of a segment.
    ode, alg : casadi.SX
        Derivatives of the states, and residuals.
    """
    nx, nz = x.numel(), z.numel()
    y, F = ca.vertcat(x, z), ca.vertcat(dense(ode), dense(alg))
    J = ca.jacobian(F, y)
    own = ca.Sparsity.triplet(nx + nz, nx + nz, list(range(nx)), list(range(nx)))
    pattern = J.sparsity() + own
    entries = ca.project(J, pattern).nz[:]
    by_time = ca.jacobian(F, t)
    slopes = ca.vertcat(entries, dense(by_time)) if by_time.nnz() else entries
    arguments = [x, z, t, p, c]

    start, row = (np.array(part, dtype=np.int32) for part in (pattern.colind(), pattern.row()))
    diagonal = np.array([pattern.get_nz(k, k) for k in range(nx)], dtype=np.int32)
    return Equations(
        *(nx, nz, p.numel(), c.numel()),
        *(_tape("values", arguments, F), _tape("slopes", arguments, slopes), None),
        *(start, row, diagonal),
    )


def with_powers(equations: Equations, arguments: Sequence[ca.SX], powers: ca.SX) -> Equations:
    """Return equations with at most two expressions in x, z, t, p, c that are integrated besides."""
    return replace(equations, powers=_tape("powers", arguments, powers))


def _tape(name: str, arguments: Sequence[ca.SX], column: ca.SX) -> Tape:
    return make_tape(ca.Function(name, list(arguments), [dense(column)], READABLE), early=(3, 4))


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


class Rodas:
    """An integrator with memory of its own, for one thread at a time.

    Parameters
    ----------
    equations : Equations
        What is integrated.

    Attributes
    ----------
    progress : Progress
        Counts since it began, and the time that was reached.
    """

    def __init__(self, equations: Equations) -> None:
        self._library, self.equations = loaded(), equations
        self._memory = equations.pool.take()
        self.progress = Progress()
        self._request: tuple[object, ...] = ()
        self._steps = np.empty(0), np.empty((0, 0)), None

    def __del__(self) -> None:
        if getattr(self, "_memory", None):
            self.equations.pool.give(self._memory)

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
        room: int = 0,
        curves: bool = False,
    ) -> Outputs:
        """Prepare an integration from the first of some times to the last; return what `go` fills.

        Parameters
        ----------
        times : array, shape (n + 1,)
            Start and output times.
        x, z, p, c : arrays
            States and algebraic unknowns at the start, consistent; parameters; constants of the segment.
        size : array, shape (nx,)
            Sizes of the states: the error of a step is that over tolerance (size + |x|), root mean square.
        tolerance : float
            Relative tolerance.
        first_step : float, optional
            Length of the first step that is tried; chosen if 0.
        rate : array, shape (nx,), optional
            Whether a state is the rate of another one; the first step resolves how these change.
        smooth : bool, optional
            Whether the error of rates leaves out vibrations that a step does not resolve.
        largest : bool, optional
            Whether the largest error of a state counts, not their root mean square.
        singular : bool, optional
            Whether positions of closed loops may be passed at which algebraic unknowns grow without end: whether their equations
            are solved where a step ends does not count then.
        most : int, optional
            Steps between two outputs.
        room : int, optional
            Most steps that are kept, see `steps`.
        curves : bool, optional
            Whether their interpolants are kept instead of outputs, see `curve`.
        """
        e, n = self.equations, len(times) - 1
        rows = 0 if curves else n
        found = Outputs(*(np.full((rows, *shape), np.nan) for shape in ((e.nx,), (e.nz,), (2,), ())))
        times, x, z, p, c, size = (np.ascontiguousarray(a, dtype=float) for a in (times, x, z, p, c, size))
        if (len(x), len(z), len(p), len(c), len(size)) != (e.nx, e.nz, e.np, e.nc, e.nx):
            raise ValueError("the arguments do not fit the equations")
        chosen = None if rate is None else np.ascontiguousarray(rate, dtype=np.int32)
        ends = np.empty(room), np.empty((room, e.nx + e.nz))
        self._steps = *ends, np.empty((room, 3, e.nx + e.nz)) if curves else None
        self._last = times[0], np.concatenate([x, z])
        written = (None,) * 4 if curves else (found.x, found.z, found.integral, found.taken)
        places = map(address, (times, *written))
        kept = map(address, self._steps)
        request = RequestData(
            *(tolerance, first_step, address(size), address(chosen), smooth, largest, singular, most, n),
            *(*places, room, *kept),
        )
        # The library keeps the addresses of these, too.
        self._request = (times, size, chosen, found)
        self.progress = Progress()
        self._library.ac_rodas_begin(self._memory, byref(request), *map(address, (x, z, p, c)))
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
            end = End(self._library.ac_rodas_go(self._memory, min(steps, at_once), byref(self.progress)))
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
        self._library.ac_rodas_move(self._memory, *map(address, (x, z)))

    def allow(self, most: int) -> None:
        """Take so many steps between two outputs at most from now on, as after `End.MANY`."""
        self._library.ac_rodas_allow(self._memory, most)

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
        return Curve(*self.steps, np.empty((0, 3, 0)) if dense is None else dense[:kept].copy())
