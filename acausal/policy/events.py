"""Thresholds of events: what is checked, how closely, and what counts as one instant."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Instants:
    """What happens at one time."""

    # Of the run: what changes sign within that time does so now.
    short: float = 1e-8
    # Of the values, and of what nominal values change in them, and the time in which conditions that are searched change by
    # theirs: a smaller jump is the error with which an event is located. By the clock there is none.
    jump: float = 1e-5
    # Of the terms of what must not jump: instants are known to that part of the time (`Agenda.added`), its rounding is less.
    rounding: float = 1e-11
    # Of the size in a run: an excess that changes less does not move.
    moves: float = 1e-3
    # Parts in which loops follow a jump, in nominal values, and how many there are at most: as far as joints stay on a branch.
    part: float = 0.2
    parts: int = 100
    # Of the run: an excess that falls to 0 within that time does so now.
    due: float = 1e-6
    # Events within that part of the run, or without any motion between them, that are chattering.
    most: int = 100
    window: float = 1e-9
    # Searched events after which a run is told that as many to its end, more than the second, takes half a minute and more.
    many: int = 200
    dear: int = 5_000


@dataclass(frozen=True)
class Laws:
    """Set-valued laws at rest."""

    # Response of a rate to its own force, relative to the sum of the sizes of its terms: below it is zero. In slider-cranks it is
    # 0.05 to 0.3, and 1e-15 where a joint reverses.
    responds: float = 1e-8
    # Round-off of the response of a rate to other forces, relative to its terms.
    independent: float = 1e-8
    # Speed over its tolerance at which a law does not rest, since a jump brought it there: events are located to about 1.
    moves: float = 100.0


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
    # Events at most that are left to the search after one that was in doubt, before the next try: twice as many each time.
    longest: int = 64


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


@dataclass(frozen=True)
class Looks:
    """Rows between outputs at which conditions are checked."""

    # Parts of an interval at least.
    fine: int = 8
    # Pairs of rows of an interval that is looked into, and steps of the integrator between two rows: in less than so many
    # nothing turns back.
    densest: int = 32
    steps_a_row: int = 4
    # Steps of the core after which conditions are checked, at first; each time twice as many.
    steps: int = 8
    # How many times as many, where there were too few.
    denser: int = 4
    # Times since the last event in which the next one is looked for, where there are many in an interval.
    ahead: float = 4.0
    # The same in all intervals, that there may be at least: few are checked as often as many.
    rows: int = 12_800
    # Difference of output intervals, over them, that is rounding.
    equal: float = 1e-9
    # Of a step: an event that comes so early is looked for again in a shorter step, as what a step interpolates is off by a part
    # of all that moves in it: a ball's first step in a run of 1e9 s takes days, in which it falls out of sight. Not where the
    # time until then is that many rounding errors of the time, or fewer.
    early: float = 1e-5
    roundings: int = 1000


@dataclass(frozen=True)
class Locate:
    """Crossings between two rows."""

    # Levels of closer looks, suspects and tries of one leg.
    depth: int = 3
    suspects: int = 4
    tries: int = 80
    trial_steps: int = 20_000
    # A condition may change within an interval that it could cross so much faster than it moves at the ends.
    reach: float = 3.0
    # A condition has changed where it is beyond 0 by that part of what the tolerance lets it be off.
    level: float = 0.01
    # Errors of the least value of a cubic, over their estimate.
    error: float = 3.0
    # Halvings of an interval beyond which there is no solution: 2^-40 of it.
    halvings: int = 40
    # Of an output interval: an event that near is on the output.
    snap: float = 0.01
    # Times at which a leg is checked between its rows.
    looks: int = 4000
    # Of the run: planned instants are no nearer to what has happened.
    shortest: float = 1e-12
    # Of the interval in which a change was found: so short a part is a straight line to rounding, as its bend is the square
    # of that; and rounding errors of the time, between which no time is looked for.
    straight: float = 1e-8
    roundings: int = 4
    # A look that is not beyond a change by its rounding error is followed by one that is so many times as far.
    further: float = 64.0
    # How far beside the predicted time the next look is, so that the change lies between both: as far as the prediction
    # moved, at least this part of the shortest time, at most that of the interval.
    beside: float = 1 / 3
    aside: float = 0.1


@dataclass(frozen=True)
class Between:
    """Points between rows, by cubics."""

    # Interpolated points are those of the motion where their defect is this part of what the tolerance allows.
    faithful: float = 0.1
    # Steps of an integration where it is not.
    most_steps: int = 20_000
    # Points of an interval whose defects tell whether its cubic is the motion.
    looks: int = 5
