"""Whether laws that are declared smooth are: the step from case to case at the instants at which a run switches them.

Both cases are evaluated on both sides of a switch. Where they do not meet, the place is examined more closely, on the cubic
between two outputs, until the law has one value on both sides or hardly any time is left between them.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.once import once
from acausal.flatten.discontinuities import Promise
from acausal.policy import POLICY
from acausal.solve.checks.validity import Watch, watch
from acausal.solve.events.between import between
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.looks import spread
from acausal.solve.point import Rows
from acausal.solve.results.evaluator import Evaluator
from acausal.symbols import scalars, stacked

PROMISES = POLICY.promises


@dataclass(frozen=True)
class _Point:
    """Values at a time: excess, step and law."""

    time: float
    excess: float
    step: np.ndarray
    value: np.ndarray


class _Look:
    """Values of the promises of a model along a run."""

    def __init__(self, integrator: Integrator, outputs: Evaluator) -> None:
        compiled = integrator.compiled
        self.seen = _known(compiled)
        self.integrator, self.outputs = integrator, outputs

    def rows(self, places: np.ndarray) -> np.ndarray:
        """Values at some of the output points."""
        return self._values(self.outputs.rows[places])

    def inside(self, row: int, times: np.ndarray) -> np.ndarray:
        """Values at times between an output point and the next."""
        return self._values(between(self.integrator, self.outputs.rows[row : row + 2], times).rows)

    def _values(self, rows: Rows) -> np.ndarray:
        solver = self.outputs.solver
        return solver.problem.each(self.seen.function, solver(rows, self.seen.wanted)[0])


@once
def _known(compiled: CompiledModel) -> Watch:
    """Promises of what the equations hold; a derivative that no equation has cannot be evaluated."""
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
    return watch(compiled, [promise for promise, _ in found], [e for _, some in found for e in some])


def broken_promises(integrator: Integrator, outputs: Evaluator) -> list[str]:
    """Report which laws jumped in a run although they are declared smooth.

    Parameters
    ----------
    integrator : Integrator
        With model, parameters and tolerance.
    outputs : Evaluator
        Output points of the run.
    """
    if not integrator.compiled.reduced.flat.discontinuities.promises or len(outputs.rows) < 2:
        return []
    look = _Look(integrator, outputs)
    rows = spread(len(outputs.rows), POLICY.validity.dear if look.seen.wanted else POLICY.validity.rows)
    values, first, found = look.rows(rows), 0, dict[str, str]()
    for promise in look.seen.stated:
        n = promise.step.numel()
        columns = slice(first, first := first + 1 + 2 * n)
        text = _broken(look, rows, values[:, columns], columns, promise)
        if text:
            found.setdefault(str(promise.origin), text)
    return list(found.values())


def _broken(look: _Look, rows: np.ndarray, values: np.ndarray, columns: slice, promise: Promise) -> str:
    """Say that a law jumps, "" if it does not."""
    size = _largest(values[:, 1 + promise.step.numel() :])
    side = promise.holds(values[:, 0])
    closer = 0
    for k in np.flatnonzero(side[1:] != side[:-1]):
        low, high = int(rows[k]), int(rows[k + 1])
        while high - low > 1:
            middle = (low + high) // 2
            differs = promise.holds(look.rows(np.array([middle]))[0, columns][0]) != side[k]
            low, high = (low, middle) if differs else (middle, high)
        if closer == PROMISES.switches:
            break
        ends = (
            values[k : k + 2] if high - low == rows[k + 1] - rows[k] else look.rows(np.array([low, high]))[:, columns]
        )
        time, jump, looked = _at_switch(look, low, ends, columns, promise, PROMISES.step * size)
        closer += looked
        if jump > PROMISES.step * size:
            return (
                f"{promise.origin}: `smooth=True` promises a law without a jump, but near t = {time:.4g} s it jumps by "
                f"{jump:.4g}; the integration did not stop there, and its error is unknown. Leave `smooth=True` out, or "
                "let the cases of piecewise meet where they switch."
            )
    return ""


def _at_switch(
    look: _Look, row: int, ends: np.ndarray, columns: slice, promise: Promise, allowed: float
) -> tuple[float, float, bool]:
    """Time of a switch between an output point and the next, the jump there, and whether it had to be examined more closely.

    `ends` are the values at both, `columns` those of the promise among all.
    """
    n, holds = promise.step.numel(), promise.holds

    def points(times: np.ndarray, values: np.ndarray) -> list[_Point]:
        return [_Point(t, v[0], v[1 : 1 + n], v[1 + n :]) for t, v in zip(times.tolist(), values, strict=True)]

    a, b = points(look.outputs.rows.times[row : row + 2], ends)
    for k in range(PROMISES.closer):
        if min(_step(a, b), _jump(a, b)) <= allowed:
            return b.time, 0.0, k > 0
        times = np.linspace(a.time, b.time, PROMISES.parts + 1)[1:-1]
        parts = [a, *points(times, look.inside(row, times)[:, columns]), b]
        place = next((i for i in range(PROMISES.parts) if holds(parts[i].excess) != holds(parts[i + 1].excess)), 0)
        a, b = parts[place], parts[place + 1]
    return b.time, _jump(a, b), True


def _step(a: _Point, b: _Point) -> float:
    """The step where the excess is 0, on the line through both sides; what has no value on one side counts as on the other."""
    one, two = (np.where(np.isfinite(p.step), p.step, q.step) for p, q in ((a, b), (b, a)))
    part = a.excess / (a.excess - b.excess) if a.excess != b.excess else 0.5
    return _largest(one + part * (two - one))


def _largest(values: np.ndarray) -> float:
    """Size of the largest of some values; what has none counts as 0."""
    return float(np.fmax.reduce(np.abs(values), axis=None, initial=0.0))


def _jump(a: _Point, b: _Point) -> float:
    """How much the law itself differs on both sides, whatever cases it takes there."""
    return float(np.max(np.abs(b.value - a.value), initial=0.0))
