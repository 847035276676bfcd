"""Work of the supplied and of the dissipated power, by quadrature on values that satisfy the equations.

An integrator chooses its steps for the states alone: where these are longer than the intervals between rows, its own
quadrature may be far off. The powers at the rows are then smooth from one to the next, and splines through them are
right, which fewer nodes tell; elsewhere the integrator's steps are the better points.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.policy import POLICY
from acausal.solve.hermite import cubic
from acausal.solve.integrate.consistent import Consistent
from acausal.solve.integrate.trace import Stretch
from acausal.solve.looks import GOLDEN, spread
from acausal.solve.problem import Point
from acausal.solve.start.newton import algebraic

ENERGY = POLICY.energy

Points = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def powers(
    compiled: CompiledModel, solver: Consistent, x: np.ndarray, z: np.ndarray, t: np.ndarray, constants: np.ndarray
) -> np.ndarray:
    """Supplied and dissipated power in W at n times, shape (n, 2).

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    solver : Consistent
        Solves for what the powers need of z.
    x, z, t : arrays, shapes (n, nx), (n, nz), (n,)
        States, algebraic unknowns nearly right, and times in s.
    constants : array
        Constants of the segment.
    """
    wanted = compiled.dependence.inside(compiled.powers)
    z = solver(x, z, t, constants, wanted)
    solver.unsolved.clear()
    return compiled.power(x, z, solver.p, t, constants)


def work(times: np.ndarray, power: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Work up to each of n times, from a spline of order 5.

    Parameters
    ----------
    times, power : arrays, shapes (k,), (k, m)
        Times in s and powers in W that are known, 6 at least.
    at : array, shape (n,)
        Times in s.
    """
    return scipy.interpolate.make_interp_spline(times, power, 5).antiderivative()(at)


def refined(
    compiled: CompiledModel, solver: Consistent, rows: Points, given: np.ndarray, tolerance: float, smooth: bool
) -> tuple[np.ndarray, bool]:
    """Work up to each row, and whether it is known to the tolerance.

    It comes from splines through some rows, or all, or points between them; or from the integrator where it agrees.

    Parameters
    ----------
    compiled, solver
        As of `powers`.
    rows : tuple of arrays
        x, z, t, constants of n rows, as of `powers`.
    given : array, shape (n, 2)
        What the integrator found, in J.
    tolerance : float
        Relative to the work between two nodes of a spline, taken positive and on average, or to what is stored meanwhile.
    smooth : bool
        Whether rows are nearer to each other than steps, so that cubics through them follow the motion.
    """
    x, z, t, constants = rows
    count, last = min(ENERGY.fewest, len(t) - 1), len(t) - 1
    least = tolerance * _exchanged(compiled, solver, rows) / len(t)
    while True:
        some = np.unique(np.linspace(0, last, count + 1).round().astype(int))
        power = powers(compiled, solver, x[some], z[some], t[some], constants)
        if not np.all(np.isfinite(power)):
            return given, False
        fine, rough = work(t[some], power, t), work(t[some[_halved(some)]], power[_halved(some)], t)
        each, error = (np.diff(w[some], axis=0) for w in (fine, rough - fine))
        settled = bool(
            np.all(np.abs(error) / ENERGY.gain <= np.maximum(tolerance * np.mean(np.abs(each), axis=0), least))
        )
        if settled or len(some) == len(t):
            break
        count = min(2 * count, last)
    # Where the nodes are too few for the power, and the integrator agrees as far as they can tell, it is nearer.
    agree = np.abs(np.diff(given[some], axis=0) - each) <= np.abs(error)
    if smooth and not (settled and _seen(compiled, solver, rows, t[some] - t[0], power)):
        closer, known = between_rows(compiled, solver, rows, tolerance)
        if known or not np.all(agree):
            return given[0] + closer, known
    steps = np.where(np.repeat(agree, np.diff(some), axis=0), np.diff(given, axis=0), np.diff(fine, axis=0))
    return np.vstack([given[:1], given[:1] + np.cumsum(steps, axis=0)]), True


def between_rows(
    compiled: CompiledModel, solver: Consistent, rows: Points, tolerance: float
) -> tuple[np.ndarray, bool]:
    """Work up to each row from more and more points between them, on cubics through the states, until it settles.

    Parameters
    ----------
    compiled, solver, rows, tolerance
        As of `refined`.
    """
    x, z, t, constants = rows
    z = solver(x, z, t, constants)
    rows, n, agreed = (x, z, t, constants), len(t) - 1, 0
    rates = solver.rates(x, z, t, constants)
    found, change = np.full((n + 1, 2), np.inf), np.full(2, np.inf)
    exchanged = _exchanged(compiled, solver, rows)
    parts = 2 ** max(1, int(np.ceil(np.log2(ENERGY.fewest / n))))
    while n * parts <= ENERGY.most:
        xs, zs, since = _inside(rows, rates, np.arange(n * parts + 1) / parts)
        power = powers(compiled, solver, xs, zs, t[0] + since, constants)
        if not np.all(np.isfinite(power)):
            break
        before, found = found, work(since, power, t - t[0])
        scale = np.mean(np.abs(power), axis=0) * (t[-1] - t[0]) + exchanged
        last, change = change, np.max(np.abs(found - before), axis=0)
        # Between its steps an integrator is not smooth: then more points do not change less.
        rough = np.all((change >= last / 4) & (change <= ENERGY.alike * scale))
        agreed = agreed + 1 if np.all(change / ENERGY.gain <= tolerance * scale) or rough else 0
        if agreed == 2 and _seen(compiled, solver, rows, since, power, rates):
            return found, True
        parts *= 2
    return np.nan_to_num(found), False


def _exchanged(compiled: CompiledModel, solver: Consistent, rows: Points) -> float:
    """By how much the stored energy varies: a tiny power need not be known to its own tolerance."""
    x, z, t, constants = rows
    some = spread(len(t), ENERGY.looks)
    return float(np.ptp([compiled.stored(x[k], z[k], solver.p, t[k], constants)[0][0] for k in some]))


def _inside(rows: Points, rates: np.ndarray, s: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """States, algebraic unknowns nearly right, and times since the first row; s counts rows."""
    x, z, t, _ = rows
    k = np.minimum(s.astype(int), len(t) - 2)
    u = (s - k)[:, None]
    h = (t[k + 1] - t[k])[:, None]
    return (
        cubic(u, h, (x[k], x[k + 1]), (rates[k], rates[k + 1]))[0],
        z[k] + u * (z[k + 1] - z[k]),
        t[k] - t[0] + (u * h)[:, 0],
    )


def _seen(
    compiled: CompiledModel,
    solver: Consistent,
    rows: Points,
    times: np.ndarray,
    power: np.ndarray,
    rates: np.ndarray | None = None,
) -> bool:
    """Whether a spline of the power, over times since the first row, is right beside its nodes."""
    x, z, t, constants = rows
    s = (np.arange(1, ENERGY.probes + 1) * GOLDEN) % 1 * (len(t) - 1)
    if rates is None:
        k = np.minimum(s.astype(int), len(t) - 2)
        ends = np.unique([k, k + 1])
        z = z.copy()
        z[ends] = solver(x[ends], z[ends], t[ends], constants)
        rates = np.zeros(x.shape)
        rates[ends] = solver.rates(x[ends], z[ends], t[ends], constants)
    probes = _inside((x, z, t, constants), rates, s)
    true = powers(compiled, solver, probes[0], probes[1], t[0] + probes[2], constants)
    missed = np.abs(scipy.interpolate.make_interp_spline(times, power, 5)(probes[2]) - true)
    return bool(np.all(missed <= ENERGY.alike * np.max(np.abs(power), axis=0)))


def _halved(some: np.ndarray) -> np.ndarray:
    """Every second node, and the last one."""
    return np.unique([*range(0, len(some), 2), len(some) - 1])


def everywhere(solver: Consistent, at: Point, times: np.ndarray, tolerance: float | None) -> Stretch:
    """Go from output to output where there is nothing to integrate.

    Parameters
    ----------
    solver : Consistent
        As of `powers`.
    at : Point
        Where it begins.
    times : array, shape (n + 1,)
        Times in s, that of the point first.
    tolerance : float or None
        Of the energies; None leaves them 0.
    """
    compiled, constants, found = solver.compiled, at.constants, [at.z]
    for time in times[1:]:
        at = algebraic(solver.problem, replace(at, time=float(time)))
        found.append(at.z)
    n, z, energy = len(times) - 1, np.array(found), np.zeros((len(times) - 1, 2))
    if tolerance is not None and not compiled.powers.is_zero():
        energy = between_rows(compiled, solver, (np.zeros((n + 1, 0)), z, times, constants.vector), tolerance)[0][1:]
    return Stretch(np.array(times[1:]), np.zeros((n, 0)), z[1:], energy, constants, 0)
