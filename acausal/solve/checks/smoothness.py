"""Smoothness of laws declared `smooth=True`: no jump between cases where a run switches them.

Both cases are evaluated on both sides of a switch. If they differ, the interval is refined, on the cubic between two outputs,
until the law has the same value on both sides or the interval is very short.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.compiler.memo import memoized
from acausal.flatten.discontinuities import Promise
from acausal.policy import POLICY
from acausal.solve.checks.validity import Statements, compiled_statements
from acausal.solve.integrate.integrator import Integrator
from acausal.solve.looks import spread
from acausal.solve.point import Rows
from acausal.solve.results.evaluator import Evaluator
from acausal.symbols import scalars, stacked

PROMISES = POLICY.promises


@dataclass(frozen=True)
class _Point:
    """Values at a time: indicator, difference of the cases, and law."""

    time: float
    excess: float
    step: np.ndarray
    value: np.ndarray


class _Samples:
    """Values of the laws declared smooth along a run."""

    def __init__(self, integrator: Integrator, outputs: Evaluator) -> None:
        compiled = integrator.compiled
        self.statements = _known(compiled)
        self.integrator, self.outputs = integrator, outputs

    def rows(self, places: np.ndarray) -> np.ndarray:
        """Values at some of the output points."""
        return self._values(self.outputs.rows[places])

    def inside(self, row: int, times: np.ndarray) -> np.ndarray:
        """Values at times between an output point and the next, on the cubic through states and rates at both."""
        ends, solver = self.outputs.rows[row : row + 2], self.integrator.consistent
        constants = ends.constants[0]
        ends, _ = solver(Rows.within(ends.times, ends.x, ends.z, constants))
        x = scipy.interpolate.CubicHermiteSpline(ends.times, ends.x, solver.rates(ends))(times)
        part = ((times - ends.times[0]) / (ends.times[1] - ends.times[0]))[:, None]
        return self._values(Rows.within(times, x, ends.z[0] + part * (ends.z[1] - ends.z[0]), constants))

    def _values(self, rows: Rows) -> np.ndarray:
        solver = self.outputs.solver
        return solver.problem.each(self.statements.function, solver(rows, self.statements.wanted)[0])


@memoized
def _known(compiled: CompiledModel) -> Statements:
    """Declared laws that can be evaluated: those without derivatives that occur in no equation."""
    r = compiled.reduced
    promises = r.flat.discontinuities.promises
    entries = [stacked([promise.excess, promise.step, promise.value]) for promise in promises]
    known = {s.element_hash() for a in compiled.arguments for s in scalars(a)}
    column = r.resolve(ca.densify(stacked(entries)))
    missing = [s for s in ca.symvar(column) if s.element_hash() not in known]
    depends = ca.which_depends(column, stacked(missing), 1, True) if missing else [False] * column.numel()
    unknown = np.split(np.array(depends), np.cumsum([entry.numel() for entry in entries])[:-1])
    found = [
        (promise, scalars(entry)) for promise, entry, u in zip(promises, entries, unknown, strict=True) if not any(u)
    ]
    return compiled_statements(compiled, [promise for promise, _ in found], [e for _, some in found for e in some])


def smoothness_warnings(integrator: Integrator, outputs: Evaluator) -> list[str]:
    """Return warnings on laws that jump in a run although they are declared smooth.

    Parameters
    ----------
    integrator : Integrator
        With model, parameters and tolerance.
    outputs : Evaluator
        Output points of the run.
    """
    if not integrator.compiled.reduced.flat.discontinuities.promises or len(outputs.rows) < 2:
        return []
    samples = _Samples(integrator, outputs)
    rows = spread(len(outputs.rows), POLICY.validity.dear if samples.statements.wanted else POLICY.validity.rows)
    values, first, found = samples.rows(rows), 0, dict[str, str]()
    for promise in samples.statements.stated:
        n = promise.step.numel()
        columns = slice(first, first := first + 1 + 2 * n)
        text = _jump_text(samples, rows, values[:, columns], columns, promise)
        if text:
            found.setdefault(str(promise.origin), text)
    return list(found.values())


def _jump_text(samples: _Samples, rows: np.ndarray, values: np.ndarray, columns: slice, promise: Promise) -> str:
    """Return the warning that a law jumps, "" if it does not."""
    size = _largest(values[:, 1 + promise.step.numel() :])
    side = promise.holds(values[:, 0])
    examined = 0
    for k in np.flatnonzero(side[1:] != side[:-1]):
        low, high = int(rows[k]), int(rows[k + 1])
        while high - low > 1:
            middle = (low + high) // 2
            differs = promise.holds(samples.rows(np.array([middle]))[0, columns][0]) != side[k]
            low, high = (low, middle) if differs else (middle, high)
        if examined == PROMISES.switches:
            break
        ends = (
            values[k : k + 2]
            if high - low == rows[k + 1] - rows[k]
            else samples.rows(np.array([low, high]))[:, columns]
        )
        time, jump, refined = _at_switch(samples, low, ends, columns, promise, PROMISES.step * size)
        examined += refined
        if jump > PROMISES.step * size:
            return (
                f"{promise.origin}: the law is declared `smooth=True`, but near t = {time:.4g} s it jumps by {jump:.4g}; "
                "the integrator did not restart there, and its error is unknown. Leave `smooth=True` out, or make the cases "
                "of piecewise equal where they switch."
            )
    return ""


def _at_switch(
    samples: _Samples, row: int, ends: np.ndarray, columns: slice, promise: Promise, allowed: float
) -> tuple[float, float, bool]:
    """Return the time of a switch between two outputs, the jump there, and whether the interval was refined.

    `ends` are the values at both outputs, `columns` those of the law among all.
    """
    n, holds = promise.step.numel(), promise.holds

    def points(times: np.ndarray, values: np.ndarray) -> list[_Point]:
        return [_Point(t, v[0], v[1 : 1 + n], v[1 + n :]) for t, v in zip(times.tolist(), values, strict=True)]

    a, b = points(samples.outputs.rows.times[row : row + 2], ends)
    for k in range(PROMISES.closer):
        if min(_step(a, b), _jump(a, b)) <= allowed:
            return b.time, 0.0, k > 0
        times = np.linspace(a.time, b.time, PROMISES.parts + 1)[1:-1]
        parts = [a, *points(times, samples.inside(row, times)[:, columns]), b]
        place = next((i for i in range(PROMISES.parts) if holds(parts[i].excess) != holds(parts[i + 1].excess)), 0)
        a, b = parts[place], parts[place + 1]
    return b.time, _jump(a, b), True


def _step(a: _Point, b: _Point) -> float:
    """Difference of the cases where the indicator is 0, by linear interpolation; a value that is not finite equals the other."""
    one, two = (np.where(np.isfinite(p.step), p.step, q.step) for p, q in ((a, b), (b, a)))
    part = a.excess / (a.excess - b.excess) if a.excess != b.excess else 0.5
    return _largest(one + part * (two - one))


def _largest(values: np.ndarray) -> float:
    """Largest magnitude of some values; NaN counts as 0."""
    return float(np.fmax.reduce(np.abs(values), axis=None, initial=0.0))


def _jump(a: _Point, b: _Point) -> float:
    """Difference of the law between both sides."""
    return float(np.max(np.abs(b.value - a.value), initial=0.0))
