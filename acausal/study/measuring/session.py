"""A session measures cases: what the journal knows is not measured again, what is new is kept at once."""

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
    """Where and how cases are measured.

    Parameters
    ----------
    job : Job
        How cases are run; each takes the place of its own.
    executor : Executor
        Where jobs run.
    journal : Journal
        What was measured earlier, and is from now on.
    progress : callable, optional
        Called with the number of cases done, of all cases so far, and what is going on.
    """

    job: Job
    executor: Executor
    journal: Journal
    progress: Progress | None = None
    found: dict[Case, Measurement] = field(default_factory=dict)
    wanted: int = 0

    def measure(self, cases: Iterable[Case], what: str = "") -> list[Measurement]:
        """Measure cases in parallel, and return what they gave in their order.

        Parameters
        ----------
        cases : iterable of Case
            What to run.
        what : str
            What they are for, for the progress.
        """
        cases = list(cases)
        new = [case for case in dict.fromkeys(cases) if case not in self.found]
        self.wanted += len(new)
        for case in new:
            kept = self.journal.get(case)
            if kept is not None:
                self.found[case] = kept
        self._tell(what)
        own = {case: case for case in new if case not in self.found}
        for measurement in run([self.job.of(case) for case in own], self.executor):
            case = own[measurement.case]
            self.found[case] = replace(measurement, case=case)
            self.journal.add(self.found[case])
            self._tell(what)
        return [self.found[case] for case in cases]

    def _tell(self, what: str) -> None:
        if self.progress:
            self.progress(len(self.found), self.wanted, what)
