"""Forces and moments at the frames of a body, given over time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array
from components.fe.reduced_body import ReducedBody

Course = Sequence[float] | Callable[[float], Any]


@dataclass(frozen=True)
class FrameLoad:
    """Force and moment at a frame of a body.

    Parameters
    ----------
    frame : str
        Name of the frame.
    force : 3 floats or callable
        Force in N, or a function of the time in s that returns it.
    moment : 3 floats or callable
        Moment in N.m, or such a function.
    follower : bool
        Whether both are resolved in the moving axes of the body instead of those of the world.
    """

    frame: str
    force: Course = (0.0, 0.0, 0.0)
    moment: Course = (0.0, 0.0, 0.0)
    follower: bool = False

    def given(self) -> list[Course]:
        """Force and moment, without those that are 0."""
        return [c for c in (self.force, self.moment) if callable(c) or np.any(np.asarray(c, dtype=float))]


def sampled(course: Course, times: Array, what: str) -> Array:
    """Values at times, shape (times, 3).

    Raises
    ------
    DeclarationError
        If a value is no finite vector of three numbers.
    """
    values: Any = [course(float(t)) for t in times] if callable(course) else [course] * len(times)
    try:
        found = np.array(values, dtype=float)
    except (TypeError, ValueError):
        found = np.zeros(0)
    if found.shape != (len(times), 3):
        raise DeclarationError(
            f"{what} is a vector of three numbers at each time, or a function of the time that returns one"
        )
    if not np.isfinite(found).all():
        first = times[~np.isfinite(found).all(axis=1)][0]
        raise DeclarationError(f"{what} is not finite at t = {first:.6g} s")
    return found


def check_loads(body: ReducedBody, loads: Sequence[FrameLoad]) -> None:
    """Refuse loads at frames that a body does not have, and moments where it cannot carry any.

    Raises
    ------
    DeclarationError
        With the frames that there are.
    """
    frames = {frame.name: frame for frame in body.interfaces}
    if not isinstance(loads, Sequence):
        raise DeclarationError(f"loads are a list, [FrameLoad(...), ...], not {loads!r}")
    for load in loads:
        if not isinstance(load, FrameLoad):
            raise DeclarationError(f'a load is FrameLoad("tip", force=(0, 0, 1)), not {load!r}')
        if load.frame not in frames:
            has = f"it has {', '.join(frames)}" if frames else "it has none: reduce_body(..., frames={...})"
            raise DeclarationError(f"the body has no frame `{load.frame}` for a load: {has}")
        if (callable(load.moment) or np.any(load.moment)) and not frames[load.frame].turns:
            raise DeclarationError(
                f"the frame `{load.frame}` is given by one node or by nodes on a line, which cannot carry a moment: take more "
                "nodes for it"
            )
