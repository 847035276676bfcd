"""Thresholds of the accuracy control and of studies."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Defaults:
    """Defaults and limits of a simulation."""

    # As in Modelica tools; docs/background/accuracy-tables.md has the errors of the scenes.
    tolerance: float = 1e-6
    # Resolution of a plot.
    intervals: int = 400
    # Smallest tolerance: a few units of round-off.
    rounding: float = 1e-15
    # Numbers in a result: 8 GB.
    numbers: float = 1e9


@dataclass(frozen=True)
class Accuracy:
    """Choice of tolerance, order, method and numbers of elements."""

    # First tolerance, relative to the accuracy; the largest and the smallest.
    first: float = 1e-2
    loosest: float = 1e-3
    smallest: float = 1e-12
    # Elements of a beam.
    fewest: int = 2
    most: int = 128
    # Increase of the work with a smaller tolerance: at the stability limit the work is constant, and so is the error.
    more: float = 1.2
    tenths: int = 3
    # Work of a step of the one-step method in steps of IDAS; growth of the work with a tenth of the tolerance; number of runs
    # worth a restart with another method.
    one_step: int = 10
    growth: int = 3
    anew: int = 3
    # Failures that end the search; ratio of errors above which an error has not decreased.
    failures: int = 3
    stuck: float = 0.8


@dataclass(frozen=True)
class Estimate:
    """Estimate of the error of a run from finer runs."""

    # Range of an output at rest, relative to its magnitude or to 1.
    rounding: float = 1e-13
    # Convergence: at least the power 2/3 of the tolerance, as for methods of order 2, or the order 2 of the elements.
    by_tolerance: float = 2 / 3
    order: float = 2.0
    highest: float = 4.0


@dataclass(frozen=True)
class Study:
    """Error against time, and changes and costs of effects."""

    # Error of a diverged solution, relative to the range of the output.
    runaway: float = 10.0
    # Seconds until the alarm repeats, in case the first one came during an uninterruptible call.
    again: float = 1.0
    # Seconds of a run that is not repeated, because long runs are measured accurately. Repeated runs fill the shorter time,
    # because the times of short runs scatter most.
    enough: float = 3.0
    little: float = 0.2
    # Refinements of a reference, and its smallest tolerance.
    rounds: int = 6
    least: float = 1e-12
    # Largest usual error of a run in tolerances; docs/background/methods-tables.md has the errors of the scenes.
    most: float = 100.0
    # Ratio of successive tolerances of a reference, and of the tolerances of a run and of the one that estimates its error.
    tighter: float = 10.0
    # Error of the finest run of a series, relative to its difference from the previous one: proportional to the power 2/3 of
    # the tolerance for methods of order 2, and at least to the square of the size of elements.
    tolerance_power: float = 2 / 3
    elements_share: float = 1 / 3
    # Change by an effect, relative to the accuracy, below which it is in no pair unless it saves time; and relative to a range,
    # above which it is in no pair, because the scene without it is another one.
    matters: float = 0.1
    other: float = 0.4
    # Smallest interaction that is printed, relative to the accuracy.
    worth: float = 0.1
    # Scatter of the ratio of solve times: medians of a few runs.
    noise: float = 0.1
