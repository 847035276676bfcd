"""What was integrated so far."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from acausal.compiler.constants import Constants
from acausal.solve.point import Point, Rows


class Piece(NamedTuple):
    """Rows, and integrals of the supplied and of the dissipated power up to each in J, shape (n, 2)."""

    rows: Rows
    energy: np.ndarray


@dataclass
class Trace:
    """What was integrated: rows in pieces, each added or exchanged whole, so that an interrupt never finds a part."""

    pieces: list[Piece] = field(default_factory=list)
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
    changes: list[str] = field(default_factory=list)

    def emptied(self) -> Trace:
        """Return a trace without rows in which the counts continue."""
        names = ("steps", "factorisations", "residual_evaluations", "calls", "choices", "seconds", "building")
        return Trace(**{name: getattr(self, name) for name in names}, methods=dict(self.methods))

    def rows(self, first: Point) -> Rows:
        """Return all rows, the point of the start before them."""
        return Rows.joined([Rows.of(first), *(piece.rows for piece in self.pieces)])

    def states(self, first: Point) -> list[np.ndarray]:
        """Return the states of all rows, piece by piece."""
        return [first.x[None], *(piece.rows.x for piece in self.pieces)]

    @property
    def energy(self) -> np.ndarray:
        """Integrals of the supplied and of the dissipated power up to the last row, in J."""
        return self.pieces[-1].energy[-1] if self.pieces else self.before

    def cut(self, time: float) -> None:
        """Drop the rows from a time on."""
        ends = [np.searchsorted(piece.rows.times, time) for piece in self.pieces]
        self.pieces = [Piece(rows[:n], energy[:n]) for (rows, energy), n in zip(self.pieces, ends, strict=True) if n]

    def count(self, method: str, steps: int, factorisations: int, evaluations: int, calls: int = 1) -> None:
        """Add the counts of a call, or of a part of one."""
        self.calls += calls
        self.steps += steps
        self.factorisations += factorisations
        self.residual_evaluations += evaluations
        self.methods[method] = self.methods.get(method, 0) + steps

    def include(self, other: Trace) -> None:
        """Add the counts of an integration beside the run."""
        self.factorisations += other.factorisations
        self.residual_evaluations += other.residual_evaluations
        self.calls += other.calls
        self.seconds += other.seconds
        for method, steps in other.methods.items():
            self.steps += steps
            self.methods[method] = self.methods.get(method, 0) + steps

    @contextmanager
    def counting(self, method: str, counts: Callable[[], Sequence[int]]) -> Iterator[None]:
        """Add the time that the block takes, and the arguments of `count` that are known after it, even if it is interrupted."""
        started = clock.perf_counter()
        try:
            yield
        finally:
            self.count(method, *counts())
            self.seconds += clock.perf_counter() - started

    def add(self, leg: Leg) -> None:
        """Append rows; integrals of power continue from the last one."""
        self.pieces.append(Piece(leg.rows, leg.energy + self.energy))

    def put(self, piece: int, at: Point) -> None:
        """Put the values of a point into the last row of a piece, if there is one, which keeps its time."""
        if len(self.pieces) >= -piece:
            rows, energy = self.pieces[piece]
            here = replace(Rows.of(at), times=rows.times[-1:])
            self.pieces[piece] = Piece(Rows.joined([rows[:-1], here]), energy)

    def delay(self, time: float) -> None:
        """Let the last row be at another time, a rounding error away."""
        if self.pieces:
            rows, energy = self.pieces[-1]
            self.pieces[-1] = Piece(replace(rows, times=np.append(rows.times[:-1], time)), energy)

    def spend(self, energy: np.ndarray) -> None:
        """Add supplied and dissipated energy to all that follows, and to the last row."""
        if self.pieces:
            rows, before = self.pieces[-1]
            self.pieces[-1] = Piece(rows, np.vstack([before[:-1], before[-1] + energy]))
        else:
            self.before = self.before + energy


@dataclass(frozen=True)
class Leg:
    """Rows of one slice; integrals of power since its start, shape (n, 2); constants."""

    rows: Rows
    energy: np.ndarray
    constants: Constants

    @property
    def times(self) -> np.ndarray:
        """Times of the rows in s."""
        return self.rows.times

    def since(self, at: Point) -> Rows:
        """Return the rows, and the point at which the call began before them, all with the constants of the call."""
        return Rows.joined([Rows.of(replace(at, constants=self.constants)), self.rows])

    def end(self, at: Point) -> Point:
        """Return the last row as a point; `at` tells which conditions hold."""
        rows = self.rows
        return Point(float(rows.times[-1]), rows.x[-1], rows.z[-1], self.constants, at.mode)

    def part(self, first: int, last: int) -> Leg:
        """Return some of the rows, as if the call had begun at its start nevertheless."""
        some = slice(first, last)
        return replace(self, rows=self.rows[some], energy=self.energy[some])
