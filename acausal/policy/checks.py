"""Thresholds of what is checked after a run: promises, validity, points that meet."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Meeting:
    """Points between which a force acts, and that meet."""

    # Nearer than this fraction of their greatest distance points meet; what acts there less than so much of its greatest
    # is 0.
    near: float = 1e-6
    nothing: float = 1e-4
    # Points may move so much faster between two rows than at them.
    reach: float = 3.0
    # The same where a run was given up: when it was is known to some digits only.
    ahead: float = 30.0
    # Parts of an interval; shortest part of the run.
    parts: int = 8
    shortest: float = 1e-13
    # Rows that are so few, with so many steps between them, that all are suspect.
    few: int = 64
    steps_a_row: int = 4
    # Meetings without an effect after which the search ends, intervals that are examined, and steps in each.
    harmless: int = 3
    looks: int = 2000
    steps: int = 20_000


@dataclass(frozen=True)
class Promises:
    """Laws that are said to be smooth."""

    # Part of the largest value of a law that is a step; less may be rounding of its constants.
    step: float = 1e-4
    # Switches of one law that are examined more closely, how often, and times at once.
    switches: int = 3
    closer: int = 12
    parts: int = 8


@dataclass(frozen=True)
class Validity:
    """Ranges in which components hold."""

    # Most output points that are checked, in general and where each check costs a solution of the equations.
    rows: int = 500
    dear: int = 40
    # Of what is not small: values of the integrator that are less are small.
    nearly: float = 0.3


@dataclass(frozen=True)
class Causes:
    """Why a run fails."""

    # What has no value counts as this in the other equations: inside the range of every function.
    ordinary: float = 0.7
    # A combination of equations of length 1 vanishes if so little of it is left; what weighs less in it takes no part.
    rank: float = 1e-11
    weight: float = 1e-3
    # Digits of a weight in which rounding does not show.
    digits: int = 6
    balancing: int = 3
    # Equations of which a dense decomposition takes a few seconds.
    largest: int = 2000
    # Beyond the last point that was reached, in parts of the way to where an integrator stopped, at least so much of the run.
    beyond: tuple[float, ...] = (1.0, 2.0, 10.0)
    shortest: float = 1e-4
    # Lines and names in a message, and letters of an expression.
    shown: int = 5
    text: int = 40
