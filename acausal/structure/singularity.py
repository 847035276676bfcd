"""The failure of the structural analysis, in terms of equations and variables."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Subsystem:
    """Some equations and variables, both ascending."""

    equations: tuple[int, ...]
    variables: tuple[int, ...]

    @classmethod
    def of(cls, equations: Iterable[int], variables: Iterable[int]) -> Subsystem:
        """Sort both and drop repetitions."""
        return cls(tuple(sorted(set(equations))), tuple(sorted(set(variables))))


class StructuralSingularity(Exception):
    """No values of its coefficients make the system solvable; the smallest offending parts come first.

    Parameters
    ----------
    over : tuple of Subsystem
        Parts with more equations than variables.
    under : tuple of Subsystem
        Parts with fewer equations than variables; a derivative stands as the variable it derives from.

    """

    def __init__(self, over: tuple[Subsystem, ...] = (), under: tuple[Subsystem, ...] = ()) -> None:
        super().__init__(f"{len(over)} over-determined and {len(under)} under-determined parts")
        self.over = over
        self.under = under
