"""Measure a case in this process: compile it, run it, and report its cost."""

from __future__ import annotations

import hashlib
import statistics
import time as clock
import warnings
from dataclasses import replace
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel, compile
from acausal.errors import AcausalError, AcausalWarning
from acausal.locks import exclusive
from acausal.policy import POLICY
from acausal.result import Result
from acausal.simulation import forget, simulate
from acausal.study.measuring.case import Job, Measurement
from acausal.study.measuring.limit import TooLong, stopping_after
from acausal.study.measuring.model_pickling import unpack
from acausal.study.measuring.own_run import run_integrator

KEPT = 2
# Compiled models of this process, the most recently used last.
_COMPILED: dict[tuple[bytes, str], CompiledModel] = {}


@exclusive
def measure(job: Job) -> Measurement:
    """Compile and run a case; errors of the model are stored in the measurement.

    Parameters
    ----------
    job : Job
        The job.
    """
    try:
        with stopping_after(job.limit) as show:
            compiled = _compiled(job)
            with warnings.catch_warnings():
                # Warnings about neglected effects are the subject of a study; values that are not finite become errors below.
                warnings.simplefilter("ignore", AcausalWarning)
                return _measure(job, compiled, show)
    except TooLong:
        _COMPILED.clear()  # the interrupt may have left a model half evaluated
        return Measurement(job.case, error=f"it was stopped after {job.limit:g} s")
    except AcausalError as error:
        return Measurement(job.case, error=(str(error).splitlines() or [type(error).__name__])[0])


def _measure(job: Job, compiled: CompiledModel, show: Any) -> Measurement:
    result, took = _run(job, compiled, show)
    if took < POLICY.study.little:
        # The first run of a process or a model includes one-time costs; the initial point is cached, so forget it.
        forget(compiled)
        result, took = _run(job, compiled, show)
    stats, seconds = result.stats, [took]
    while sum(seconds) < (
        POLICY.study.enough if len(seconds) < job.repeats else POLICY.study.little * (job.repeats > 1)
    ):
        seconds.append(_run(job, compiled, show)[1])
    found = Measurement(
        job.case,
        compile_seconds=stats.compile_seconds,
        solve_seconds=statistics.median(seconds),
        steps=stats.steps,
        factorisations=stats.factorisations,
        residual_evaluations=stats.residual_evaluations,
        equations=stats.equations_reduced,
        operations=stats.operations or (0 if job.run else int(compiled.local.function.n_instructions())),
        max_order=stats.max_order,
        method=stats.method,
        constraints=stats.constraints,
    )
    if loosened := stats.loosened_at:
        return replace(found, error=f"no step was short enough for the tolerance after t = {loosened[0]:.6g} s")
    wrong = result.not_finite(*job.outputs)
    if wrong:
        name, time = next(iter(wrong.items()))
        return replace(found, error=f"`{name}` is not finite from t = {time:.6g} s on")
    values = {s.name: np.array(s.values) for s in result.series(*job.outputs)}
    return replace(found, times=result.time, values=values)


def _run(job: Job, compiled: CompiledModel, show: Any) -> tuple[Result, float]:
    """Run, and return the result and the solve time, scaled by the process's share of the processor."""
    began, busy = clock.perf_counter(), clock.process_time()
    result, seconds = run_integrator(job, compiled, show) if job.run else _simulated(job, compiled, show)
    share = (clock.process_time() - busy) / (clock.perf_counter() - began)
    return result, seconds * min(1.0, share)


def _simulated(job: Job, compiled: CompiledModel, show: Any) -> tuple[Result, float]:
    case = job.case
    result = simulate(
        compiled,
        stop_time=job.stop_time,
        intervals=job.intervals,
        tolerance=case.tolerance,
        max_order=case.max_order,
        method=case.method,
        constraints=case.constraints,
        initial=job.initial,
        progress=show,
    )
    return result, result.stats.solve_seconds


def _compiled(job: Job) -> CompiledModel:
    """Return the compiled model of a case, compiling it unless another case with the same structure did."""
    key = (hashlib.sha256(job.model).digest(), job.case.structure)
    found = _COMPILED.pop(key, None) or compile(unpack(job.model), parameters=job.values)
    _COMPILED[key] = found
    while len(_COMPILED) > KEPT:
        del _COMPILED[next(iter(_COMPILED))]
    return found
