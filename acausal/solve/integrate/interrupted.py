"""What an integration had reached when it was interrupted."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal.solve.integrate.consistent import Consistent
from acausal.solve.integrate.integration import Integration
from acausal.solve.integrate.trace import Leg
from acausal.solve.point import Point


def reached(consistent: Consistent, integration: Integration) -> Leg | None:
    """Return the rows that an integration had written when it ended, up to the first change of a watched condition.

    Parameters
    ----------
    consistent : Consistent
        Solver for algebraic unknowns.
    integration : Integration
        It writes a row as soon as it is there; those that it did not reach are nan.
    """
    found, at = integration.leg(), integration.request.at
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
    signs = np.sign(consistent.problem.indicators(rows)[0])
    # Right after an event a condition is at its threshold.
    first = np.where(signs[0] == 0, signs[1], signs[0])
    return _leading((signs[1:] == first).all(axis=1))
