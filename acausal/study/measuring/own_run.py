"""Runs of a formulation's own integrator in place of `simulate`: its arguments, and checks of its result."""

from __future__ import annotations

import inspect
import time as clock
import traceback
from collections.abc import Callable
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import AcausalError, DeclarationError, SimulationError
from acausal.language.value_checks import shown
from acausal.result import Result
from acausal.study.measuring.case import Job
from acausal.study.measuring.limit import TooLong
from acausal.study.measuring.model_pickling import unpack

# Largest deviation of an output time from the requested one, as a fraction of the output interval: allows round-off.
AT = 1e-6


def run_integrator(job: Job, compiled: CompiledModel, show: Callable[[float, int], None]) -> tuple[Result, float]:
    """Run a case by the formulation's own integrator.

    Parameters
    ----------
    job : Job
        A job with such an integrator.
    compiled : CompiledModel
        Its model.
    show : callable
        Progress function, passed on if the integrator takes one.

    Returns
    -------
    result : Result
        The result at the times of the job.
    seconds : float
        Solve time from the statistics of the result, or else the elapsed time.

    Raises
    ------
    AcausalError
        If the integrator fails or returns an invalid result.
    """
    case, what = job.case, f"the run of formulation `{job.case.formulation}`"
    times = job.stop_time * np.linspace(0.0, 1.0, job.intervals + 1)
    given: dict[str, Any] = {"tolerance": case.tolerance} if case.dt is None else {"dt": case.dt}
    began = clock.perf_counter()
    try:
        run = unpack(job.run)
        if _takes_progress(run):
            given["progress"] = show
        result = run(compiled, job.stop_time, times.copy(), **given)
    except (AcausalError, TooLong):
        raise
    except Exception as error:
        raise SimulationError(f"{what} ended with {type(error).__name__}: {error}{_place(error)}") from error
    took = clock.perf_counter() - began
    if not isinstance(result, Result):
        raise DeclarationError(
            f"{what} returned {shown(result)}; it must return a Result, as from simulate or result_of"
        )
    if result.time.shape != times.shape or not np.allclose(result.time, times, rtol=0, atol=AT * times[1]):
        ends = f"{result.time.size} times" + (f" up to {result.time[-1]:g} s" if result.time.size else "")
        raise DeclarationError(
            f"{what} returned {ends}; it must return the times that it was given: {times.size} up to {times[-1]:g} s"
        )
    lost = [name for name in job.outputs if name not in result]
    if lost:
        raise DeclarationError(
            f"{what} returned a result without `{lost[0]}`: it must contain all compared outputs, see "
            "result_of(..., model=model)"
        )
    return result, result.stats.solve_seconds or took


def _takes_progress(run: Any) -> bool:
    try:
        known = inspect.signature(run).parameters
    except (TypeError, ValueError):
        return False
    return "progress" in known or any(p.kind is inspect.Parameter.VAR_KEYWORD for p in known.values())


def _place(error: Exception) -> str:
    """Return the file and line of an error."""
    frames = traceback.extract_tb(error.__traceback__)[1:]
    return f" ({frames[-1].filename}:{frames[-1].lineno})" if frames else ""
