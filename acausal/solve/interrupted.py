"""What a call of an integrator had reached when it was interrupted."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from acausal.compiler.call import Call
from acausal.compiler.constants import Constants
from acausal.solve.trace import Stretch

if TYPE_CHECKING:
    from acausal.solve.integrate import Integrator
    from acausal.solve.methods import Way


def keep_reached(
    integrator: Integrator,
    call: Call,
    way: Way,
    times: np.ndarray,
    constants: Constants,
    parts: int,
) -> None:
    """Keep the rows that an interrupted call had written.

    An integrator writes a row as soon as it is there; those it did not reach are NaN, see `Call.clear`.

    Parameters
    ----------
    integrator : Integrator
        Its trace gets the rows.
    call : Call
        The interrupted call.
    way : Way
        How it integrates.
    times : array
        Its start and output times.
    constants : Constants
        Those of the segment.
    parts : int
        One row in so many is kept.
    """
    trace = integrator.trace
    end = trace.last().times if trace.pieces else integrator.span[0]
    if not np.isclose(times[0], end, rtol=1e-9, atol=1e-9 * (integrator.span[1] - integrator.span[0])):
        return  # a trial on the way: what comes before it is not in the trace
    x, z, energy = way.rows(call)
    if energy is None:
        if integrator.settings.energy:
            return  # a trial, without works
        energy = np.zeros((len(x), 2))
    whole = np.isfinite(x).all(axis=1) & np.isfinite(z).all(axis=1) & np.isfinite(energy).all(axis=1)
    reached = Stretch(times[1:], x, z, energy, constants, 0).rows(0, _leading(whole)).every(parts)
    if not len(reached.times) or integrator._is_worn(reached.times, reached.x, constants):
        return
    given = dict(zip(call.function.name_in(), call.inputs, strict=True))
    start = Stretch(
        times[:1], given["x0"][None] * way.sizes[0], given["z0"][None] * way.sizes[1], np.zeros((1, 2)), constants, 0
    )
    before = reached.rows(0, _before_event(integrator, start, reached))
    if len(before.times):
        trace.add(before)


def _leading(holds: Any) -> int:
    """Number of entries of an array before the first that does not hold."""
    return len(holds) if holds.all() else int(np.argmin(holds))


def _before_event(integrator: Integrator, start: Stretch, reached: Stretch) -> int:
    """Number of rows before a watched condition changes: beyond, the equations would be others."""
    guards = integrator.compiled.guards
    if not guards.watched:
        return len(reached.times)
    x, z, t = (
        np.concatenate(pair) for pair in ((start.x, reached.x), (start.z, reached.z), (start.times, reached.times))
    )
    vector = reached.constants.vector
    z = integrator.consistent(x, z, t, vector, guards.needs)
    signs = np.sign(guards.along(x, z, integrator.problem.p, t, vector)[0])
    # Right after an event a condition is at its threshold.
    first = np.where(signs[0] == 0, signs[1], signs[0])
    return _leading((signs[1:] == first).all(axis=1))
