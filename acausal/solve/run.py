"""One run: initialise, choose the order, integrate, and make a Result."""

from __future__ import annotations

import time as clock
from dataclasses import dataclass, replace
from typing import Any, NoReturn

import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import SimulationError, caution
from acausal.result import Result
from acausal.solve.checks.meeting import first_meeting
from acausal.solve.checks.promises import broken_promises
from acausal.solve.checks.validity import check_start, doubts
from acausal.solve.evaluator import Evaluator
from acausal.solve.events.agenda import APART
from acausal.solve.events.clock_times import clock_times
from acausal.solve.events.course import Chattering, Run
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.ladder import Failure
from acausal.solve.integrate.order import eigenvalues_of, order_limit
from acausal.solve.integrate.settings import Progress, Settings
from acausal.solve.integrate.trace import Trace
from acausal.solve.problem import Point, Problem
from acausal.solve.sizes import PASSES, absolute_sizes, smaller_sizes
from acausal.solve.start.initialize import Start
from acausal.solve.start.redundancy import is_singular
from acausal.solve.start.start import go_on, start

ROUGH = (
    "the energies are not known to the tolerance: a power turns faster than points between the outputs can follow. More "
    "intervals, simulate(..., intervals=...), give more points."
)


@dataclass(frozen=True)
class Task:
    """What to run, as of `simulate`; `max_order` None is chosen from the eigenvalues."""

    start_time: float
    stop_time: float
    tolerance: float
    intervals: int
    initial: str
    method: str
    constraints: str
    max_order: int | None
    energy: bool
    progress: Progress | None


def run(compiled: CompiledModel, p: np.ndarray, task: Task) -> Result:
    """Run a compiled model once with the parameter values p.

    Raises
    ------
    InitializationError
        If no consistent initial values exist or are found.
    SimulationError
        If the integration fails; its `result` holds what was computed.
    """
    start_time, stop_time = task.start_time, task.stop_time
    built = compiled.seconds.get("integrators", 0.0)
    started = clock.perf_counter()
    times = start_time + (stop_time - start_time) * np.linspace(0.0, 1.0, task.intervals + 1)
    times[-1] = stop_time
    found = clock_times(compiled, p, start_time, stop_time)
    breaks = _breaks(compiled.guards.breaks(p)[0].tolist(), start_time, stop_time)
    ends = _breaks([*breaks, *found], start_time, stop_time)
    problem = Problem(compiled, p)
    begun = start(problem, start_time, _middle(start_time, ends, stop_time), task.initial)
    check_start(problem, begun.point)
    first, at = begun.point, go_on(problem, begun)
    rates = eigenvalues_of(problem, at)
    max_order = task.max_order or order_limit(rates, stop_time - start_time)
    fastest = float(np.max(np.abs(rates), initial=0.0))
    span = stop_time - start_time
    fixed = (task.tolerance, max_order, task.energy, task.progress, task.constraints, task.method, fastest)
    nominal, counts = compiled.nominal, Trace()
    for _ in range(PASSES):
        integrator = Integrator(problem, Settings(nominal, *fixed), (start_time, stop_time), counts)
        events = Run(integrator, times, ends, breaks)
        failure: BaseException | None = None
        try:
            events.go(at)
        except (Failure, Chattering, KeyboardInterrupt) as caught:
            failure = caught
        fitting = (
            None
            if isinstance(failure, KeyboardInterrupt)
            else smaller_sizes(problem, integrator.trace.rows(at).x, nominal, task.tolerance, span)
        )
        if fitting is None:
            break
        nominal, counts = fitting, integrator.trace
    waited = compiled.seconds.get("integrators", 0.0) - built
    stats = _stats(begun, integrator, breaks)
    stats |= {"events": len(events.events), "event_times": events.events}
    stats["solve_seconds"] = clock.perf_counter() - started - waited
    first = (events.first or at) if at is first else first
    met = None if isinstance(failure, KeyboardInterrupt) else first_meeting(integrator, first)
    if met:
        integrator.trace = integrator.trace.until(met.time)
    result = _result(compiled, integrator, first, times, stats, task.energy)
    if met:
        raise SimulationError(met.text, result)
    if failure is not None:
        _raise(failure, result, integrator, replace(begun, point=at))
    return result


def _raise(failure: BaseException, result: Result, integrator: Integrator, first: Start) -> NoReturn:
    """Raise what ended a run, with what was computed."""
    if isinstance(failure, Failure):
        raise SimulationError(_failure_text(integrator, first, failure), result)
    if isinstance(failure, Chattering):
        raise SimulationError(str(failure), result)
    failure.result = result  # type: ignore[attr-defined]
    raise failure


def _breaks(instants: list[float], start: float, stop: float) -> list[float]:
    """Break times inside of a run; those that are but a few rounding errors apart are one."""
    found: list[float] = []
    for b in sorted(b for b in instants if start < b < stop):
        if b - (found or [start])[-1] > APART * abs(b) and stop - b > APART * abs(stop):
            found.append(b)
    return found


def _middle(start: float, breaks: list[float], stop: float) -> float:
    return (start + (breaks[0] if breaks else stop)) / 2


def _stats(begun: Start, run: Integrator, breaks: list[float]) -> dict[str, Any]:
    compiled, trace = run.compiled, run.trace
    report = compiled.report_at(begun.found(compiled))
    return {
        "loops": report["loops"],
        "independent_states": report["independent_states"],
        "equations_flat": report["equations_flat"],
        "equations_reduced": report["equations_reduced"],
        "states": compiled.nx,
        "algebraic": compiled.nz,
        "compile_seconds": sum(compiled.seconds.values()),
        "steps": trace.steps,
        "factorisations": trace.factorisations,
        "residual_evaluations": trace.residual_evaluations,
        "calls": trace.calls,
        "integration_seconds": trace.seconds,
        "max_order": run.settings.max_order,
        "tolerance": run.settings.tolerance,
        "sizes": absolute_sizes(compiled, run.settings.nominal),
        "method": " and ".join(trace.methods) or "none",
        "method_steps": dict(trace.methods),
        "fastest_rate": run.settings.fastest,
        "constraints": "none" if not compiled.closing.size else "projection" if run.way.moves else "states",
        "choices": trace.choices,
        "loosened_at": trace.loosened,
        "break_times": breaks,
    }


def _result(
    compiled: CompiledModel,
    run: Integrator,
    first: Point,
    times: np.ndarray,
    stats: dict[str, Any],
    energy: bool,
) -> Result:
    t, x, z, works, modes = run.trace.rows(first)
    rows = np.searchsorted(t, times[times <= t[-1]])
    evaluate = Evaluator(compiled, t[rows], x[rows], z[rows], modes[rows], run.consistent)
    stats["doubts"] = doubts(compiled, evaluate) + broken_promises(run, evaluate)
    if energy:
        if run.trace.rough:
            caution(ROUGH)
        stored = Evaluator(compiled, t[[0, -1]], x[[0, -1]], z[[0, -1]], modes[[0, -1]], run.consistent)
        held = stored(compiled.reduced.flat.energies["stored_energy"])[:, 0]
        supplied, dissipated = works[-1]
        change = held[1] - held[0]
        stats |= {
            "energy_supplied": float(supplied),
            "energy_stored_change": float(change),
            "energy_dissipated": float(dissipated),
            "energy_method": float(supplied - change - dissipated),
        }
    stats["consistent_evaluations"] = run.consistent.evaluations
    result = Result(t[rows], evaluate, compiled.tree, compiled.outputs, stats, title=type(compiled.tree).__name__)
    evaluate.counts = result.stats
    return result


def _failure_text(run: Integrator, first: Start, failure: Failure) -> str:
    problem, compiled, trace, at = run.problem, run.compiled, run.trace, first.point
    lines = [f"the integration stopped at t = {failure.time:.6g} s after {trace.steps} steps: {failure.reason}."]
    if trace.pieces:
        last = trace.last()
        at = Point(float(last.times), last.x, last.z, compiled.layout.constants(last.constants))
        rates = problem.values(at)[: compiled.nx] / compiled.nominal[: compiled.nx]
        fastest = np.argsort(-np.abs(np.nan_to_num(rates, nan=np.inf)))[:3]
        names = ", ".join(f"`{compiled.states[k]}`" for k in fastest)
        lines.append(f"Until t = {at.time:.6g} s all is well; what changes fastest there: {names}.")
    left = first.redundancy
    if is_singular(problem, at, left) or (left.singular and not trace.pieces):
        lines.append(
            "The loops are in a singular position there, or just beside it, as where all links lie in line: it does not tell "
            "on which branch they go on, and forces have no value. Start 0.01 rad beside it, give a velocity with which they "
            "can go on, w=fixed(...) of a joint, or try another method=. What was computed is kept."
        )
        return "\n".join(lines)
    lines.append(
        "A motion that grows without bound, a force that becomes infinite, or a jump that no break time declares "
        "stops an integrator. What was computed is kept."
    )
    return "\n".join(lines)
