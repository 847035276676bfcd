"""Whether the algebraic unknowns go on along one solution of their equations, in steps of a method that does not iterate.

It sees errors of the states alone. Where a solution ends, as at a fold of the equations, its next step leads to another one,
or to values that are none: the unknowns jump there, however closely one looks.
"""

from __future__ import annotations

import numpy as np

from acausal.core import Curve
from acausal.policy import POLICY
from acausal.solve.integrate.consistent import Consistent
from acausal.solve.point import Rows

BRANCHES = POLICY.branches


def first_jump(consistent: Consistent, curve: Curve, constants: np.ndarray) -> float | None:
    """Return a time in s at which algebraic unknowns jump, or have no value, in some steps, None if there is none.

    Parameters
    ----------
    consistent : Consistent
        Solves for the unknowns.
    curve : Curve
        The steps, states and algebraic unknowns.
    constants : array
        Constants of the segment.
    """
    if len(curve.times) == 1:  # all steps were refused
        return None
    nx, parts = consistent.problem.nx, np.linspace(0, 1, BRANCHES.parts + 1)

    def solved(times: np.ndarray, *guesses: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Values at some times, from the first of some guesses that leads to them, and times at which none does."""
        x, z, left = curve(times)[:, :nx], guesses[0].copy(), np.arange(len(times))
        for guess in guesses:
            rows, right = consistent.solve(Rows.within(times[left], x[left], guess[left], constants))
            z[left], left = rows.z, left[~right]
            if not left.size:
                break
        return z, times[left]

    z, lost = solved(curve.times, curve.y[:, nx:])
    size = consistent.sizes(np.maximum.accumulate(np.abs(z)))[1:]
    begins, ends, before, after = curve.times[:-1], curve.times[1:], z[:-1], z[1:]
    most = np.max(np.abs(after - before) / size, axis=1)
    on = np.flatnonzero(most > BRANCHES.slight)
    for _ in range(BRANCHES.zooms):
        if lost.size or not on.size:
            return float(lost[0]) if lost.size else None
        begins, ends, before, after, size, most = (a[on] for a in (begins, ends, before, after, size, most))
        times = begins[:, None] + parts * (ends - begins)[:, None]
        nearly = before[:, None] + parts[:, None] * (after - before)[:, None]
        near = np.repeat(before, len(parts), axis=0)
        z, lost = solved(times.ravel(), nearly.reshape(near.shape), near)
        z = z.reshape(nearly.shape)
        change = np.max(np.abs(np.diff(z, axis=1)) / size[:, None], axis=2)
        every, place = np.arange(len(on)), np.argmax(change, axis=1)
        begins, ends, before, after = times[every, place], times[every, place + 1], z[every, place], z[every, place + 1]
        largest = change[every, place]
        # What is smooth changes by about as much in each part.
        on, most = np.flatnonzero((largest > BRANCHES.slight) & (largest > BRANCHES.share * most)), largest
    return float(begins[on[0]]) if on.size else None
