"""Values between two points of a run, from the cubic that has their states and rates (Hermite)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from acausal.compiler.constants import Constants
from acausal.policy import POLICY
from acausal.solve.hermite import cubic
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.energy import between_rows
from acausal.solve.integrate.trace import Stretch
from acausal.solve.problem import Point

BETWEEN = POLICY.between


@dataclass(frozen=True)
class Between:
    """Points between two others.

    Attributes
    ----------
    times, x, z : arrays, shapes (n,), (n, nx), (n, nz)
        Times in s, states and consistent algebraic unknowns.
    defect : array, shape (n,)
        How much the states would be off at the end if their rates were off all the way as they are there, as a fraction of
        what the tolerance allows (defect control, Enright 1989).
    """

    times: np.ndarray
    x: np.ndarray
    z: np.ndarray
    defect: np.ndarray


def between(
    run: Integrator,
    constants: Constants,
    ends: np.ndarray,
    x: np.ndarray,
    z: np.ndarray,
    times: np.ndarray,
) -> Between:
    """Interpolate.

    Parameters
    ----------
    run : Integrator
        With model, parameters and tolerance.
    constants : Constants
        Those of the segment.
    ends, x, z : arrays, shapes (2,), (2, nx), (2, nz)
        The two points, with algebraic unknowns nearly right.
    times : array, shape (n,)
        Times between them.
    """
    c, h, vector = run.compiled, ends[1] - ends[0], constants.vector
    s = ((times - ends[0]) / h)[:, None]
    z = run.consistent(x, z, ends, vector)
    rates = run.consistent.rates(x, z, ends, vector)
    found, slope = cubic(s, h, x, rates)
    nearly = z[0] + s * (z[1] - z[0])
    inside = run.consistent(found, nearly, times, vector)
    true = run.consistent.rates(found, inside, times, vector)
    weights = run.tolerance * (np.abs(found) + run.settings.nominal[: c.nx])
    defect = np.max(np.abs(slope - true) * h / weights, axis=1, initial=0.0)
    if run.consistent.unsolved:
        run.consistent.unsolved.clear()
        defect[:] = np.inf
    return Between(times, found, inside, np.nan_to_num(defect, nan=np.inf))


def work_between(run: Integrator, constants: Constants, ends: np.ndarray, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Integrals of the supplied and of the dissipated power in J from one point to another; arguments as of `between`."""
    c, vector = run.compiled, constants.vector
    if not run.settings.energy or c.powers.is_zero() or ends[1] <= ends[0]:
        return np.zeros(2)
    looks = np.linspace(ends[0], ends[1], BETWEEN.looks + 2)[1:-1]
    if np.all(between(run, constants, ends, x, z, looks).defect <= BETWEEN.faithful):
        found, known = between_rows(c, run.consistent, (x, z, ends, vector), run.tolerance)
        if known:
            return found[-1]
    at = Point(float(ends[0]), x[0], z[0], constants)
    stretch = run.attempt(at, ends, replace(run.way, max_steps=BETWEEN.most_steps, careful=True))
    if isinstance(stretch, Stretch):
        return stretch.energy[-1]
    return between_rows(c, run.consistent, (x, z, ends, vector), run.tolerance)[0][-1]
