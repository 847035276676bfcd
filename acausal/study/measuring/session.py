"""A session of measurements: cases in the journal are not measured again, new ones are recorded at once."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace

from acausal.study.measuring.case import Case, Job, Measurement
from acausal.study.measuring.journal import Journal
from acausal.study.measuring.pool import run

Progress = Callable[[int, int, str], None]


@dataclass
class Session:
    """A session of measurements.

    Parameters
    ----------
    job : Job
        Template of the jobs, for every case.
    executor : Executor
        Executor of the jobs.
    journal : Journal
        Journal of earlier and new measurements.
    progress : callable, optional
        Called with the number of cases done, the number of cases so far, and the current stage.
    """

    job: Job
    executor: Executor
    journal: Journal
    progress: Progress | None = None
    found: dict[Case, Measurement] = field(default_factory=dict)
    wanted: int = 0

    def measure(self, cases: Iterable[Case], what: str = "") -> list[Measurement]:
        """Measure cases in parallel, and return the measurements in the order of the cases.

        Parameters
        ----------
        cases : iterable of Case
            The cases.
        what : str
            The current stage, for the progress.
        """
        cases = list(cases)
        new = [case for case in dict.fromkeys(cases) if case not in self.found]
        self.wanted += len(new)
        for case in new:
            kept = self.journal.get(case)
            if kept is not None:
                self.found[case] = kept
        self._report(what)
        own = {case: case for case in new if case not in self.found}
        for measurement in run([self.job.of(case) for case in own], self.executor):
            case = own[measurement.case]
            self.found[case] = replace(measurement, case=case)
            self.journal.add(self.found[case])
            self._report(what)
        return [self.found[case] for case in cases]

    def _report(self, what: str) -> None:
        if self.progress:
            self.progress(len(self.found), self.wanted, what)
