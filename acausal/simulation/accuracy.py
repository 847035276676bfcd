"""Accuracy: choose tolerance, method, order limit and number of elements so that every output is as good as asked.

The error of a run is its difference from a run with a tenth of the tolerance, and from one with twice the elements. The
run that is returned is the one whose error was estimated, not the better ones beside it, whose errors are unknown.
The larger of both errors tells what to refine.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from acausal.errors import SimulationError
from acausal.result import Result
from acausal.simulation.estimate import Estimate, estimate
from acausal.simulation.trials import Choice, Trials

# Tolerances tried first, as fractions of the accuracy; the loosest and the smallest.
FIRST, LOOSEST, SMALLEST = 1e-2, 1e-3, 1e-12
FEWEST, MOST = 2, 128
# A run with a smaller tolerance is better only if it takes more work: at the limit of stability it does not.
MORE, TENTHS = 1.2, 3
# A step of the one-step method is worth several; growth of the work by a tenth of the tolerance; runs that it takes
# to begin again with another method.
ONE_STEP, GROWTH, ANEW = 10, 3, 3
FAILURES, STUCK = 3, 0.8


@dataclass(frozen=True)
class State:
    """A choice with its run and the estimate of its error."""

    choice: Choice
    result: Result
    estimate: Estimate


def reach(accuracy: float, trials: Trials) -> Result:
    """Return a run whose estimated errors are at most `accuracy`.

    Parameters
    ----------
    accuracy : float
        Largest error of each output as a fraction of its range.
    trials : Trials
        Runs of the model.

    Raises
    ------
    SimulationError
        If no such run is found; its `result` is the best one.
    """
    search = Search(accuracy, trials)
    try:
        return search.report(search.go())
    except KeyboardInterrupt as interrupt:
        complete = [found for found in trials.results.values() if isinstance(found, Result)]
        if search.best:
            interrupt.result = search.report(search.best)  # type: ignore[attr-defined]
        elif complete:
            interrupt.result = complete[-1]  # type: ignore[attr-defined]
        raise


class Search:
    """Search for a choice that is accurate enough.

    Parameters
    ----------
    accuracy : float
        Largest error of each output as a fraction of its range.
    trials : Trials
        Runs of the model.
    """

    def __init__(self, accuracy: float, trials: Trials) -> None:
        self.accuracy, self.trials = accuracy, trials
        exponent = np.floor(np.log10(FIRST * accuracy) + 1e-9)
        self.first = float(np.clip(_tenth(10.0**exponent, 0), 10 * SMALLEST, LOOSEST))
        self.best: State | None = None
        self.failures: list[SimulationError] = []
        self.history: list[float] = []

    def go(self) -> State:
        """Refine what causes the larger error until the estimate is small enough."""
        task = self.trials.task
        choice = Choice(FEWEST if self.trials.adaptive else 0, self.first, task.method, task.max_order)
        while True:
            choice = self._way(choice)
            state = self._state(choice)
            if state is None:
                choice = self._past_failure(choice)
                continue
            if self.best is None or state.estimate.total < self.best.estimate.total:
                self.best = state
            if state.estimate.total <= self.accuracy:
                return state
            choice = self._refined(state)

    def report(self, state: State) -> Result:
        """Return the run with what was chosen, estimated and tried in its stats."""
        found = state.estimate
        chosen = {
            "tolerance": state.choice.tolerance,
            "max_order": state.result.stats.max_order,
            "method": state.choice.method,
            "sizes": self.trials.sizes(state.choice.number),
        }
        return state.result.with_stats(
            **self.trials.seconds(),
            accuracy=self.accuracy,
            accuracy_reached=found.total <= self.accuracy,
            error_estimate=found.total,
            error_output=found.worst,
            error_tolerance=found.tolerance,
            error_elements=found.elements,
            error_estimates=found.outputs,
            elements_kept=self.trials.keeps_elements,
            chosen=chosen,
            trials=self.trials.done,
        )

    def _way(self, choice: Choice) -> Choice:
        """Follow every vibration at order 5 where going on as before would cost more.

        The multistep method then takes about a step for each radian of the fastest vibration, whatever the tolerance.
        """
        task, coarse = self.trials.task, self.trials(choice)
        if isinstance(coarse, SimulationError) or task.max_order or task.method == "rosenbrock":
            return choice
        follows = coarse.stats.max_order == 5 and "rosenbrock" not in coarse.stats.method_steps
        turns = coarse.stats.fastest_rate * (task.stop_time - task.start_time)
        if follows or GROWTH * _work(coarse) < ANEW * turns:
            return choice
        self.history.clear()
        return replace(choice, tolerance=self.first, method="idas", max_order=5)

    def _state(self, choice: Choice) -> State | None:
        """Run and estimate; None where a run fails."""
        run = self._run(choice)
        fine = run and self._finer(choice, run)
        finer = fine and self._run(fine)
        if run is None or fine is None or finer is None:
            return None
        doubled = halved = None
        if self.trials.adaptive:
            doubled = self._run(replace(fine, number=2 * choice.number))
            if doubled is None:
                return None
            halved = self.trials.results.get(replace(fine, number=choice.number // 2))
        tenths = fine.tolerance / choice.tolerance
        half = halved if isinstance(halved, Result) else None
        return State(choice, run, estimate(run, finer, tenths, doubled, half))

    def _finer(self, choice: Choice, run: Result) -> Choice | None:
        """Return the choice with the largest smaller tolerance that makes a difference."""
        fine = choice
        for k in range(1, TENTHS + 1):
            if (tolerance := _tenth(choice.tolerance, k)) < SMALLEST:
                break
            fine = replace(choice, tolerance=tolerance)
            finer = self._run(fine)
            if finer is None:
                return None
            if _work(finer) >= MORE * _work(run):
                break
        return fine

    def _run(self, choice: Choice) -> Result | None:
        found = self.trials(choice)
        if isinstance(found, Result):
            return found
        if found not in self.failures:
            self.failures.append(found)
        return None

    def _refined(self, state: State) -> Choice:
        choice, found = state.choice, state.estimate
        if found.elements > found.tolerance:
            if 4 * choice.number > MOST:
                raise self._refusal(f"more than {MOST} elements or volumes are not tried")
            return replace(choice, number=2 * choice.number)
        self.history.append(found.tolerance)
        if len(self.history) > 2 and self.history[-1] > STUCK * self.history[-3]:
            raise self._refusal("smaller tolerances keep changing the result")
        missing = np.log10(min(found.tolerance, 1e3) / self.accuracy)
        return self._tighter(choice, max(1, int(missing)))

    def _past_failure(self, choice: Choice) -> Choice:
        """Refine everything, if nothing better than this succeeded and not too much failed already."""
        if self.best or len(self.failures) >= FAILURES:
            raise self._refusal("runs with smaller tolerances or more elements fail")
        number = 2 * choice.number
        return self._tighter(choice if 2 * number > MOST else replace(choice, number=number), 1)

    def _tighter(self, choice: Choice, tenths: int) -> Choice:
        smallest = 10 * SMALLEST
        if choice.tolerance <= smallest:
            raise self._refusal(f"a tolerance below {smallest:g} is lost in rounding")
        return replace(choice, tolerance=max(_tenth(choice.tolerance, tenths), smallest))

    def _refusal(self, reason: str) -> SimulationError:
        if self.best is None:
            return self.failures[-1]
        best = self.report(self.best)
        text = chosen_text(best.stats)
        return SimulationError(
            f"the accuracy was not reached: {reason}. The best run is kept: {text}. Ask for less, or examine "
            "the outputs of a run with tolerance=... .",
            best,
        )


def chosen_text(stats: Mapping[str, Any]) -> str:
    """Return what was asked, chosen and estimated, a line."""
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
    """Return the steps, those of the one-step method counted several times."""
    return sum(n * (ONE_STEP if name == "rosenbrock" else 1) for name, n in run.stats.method_steps.items())


def _tenth(tolerance: float, k: int) -> float:
    return float(f"{tolerance * 10.0**-k:.0e}")
