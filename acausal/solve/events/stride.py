"""How much time is integrated at once, and how often conditions are checked in it.

After an event the outputs are integrated in blocks of 1, 2, 4, ... intervals: their relative grids, and so the
integrators, are the same after each event.
"""

from __future__ import annotations

import numpy as np

from acausal.policy import POLICY
from acausal.solve.integrate.trace import Leg
from acausal.solve.looks import uneven

LOOKS = POLICY.looks


class Stride:
    """Times of the next leg.

    Parameters
    ----------
    times : array
        Output times in s.

    Attributes
    ----------
    density : int
        Pairs of looks in an interval.
    block : int
        Intervals in a leg; 0 for all that there are.
    piece : float
        Length of a leg in s, where that is less than an interval.
    """

    def __init__(self, times: np.ndarray) -> None:
        self.times = times
        self.interval = float(times[-1] - times[0]) / (len(times) - 1)
        self.densest = max(LOOKS.densest, LOOKS.rows // (len(times) - 1))
        self.density, self.block, self.piece = 1, 0, np.inf

    def outputs(self, now: float, end: float) -> np.ndarray:
        """Return a time, the outputs after it, and an end."""
        first, last = np.searchsorted(self.times, now, "right"), np.searchsorted(self.times, end)
        return np.concatenate([[now], self.times[first:last], [end]])

    def grid(self, now: float, end: float) -> np.ndarray:
        """Return the next times: all up to the end at first, blocks of equal intervals after an event."""
        grid = self.outputs(now, end)
        if now + self.piece < grid[1]:
            return np.array([now, now + self.piece])
        if not self.block:
            return grid
        steps = np.diff(grid)
        equal = int(np.argmin(np.append(np.isclose(steps, steps[0], rtol=LOOKS.equal), False)))
        return grid[: 1 + 2 ** int(np.log2(min(equal, self.block)))]

    def looks(self, grid: np.ndarray) -> np.ndarray:
        """Return the times at which conditions are checked in a grid."""
        n = len(grid) - 1
        pairs = self.density * (min(1.0, self.piece / self.interval) if n == 1 else 1.0)
        return uneven(grid, 2 ** max(1 + int(np.ceil(np.log2(pairs))), int(np.log2(LOOKS.fine / n))))

    def is_enough(self, leg: Leg, grid: np.ndarray) -> bool:
        """Whether a leg shows all that its steps do; the next one is denser or shorter if not."""
        if leg.steps <= LOOKS.steps_a_row * (len(leg.times) + 3):
            return True
        if self.density < self.densest:
            needed = max(LOOKS.denser * self.density, leg.steps / (LOOKS.steps_a_row * (len(grid) - 1)))
            while self.density < min(needed, self.densest):
                self.density *= LOOKS.denser
            self.density = min(self.density, self.densest)
        elif len(grid) > 2:
            self.block = max(1, (len(grid) - 1) // LOOKS.fine)
        else:
            self.piece = float(grid[1] - grid[0]) / LOOKS.fine
        return False

    def look_closer(self) -> bool:
        """Check more often from now on; False if the limit is reached."""
        if self.density >= self.densest:
            return False
        self.density = min(self.densest, LOOKS.denser * self.density)
        return True

    def lengthen(self) -> None:
        """Take more of the time next."""
        self.block *= 2
        self.piece *= 2

    def shorten(self, grid: np.ndarray) -> bool:
        """Take fewer intervals next; False if there is only one."""
        if len(grid) <= 2:
            return False
        self.block = max(1, (len(grid) - 1) // LOOKS.fine)
        return True

    def cut(self, reached: float, least: float) -> bool:
        """Take less than an interval next, where all steps that are allowed led so far; False if that is as good as nothing.

        Looks at its ends alone would not show what so many steps follow.
        """
        if reached <= LOOKS.fine * least:
            return False
        self.piece = reached / LOOKS.fine
        return True

    def begin(self, since: float | None = None) -> None:
        """Begin with one interval, after an event that came `since` seconds after the point before."""
        self.block = 1
        if since is not None and self.density > LOOKS.densest:
            # Where there are many looks to an interval, there are many events: look no further than a few.
            self.piece = max(LOOKS.ahead * since, self.interval * LOOKS.densest / self.density)
