"""A session measures points: what the journal knows is not measured again, what is new is kept at once."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace

from acausal.study.measuring.journal import Journal
from acausal.study.measuring.point import Job, Measurement, Point
from acausal.study.measuring.pool import run

Progress = Callable[[int, int, str], None]


@dataclass
class Session:
    """Where and how points are measured.

    Parameters
    ----------
    job : Job
        How points are run; each takes the place of its own.
    executor : Executor
        Where jobs run.
    journal : Journal
        What was measured earlier, and is from now on.
    progress : callable, optional
        Called with the number of points done, of all points so far, and what is going on.
    """

    job: Job
    executor: Executor
    journal: Journal
    progress: Progress | None = None
    found: dict[Point, Measurement] = field(default_factory=dict)
    wanted: int = 0

    def measure(self, points: Iterable[Point], what: str = "") -> list[Measurement]:
        """Measure points in parallel, and return what they gave in their order.

        Parameters
        ----------
        points : iterable of Point
            What to run.
        what : str
            What they are for, for the progress.
        """
        points = list(points)
        new = [point for point in dict.fromkeys(points) if point not in self.found]
        self.wanted += len(new)
        for point in new:
            kept = self.journal.get(point)
            if kept is not None:
                self.found[point] = kept
        self._tell(what)
        for measurement in run([replace(self.job, point=p) for p in new if p not in self.found], self.executor):
            self.journal.add(measurement)
            self.found[measurement.point] = measurement
            self._tell(what)
        return [self.found[point] for point in points]

    def _tell(self, what: str) -> None:
        if self.progress:
            self.progress(len(self.found), self.wanted, what)
