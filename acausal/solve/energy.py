"""Work of the supplied and of the dissipated power, by quadrature on values that satisfy the equations.

An integrator chooses its steps for the states alone: where these are longer than the intervals between rows, its own
quadrature may be far off. The powers at the rows are then smooth from one to the next, and splines through them are
right, which fewer nodes tell; elsewhere the integrator's steps are the better points.
"""

from __future__ import annotations

import numpy as np
from scipy.interpolate import make_interp_spline

from acausal.compiler import CompiledModel
from acausal.solve.consistent import Consistent
from acausal.solve.initialize import algebraic
from acausal.solve.trace import Stretch

# Nodes of a spline to begin with, and rows of a stretch that there must be at least, to have more.
FEWEST, ROWS = 48, 192
# Steps of an interval from which on a method of order 2 is right; higher orders are with one (measured on the spin-up).
RESOLVED = 8
# Of the error by halving the intervals, 2^6 for smooth powers, with some caution.
GAIN = 20
# Halvings after which the power of a model without states counts as rough.
HALVINGS = 8


def powers(
    compiled: CompiledModel, solver: Consistent, x: np.ndarray, z: np.ndarray, t: np.ndarray, modes: np.ndarray
) -> np.ndarray:
    """Supplied and dissipated power in W at n times, shape (n, 2).

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    solver : Consistent
        Makes what the powers need of z right.
    x, z, t : arrays, shapes (n, nx), (n, nz), (n,)
        States, algebraic unknowns nearly right, and times in s.
    modes : array
        Constants of the segment.
    """
    wanted = compiled.dependence.inside(compiled.powers)
    z = solver(x, z, t, np.broadcast_to(modes, (len(t), len(modes))), wanted)
    solver.unsolved.clear()
    rows = zip(x, z, t.tolist(), strict=True)
    return np.array([compiled.power(a, b, solver.p, time, modes)[0].copy() for a, b, time in rows])


def work(times: np.ndarray, power: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Work up to each of n times, from a spline of order 5.

    Parameters
    ----------
    times, power : arrays, shapes (k,), (k, m)
        Times in s and powers in W that are known, 6 at least.
    at : array, shape (n,)
        Times in s.
    """
    return make_interp_spline(times, power, 5).antiderivative()(at)


def refined(
    compiled: CompiledModel,
    solver: Consistent,
    rows: tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray],
    given: np.ndarray,
    tolerance: float,
) -> np.ndarray:
    """Work up to each row: by splines, or as the integrator gives it where these cannot tell.

    Parameters
    ----------
    compiled, solver
        As of `powers`.
    rows : tuple of arrays
        x, z, t, modes of n rows, as of `powers`.
    given : array, shape (n, 2)
        What the integrator found, in J.
    tolerance : float
        Relative to the work between two nodes of a spline, taken positive and on average.
    """
    x, z, t, modes = rows
    count, last = min(FEWEST, len(t) - 1), len(t) - 1
    while True:
        some = np.unique(np.linspace(0, last, count + 1).round().astype(int))
        power = powers(compiled, solver, x[some], z[some], t[some], modes)
        fine, rough = work(t[some], power, t), work(t[some[_halved(some)]], power[_halved(some)], t)
        each, error = (np.diff(w[some], axis=0) for w in (fine, rough - fine))
        if np.all(np.abs(error) / GAIN <= tolerance * np.mean(np.abs(each), axis=0)) or len(some) == len(t):
            break
        count = min(2 * count, last)
    # Where the nodes are too few for the power, and the integrator agrees as far as they can tell, it is nearer.
    agree = np.abs(np.diff(given[some], axis=0) - each) <= np.abs(error)
    steps = np.where(np.repeat(agree, np.diff(some), axis=0), np.diff(given, axis=0), np.diff(fine, axis=0))
    return np.vstack([given[:1], given[:1] + np.cumsum(steps, axis=0)])


def _halved(some: np.ndarray) -> np.ndarray:
    """Every second node, and the last one."""
    return np.unique([*range(0, len(some), 2), len(some) - 1])


def everywhere(
    compiled: CompiledModel,
    solver: Consistent,
    times: np.ndarray,
    z: np.ndarray,
    modes: np.ndarray,
    tolerance: float | None,
) -> Stretch:
    """Go from output to output where there is nothing to integrate.

    Parameters
    ----------
    compiled, solver
        As of `powers`.
    times : array, shape (n + 1,)
        The first is where it begins, in s.
    z, modes : arrays
        Values there.
    tolerance : float or None
        Of the energies; None leaves them 0.
    """
    found = [z]
    for time in times[1:]:
        found.append(algebraic(compiled, found[-1], solver.p, float(time), modes))
    n, energy = len(times) - 1, np.zeros((len(times) - 1, 2))
    if tolerance is not None and not compiled.powers.is_zero():
        energy = _motionless(compiled, solver, times, np.array(found), modes, tolerance)
    return Stretch(np.array(times[1:]), np.zeros((n, 0)), np.array(found[1:]), energy, modes, 0)


def _motionless(
    compiled: CompiledModel, solver: Consistent, times: np.ndarray, z: np.ndarray, modes: np.ndarray, tolerance: float
) -> np.ndarray:
    """Work up to each output of a model without states: intervals are halved until two halvings change nothing."""
    n, found, agreed = len(times) - 1, np.full((len(times) - 1, 2), np.inf), 0
    parts = 2 ** max(1, int(np.ceil(np.log2(FEWEST / n))))
    for _ in range(HALVINGS):
        s = np.arange(n * parts + 1) / parts
        t, near = np.interp(s, np.arange(n + 1), times), np.minimum(s.astype(int), n - 1)
        guess = z[near] + (s - near)[:, None] * (z[near + 1] - z[near])
        power = powers(compiled, solver, np.zeros((len(t), 0)), guess, t, modes)
        before, found = found, work(t, power, times[1:])
        right = np.abs(found - before) / GAIN <= tolerance * np.max(np.abs(found), axis=0)
        agreed = agreed + 1 if right.all() else 0
        if agreed == 2:
            break
        parts *= 2
    return found
