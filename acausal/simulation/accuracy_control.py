"""Accuracy control: choose tolerance, method, order limit and number of elements so that all outputs reach an accuracy.

The error of a run is estimated by comparison with a run at a tenth of the tolerance, and with one with twice as many
elements. The larger of the two errors decides what to refine. The run that is returned is the one with the estimate, not
one of the finer runs, whose errors are unknown.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from acausal.errors import SimulationError
from acausal.policy import POLICY
from acausal.result import Result
from acausal.simulation.estimate import Estimate, estimate
from acausal.simulation.run_cache import Numerics, RunCache
from acausal.solve.integrate.methods import chosen

ACCURACY = POLICY.accuracy


@dataclass(frozen=True)
class State:
    """A choice of numerics, its run, and the estimated error of the run."""

    numerics: Numerics
    result: Result
    estimate: Estimate


def simulate_to_accuracy(accuracy: float, runs: RunCache) -> Result:
    """Return a run whose estimated errors are at most `accuracy`.

    Parameters
    ----------
    accuracy : float
        Largest error of each output as a fraction of its range.
    runs : RunCache
        Runs of the model.

    Raises
    ------
    SimulationError
        If no such run is found; its `result` is the best run.
    """
    search = Search(accuracy, runs)
    try:
        return search.report(search.find())
    except KeyboardInterrupt as interrupt:
        complete = [found for found in runs.results.values() if isinstance(found, Result)]
        if search.best:
            interrupt.result = search.report(search.best)  # type: ignore[attr-defined]
        elif complete:
            interrupt.result = complete[-1]  # type: ignore[attr-defined]
        raise


class Search:
    """Search for numerics that are accurate enough.

    Parameters
    ----------
    accuracy : float
        Largest error of each output as a fraction of its range.
    runs : RunCache
        Runs of the model.
    """

    def __init__(self, accuracy: float, runs: RunCache) -> None:
        self.accuracy, self.runs = accuracy, runs
        exponent = np.floor(np.log10(ACCURACY.first * accuracy) + 1e-9)
        self.first = float(np.clip(_tenth(10.0**exponent, 0), 10 * ACCURACY.smallest, ACCURACY.loosest))
        self.best: State | None = None
        self.failures: list[SimulationError] = []
        self.history: list[float] = []

    def find(self) -> State:
        """Refine what causes the larger error until the estimate is small enough."""
        task = self.runs.task
        numerics = Numerics(ACCURACY.fewest if self.runs.adaptive else 0, self.first, task.method, task.max_order)
        while True:
            numerics = self._resolving_if_cheaper(numerics)
            state = self._state(numerics)
            if state is None:
                numerics = self._refined_after_failure(numerics)
                continue
            if self.best is None or state.estimate.total < self.best.estimate.total:
                self.best = state
            if state.estimate.total <= self.accuracy:
                return state
            numerics = self._refined(state)

    def report(self, state: State) -> Result:
        """Return the run with the chosen numerics, the estimates and the trials in its statistics."""
        found = state.estimate
        chosen = {
            "tolerance": state.numerics.tolerance,
            "max_order": state.result.stats.max_order,
            "method": state.numerics.method,
            "sizes": self.runs.sizes(state.numerics.number),
        }
        return state.result.with_stats(
            **self.runs.seconds(),
            accuracy=self.accuracy,
            accuracy_reached=found.total <= self.accuracy,
            error_estimate=found.total,
            error_output=found.worst,
            error_tolerance=found.tolerance,
            error_elements=found.elements,
            error_estimates=found.outputs,
            elements_kept=self.runs.keeps_elements,
            chosen=chosen,
            trials=self.runs.done,
        )

    def _resolving_if_cheaper(self, numerics: Numerics) -> Numerics:
        """Switch to resolving every vibration at order 5 if refining the present choice would cost more.

        Cost of resolving: about one step per radian of the fastest vibration, whatever the tolerance.
        """
        task, coarse = self.runs.task, self.runs(numerics)
        if isinstance(coarse, SimulationError) or task.max_order or task.method == "rosenbrock":
            return numerics
        low = "idas" in coarse.stats.method_steps and coarse.stats.max_order < POLICY.order.highest
        follows = not coarse.stats.damped and not low
        turns = coarse.stats.fastest_rate * (task.stop_time - task.start_time)
        if follows or ACCURACY.growth * _work(coarse) < ACCURACY.anew * turns:
            return numerics
        self.history.clear()
        return replace(numerics, tolerance=self.first, method=chosen("resolve")[0], max_order=POLICY.order.highest)

    def _state(self, numerics: Numerics) -> State | None:
        """Run and estimate the error; None if a run fails."""
        run = self._run(numerics)
        fine = run and self._finer(numerics, run)
        finer = fine and self._run(fine)
        if run is None or fine is None or finer is None:
            return None
        doubled = halved = None
        if self.runs.adaptive:
            doubled = self._run(replace(fine, number=2 * numerics.number))
            if doubled is None:
                return None
            halved = self.runs.results.get(replace(fine, number=numerics.number // 2))
        tenths = fine.tolerance / numerics.tolerance
        half = halved if isinstance(halved, Result) else None
        return State(numerics, run, estimate(run, finer, tenths, doubled, half))

    def _finer(self, numerics: Numerics, run: Result) -> Numerics | None:
        """Return the numerics with the largest tighter tolerance that takes noticeably more steps; None if a run fails."""
        fine = numerics
        for k in range(1, ACCURACY.tenths + 1):
            if (tolerance := _tenth(numerics.tolerance, k)) < ACCURACY.smallest:
                break
            fine = replace(numerics, tolerance=tolerance)
            finer = self._run(fine)
            if finer is None:
                return None
            if _work(finer) >= ACCURACY.more * _work(run):
                break
        return fine

    def _run(self, numerics: Numerics) -> Result | None:
        found = self.runs(numerics)
        if isinstance(found, Result):
            return found
        if found not in self.failures:
            self.failures.append(found)
        return None

    def _refined(self, state: State) -> Numerics:
        numerics, found = state.numerics, state.estimate
        if found.elements > found.tolerance:
            if 4 * numerics.number > ACCURACY.most:
                raise self._refusal(f"more than {ACCURACY.most} elements or volumes are not tried")
            return replace(numerics, number=2 * numerics.number)
        self.history.append(found.tolerance)
        if len(self.history) > 2 and self.history[-1] > ACCURACY.stuck * self.history[-3]:
            raise self._refusal("smaller tolerances keep changing the result")
        missing = np.log10(min(found.tolerance, 1e3) / self.accuracy)
        return self._tighter(numerics, max(1, int(missing)))

    def _refined_after_failure(self, numerics: Numerics) -> Numerics:
        """Refine tolerance and elements after a failed run; give up if a run has succeeded or too many have failed."""
        if self.best or len(self.failures) >= ACCURACY.failures:
            raise self._refusal("runs with smaller tolerances or more elements fail")
        number = 2 * numerics.number
        return self._tighter(numerics if 2 * number > ACCURACY.most else replace(numerics, number=number), 1)

    def _tighter(self, numerics: Numerics, tenths: int) -> Numerics:
        smallest = 10 * ACCURACY.smallest
        if numerics.tolerance <= smallest:
            raise self._refusal(f"a tolerance below {smallest:g} is lost in round-off")
        return replace(numerics, tolerance=max(_tenth(numerics.tolerance, tenths), smallest))

    def _refusal(self, reason: str) -> SimulationError:
        if self.best is None:
            return self.failures[-1]
        best = self.report(self.best)
        text = chosen_text(best.stats)
        refusal = SimulationError(
            f"the accuracy was not reached: {reason}. The best run: {text}. Do this: request less accuracy, or examine the "
            "outputs of a run with tolerance=... .",
            best,
        )
        refusal.kept = "The best run"
        return refusal


def chosen_text(stats: Mapping[str, Any]) -> str:
    """Return the requested accuracy, the chosen numerics and the estimated error, in one line."""
    chosen = stats["chosen"]
    sizes = "".join(f", {n} {_what(path)}" for path, n in chosen["sizes"].items())
    text = (
        f"accuracy {stats['accuracy']:g} requested: tolerance {chosen['tolerance']:g}, order at most "
        f"{chosen['max_order']}{sizes}; estimated error {stats['error_estimate']:.1g} of the range of "
        f"`{stats['error_output']}`"
    )
    if stats["elements_kept"]:
        text += "; the numbers of elements are fixed, and their error is not included (adaptive=True)"
    if sizes:
        text += f" (tolerance {stats['error_tolerance']:.1g}, elements {stats['error_elements']:.1g})"
    return text


def _what(path: str) -> str:
    owner, _, field = path.rpartition(".")
    return f"{field} in `{owner}`" if owner else field


def _work(run: Result) -> int:
    """Return the number of steps, those of the one-step method weighted by their cost."""
    return sum(n * (1 if name == "idas" else ACCURACY.one_step) for name, n in run.stats.method_steps.items())


def _tenth(tolerance: float, k: int) -> float:
    return float(f"{tolerance * 10.0**-k:.0e}")
