"""What is tried where a call over many outputs failed: output by output, other states, the other method, longer steps."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from acausal.solve.problem import Point
from acausal.solve.trace import Stretch

if TYPE_CHECKING:
    from acausal.solve.integrate import Integrator

# Steps before a run counts as long, before a chunk or an output counts as hopeless, and in each of the last tries.
LONG, HOPELESS, PATIENT = 100_000, 2_000_000, 20_000
LOOSER, LOOSEST = (1.0, 1e2, 1e4), 1e-4


def creep(run: Integrator, at: Point, times: np.ndarray) -> Point:
    """Go from output to output, until the failure if there is one; return the last point."""
    for k in range(len(times) - 1):
        here = times[k : k + 2]
        stretch = passage(run, at, here, hard=True)
        if stretch is None:
            raise run.failure(*here)
        run.trace.add(stretch)
        at = stretch.end(at)
    return at


def passage(run: Integrator, at: Point, times: np.ndarray, hard: bool) -> Stretch | None:
    """Go over one interval where a call over many failed; None if it cannot be done either.

    Parameters
    ----------
    run : Integrator
        The run.
    at : Point
        Where it begins.
    times : array, shape (2,)
        Its ends in s.
    hard : bool
        Whether to try everything: new choices of states on the way, the other method, a larger tolerance.
    """
    if not hard:
        return run.attempt(at, times, LONG, careful=True)
    return _stride(run, at, times) or _loosely(run, at, times)


def _stride(run: Integrator, at: Point, times: np.ndarray, halvings: int = 6) -> Stretch | None:
    """Go to the next output, with new choices of states on the way where one does not last."""
    # Loops that get stuck beside a singular position do so for ever.
    most = LONG if run.compiled.closing.size else HOPELESS // min(run.outputs, HOPELESS // LONG)
    stretch = run.attempt(at, times, most, careful=True)
    if stretch is not None or not run.worn or not halvings:
        return stretch
    middle = (times[0] + times[1]) / 2
    first = _stride(run, at, np.array([times[0], middle]), halvings - 1)
    if first is None:
        return None
    last = _stride(run, first.end(at), np.array([middle, times[1]]), halvings - 1)
    return last and replace(last, energy=last.energy + first.energy[-1])


def _loosely(run: Integrator, at: Point, times: np.ndarray) -> Stretch | None:
    """Pass a nearly singular position: with the other method, then with longer steps, which short ones cannot replace."""
    rings, auto = run.rings, run.settings.method == "auto"
    for factor in LOOSER:
        run.tolerance = min(factor * run.settings.tolerance, max(LOOSEST, run.settings.tolerance))
        for run.rings in (True, False) if auto else (rings,):
            stretch = run.attempt(at, times, PATIENT, careful=True)
            if stretch is not None:
                break
        run.rings, run.tolerance = rings, run.settings.tolerance
        if stretch is not None:
            run.trace.loosened += [float(times[0])] * (factor > 1)
            return stretch
    return None
