"""Find the first instant at which a watched condition changes, and the values there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from acausal.policy import POLICY
from acausal.solve.diagnosis.undefined_conditions import undefined_conditions
from acausal.solve.events.between import between
from acausal.solve.events.crossing import Sides, dips, levels, root, turns
from acausal.solve.events.instant import Instants
from acausal.solve.events.samples import Sample, Samples
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.ladder import Failure, Kind, Refusal, accepted
from acausal.solve.integrate.trace import Leg
from acausal.solve.looks import pace
from acausal.solve.point import Point, Rows

LOCATE = POLICY.locate
LOOKS = POLICY.looks
EPS = float(np.finfo(float).eps)


@dataclass(frozen=True)
class Crossing:
    """The first change: a sample at most a rounding error after it, and the greatest values before."""

    after: Sample
    peak: np.ndarray


class TooCoarse(Exception):
    """Between the times of a leg a condition may change and change back in many places."""


class Undecided(Failure):
    """A condition has no value any more."""


class Locator:
    """Search along the legs of a run.

    Parameters
    ----------
    integrator : Integrator
        Integrates from any point.
    instants : Instants
        Watched conditions.

    Attributes
    ----------
    passed : array or float
        Greatest values along the legs without a change since the last one; whoever applies a change begins anew with 0.
    """

    def __init__(self, integrator: Integrator, instants: Instants) -> None:
        self.integrator, self.instants = integrator, instants
        self.shortest = LOCATE.shortest * instants.span
        self.passed: np.ndarray | float = 0.0
        self._rows: Callable[[np.ndarray], Rows] | None = None

    def first(self, at: Point, leg: Leg, depth: int = 0, content: bool = False) -> Crossing | None:
        """Return the first change after `at` along a leg that begins there.

        Parameters
        ----------
        at : Point
            Where the leg begins.
        leg : Leg
            Rows after it.
        depth : int
            How often samples between samples were requested.
        content : bool
            Whether to do without a look between the samples where there would be too many.

        Raises
        ------
        TooCoarse
            If the leg needs more samples to tell.
        Failure
            If the motion cannot be followed up to the change.
        """
        self._rows = leg.inside
        samples = self._samples(replace(at, constants=leg.constants), leg.since(at))
        known, text = self._known(samples)
        if not text:
            return self._change(at, samples, depth, content)
        found = self._change(at, samples.before(known), depth, content) if known > 1 else None
        return found or self._to_undecided(at, samples, known, text)

    def _change(self, at: Point, samples: Samples, depth: int, content: bool) -> Crossing | None:
        """The first change along samples whose conditions have values."""
        sides, width = samples.sides, self.instants.width(at)
        level = levels(sides, LOCATE.level * width)
        out = np.any(sides.value[1:] < level[1:], axis=1)
        end = int(np.argmax(out)) if out.any() else len(out)
        least, error = dips(sides)
        margin = least - level[:-1]
        travel = pace(sides.times, sides.rate)
        most = max(LOCATE.suspects, len(out) // LOOKS.fine) if depth == 0 or content else len(out)
        near = np.minimum(sides.value[1:], sides.value[:-1]) - level[:-1] <= LOCATE.reach * travel
        round_about = np.any(near & (travel > np.maximum(np.ptp(sides.value, axis=0), width)), axis=1)[: end + 1]
        turning = turns(samples.before(end + 1).sides, level[: end + 1])
        doubtful = np.any(near & ((margin < -width) | ((error > width) & (margin < LOCATE.error * error))), axis=1)[
            : end + 1
        ]
        doubtful[end:] = False
        if not content and depth == 0 and (round_about.any() or len(turning) > most):
            raise TooCoarse
        if len(turning) <= most:
            doubtful[:end] |= self._seen_between(samples, level, turning, end)
        suspects = np.flatnonzero(doubtful)
        if len(suspects) > most:
            if not content:
                raise TooCoarse
            suspects = suspects[:0]
        peak = np.maximum.accumulate(sides.value, axis=0)
        for k in suspects.tolist() if depth < LOCATE.depth else []:
            inner = self._inside(samples[k], samples[k + 1], depth)
            if inner:
                return Crossing(inner.after, np.maximum(peak[k], inner.peak))
        if end == len(out):
            if depth == 0:
                self.passed = np.maximum(self.passed, peak[-1])
            return None
        return self._narrow(at, samples[end], samples[end + 1], LOCATE.level * width, peak[end])

    def _known(self, samples: Samples) -> tuple[int, str]:
        """How many samples have conditions with values, and what to say of the next; "" if what has none does not matter."""
        lost = np.isnan(samples.value)
        rows = np.flatnonzero(lost.any(axis=1))
        for k in rows[[0, -1]] if rows.size else ():
            if text := undefined_conditions(
                self.integrator.problem, samples[k].at, self.instants.watched[lost[k]].tolist()
            ):
                return int(rows[0] if k == rows[0] else k), text
        return len(samples), ""

    def _to_undecided(self, at: Point, samples: Samples, known: int, text: str) -> Crossing:
        """A change just before a condition has no value any more.

        Raises
        ------
        Undecided
            If there is none.
        """
        a, b = samples[max(known - 1, 0)], samples[known]
        slack, shortest = LOCATE.level * self.instants.width(at), LOCATE.straight * (b.time - a.time)
        while b.time - a.time > shortest:
            found = self._between(at, a, b, (a.time + b.time) / 2)
            if isinstance(found, Refusal):
                raise Failure.of(found)
            without, middle = self._known(found)[1], found[0]
            if without:
                b, text = middle, without
            elif np.any(middle.value < np.minimum(a.value, 0.0) - np.where(a.value > 0, 0.0, slack)):
                return self._narrow(at, a, middle, slack, a.value)
            else:
                a = middle
        raise Undecided(b.time, text)

    def sample(self, at: Point, here: Point) -> Sample:
        """Values of the watched conditions at another point, on the side on which they are at `at`."""
        return self._alone(at, here)[0]

    def _alone(self, at: Point, here: Point) -> Samples:
        return self._samples(replace(here, mode=at.mode), Rows.of(here))

    def _samples(self, at: Point, rows: Rows) -> Samples:
        """Rows of the segment of a point, consistent as far as the watched conditions need it, on the side of that point."""
        problem = self.integrator.problem
        rows, _ = self.integrator.consistent(rows, self.instants.guards.needs)
        value, rate = problem.indicators(rows)
        side = np.where(at.mode, -1.0, 1.0)
        return Samples(at, rows, value * side, rate * side)

    def _seen_between(self, samples: Samples, level: np.ndarray, turning: list[int], end: int) -> np.ndarray:
        """In which of the first intervals a condition changes and changes back, where it turns fast enough for that."""
        found, shortest = np.zeros(end, dtype=bool), LOCATE.straight * np.diff(samples.rows.times)
        todo = [(k, samples[k], samples[k + 1], level[k]) for k in turning]
        looks = 0
        while todo:
            k, a, b, least = todo.pop()
            if found[k] or b.time - a.time <= LOOKS.fine * shortest[k]:
                continue
            looks += LOOKS.fine
            inner = self._interpolated(a, b, np.linspace(a.time, b.time, LOOKS.fine + 1)[1:-1])
            if inner is None or looks > LOCATE.looks or np.any(inner.value < least):
                found[k] = True
                continue
            parts = [a, *(inner[i] for i in range(len(inner))), b]
            times, value, rate = (np.array([getattr(r, name) for r in parts]) for name in ("time", "value", "rate"))
            todo += [(k, parts[i], parts[i + 1], least) for i in turns(Sides(times, value, rate), least)]
        return found

    def _interpolated(self, a: Sample, b: Sample, times: np.ndarray) -> Samples | None:
        """Rows between two others, of the leg or on their cubic; None where that does not follow the motion."""
        if self._rows:
            return self._samples(a.at, self._rows(times))
        found = between(self.integrator, Rows.of(a.at, b.at), times)
        if np.any(found.defect > POLICY.between.faithful):
            return None
        return self._samples(a.at, found.rows)

    def _inside(self, a: Sample, b: Sample, depth: int) -> Crossing | None:
        """Look closer between two samples."""
        times = np.linspace(a.time, b.time, LOOKS.fine + 1)
        if self._rows:
            leg = Leg(self._rows(times[1:]), np.zeros((LOOKS.fine, 2)), a.at.constants, 0, self._rows)
        else:
            leg = accepted(self.integrator.trial(a.at, times, LOCATE.trial_steps))
        return self.first(a.at, leg, depth + 1)

    def _narrow(self, at: Point, a: Sample, b: Sample, slack: np.ndarray, peak: np.ndarray) -> Crossing:
        """Narrow an interval: the cubic tells where to look next, a little to the side where no sample is near.

        Raises
        ------
        Failure
            If the motion cannot be followed up to the change.
        """
        level = np.where(a.value > 0, 0.0, np.minimum(a.value, 0.0) - slack)
        # Of the interval and not of the run: a brake is as exact in a run of a day as in one of a second.
        shortest = max(LOCATE.straight * (b.time - a.time), LOCATE.roundings * float(np.spacing(abs(b.time))))
        predicted, last, width = b.time, b.time, [np.inf, np.inf]
        # A time that could not be reached: perhaps the law has no value beyond the change.
        wall, refusal = np.inf, Refusal(Kind.OTHER, a.time)
        for _ in range(LOCATE.tries):
            span = min(b.time, wall) - a.time
            if span <= shortest:
                break
            last, predicted = predicted, self._predicted(a, b, level)
            aside = min(max(abs(predicted - last), LOCATE.beside * shortest), LOCATE.aside * span)
            time = predicted + aside if predicted - a.time < b.time - predicted else predicted - aside
            if span > 0.5 * width[-2] or not a.time < time < min(b.time, wall):
                time = a.time + span / 2
            width.append(span)
            found = self._between(at, a, b, time)
            if isinstance(found, Refusal):
                wall, refusal = time, found
            elif np.any(found.value < level):
                b = found[0]
            else:
                a = found[0]
                peak = np.maximum(peak, a.value)
                level = np.where(a.value > 0, 0.0, level)
        return Crossing(self._landed(a, b, level) if b.time < wall else self._at_wall(at, a, b, wall, refusal), peak)

    def _landed(self, a: Sample, b: Sample, level: np.ndarray) -> Sample:
        """Where the first condition changes, on the straight line between two samples: nearer than times can tell.

        What a time that is rounded leaves of a speed would stay for ever where the new law holds the speed.
        """
        out = b.value < level
        if not out.any():  # exactly there
            return b
        change = (a.value - b.value)[out]
        s = float(np.min((a.value - level)[out] / change))
        # One state alone is as exact as itself; a difference of states is as exact as they are.
        sizes = float(np.max(self.instants.width(a.at)[out] / change)) / self.integrator.tolerance
        for errors in (1.0, *(sizes * LOCATE.further ** np.arange(LOCATE.roundings))):
            found = self._at_share(a, b, min(s + EPS * errors, 1.0))
            if np.any(found.value < level):
                return found
        return b

    def _at_share(self, a: Sample, b: Sample, s: float) -> Sample:
        """The sample at a share of the way from one to another."""
        here, there = a.at, b.at
        between = replace(here, time=a.time + s * (b.time - a.time)).with_y(here.y + s * (there.y - here.y))
        return self._alone(here, between)[0]

    def _at_wall(self, at: Point, a: Sample, b: Sample, wall: float, refusal: Refusal) -> Sample:
        """The last sample that could be reached, where a condition is as near to its change as the tolerance can tell."""
        due = (b.value <= 0) & (a.value <= self.instants.width(at))
        if not due.any():
            raise Failure.of(refusal)
        return replace(a, at=replace(a.at, time=wall), value=np.where(due, np.minimum(a.value, 0.0), a.value))

    def _predicted(self, a: Sample, b: Sample, level: np.ndarray) -> float:
        out = np.flatnonzero(b.value < level)
        found = [
            root((a.time, b.time), (a.value[k] - level[k], b.value[k] - level[k]), (a.rate[k], b.rate[k])) for k in out
        ]
        return min(found, default=b.time)

    def _between(self, at: Point, a: Sample, b: Sample, time: float) -> Samples | Refusal:
        """The one sample at a time between two others: on their cubic if it follows the motion, else integrated."""
        found = self._interpolated(a, b, np.array([time]))
        if found:
            return found
        leg = self.integrator.trial(a.at, np.array([a.time, time]), LOCATE.trial_steps)
        return leg if isinstance(leg, Refusal) else self._alone(at, leg.end(at))
