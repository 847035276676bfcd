"""Work of the supplied and of the dissipated power, by quadrature on values that satisfy the equations.

An integrator chooses its steps for the states alone: where these are longer than the intervals between rows, its own
quadrature may be far off. The powers at the rows are then smooth from one to the next, and splines through them are
right, which fewer nodes tell; elsewhere the integrator's steps are the better points. A run has stretches of both kinds: what
settles does so in a small part of it.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy

from acausal.policy import POLICY
from acausal.solve.hermite import cubic
from acausal.solve.integrate.consistent import Consistent
from acausal.solve.looks import GOLDEN, spread
from acausal.solve.point import Rows

ENERGY = POLICY.energy


def powers(solver: Consistent, rows: Rows) -> np.ndarray:
    """Supplied and dissipated power in W at n times, shape (n, 2).

    Parameters
    ----------
    solver : Consistent
        Solves for the algebraic unknowns that the powers need.
    rows : Rows
        States, and algebraic unknowns nearly right.
    """
    compiled = solver.compiled
    return solver.problem.each(compiled.power, solver(rows, compiled.dependence.inside(compiled.powers))[0])


def work(times: np.ndarray, power: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Work up to each of n times, from a spline of order 5.

    Parameters
    ----------
    times, power : arrays, shapes (k,), (k, m)
        Times in s and powers in W that are known.
    at : array, shape (n,)
        Times in s.
    """
    return _spline(times, power).antiderivative()(at)


def _spline(times: np.ndarray, values: np.ndarray) -> scipy.interpolate.BSpline:
    """Return the spline of order 5 through values at times of which some may be equal, of a lower one through few of them."""
    apart = np.append(True, np.diff(times) > 0)  # parts of an interval of a few rounding errors are
    order = {1: 0, 2: 1, 3: 1, 4: 3, 5: 3}.get(int(np.sum(apart)), 5)
    return scipy.interpolate.make_interp_spline(times[apart], values[apart], order)


def refined(
    solver: Consistent, rows: Rows, given: np.ndarray, tolerance: float, taken: np.ndarray | None, smooth: bool
) -> tuple[np.ndarray, bool]:
    """Work up to each row, and whether it is known to the tolerance.

    It comes from the integrator where its steps are no longer than the intervals between rows, and from splines through some
    rows, or all, or points between them, in stretches of longer steps; or the other way round where that balances clearly
    better with the stored energy.

    Parameters
    ----------
    solver : Consistent
        As of `powers`.
    rows : Rows
        n rows of one segment, as of `powers`.
    given : array, shape (n, 2)
        What the integrator found, in J.
    tolerance : float
        Relative to the work between two nodes of a spline, taken positive and on average, or to what is stored meanwhile.
    taken : array, shape (n,), or None
        Steps up to each row, with parts of steps; not known if None.
    smooth : bool
        Whether rows are nearer to each other than steps, so that cubics through them follow the motion.
    """
    work = np.diff(given, axis=0)
    steps = np.zeros(len(work)) if taken is None else np.diff(taken)
    if np.all(steps >= 1):
        return given, True
    known, energy = True, _stored(solver, rows)
    stored, exchanged = np.diff(energy), _exchanged(energy)
    off = _unbalanced(work, stored)
    apart = (steps < 1) | (off > tolerance * np.mean(np.sum(np.abs(work), axis=1) + np.abs(stored)))
    ends = np.flatnonzero(np.diff(np.concatenate([[False], apart, [False]])))
    for first, last in ends.reshape(-1, 2).tolist():
        if last - first < ENERGY.least:
            continue
        some, rest = slice(first, last), slice(first, last + 1)
        found, sure = _by_splines(
            *(solver, rows[rest], given[rest], tolerance, exchanged, None if taken is None else taken[rest], smooth)
        )
        each = np.diff(found, axis=0)
        left = _unbalanced(each, stored[some])
        kept = np.where(steps[some] < 1, off[some] < ENERGY.clearly * left, left >= ENERGY.clearly * off[some])
        work[some] = np.where(kept[:, None], work[some], each)
        known &= sure or np.sum(np.minimum(left, off[some])) <= tolerance * np.sum(np.abs(work[some]))
    return np.vstack([given[:1], given[:1] + np.cumsum(work, axis=0)]), bool(known)


def _stored(solver: Consistent, rows: Rows) -> np.ndarray:
    """Stored energy at each row in J."""
    problem, rows = solver.problem, solver(rows)[0]
    return np.array([problem.stored(problem.point(rows, k)) for k in range(len(rows))])


def _exchanged(stored: np.ndarray) -> float:
    """By how much the stored energy varies, but for rounding: a tiny power need not be known to its own tolerance."""
    return float(np.ptp(stored) + ENERGY.rounding * np.max(np.abs(stored)))


def _unbalanced(work: np.ndarray, stored: np.ndarray) -> np.ndarray:
    """What supplied, dissipated and stored energy leave in each interval, in J."""
    return np.abs(work[:, 0] - work[:, 1] - stored)


def _nodes(times: np.ndarray, taken: np.ndarray | None, count: int) -> np.ndarray:
    """Some rows: evenly spread over time, and over the steps that led there, if these are known."""
    last = len(times) - 1
    even = np.linspace(0, last, count + 1).round().astype(int)
    if taken is None:
        return np.unique(even)
    along = np.searchsorted(taken, np.linspace(taken[0], taken[-1], count + 1))
    return np.unique(np.concatenate([even, np.minimum(along, last)]))


def _by_splines(
    solver: Consistent,
    rows: Rows,
    given: np.ndarray,
    tolerance: float,
    exchanged: float,
    taken: np.ndarray | None,
    smooth: bool,
) -> tuple[np.ndarray, bool]:
    """The same for one stretch, in which the stored energy varies by `exchanged` J."""
    t, last, least = rows.times, len(rows) - 1, tolerance * exchanged
    # Two nodes for each step: no motion that the integrator followed lies between them.
    count = min(max(ENERGY.fewest, last if taken is None else 2 * int(np.ceil(taken[-1] - taken[0]))), last)
    while True:
        some = _nodes(t, taken, count)
        power = powers(solver, rows[some])
        if not np.all(np.isfinite(power)):
            return given, False
        fine, rough = work(t[some], power, t), work(t[some[_halved(some)]], power[_halved(some)], t)
        each, error = (np.diff(w[some], axis=0) for w in (fine, rough - fine))
        settled = bool(
            np.all(np.abs(error) / ENERGY.gain <= np.maximum(tolerance * np.mean(np.abs(each), axis=0), least / len(t)))
        )
        if settled or len(some) == len(t):
            break
        count = min(2 * count, last)
    # Where the nodes are too few for the power, and the integrator agrees as far as they can tell, it is nearer.
    agree = np.abs(np.diff(given[some], axis=0) - each) <= np.abs(error)
    if smooth and not (settled and _seen(solver, rows, t[some] - t[0], power, least)):
        steps = last if taken is None else int(np.ceil(taken[-1] - taken[0]))
        closer, known = between_rows(solver, rows, tolerance, exchanged, ENERGY.a_step * max(steps, last))
        if known or not np.all(agree):
            return given[0] + closer, known
    steps = np.where(np.repeat(agree, np.diff(some), axis=0), np.diff(given, axis=0), np.diff(fine, axis=0))
    return np.vstack([given[:1], given[:1] + np.cumsum(steps, axis=0)]), True


def between_rows(
    solver: Consistent, rows: Rows, tolerance: float, exchanged: float | None = None, most: int = ENERGY.most
) -> tuple[np.ndarray, bool]:
    """Work up to each row from more and more points between them, on cubic splines through the states, until it settles.

    Parameters
    ----------
    solver, rows, tolerance
        As of `refined`.
    exchanged : float, optional
        By how much the stored energy varies in J, if that is known.
    most : int, optional
        Points at most, in all.
    """
    rows, _ = solver(rows)
    t, n, agreed = rows.times, len(rows) - 1, 0
    slopes = _slopes(solver, rows)
    found, change = np.full((n + 1, 2), np.inf), np.full(2, np.inf)
    some = rows[spread(n + 1, ENERGY.looks)]
    exchanged = _exchanged(_stored(solver, some)) if exchanged is None else exchanged
    parts = 2 ** max(1, int(np.ceil(np.log2(ENERGY.fewest / n))))
    while n * parts <= min(most, ENERGY.most):
        inside, since = _inside(rows, slopes, np.arange(n * parts + 1) / parts)
        power = powers(solver, inside)
        if not np.all(np.isfinite(power)):
            break
        before, found = found, work(since, power, t - t[0])
        scale = np.mean(np.abs(power), axis=0) * (t[-1] - t[0]) + exchanged
        last, change = change, np.max(np.abs(found - before), axis=0)
        # Between its steps an integrator is not smooth: then more points do not change less.
        rough = np.all((change >= last / 4) & (change <= ENERGY.alike * scale))
        agreed = agreed + 1 if np.all(change / ENERGY.gain <= tolerance * scale) or rough else 0
        if agreed == 2 and _seen(solver, rows, since, power, tolerance * exchanged):
            return found, True
        parts *= 2
    return np.nan_to_num(found), False


def along(solver: Consistent, inside: Callable[[np.ndarray], Rows], times: np.ndarray) -> np.ndarray:
    """Work up to each of n times by Lobatto's rule of order 6 between each two, shape (n, 2).

    Parameters
    ----------
    solver : Consistent
        As of `powers`.
    inside : callable
        Rows at any times, as of `powers`.
    times : array, shape (n,)
        Times in s, near enough that nothing turns twice between two of them.
    """
    h = np.diff(times)
    nodes = (times[:-1, None] + h[:, None] * (0.5 + np.array([-0.5, -0.5 / 5**0.5, 0.5 / 5**0.5, 0.5]))).ravel()
    power = powers(solver, inside(nodes)).reshape(len(h), 4, 2)
    each = h[:, None] * np.tensordot(power, np.array([1, 5, 5, 1]) / 12, (1, 0))
    return np.vstack([np.zeros((1, 2)), np.cumsum(each, axis=0)])


def _slopes(solver: Consistent, rows: Rows) -> np.ndarray:
    """Slopes of the states at consistent rows: those of splines of order 5 through them, or the rates of a few rows.

    What is stiff makes more of an interpolant's errors in its rates: stiff dampers would waste what is not there.
    """
    if len(rows) < 6:
        return solver.rates(rows)
    return _spline(rows.times, rows.x)(rows.times, 1)


def _inside(rows: Rows, slopes: np.ndarray, s: np.ndarray) -> tuple[Rows, np.ndarray]:
    """Rows whose algebraic unknowns are nearly right, and their times since the first row; s counts rows."""
    x, z, t = rows.x, rows.z, rows.times
    k = np.minimum(s.astype(int), len(t) - 2)
    u = (s - k)[:, None]
    h = (t[k + 1] - t[k])[:, None]
    found, _ = cubic(u, h, (x[k], x[k + 1]), (slopes[k], slopes[k + 1]))
    since = t[k] - t[0] + (u * h)[:, 0]
    return Rows(t[0] + since, found, z[k] + u * (z[k + 1] - z[k]), rows.constants[k]), since


def _seen(solver: Consistent, rows: Rows, times: np.ndarray, power: np.ndarray, least: float) -> bool:
    """Whether a spline of the power, over times since the first row, is right beside its nodes, but for a work of `least`."""
    s = (np.arange(1, ENERGY.probes + 1) * GOLDEN) % 1 * (len(rows) - 1)
    k = np.minimum(s.astype(int), len(rows) - 2)
    ends = np.unique([k, k + 1])
    z = rows.z.copy()
    z[ends] = solver(rows[ends])[0].z
    rows = rows.with_z(z)
    probes, since = _inside(rows, _slopes(solver, rows), s)
    missed = np.abs(_spline(times, power)(since) - powers(solver, probes))
    return bool(np.all(missed <= np.maximum(ENERGY.alike * np.max(np.abs(power), axis=0), least / times[-1])))


def _halved(some: np.ndarray) -> np.ndarray:
    """Every second node, and the last one."""
    return np.unique([*range(0, len(some), 2), len(some) - 1])
