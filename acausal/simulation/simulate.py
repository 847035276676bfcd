"""simulate(): from a model to a Result."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel, ready
from acausal.errors import DeclarationError, SimulationError, caution
from acausal.language.component import Component
from acausal.locks import alone
from acausal.policy import POLICY
from acausal.result import Result
from acausal.simulation.accuracy import reach
from acausal.simulation.runs import Runs
from acausal.simulation.settings import settled
from acausal.solve.integrate.methods import METHODS
from acausal.solve.integrate.settings import Progress
from acausal.solve.run import Task, run
from acausal.solve.start.initialize import INITIAL

CHOICES = ("auto", *METHODS, "resolve")
CONSTRAINTS = ("auto", "states", "projection")
CHOOSE = {"method": CHOICES, "constraints": CONSTRAINTS, "initial": INITIAL}
MOST = 100_000_000  # points of a run


@alone
def simulate(
    model: Component | CompiledModel,
    *,
    stop_time: float | None = None,
    start_time: float = 0.0,
    tolerance: float | None = None,
    accuracy: float | None = None,
    intervals: int | None = None,
    parameters: Mapping[str, Any] | None = None,
    initial: str | None = None,
    method: str | None = None,
    constraints: str | None = None,
    max_order: int | None = None,
    energy: bool = False,
    progress: Progress | None = None,
) -> Result:
    """Simulate a model.

    Of stop_time, tolerance, accuracy, intervals, initial, method, constraints and max_order, what is not given is taken
    from attributes of the same name in the model's class.

    Parameters
    ----------
    model : Component or CompiledModel
        A model is compiled first, with the given parameters; a compiled one only takes new values.
    stop_time, start_time : float
        In s.
    tolerance : float, optional
        Relative tolerance of a step; absolute tolerance = tolerance * nominal value. The error of a result is typically
        100 to 1000 times larger where bodies oscillate. Default 1e-6.
    accuracy : float, optional
        Instead of a tolerance: largest error of every output at the output points, as a fraction of its range in the run.
        Tolerance and order limit are chosen by comparing runs, and so is the number of elements or volumes of adaptive
        beams, whatever the model says. `stats` lists what was chosen, estimated and tried; its counts are those of the
        run that is returned, its compile and solve seconds those of all runs.
    intervals : int
        The result has intervals + 1 equidistant points; 400 by default.
    parameters : mapping of str to value, optional
        Values by path, such as {"beam.E": 7e10}.
    initial : "fixed", "guesses" or "steady"
        Whether states without a condition at the start are refused, take their guesses, or take values at which all
        derivatives vanish. Default "fixed".
    method : "auto", "idas", "rosenbrock" or "resolve"
        "idas" is a multistep method whose error test sees every velocity; "resolve" is another name for it, and follows
        every vibration. "rosenbrock" is a one-step method that damps vibrations too small to be seen in positions. "auto"
        begins with the first, and takes the other where vibrations faster than the outputs take more steps than the
        motion. Default "auto".
    constraints : "auto", "states" or "projection"
        How closed loops stay closed: "states" lets some coordinates follow from the others, chosen by pivots at the start
        and again where the pivots fall; "projection" integrates all of them and projects. "auto" begins with states, and
        projects if they do not last. Default "auto".
    max_order : int, optional
        Limit of the order of the multistep method, 1 to 5; chosen from the problem where it is not given.
    energy : bool
        Integrate the supplied and the dissipated power as well.
    progress : callable, optional
        Called from time to time in long runs with the fraction that is done and the number of steps; with `accuracy`, those
        of the run under way.

    Returns
    -------
    Result
        Read any variable by its path.

    Raises
    ------
    InitializationError
        If no consistent initial values exist or are found.
    SimulationError
        If the integration fails, or the accuracy is not reached; its `result` holds what was computed.
    """
    given: dict[str, Any] = {
        "stop_time": stop_time,
        "tolerance": tolerance,
        "accuracy": accuracy,
        "intervals": intervals,
        "initial": initial,
        "method": method,
        "constraints": constraints,
        "max_order": max_order,
    }
    task, accuracy = planned(model, parameters, given, start_time=start_time, energy=energy, progress=progress)
    try:
        result = _simulate(model, parameters, task, accuracy)
    except SimulationError as failure:
        _warn(failure.result)
        raise
    _warn(result)
    return result


def _simulate(
    model: Component | CompiledModel, parameters: Mapping[str, Any] | None, task: Task, accuracy: float | None
) -> Result:
    if accuracy is not None:
        return reach(accuracy, Runs(model, parameters, task))
    return run(*ready(model, parameters), task)


def _warn(result: object) -> None:
    """Warn where components were used outside their range."""
    if isinstance(result, Result):
        for doubt in result.stats.doubts:
            caution(doubt)


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
    _check(start_time, task.stop_time, task.tolerance, accuracy, task.intervals, task.max_order)
    for name in CHOOSE:
        check_choice(name, getattr(task, name))
    return task, accuracy


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
        raise DeclarationError(f"intervals is {intervals!r}; it must be a whole number of at least 1.")
    if intervals > MOST:
        raise DeclarationError(f"intervals is {intervals}; more than {MOST} points do not fit into the memory.")


def _check(
    start: float, stop: float, tolerance: float, accuracy: float | None, intervals: int, order: int | None
) -> None:
    numbers = {"start_time": start, "stop_time": stop, "tolerance": tolerance}
    numbers |= {} if accuracy is None else {"accuracy": accuracy}
    for name, value in numbers.items():
        if isinstance(value, bool) or not isinstance(value, int | float | np.number):
            raise DeclarationError(f"{name} is {value!r}; it must be a number.")
    for name, value in {"start_time": start, "stop_time": stop}.items():
        if not np.isfinite(value):
            raise DeclarationError(f"{name} is {value:g} s; it must be a finite number of seconds, for instance 2.0.")
    if stop <= start:
        raise DeclarationError(f"stop_time is {stop:g} s; it must come after start_time = {start:g} s.")
    if not 0 < tolerance < 1:
        raise DeclarationError(f"tolerance is {tolerance:g}; it must lie between 0 and 1, for instance 1e-6.")
    if tolerance < np.finfo(float).eps:
        raise DeclarationError(
            f"tolerance is {tolerance:g}, but numbers have 16 digits; take one between 1e-12 and 1e-2."
        )
    if accuracy is not None and not 0 < accuracy < 1:
        raise DeclarationError(f"accuracy is {accuracy:g}; it must lie between 0 and 1, for instance 1e-3.")
    check_intervals(intervals)
    if order is not None and order not in range(1, 6):
        raise DeclarationError(f"max_order is {order!r}; it must be a whole number from 1 to 5.")
