"""Thresholds of the checks after a run: separation of points, smoothness, validity, causes of failures."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Meeting:
    """Separation of points between which a force acts."""

    # Distance of coincident points, relative to their largest distance; force that counts as 0, relative to its largest value.
    near: float = 1e-6
    nothing: float = 1e-4
    # Speed between two rows, relative to that at the rows.
    reach: float = 3.0
    # The same after a failed run, whose time of failure is known to few digits.
    ahead: float = 30.0
    # Parts of an interval; shortest part, relative to the run.
    parts: int = 8
    shortest: float = 1e-13
    # All intervals are examined if there are fewer rows than this, with more steps between two of them than this.
    few: int = 64
    steps_a_row: int = 4
    # Limits of the search: coincidences without force, intervals, and steps in each.
    harmless: int = 3
    looks: int = 2000
    steps: int = 20_000


@dataclass(frozen=True)
class Promises:
    """Laws declared smooth."""

    # Jump of a law, relative to its largest value: less may be round-off of its constants.
    step: float = 1e-4
    # Switches of one law that are located, refinements of each, and times per refinement.
    switches: int = 3
    closer: int = 12
    parts: int = 8


@dataclass(frozen=True)
class Validity:
    """Ranges of validity of components."""

    # Output points checked at most: in general, and if each check needs a solution of the equations.
    rows: int = 500
    dear: int = 40
    # Value at the integrator's states, relative to the limit, below which no accurate value is needed.
    nearly: float = 0.3


@dataclass(frozen=True)
class Causes:
    """Causes of failed runs."""

    # Substitute for an undefined value in other equations: inside the domain of every function.
    ordinary: float = 0.7
    # Norm of a combination of equations of length 1 that vanishes; smallest weight of an equation in it.
    rank: float = 1e-11
    weight: float = 1e-3
    # Digits of a weight that are unaffected by round-off; number of scaling iterations.
    digits: int = 6
    balancing: int = 3
    # Equations for a dense decomposition, which then takes a few seconds.
    largest: int = 2000
    # Points examined beyond the last one reached, relative to the way to the failure, which is at least this part of the run.
    beyond: tuple[float, ...] = (1.0, 2.0, 10.0)
    shortest: float = 1e-4
    # Lines and names in a message, and characters of an expression.
    shown: int = 5
    text: int = 40
