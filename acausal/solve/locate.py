"""Find the first instant at which a watched condition changes, and the values there."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from acausal.solve.crossing import Sides, dips, levels, root
from acausal.solve.instant import Instants, Point
from acausal.solve.integrate import Integrator, Stretch

FINE, DEPTH, SUSPECTS, TRIALS = 8, 3, 4, 80
TRIAL_STEPS = 20_000


@dataclass(frozen=True)
class Row:
    """Values at a time; `energy` counts from the start of the stretch, `value` and `rate` are positive if unchanged."""

    time: float
    x: np.ndarray
    z: np.ndarray
    energy: np.ndarray
    value: np.ndarray
    rate: np.ndarray
    modes: np.ndarray


@dataclass(frozen=True)
class Crossing:
    """The first change: rows before and after it, at most a rounding error apart, and the greatest values before."""

    before: Row
    after: Row
    peak: np.ndarray


class TooCoarse(Exception):
    """Between the times of a stretch a condition may change and change back in many places."""


class Locator:
    """Search along the stretches of a run.

    Parameters
    ----------
    run : Integrator
        Integrates from any point.
    instants : Instants
        Watched conditions.
    """

    def __init__(self, run: Integrator, instants: Instants) -> None:
        self.run, self.instants = run, instants
        self.shortest = 1e-12 * instants.span

    def first(self, at: Point, stretch: Stretch, depth: int = 0) -> Crossing | None:
        """Return the first change after `at` along a stretch that begins there.

        Raises
        ------
        TooCoarse
            If the stretch needs more rows to tell.
        """
        rows = self._rows(at, stretch)
        sides = Sides(
            np.array([r.time for r in rows]), np.array([r.value for r in rows]), np.array([r.rate for r in rows])
        )
        width = self.instants.width(at)
        level = levels(sides, width / 100)
        out = np.any(sides.value[1:] < level[1:], axis=1)
        end = int(np.argmax(out)) if out.any() else len(out)
        least, error = dips(sides)
        margin = least - level[:-1]
        doubtful = np.any((margin < -width) | ((error > width) & (margin < 3 * error)), axis=1)[: end + 1]
        doubtful[end:] = False
        suspects = np.flatnonzero(doubtful)
        if depth == 0 and len(suspects) > max(SUSPECTS, len(out) // FINE):
            raise TooCoarse
        peak = np.maximum.accumulate(sides.value, axis=0)
        for k in suspects if depth < DEPTH else []:
            inner = self._inside(at, rows[k], rows[k + 1], depth)
            if inner:
                return Crossing(inner.before, inner.after, np.maximum(peak[k], inner.peak))
        if end == len(out):
            return None
        return self._narrow(at, rows[end], rows[end + 1], width / 100, peak[end])

    def row(self, at: Point, time: float, x: np.ndarray, z: np.ndarray, energy: np.ndarray, modes: np.ndarray) -> Row:
        """Values of the watched conditions at other states, on the side on which they are at `at`."""
        value, rate = self.instants.rates(Point(time, x, z, modes, at.truth))
        side = np.where(at.truth, -1.0, 1.0)
        return Row(time, x, z, energy, value * side, rate * side, modes)

    def _rows(self, at: Point, stretch: Stretch) -> list[Row]:
        times = np.concatenate([[at.time], stretch.times])
        x, z = np.vstack([at.x[None], stretch.x]), np.vstack([at.z[None], stretch.z])
        energy = np.vstack([np.zeros((1, 2)), stretch.energy])
        value, rate = self.instants.guards.along(x, z, self.run.p, times, stretch.modes)
        side = np.where(at.truth, -1.0, 1.0)
        return [
            Row(t, a, b, e, g, d, stretch.modes)
            for t, a, b, e, g, d in zip(times.tolist(), x, z, energy, value * side, rate * side, strict=True)
        ]

    def _inside(self, at: Point, a: Row, b: Row, depth: int) -> Crossing | None:
        """Look closer between two rows."""
        times = np.linspace(a.time, b.time, FINE + 1)
        stretch = self.run.attempt(times, a.x, a.z, at.modes, TRIAL_STEPS, careful=False)
        if stretch is None:
            return None
        found = self.first(Point(a.time, a.x, a.z, at.modes, at.truth), stretch, depth + 1)
        if not found:
            return None
        before, after = (replace(r, energy=a.energy + r.energy) for r in (found.before, found.after))
        return Crossing(before, after, found.peak)

    def _narrow(self, at: Point, a: Row, b: Row, slack: np.ndarray, peak: np.ndarray) -> Crossing:
        """Narrow an interval: the cubic tells where to look next, a little to the side where no row is near."""
        level = np.where(a.value > 0, 0.0, np.minimum(a.value, 0.0) - slack)
        shortest = max(self.shortest, 4 * float(np.spacing(abs(b.time))))
        guess, last, width = b.time, b.time, [np.inf, np.inf]
        for _ in range(TRIALS):
            span = b.time - a.time
            if span <= shortest:
                break
            last, guess = guess, self._guess(a, b, level)
            aside = min(max(abs(guess - last), shortest / 3), span / 10)
            time = guess + aside if guess - a.time < b.time - guess else guess - aside
            if span > 0.5 * width[-2] or not a.time < time < b.time:
                time = (a.time + b.time) / 2
            width.append(span)
            middle = self._between(at, a, time)
            if middle is None or np.any(middle.value < level):
                b = middle or replace(b, time=time)
            else:
                a = middle
                peak = np.maximum(peak, a.value)
                level = np.where(a.value > 0, 0.0, level)
        return Crossing(a, b, peak)

    def _guess(self, a: Row, b: Row, level: np.ndarray) -> float:
        out = np.flatnonzero(b.value < level)
        found = [
            root((a.time, b.time), (a.value[k] - level[k], b.value[k] - level[k]), (a.rate[k], b.rate[k])) for k in out
        ]
        return min(found, default=b.time)

    def _between(self, at: Point, a: Row, time: float) -> Row | None:
        times = np.array([a.time, time])
        stretch = self.run.attempt(times, a.x, a.z, at.modes, TRIAL_STEPS, careful=False)
        stretch = stretch or self.run.attempt(times, a.x, a.z, at.modes, TRIAL_STEPS, careful=True)
        if stretch is None:
            return None
        return self.row(at, time, stretch.x[0], stretch.z[0], a.energy + stretch.energy[0], stretch.modes)
