"""Checks of the settings of a simulation, before any work is done."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import DeclarationError
from acausal.language.component import Component
from acausal.policy import POLICY
from acausal.simulation.model_settings import check_number, effective_settings
from acausal.solve.initialization.initialize import INITIAL
from acausal.solve.integrate.settings import Progress
from acausal.solve.run import Task

CHOICES = ("auto", "idas", "rosenbrock", "resolve")
CONSTRAINTS = ("auto", "states", "projection")
CHOOSE = {"method": CHOICES, "constraints": CONSTRAINTS, "initial": INITIAL}
MOST = 100_000_000  # output points of a run: more would not fit into memory


def checked_task(
    model: Component | CompiledModel,
    parameters: Mapping[str, Any] | None,
    given: Mapping[str, Any],
    start_time: float = 0.0,
    energy: bool = False,
    progress: Progress | None = None,
    max_steps: int | None = None,
    max_seconds: float | None = None,
) -> tuple[Task, float | None]:
    """Return the task of a simulation and the requested accuracy; raise DeclarationError for invalid settings.

    Parameters
    ----------
    model : Component or CompiledModel
        The model.
    parameters : mapping of str to value or None
        As in `simulate`.
    given : mapping of str to value
        Settings by the name of the argument, None if not given.
    start_time, energy, progress, max_steps, max_seconds
        As in `simulate`.
    """
    how = effective_settings(model, parameters, given)
    if how["stop_time"] is None:
        raise DeclarationError(
            "the model declares no stop_time; give one: stop_time=2.0, or stop_time = 2.0 in its class."
        )
    if how["accuracy"] is not None and how["tolerance"] is not None:
        raise DeclarationError("accuracy and tolerance are both given; accuracy chooses the tolerance, leave one out.")
    accuracy = how.pop("accuracy")
    how["tolerance"] = POLICY.defaults.tolerance if how["tolerance"] is None else how["tolerance"]
    check_limits(max_steps, max_seconds)
    limits = {"max_steps": max_steps, "max_seconds": max_seconds}
    task = Task(start_time=start_time, energy=energy, progress=progress, **limits, **how)
    check_intervals(task.intervals)
    _check(task, accuracy)
    for name in CHOOSE:
        check_choice(name, getattr(task, name))
    numbers = {name: float(getattr(task, name)) for name in ("start_time", "stop_time", "tolerance")}
    return replace(task, **numbers), accuracy  # plain floats: comparing numpy's numbers does not give a bool


def check_choice(name: str, value: Any) -> None:
    """Raise DeclarationError if an argument of `simulate` is not one of its choices.

    Parameters
    ----------
    name : "method", "constraints" or "initial"
        The argument.
    value : object
        Its value; None leaves it to the model.
    """
    if value is not None and not (isinstance(value, str) and value in CHOOSE[name]):
        raise DeclarationError(f"{name} is {value!r}; it must be one of {', '.join(CHOOSE[name])}.")


def check_limits(max_steps: Any, max_seconds: Any) -> None:
    """Raise DeclarationError if a limit of a run is not positive.

    Parameters
    ----------
    max_steps, max_seconds : object
        The limits; None for none.
    """
    if max_steps is not None:
        _check_count("max_steps", max_steps)
    if max_seconds is not None:
        check_number("max_seconds", max_seconds)
        if max_seconds <= 0:
            raise DeclarationError(f"max_seconds is {max_seconds!r}; it must be positive.")


def check_intervals(intervals: Any) -> None:
    """Raise DeclarationError if a number of intervals is not a positive whole number, or too large for any memory.

    Parameters
    ----------
    intervals : object
        The number.
    """
    _check_count("intervals", intervals)
    if intervals > MOST:
        raise DeclarationError(f"intervals is {intervals}; at most {MOST} points are allowed.")


def _check_count(name: str, value: Any) -> None:
    """Raise DeclarationError if a setting is not a positive whole number."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < 1:
        whole = isinstance(value, float) and value >= 1 and value.is_integer()
        remedy = f": {int(value)}" if whole else ""
        raise DeclarationError(f"{name} is {value!r}; it must be a whole number of at least 1{remedy}.")


def _check(task: Task, accuracy: float | None) -> None:
    """Raise DeclarationError for settings that are out of range or contradict each other."""
    numbers = {"start_time": task.start_time, "stop_time": task.stop_time, "tolerance": task.tolerance}
    for name, value in {**numbers, **({} if accuracy is None else {"accuracy": accuracy})}.items():
        check_number(name, value)
    start, stop = task.start_time, task.stop_time
    if stop <= start:
        raise DeclarationError(f"stop_time is {stop:g} s; it must come after start_time = {start:g} s.")
    if (stop - start) / task.intervals <= 8 * np.spacing(max(abs(start), abs(stop))):
        raise DeclarationError(
            f"start_time = {start:g} s and stop_time = {stop:g} s are too close for {task.intervals} output intervals: "
            "floating-point numbers of this size cannot resolve them. Count time from 0, or take fewer intervals."
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
