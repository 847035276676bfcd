"""State of a run at one time, and at many times, as arguments of the functions of a model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from acausal.compiler.constants import Constants


@dataclass(frozen=True, eq=False)
class Point:
    """State of a run: time in s, states, algebraic unknowns, constants, and mode: which conditions hold."""

    time: float
    x: np.ndarray
    z: np.ndarray
    constants: Constants
    mode: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=bool))

    @property
    def y(self) -> np.ndarray:
        """States and algebraic unknowns."""
        return np.concatenate([self.x, self.z])

    def differs(self, other: Point) -> bool:
        """Return whether states, constants or modes differ."""
        mine, others = ((at.x, at.constants.vector, at.mode) for at in (self, other))
        return any((one != another).any() for one, another in zip(mine, others, strict=True))

    def with_y(self, y: np.ndarray) -> Point:
        """Return the point with other states and algebraic unknowns."""
        return replace(self, x=y[: len(self.x)], z=y[len(self.x) :])


@dataclass(frozen=True, eq=False)
class Rows:
    """Values at n times.

    Attributes
    ----------
    times : array, shape (n,)
        Times in s.
    x, z : arrays, shapes (n, nx), (n, nz)
        States and algebraic unknowns.
    constants : array, shape (n, m)
        Vectors of the constants of a segment.
    """

    times: np.ndarray
    x: np.ndarray
    z: np.ndarray
    constants: np.ndarray

    @classmethod
    def within(cls, times: np.ndarray, x: np.ndarray, z: np.ndarray, constants: np.ndarray) -> Rows:
        """Return rows of one segment, from the vector of its constants."""
        return cls(times, x, z, np.broadcast_to(constants, (len(times), len(constants))))

    @classmethod
    def of(cls, *points: Point) -> Rows:
        """Return one row for each point."""
        columns = [(at.x, at.z, at.constants.vector) for at in points]
        return cls(np.array([at.time for at in points]), *(np.array(c) for c in zip(*columns, strict=True)))

    @classmethod
    def joined(cls, parts: Sequence[Rows]) -> Rows:
        """Return the rows of all parts, in order."""
        columns = ((one.times, one.x, one.z, one.constants) for one in parts)
        return cls(*(np.concatenate(column) for column in zip(*columns, strict=True)))

    def __len__(self) -> int:
        return len(self.times)

    def __getitem__(self, some: slice | np.ndarray | list[int]) -> Rows:
        if (
            isinstance(some, np.ndarray)
            and some.dtype != bool
            and len(some) == len(self)
            and np.all(np.diff(some) == 1)
        ):
            return self  # all rows: copying a long run takes as long as evaluating it
        return Rows(self.times[some], self.x[some], self.z[some], self.constants[some])

    def with_z(self, z: np.ndarray) -> Rows:
        """Return the rows with other algebraic unknowns."""
        return replace(self, z=z)
