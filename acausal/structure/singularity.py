"""Structural singularity in terms of equations and variables."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Subsystem:
    """A subset of the equations and variables, both ascending."""

    equations: tuple[int, ...]
    variables: tuple[int, ...]

    @classmethod
    def of(cls, equations: Iterable[int], variables: Iterable[int]) -> Subsystem:
        """Return the subsystem of some equations and variables, sorted and without repetitions."""
        return cls(tuple(sorted(set(equations))), tuple(sorted(set(variables))))


class StructuralSingularity(Exception):
    """Error for a system that is singular for all values of its coefficients; the smallest parts come first.

    Parameters
    ----------
    over : tuple of Subsystem
        Parts with more equations than variables.
    under : tuple of Subsystem
        Parts with fewer equations than variables; a derivative is represented by its lowest variable.

    """

    def __init__(self, over: tuple[Subsystem, ...] = (), under: tuple[Subsystem, ...] = ()) -> None:
        super().__init__(f"{len(over)} over-determined and {len(under)} under-determined parts")
        self.over = over
        self.under = under
