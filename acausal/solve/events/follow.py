"""How closed loops follow when some of their states jump: they are led there on the way, and stiff parts are spared."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.policy import POLICY
from acausal.solve.initialization.assembly import close
from acausal.solve.initialization.coordinate_partitioning import closing_scales
from acausal.solve.point import Point
from acausal.solve.problem import Problem

INSTANTS = POLICY.instants


def follow(problem: Problem, before: Point, after: Point, held: np.ndarray) -> tuple[Point, float]:
    """Close the loops after a jump of some states by the least change of the others.

    The jump is gone in parts, each so small that loops stay in their assembly; where they do not close on the way, at once.

    Parameters
    ----------
    problem : Problem
        The model.
    before : Point
        Just before, consistent.
    after : Point
        The same with the states that jumped.
    held : array of int
        These states.

    Returns
    -------
    at : Point
        With the loops closed.
    mismatch : float
        Largest residual, over its size.
    """
    sizes = closing_scales(problem, before, held)
    way = after.x[held] - before.x[held]
    far = np.max(np.abs(way) / problem.nominal[held], initial=0.0)
    parts = int(np.clip(np.ceil(far / INSTANTS.part), 1, INSTANTS.parts))
    at, mismatch = before, 0.0
    for part in np.arange(1, parts) / parts:
        x = at.x.copy()
        x[held] = before.x[held] + part * way
        at, mismatch = close(problem, replace(at, x=x), held, positions=True, scales=sizes)
        if not mismatch <= POLICY.loops.closed:
            at = before
            break
    x = at.x.copy()
    x[held] = after.x[held]
    return close(problem, replace(after, x=x), held, scales=sizes)
