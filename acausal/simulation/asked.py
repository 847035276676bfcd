"""What a simulation is asked for: settings that no run can have are refused before any work is done."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import DeclarationError
from acausal.language.component import Component
from acausal.policy import POLICY
from acausal.simulation.settings import check_number, settled
from acausal.solve.initialization.initialize import INITIAL
from acausal.solve.integrate.settings import Progress
from acausal.solve.run import Task

CHOICES = ("auto", "idas", "rosenbrock", "resolve")
CONSTRAINTS = ("auto", "states", "projection")
CHOOSE = {"method": CHOICES, "constraints": CONSTRAINTS, "initial": INITIAL}
MOST = 100_000_000  # points of a run


def planned(
    model: Component | CompiledModel,
    parameters: Mapping[str, Any] | None,
    given: Mapping[str, Any],
    start_time: float = 0.0,
    energy: bool = False,
    progress: Progress | None = None,
) -> tuple[Task, float | None]:
    """Return what to run and the accuracy, or refuse what cannot be meant, before any work is done.

    Parameters
    ----------
    model : Component or CompiledModel
        The model.
    parameters : mapping of str to value or None
        As of `simulate`.
    given : mapping of str to value
        Settings by the name of the argument, None where it is not given.
    start_time, energy, progress
        As of `simulate`.
    """
    how = settled(model, parameters, given)
    if how["stop_time"] is None:
        raise DeclarationError(
            "the model declares no stop_time; give one: stop_time=2.0, or stop_time = 2.0 in its class."
        )
    if how["accuracy"] is not None and how["tolerance"] is not None:
        raise DeclarationError("accuracy and tolerance are both given; accuracy chooses the tolerance, leave one out.")
    accuracy = how.pop("accuracy")
    how["tolerance"] = POLICY.defaults.tolerance if how["tolerance"] is None else how["tolerance"]
    task = Task(start_time=start_time, energy=energy, progress=progress, **how)
    check_intervals(task.intervals)
    _check(task, accuracy)
    for name in CHOOSE:
        check_choice(name, getattr(task, name))
    numbers = {name: float(getattr(task, name)) for name in ("start_time", "stop_time", "tolerance")}
    return replace(task, **numbers), accuracy  # a comparison of numbers of numpy is no bool


def check_choice(name: str, value: Any) -> None:
    """Refuse what is none of the choices of an argument of `simulate`.

    Parameters
    ----------
    name : "method", "constraints" or "initial"
        The argument.
    value : object
        What is given; None leaves it to the model.
    """
    if value is not None and not (isinstance(value, str) and value in CHOOSE[name]):
        raise DeclarationError(f"{name} is {value!r}; it must be one of {', '.join(CHOOSE[name])}.")


def check_intervals(intervals: Any) -> None:
    """Refuse what is no number of intervals, or more than any memory holds.

    Parameters
    ----------
    intervals : object
        What is given.
    """
    if isinstance(intervals, bool) or not isinstance(intervals, int | np.integer) or intervals < 1:
        whole = isinstance(intervals, float) and intervals >= 1 and intervals.is_integer()
        mend = f": {int(intervals)}" if whole else ""
        raise DeclarationError(f"intervals is {intervals!r}; it must be a whole number of at least 1{mend}.")
    if intervals > MOST:
        raise DeclarationError(f"intervals is {intervals}; at most {MOST} points are allowed.")


def _check(task: Task, accuracy: float | None) -> None:
    """Refuse settings that no run can have."""
    numbers = {"start_time": task.start_time, "stop_time": task.stop_time, "tolerance": task.tolerance}
    for name, value in {**numbers, **({} if accuracy is None else {"accuracy": accuracy})}.items():
        check_number(name, value)
    start, stop = task.start_time, task.stop_time
    if stop <= start:
        raise DeclarationError(f"stop_time is {stop:g} s; it must come after start_time = {start:g} s.")
    if (stop - start) / task.intervals <= 8 * np.spacing(max(abs(start), abs(stop))):
        raise DeclarationError(
            f"start_time = {start:g} s and stop_time = {stop:g} s are too near each other for {task.intervals} outputs between "
            "them: numbers of this size cannot tell them apart. Count time from 0, or take fewer intervals."
        )
    limits = (("tolerance", task.tolerance, POLICY.defaults.rounding, "1e-6"), ("accuracy", accuracy, 0, "1e-3"))
    for name, value, least, example in limits:
        if value is not None and not (least <= value < 1 and value > 0):
            raise DeclarationError(f"{name} is {value:g}; it must lie between {least:g} and 1, for instance {example}.")
    if task.max_order is not None and (isinstance(task.max_order, bool) or task.max_order not in range(1, 6)):
        raise DeclarationError(f"max_order is {task.max_order!r}; it must be a whole number from 1 to 5.")
    if not isinstance(task.energy, bool | np.bool_):
        raise DeclarationError(f"energy is {task.energy!r}; it must be True or False.")
    if task.progress is not None and not callable(task.progress):
        raise DeclarationError(
            f"progress is {task.progress!r}; it must be a function of the fraction done (0 to 1) and the number of steps."
        )
