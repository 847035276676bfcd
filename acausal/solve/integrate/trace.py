"""What was integrated so far."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from acausal.compiler.constants import Constants
from acausal.solve.problem import Point


class Rows(NamedTuple):
    """Rows at times: states, algebraic unknowns, integrals of supplied and dissipated power, vectors of constants."""

    times: np.ndarray
    x: np.ndarray
    z: np.ndarray
    energy: np.ndarray
    constants: np.ndarray


@dataclass
class Trace:
    """What was integrated: rows in pieces, each added or exchanged whole, so that an interrupt never finds a part."""

    pieces: list[Rows] = field(default_factory=list)
    steps: int = 0
    factorisations: int = 0
    residual_evaluations: int = 0
    calls: int = 0
    choices: int = 0
    seconds: float = 0.0
    building: float = 0.0
    before: np.ndarray = field(default_factory=lambda: np.zeros(2))
    methods: dict[str, int] = field(default_factory=dict)
    loosened: list[float] = field(default_factory=list)
    orders: list[str] = field(default_factory=list)
    rough: bool = False

    def emptied(self) -> Trace:
        """Return a trace without rows in which the counts continue."""
        names = ("steps", "factorisations", "residual_evaluations", "calls", "choices", "seconds", "building")
        return Trace(**{name: getattr(self, name) for name in names}, methods=dict(self.methods))

    def rows(self, first: Point) -> Rows:
        """Return all rows, the point of the start before them."""
        constants = first.constants.vector[None]
        start = Rows(np.array([first.time]), first.x[None], first.z[None], np.zeros((1, 2)), constants)
        return Rows(*(np.concatenate(columns) for columns in zip(start, *self.pieces, strict=True)))

    def last(self) -> Rows:
        """Return the last row; there must be one."""
        return Rows(*(column[-1] for column in self.pieces[-1]))

    def until(self, time: float) -> Trace:
        """Return the rows before a time, with the same counts."""
        kept = [Rows(*(column[: np.searchsorted(piece.times, time)] for column in piece)) for piece in self.pieces]
        return replace(self, pieces=[piece for piece in kept if len(piece.times)])

    def count(self, stats: dict, plugin: str) -> int:
        """Add the counts of a call, and return its steps."""
        names = ("nsteps", "nlinsetups", "nfevals") if plugin == "idas" else ("n_steps", "n_jac", "n_rhs")
        steps, factorisations, evaluations = (int(stats.get(name, 0)) for name in names)
        self.calls += 1
        self.steps += steps
        self.factorisations += factorisations
        self.residual_evaluations += evaluations
        self.methods[plugin] = self.methods.get(plugin, 0) + steps
        return steps

    def add(self, stretch: Stretch) -> None:
        """Append rows; integrals of power continue from the last one."""
        energy = stretch.energy + (self.last().energy if self.pieces else self.before)
        vector = stretch.constants.vector
        constants = np.broadcast_to(vector, (len(stretch.times), len(vector)))
        self.pieces.append(Rows(stretch.times, stretch.x, stretch.z, energy, constants))

    def put(self, piece: int, at: Point) -> None:
        """Put the values of a point into the last row of a piece, if there is one."""
        self._replace(piece, x=at.x, z=at.z, constants=at.constants.vector)

    def delay(self, time: float) -> None:
        """Let the last row be at another time, a rounding error away."""
        self._replace(-1, times=np.array(time))

    def _replace(self, piece: int, **values: np.ndarray) -> None:
        if len(self.pieces) >= -piece:
            rows = self.pieces[piece]
            given = {name: np.concatenate([getattr(rows, name)[:-1], value[None]]) for name, value in values.items()}
            self.pieces[piece] = rows._replace(**given)

    def spend(self, energy: np.ndarray) -> None:
        """Add supplied and dissipated energy to all that follows, and to the last row."""
        if self.pieces:
            self._replace(-1, energy=self.last().energy + energy)
        else:
            self.before = self.before + energy


@dataclass(frozen=True)
class Stretch:
    """Rows of one call: times, states, algebraic unknowns, integrals of power since its start; constants and steps."""

    times: np.ndarray
    x: np.ndarray
    z: np.ndarray
    energy: np.ndarray
    constants: Constants
    steps: int

    def end(self, at: Point) -> Point:
        """Return the last row as a point; `at` tells which conditions hold."""
        return Point(float(self.times[-1]), self.x[-1], self.z[-1], self.constants, at.truth)

    def rows(self, first: int, last: int) -> Stretch:
        """Return some of the rows, as if the call had begun at its start nevertheless."""
        part = slice(first, last)
        return Stretch(self.times[part], self.x[part], self.z[part], self.energy[part], self.constants, self.steps)

    def every(self, parts: int) -> Stretch:
        """Return one row in so many, the last one of each."""
        part = slice(parts - 1, None, parts)
        return Stretch(self.times[part], self.x[part], self.z[part], self.energy[part], self.constants, self.steps)
