"""What a call of an integrator had reached when it was interrupted."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal.compiler.call import Call
from acausal.solve.integrate.consistent import Consistent
from acausal.solve.integrate.methods import Setup
from acausal.solve.integrate.trace import Leg
from acausal.solve.points import Point


def reached(consistent: Consistent, call: Call, setup: Setup, at: Point, times: np.ndarray) -> Leg | None:
    """Return the rows that an interrupted call had written, up to the first change of a watched condition.

    An integrator writes a row as soon as it is there; those it did not reach are NaN, see `Call.clear`.

    Parameters
    ----------
    consistent : Consistent
        Solver for algebraic unknowns.
    call : Call
        The interrupted call.
    setup : Setup
        How it integrates.
    at : Point
        Where it began.
    times : array
        Its start and output times.
    """
    found = setup.leg(call, at, times)
    whole = np.isfinite(np.hstack([found.rows.x, found.rows.z, found.energy])).all(axis=1)
    found = found.part(0, _leading(whole))
    if not len(found.rows):
        return None
    return found.part(0, _before_event(consistent, at, found))


def _leading(holds: Any) -> int:
    """Number of entries of an array before the first that does not hold."""
    return len(holds) if holds.all() else int(np.argmin(holds))


def _before_event(consistent: Consistent, at: Point, found: Leg) -> int:
    """Number of rows before a watched condition changes: beyond, the equations would be others."""
    guards = consistent.compiled.guards
    if not guards.watched:
        return len(found.rows)
    rows, _ = consistent(found.since(at), guards.needs)
    signs = np.sign(consistent.problem.watched(rows)[0])
    # Right after an event a condition is at its threshold.
    first = np.where(signs[0] == 0, signs[1], signs[0])
    return _leading((signs[1:] == first).all(axis=1))
