"""Quantities that are constant between two events: switches, discrete variables, independent loop closures, projections."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np


@dataclass(frozen=True, eq=False)
class Constants:
    """Constants between two events.

    Attributes
    ----------
    switches : array
        1 where the condition of the switch holds, else 0.
    discretes : array
        Values of the discrete variables.
    closures : array
        1 where the constraints of a closure are independent, 0 where they are redundant.
    shares : array, shape (n, n)
        For redundant constraints stated by parts: the distribution of the constraint forces over the constraints.
    moves : bool or None
        Whether D scales the current constraint Jacobian (True) or is a fixed matrix (False); None without constraints.
    feedback : float
        Rate at which states return to invariants, in 1/s.
    D : array
        Directions of the projection onto the constraints, see `Constraints.entries`.
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
        """All constants in the order of `ReducedModel.constants`."""
        moves = [] if self.moves is None else [float(self.moves)]
        return np.concatenate(
            [self.switches, self.discretes, self.closures, self.shares.T.ravel(), moves, self.D, [self.feedback]]
        )

    @cached_property
    def all_count(self) -> bool:
        """Whether the constraints of all closures are independent."""
        return bool(np.all(self.closures > 0))

    def switched(self, places: np.ndarray | list[int], on: np.ndarray | list[bool]) -> Constants:
        """Return the constants with the given switches set."""
        if not len(places):
            return self
        switches = self.switches.copy()
        switches[places] = on
        return replace(self, switches=switches)


@dataclass(frozen=True)
class Layout:
    """Number of constants of each kind: switches, discrete variables, closures, constraints stated by parts, entries of D.

    `moves` is 1 if the projection may follow the constraint Jacobian.
    """

    switches: int
    discretes: int
    closures: int
    parts: int
    moves: int
    D: int

    def begin(self, head: np.ndarray, feedback: float) -> Constants:
        """Return constants from switches and discrete variables, with all closures independent and D = 1."""
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
        """Return the constants that a vector holds."""
        head = self.switches + self.discretes
        first = head + self.closures + self.parts**2 + self.moves
        closures, D = self.closures_of(vector), vector[first:-1]
        shares = vector[head + self.closures : first - self.moves].reshape(self.parts, self.parts).T
        moves = bool(vector[first - 1]) if self.moves else None
        return Constants(
            vector[: self.switches], vector[self.switches : head], closures, shares, moves, D, float(vector[-1])
        )

    def closures_of(self, vectors: np.ndarray) -> np.ndarray:
        """Return the flags of independent closures, in the last dimension, from vectors of constants."""
        head = self.switches + self.discretes
        return vectors[..., head : head + self.closures]
