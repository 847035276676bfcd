"""What is tried where a call over many outputs failed: output by output, other states, the other method, longer steps."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from acausal.solve.trace import Stretch

if TYPE_CHECKING:
    from acausal.solve.integrate import Integrator

# Steps before a run counts as long, before a chunk or an output counts as hopeless, and in each of the last tries.
LONG, HOPELESS, PATIENT = 100_000, 2_000_000, 20_000
LOOSER, LOOSEST = (1.0, 1e2, 1e4), 1e-4


def creep(run: Integrator, times: np.ndarray, x: np.ndarray, z: np.ndarray, modes: np.ndarray) -> None:
    """Go from output to output until the failure."""
    for k in range(len(times) - 1):
        here = times[k : k + 2]
        stretch = passage(run, here, x, z, modes, hard=True)
        if stretch is None:
            raise run.failure(*here)
        run.trace.add(stretch)
        x, z = stretch.x[-1], stretch.z[-1]


def passage(
    run: Integrator, times: np.ndarray, x: np.ndarray, z: np.ndarray, modes: np.ndarray, hard: bool
) -> Stretch | None:
    """Go over one interval where a call over many failed; None if it cannot be done either.

    Parameters
    ----------
    run : Integrator
        The run.
    times : array, shape (2,)
        Its ends in s.
    x, z, modes : arrays
        Where it begins.
    hard : bool
        Whether to try everything: new choices of states on the way, the other method, a larger tolerance.
    """
    if not hard:
        return run.attempt(times, x, z, modes, LONG, careful=True)
    return _stride(run, times, x, z, modes) or _loosely(run, times, x, z, modes)


def _stride(
    run: Integrator, times: np.ndarray, x: np.ndarray, z: np.ndarray, modes: np.ndarray, halvings: int = 6
) -> Stretch | None:
    """Go to the next output, with new choices of states on the way where one does not last."""
    # Loops that get stuck beside a singular position do so for ever.
    most = LONG if run.compiled.closing.size else HOPELESS // min(run.outputs, HOPELESS // LONG)
    stretch = run.attempt(times, x, z, modes, most, careful=True)
    if stretch is not None or not run.worn or not halvings:
        return stretch
    middle = (times[0] + times[1]) / 2
    first = _stride(run, np.array([times[0], middle]), x, z, modes, halvings - 1)
    if first is None:
        return None
    last = _stride(run, np.array([middle, times[1]]), first.x[-1], first.z[-1], modes, halvings - 1)
    return last and replace(last, energy=last.energy + first.energy[-1])


def _loosely(run: Integrator, times: np.ndarray, x: np.ndarray, z: np.ndarray, modes: np.ndarray) -> Stretch | None:
    """Pass a nearly singular position: with the other method, then with longer steps, which short ones cannot replace."""
    rings, auto = run.rings, run.settings.method == "auto"
    for factor in LOOSER:
        run.tolerance = min(factor * run.settings.tolerance, max(LOOSEST, run.settings.tolerance))
        for run.rings in (True, False) if auto else (rings,):
            stretch = run.attempt(times, x, z, modes, PATIENT, careful=True)
            if stretch is not None:
                break
        run.rings, run.tolerance = rings, run.settings.tolerance
        if stretch is not None:
            run.trace.loosened += [float(times[0])] * (factor > 1)
            return stretch
    return None
