"""Thresholds of events: what is checked, how closely, and what counts as one instant."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Instants:
    """What happens at one time."""

    # Events within that part of the run, or without any motion between them, that are chattering.
    most: int = 100
    window: float = 1e-9
    # Searched events after which a run is told that as many to its end, more than the second, takes half a minute and more.
    many: int = 200
    dear: int = 5_000


@dataclass(frozen=True)
class Rests:
    """Laws of time that rest, act, and return to rest in less time than steps take that have grown meanwhile."""

    # Parts of a run at whose ends they are evaluated, however many segments it has, and how many of them make a rest.
    parts: int = 400
    least: int = 4
    # Change in a part that is none, over the range of a law.
    still: float = 1e-6
    # What a step may pass over, in lengths of the rest before: it grows sixfold at most.
    growth: int = 6
    # Of what a law changes meanwhile, what may be left; more is seen after it.
    left: float = 0.5
    # Of the segment: an output so near is at the same place.
    near: float = 1e-9
    # Of a run: a case of a law that is declared smooth which lasts no longer is ended by a step. Its first step may take a
    # hundredth of what is ahead, and the law may begin at rest.
    short: float = 0.01


@dataclass(frozen=True)
class Sampling:
    """Slices of a run in the core."""

    # Rows at one go, and numbers in them: 8 MB.
    rows: int = 512
    numbers: int = 1_000_000


@dataclass(frozen=True)
class Agenda:
    """Times that are known before."""

    # Of the time, or of a run that is shorter, but at least of `late` of the time: less is no room for an integration.
    apart: float = 1e-12
    # Likewise: instants that add up, due + 0.1 again and again, are on an output that near.
    added: float = 1e-11
    # In seconds since 1970 a sample comes every 0.01 s, and rounding is 2.4e-7 s.
    late: float = 2e-2
    # Of the time between two breaks: so far behind the first one, what holds between them does.
    after: float = 1e-6
    # Of the time: a break and an output are one.
    same: float = 1e-13


@dataclass(frozen=True)
class Clock:
    """Conditions of time alone: roots of a function that is known everywhere."""

    # Intervals to begin with, and most at once.
    first: int = 64
    # Intervals at whose ends conditions are asked whether they have a value.
    looks: int = 512
    most: int = 50_000
    # Of the greatest time.
    shortest: float = 1e-14
    # Of the greatest value in an interval.
    rounding: float = 1e-12
    # 2^-60 of an interval is rounding of the time.
    halvings: int = 60
