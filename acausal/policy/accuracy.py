"""Thresholds of the search for an accuracy, and of studies."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Defaults:
    """What a simulation takes that is told nothing else, and how much it may take."""

    # That of Modelica tools; docs/accuracy.md tells the errors of the scenes.
    tolerance: float = 1e-6
    # A picture shows no more points.
    intervals: int = 400
    # No tolerance is smaller: a few rounding errors of numbers.
    rounding: float = 1e-15
    # Most numbers that a result may hold: 8 GB.
    numbers: float = 1e9


@dataclass(frozen=True)
class Accuracy:
    """Search for a tolerance, an order, a method and numbers of elements."""

    # Tolerances tried first, as fractions of the accuracy; the loosest and the smallest.
    first: float = 1e-2
    loosest: float = 1e-3
    smallest: float = 1e-12
    # Elements of a beam.
    fewest: int = 2
    most: int = 128
    # A run with a smaller tolerance is better only if it takes more work: at the limit of stability it does not.
    more: float = 1.2
    tenths: int = 3
    # A step of the one-step method is worth several; growth of the work by a tenth of the tolerance; runs that it takes
    # to begin again with another method.
    one_step: int = 10
    growth: int = 3
    anew: int = 3
    # Failures after which the search ends, and an error that fell by less than that did not fall.
    failures: int = 3
    stuck: float = 0.8


@dataclass(frozen=True)
class Estimate:
    """Error of a run from finer ones."""

    # An output that moves by no more than this fraction of its size or of 1 is at rest.
    rounding: float = 1e-13
    # The error falls at least with the power 2/3 of the tolerance, that of order 2, or with the order 2 of the elements.
    by_tolerance: float = 2 / 3
    order: float = 2.0
    highest: float = 4.0


@dataclass(frozen=True)
class Study:
    """Error against time, and what effects change and cost."""

    # Times the range of an output: beyond it, a solution has nothing to do with the reference.
    runaway: float = 10.0
    # Seconds after which the alarm repeats, in case it came where nothing can be interrupted.
    again: float = 1.0
    # Seconds after which a run is not repeated: long runs are measured well enough. Runs that are repeated fill the
    # lesser time, because the times of short ones scatter most.
    enough: float = 3.0
    little: float = 0.2
    # Refinements that are tried, and the least tolerance of a reference.
    rounds: int = 6
    least: float = 1e-12
    # Errors of runs are rarely more tolerances than this; docs/methods.md has those of the scenes.
    most: float = 100.0
    # Ratio of the tolerance of a reference to the next, and of a run's to the one that tells its error.
    tighter: float = 10.0
    # The finest of a series is compared with the one before it, whose error is larger: that of a method of order 2 goes
    # with the power 2/3 of the tolerance, that of elements at least with the square of their size.
    tolerance_power: float = 2 / 3
    elements_share: float = 1 / 3
    # An effect that changes less than this part of the accuracy takes part in no pair, unless it saves time; nor does one
    # that changes more than this part of a range: what is left without it is another scene.
    matters: float = 0.1
    other: float = 0.4
    # Interactions below this part of the accuracy are not worth a line.
    worth: float = 0.1
    # Ratio of solve times that cannot be distinguished from 1: medians of a few runs scatter that much.
    noise: float = 0.1
