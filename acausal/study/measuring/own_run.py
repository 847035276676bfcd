"""Runs that a formulation brings itself, in place of `simulate`: what they are given, and what they must return."""

from __future__ import annotations

import inspect
import time as clock
import traceback
from collections.abc import Callable
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import AcausalError, DeclarationError, SimulationError
from acausal.language.values import shown
from acausal.result import Result
from acausal.study.measuring.case import Job
from acausal.study.measuring.limit import TooLong
from acausal.study.measuring.model_pickling import unpack

# Of an output interval: how far a time may be from the one that was asked for, by rounding.
AT = 1e-6


def take(job: Job, compiled: CompiledModel, show: Callable[[float, int], None]) -> tuple[Result, float]:
    """Run a case of a formulation with a run of its own.

    Parameters
    ----------
    job : Job
        With such a run.
    compiled : CompiledModel
        Its model.
    show : callable
        For the progress, where the run takes that.

    Returns
    -------
    result : Result
        At the times of the job.
    seconds : float
        What the run says that solving took, all that it took if it says nothing.

    Raises
    ------
    AcausalError
        If it fails, or returns something else.
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
            f"{what} returned {shown(result)}, where a Result is needed, as of simulate or result_of"
        )
    if result.time.shape != times.shape or not np.allclose(result.time, times, rtol=0, atol=AT * times[1]):
        ends = f"{result.time.size} times" + (f" up to {result.time[-1]:g} s" if result.time.size else "")
        raise DeclarationError(
            f"{what} returned {ends}, where those were asked for that it was given: {times.size} up to {times[-1]:g} s"
        )
    lost = [name for name in job.outputs if name not in result]
    if lost:
        raise DeclarationError(
            f"{what} returned a result without `{lost[0]}`: it needs all that is compared, see result_of(..., model=model)"
        )
    return result, result.stats.solve_seconds or took


def _takes_progress(run: Any) -> bool:
    try:
        known = inspect.signature(run).parameters
    except (TypeError, ValueError):
        return False
    return "progress" in known or any(p.kind is inspect.Parameter.VAR_KEYWORD for p in known.values())


def _place(error: Exception) -> str:
    """Where an error arose."""
    frames = traceback.extract_tb(error.__traceback__)[1:]
    return f" ({frames[-1].filename}:{frames[-1].lineno})" if frames else ""
