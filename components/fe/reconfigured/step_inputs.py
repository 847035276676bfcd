"""What acts on a body in each step: loads and weight over time, as inputs of the steps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from components.fe.arrays import Array
from components.fe.reconfigured.free_modes import FreeModes
from components.fe.reconfigured.load import FrameLoad, acting, sampled

# Of a step: how far inside of it its ends are looked at, far above rounding of the time after 1e5 steps, far below any error.
EDGE = 1e-9


@dataclass(frozen=True, eq=False)
class Inputs:
    """Loads and weight of a body, as functions of the time.

    Attributes
    ----------
    world, follower : array, shape (N, 3 k) and (N, 3 l)
        Accelerations of the modes by components of the k loads that are resolved in the world and of the l in the body.
    courses : tuple of (vector or callable, str)
        Acceleration of gravity resolved in the world, the k and the l loads, each with what it is.
    """

    world: Array
    follower: Array
    courses: tuple[tuple[Any, str], ...]

    @classmethod
    def of(cls, modes: FreeModes, loads: Sequence[FrameLoad], gravity: Any) -> Inputs:
        """Collect what acts on a body; wrong loads are refused."""
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
        """Accelerations of the modes by unit loads, in the world and following, each (N, 3 k)."""
        return self.world, self.follower

    def at(self, times: Array) -> Array:
        """Acceleration of gravity and all loads at times, shape (times, 3 (1 + k + l))."""
        return np.hstack([sampled(course, times, what) for course, what in self.courses])

    def steps(self, dt: float, count: int, middle: str = "middle") -> Array:
        """What acts at the start, in the middle and at the end of each step, and in one after the last.

        Limits from inside of each step: a load may jump between two steps. The last step is given the load of its start.
        """
        starts = dt * np.arange(count + 1)
        first, last = self.at(np.append(starts[:-1] + EDGE * dt, starts[-1])), self.at(starts[:-1] + (1 - EDGE) * dt)
        between = (first[:-1] + last) / 2 if middle == "mean" else self.at(starts[:-1] + dt / 2)
        return np.hstack([first, *(np.vstack([part, first[-1:]]) for part in (between, last))])

    def pairs(self, start: float, dt: float, count: int) -> Array:
        """What acts in pairs of steps: the step, and all at the ends of a pair, in its middle, and halfway between."""
        starts = start + 2 * dt * np.arange(count)
        instants = [starts + part * dt for part in (EDGE, 0.5, 1, 1.5, 2 - EDGE)]
        return np.hstack([np.full((count, 1), dt), *(self.at(times) for times in instants)])
