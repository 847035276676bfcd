"""Values between two points of a run, from the cubic that has their states and rates (Hermite)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from acausal.solve.integrate import Integrator


@dataclass(frozen=True)
class Between:
    """Points between two others.

    Attributes
    ----------
    times, x, z : arrays, shapes (n,), (n, nx), (n, nz)
        Times in s, states and consistent algebraic unknowns.
    energy : array, shape (n, 2)
        Integrals of the supplied and of the dissipated power in J.
    defect : array, shape (n,)
        How much the states would be off at the end if their rates were off all the way as they are there, in parts of
        what the tolerance allows (defect control, Enright 1989).
    """

    times: np.ndarray
    x: np.ndarray
    z: np.ndarray
    energy: np.ndarray
    defect: np.ndarray


def between(
    run: Integrator,
    modes: np.ndarray,
    ends: np.ndarray,
    x: np.ndarray,
    z: np.ndarray,
    energy: np.ndarray,
    times: np.ndarray,
) -> Between:
    """Interpolate.

    Parameters
    ----------
    run : Integrator
        Tells model, parameters and tolerance.
    modes : array
        Constants of the segment.
    ends, x, z, energy : arrays, shapes (2,), (2, nx), (2, nz), (2, 2)
        The two points, with algebraic unknowns nearly right.
    times : array, shape (n,)
        Times between them.
    """
    c, h = run.compiled, ends[1] - ends[0]
    s = ((times - ends[0]) / h)[:, None]
    both = np.broadcast_to(modes, (2, len(modes)))
    z = run.consistent(x, z, ends, both)
    rates = run.consistent.rates(x, z, ends, both)
    found, slope = _cubic(s, h, x, rates)
    inner = np.broadcast_to(modes, (len(times), len(modes)))
    guess = z[0] + s * (z[1] - z[0])
    inside = run.consistent(found, guess, times, inner)
    true = run.consistent.rates(found, inside, times, inner)
    weights = run.tolerance * (np.abs(found) + run.settings.nominal[: c.nx])
    defect = np.max(np.abs(slope - true) * h / weights, axis=1, initial=0.0)
    if run.consistent.unsolved:
        run.consistent.unsolved.clear()
        defect[:] = np.inf
    work = energy[0] + s * 0
    if run.settings.energy:
        at = zip(x, z, ends, strict=True)
        powers = np.array([c.power(a, b, run.p, t, modes)[0].copy() for a, b, t in at])
        work = _cubic(s, h, energy, powers)[0]
    return Between(times, found, inside, work, np.nan_to_num(defect, nan=np.inf))


def _cubic(s: np.ndarray, h: float, value: np.ndarray, rate: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Value and slope at parts s of an interval of length h."""
    (a, b), (da, db) = value, rate * h
    c3, c2 = 2 * a - 2 * b + da + db, 3 * (b - a) - 2 * da - db
    return ((c3 * s + c2) * s + da) * s + a, ((3 * c3 * s + 2 * c2) * s + da) / h
