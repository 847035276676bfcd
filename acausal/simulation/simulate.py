"""simulate(): from a model to a Result."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from acausal.compiler import CompiledModel, ready
from acausal.errors import InitializationError, SimulationError, caution
from acausal.language.call_arguments import checked_arguments
from acausal.language.component import Component
from acausal.locks import exclusive
from acausal.result import Result
from acausal.simulation.accuracy_control import simulate_to_accuracy
from acausal.simulation.inputs import with_inputs
from acausal.simulation.run_cache import RunCache
from acausal.simulation.settings_checks import checked_task
from acausal.solve.integrate.settings import Progress
from acausal.solve.run import Task, run


@checked_arguments
@exclusive
def simulate(
    model: Component | CompiledModel,
    *,
    stop_time: float | None = None,
    start_time: float = 0.0,
    tolerance: float | None = None,
    accuracy: float | None = None,
    intervals: int | None = None,
    parameters: Mapping[str, Any] | None = None,
    inputs: Mapping[str, Any] | None = None,
    extrapolation: str = "refuse",
    initial: str | None = None,
    method: str | None = None,
    constraints: str | None = None,
    max_order: int | None = None,
    energy: bool = False,
    progress: Progress | None = None,
    max_steps: int | None = None,
    max_seconds: float | None = None,
) -> Result:
    """Simulate a model.

    The arguments stop_time, tolerance, accuracy, intervals, initial, method, constraints and max_order default to
    attributes of the same name in the model's class.

    Parameters
    ----------
    model : Component or CompiledModel
        A model is compiled first, with the given parameters; a compiled model only takes new values.
    stop_time, start_time : float
        In s.
    tolerance : float, optional
        Relative tolerance of a step; absolute tolerance = tolerance * nominal value. The global error is typically 100 to
        1000 times larger if bodies oscillate. Default 1e-6.
    accuracy : float, optional
        Instead of a tolerance: largest error of every output at the output points, as a fraction of its range in the run.
        Tolerance and order limit are chosen by comparing runs, and so is the number of elements or volumes of adaptive
        beams, whatever the model says. `stats` lists choices, estimates and trials; its counts are those of the returned
        run, its compile and solve seconds those of all runs.
    intervals : int
        The result has intervals + 1 equidistant points; 400 by default.
    parameters : mapping of str to value, optional
        Values by path, such as {"beam.E": 7e10}.
    inputs : mapping of str to data, optional
        What inputs of the whole model do in the run, by name: (times, values), interpolated linearly (truth values hold), a
        pandas Series, a Table, or a function of time. Others keep their start value.
    extrapolation : "refuse" or "hold"
        Whether data have to cover the run, or hold their first and last value. A Table has an extrapolation of its own.
    initial : "fixed", "guesses" or "steady"
        What to do with states without an initial condition: refuse them, take their guesses, or solve for an equilibrium;
        without an equilibrium, for steady rotation about cyclic coordinates. Default "fixed".
    method : "auto", "idas", "rosenbrock" or "resolve"
        "idas" is SUNDIALS' multistep method, with every velocity in its error test, so that it resolves every vibration;
        "resolve" is another name for it. "rosenbrock" is a one-step method of order 5 that damps vibrations too small to be
        seen in positions. "auto" resolves them by the one-step method, damps them if vibrations faster than the outputs
        take more steps than the motion, and takes IDAS where loops pass singular configurations
        (docs/background/ringing.md). Default "auto".
    constraints : "auto", "states" or "projection"
        How closed loops stay closed: "states" integrates independent coordinates, chosen by pivots at the start and again
        if the pivots become small; "projection" integrates all of them and projects. "auto" projects in the core; IDAS
        begins with states, and projects if they become dependent too often. Default "auto".
    max_order : int, optional
        Limit of the order of the multistep method, 1 to 5; chosen from the problem if not given.
    energy : bool
        Integrate the supplied and the dissipated power as well.
    progress : callable, optional
        Called repeatedly in long runs with the fraction done and the number of steps; with `accuracy`, those of the
        current run.
    max_steps, max_seconds : int, float, optional
        Steps and seconds after which a run ends with SimulationError; `stats.stopped` of its result says so. With `accuracy`,
        of each run.

    Returns
    -------
    Result
        Read any variable by its path.

    Raises
    ------
    InitializationError
        If no consistent initial values are found.
    SimulationError
        If the integration fails, diverges or is at a limit, or the accuracy is not reached; its `result` holds the run so far.
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
    task, accuracy = checked_task(
        *(model, parameters, given, start_time, energy, progress), max_steps=max_steps, max_seconds=max_seconds
    )
    ends = task.start_time, task.stop_time
    values = with_inputs(model, parameters, inputs, extrapolation, ends)
    try:
        result = _simulate(model, values, task, accuracy)
    except SimulationError as failure:
        if not failure.begun:
            raise InitializationError(str(failure)) from None
        _warn(failure.result)
        raise
    _warn(result)
    return result


def _simulate(
    model: Component | CompiledModel, parameters: Mapping[str, Any] | None, task: Task, accuracy: float | None
) -> Result:
    if accuracy is not None:
        return simulate_to_accuracy(accuracy, RunCache(model, parameters, task))
    return run(*ready(model, parameters), task)


def _warn(result: object) -> None:
    """Warn of components used outside their range of validity."""
    if isinstance(result, Result):
        for doubt in result.stats.doubts:
            caution(doubt)
