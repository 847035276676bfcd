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
    moves : bool or None
        Whether D are factors of the constraint Jacobian, which moves along, or numbers; None where nothing is constrained.
    D : array
        Directions along which coordinates are projected on the constraints, see `Constraints.entries`.
    """

    switches: np.ndarray
    discretes: np.ndarray
    closures: np.ndarray
    moves: bool | None
    D: np.ndarray

    @cached_property
    def vector(self) -> np.ndarray:
        """All of them, in the order of `ReducedModel.constants`."""
        moves = [] if self.moves is None else [float(self.moves)]
        return np.concatenate([self.switches, self.discretes, self.closures, moves, self.D])

    def switched(self, places: np.ndarray | list[int], on: np.ndarray | list[bool]) -> Constants:
        """Return the constants with some switches on or off."""
        switches = self.switches.copy()
        switches[places] = on
        return replace(self, switches=switches)


@dataclass(frozen=True)
class Layout:
    """How many constants of each kind a model has: switches, discrete variables, closures, entries of D; 1 for `moves`."""

    switches: int
    discretes: int
    closures: int
    moves: int
    D: int

    def constants(self, vector: np.ndarray) -> Constants:
        """Return the constants in a vector; one that ends before the closures lets all of them count, without D."""
        head = self.switches + self.discretes
        first = head + self.closures + self.moves
        if len(vector) == head:
            vector = np.concatenate([vector, np.ones(self.closures), np.zeros(self.moves), np.ones(self.D)])
        closures, D = vector[head : head + self.closures], vector[first:]
        moves = bool(vector[first - 1]) if self.moves else None
        return Constants(vector[: self.switches], vector[self.switches : head], closures, moves, D)
