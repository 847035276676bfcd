"""Watched conditions at one place of a segment, and at many."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from acausal.solve.events.crossing import Sides
from acausal.solve.point import Point, Rows


@dataclass(frozen=True, eq=False)
class Sample:
    """Watched conditions at a point: excesses and their rates, positive if unchanged."""

    at: Point
    value: np.ndarray
    rate: np.ndarray

    @property
    def time(self) -> float:
        """Time in s."""
        return self.at.time


@dataclass(frozen=True, eq=False)
class Samples:
    """The same in n rows of a segment, of which a point tells the constants and which conditions hold.

    Attributes
    ----------
    of : Point
        Any point of the segment.
    rows : Rows
        Where they are.
    value, rate : arrays, shape (n, m)
        Excesses and rates of m conditions.
    """

    of: Point
    rows: Rows
    value: np.ndarray
    rate: np.ndarray

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, k: int) -> Sample:
        rows, of = self.rows, self.of
        at = Point(float(rows.times[k]), rows.x[k], rows.z[k], of.constants, of.mode)
        return Sample(at, self.value[k], self.rate[k])

    def before(self, n: int) -> Samples:
        """Return the first n."""
        return Samples(self.of, self.rows[:n], self.value[:n], self.rate[:n])

    @property
    def sides(self) -> Sides:
        """They as functions of time."""
        return Sides(self.rows.times, self.value, self.rate)
