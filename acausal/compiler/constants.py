"""What the equations take as constant between two instants of a run."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np


@dataclass(frozen=True, eq=False)
class Constants:
    """Constants of a segment of a run.

    Attributes
    ----------
    switches : array
        1 where the condition of a switch holds.
    discretes : array
        Values of the discrete variables.
    closures : array
        1 where the constraints of a closure count, 0 where they are redundant.
    shares : array, shape (n, n)
        For each constraint of a part how much of what works on each of them counts in its place where it is redundant.
    moves : bool or None
        Whether D are factors of the constraint Jacobian, which moves along, or numbers; None where nothing is constrained.
    feedback : float
        How fast states return to invariants, in 1/s.
    D : array
        Directions along which coordinates are projected on the constraints, see `Constraints.entries`.
    """

    switches: np.ndarray
    discretes: np.ndarray
    closures: np.ndarray
    shares: np.ndarray
    moves: bool | None
    D: np.ndarray
    feedback: float = 1.0

    @cached_property
    def vector(self) -> np.ndarray:
        """All of them, in the order of `ReducedModel.constants`."""
        moves = [] if self.moves is None else [float(self.moves)]
        return np.concatenate(
            [self.switches, self.discretes, self.closures, self.shares.T.ravel(), moves, self.D, [self.feedback]]
        )

    @cached_property
    def all_count(self) -> bool:
        """Whether the constraints of all closures count."""
        return bool(np.all(self.closures > 0))

    def switched(self, places: np.ndarray | list[int], on: np.ndarray | list[bool]) -> Constants:
        """Return the constants with some switches on or off."""
        if not len(places):
            return self
        switches = self.switches.copy()
        switches[places] = on
        return replace(self, switches=switches)


@dataclass(frozen=True)
class Layout:
    """How many constants of each kind a model has: switches, discrete variables, closures, those of parts, entries of D.

    `moves` is 1 where the projection may move.
    """

    switches: int
    discretes: int
    closures: int
    parts: int
    moves: int
    D: int

    def begin(self, head: np.ndarray, feedback: float) -> Constants:
        """Return constants with which all closures count, without D, from switches and discrete variables."""
        switches, discretes = np.split(head, [self.switches])
        return Constants(
            switches,
            discretes,
            np.ones(self.closures),
            np.eye(self.parts),
            False if self.moves else None,
            np.ones(self.D),
            feedback,
        )

    def constants(self, vector: np.ndarray) -> Constants:
        """Return the constants in a vector."""
        head = self.switches + self.discretes
        first = head + self.closures + self.parts**2 + self.moves
        closures, D = self.closures_of(vector), vector[first:-1]
        shares = vector[head + self.closures : first - self.moves].reshape(self.parts, self.parts).T
        moves = bool(vector[first - 1]) if self.moves else None
        return Constants(
            vector[: self.switches], vector[self.switches : head], closures, shares, moves, D, float(vector[-1])
        )

    def closures_of(self, vectors: np.ndarray) -> np.ndarray:
        """Return which closures count, in the last dimension, from vectors of constants."""
        head = self.switches + self.discretes
        return vectors[..., head : head + self.closures]
