"""Loads and gravity over time, sampled as inputs of the steps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from components.fe.arrays import Array
from components.fe.reconfigured.free_modes import FreeModes
from components.fe.reconfigured.load import FrameLoad, acting, sampled

# Offset of samples from the ends of a step, relative to the step: far above the round-off of time after 1e5 steps, far
# below any error.
EDGE = 1e-9


@dataclass(frozen=True, eq=False)
class Inputs:
    """Loads and gravity of a body as functions of time.

    Attributes
    ----------
    world, follower : array, shape (N, 3 k) and (N, 3 l)
        Modal accelerations by unit components of the k loads resolved in the world and the l loads resolved in the
        body.
    courses : tuple of (vector or callable, str)
        Acceleration of gravity resolved in the world, the k and the l loads, each with its name in messages.
    """

    world: Array
    follower: Array
    courses: tuple[tuple[Any, str], ...]

    @classmethod
    def of(cls, modes: FreeModes, loads: Sequence[FrameLoad], gravity: Any) -> Inputs:
        """Collect the loads on a body; DeclarationError for invalid loads."""
        maps: dict[bool, list[Array]] = {follows: [np.zeros((modes.size, 0))] for follows in (False, True)}
        found: dict[bool, list[tuple[Any, str]]] = {False: [], True: []}
        for load, at in acting(modes.body, loads):
            for kind, course in load.courses():
                maps[bool(load.follower)].append(modes.load(at)[kind == "moment"])
                found[bool(load.follower)].append((course, f"the {kind} at {load.place}"))
        weight = ((0.0, 0.0, 0.0) if gravity is None else gravity, "gravity")
        courses = (weight, *found[False], *found[True])
        return cls(np.hstack(maps[False]), np.hstack(maps[True]), courses)

    @property
    def maps(self) -> tuple[Array, Array]:
        """Modal accelerations by unit loads, resolved in the world and in the body, each (N, 3 k)."""
        return self.world, self.follower

    def at(self, times: Array) -> Array:
        """Return gravity and all loads at times, shape (times, 3 (1 + k + l))."""
        return np.hstack([sampled(course, times, what) for course, what in self.courses])

    def steps(self, dt: float, count: int, middle: str = "middle") -> Array:
        """Return the inputs at start, middle and end of each step, and of one step after the last.

        The ends are sampled inside the step, as a load may jump between two steps. The step after the last has constant
        loads.
        """
        starts = dt * np.arange(count + 1)
        first, last = self.at(np.append(starts[:-1] + EDGE * dt, starts[-1])), self.at(starts[:-1] + (1 - EDGE) * dt)
        between = (first[:-1] + last) / 2 if middle == "mean" else self.at(starts[:-1] + dt / 2)
        return np.hstack([first, *(np.vstack([part, first[-1:]]) for part in (between, last))])

    def pairs(self, start: float, dt: float, count: int) -> Array:
        """Return the step size and the inputs of pairs of steps at 0, 1/4, 1/2, 3/4 and 1 of each pair."""
        starts = start + 2 * dt * np.arange(count)
        instants = [starts + part * dt for part in (EDGE, 0.5, 1, 1.5, 2 - EDGE)]
        return np.hstack([np.full((count, 1), dt), *(self.at(times) for times in instants)])
