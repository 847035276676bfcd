"""One run: initialise, choose the order, integrate, and make a Result."""

from __future__ import annotations

import time as clock
from collections import Counter
from dataclasses import dataclass, replace
from typing import Any, NoReturn

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.memo import memo_seconds
from acausal.compiler.report import loops_at, parts_at
from acausal.errors import DeclarationError, SimulationError
from acausal.flatten.model_inputs import held_inputs
from acausal.policy import POLICY
from acausal.result import Result
from acausal.result.statistics import Statistics
from acausal.signals import Signals
from acausal.solve.checks.constraint_drift import first_violation, refuse_constraint_drift
from acausal.solve.checks.growth import growth_warnings
from acausal.solve.checks.loop_drift import loop_drift
from acausal.solve.checks.mobility import mobility_warnings
from acausal.solve.checks.smoothness import smoothness_warnings
from acausal.solve.checks.validity import validity_warnings
from acausal.solve.diagnosis.failure import failure_text
from acausal.solve.events.agenda import part_of_time
from acausal.solve.events.chattering import Chattering
from acausal.solve.events.clock_times import clock_times
from acausal.solve.events.course import Course
from acausal.solve.initialization.initial_modes import leave_singular_start
from acausal.solve.initialization.initial_point import InitialPoint, initial_point
from acausal.solve.initialization.initialize import Start
from acausal.solve.integrate.integrator import Integrator
from acausal.solve.integrate.ladder import Failure, Kind
from acausal.solve.integrate.limits import Limits
from acausal.solve.integrate.methods import METHODS, chosen, why_first
from acausal.solve.integrate.settings import Progress, Settings
from acausal.solve.integrate.sizes import absolute_sizes, smaller_sizes
from acausal.solve.integrate.trace import Trace
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.solve.results.evaluator import Evaluator

PLAIN = 10  # further numbers stored for each output
SHOWN = 5  # times in a message


@dataclass(frozen=True)
class Task:
    """What to run, as in `simulate`; `max_order` None is chosen from the eigenvalues."""

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
    max_steps: int | None = None
    max_seconds: float | None = None


# As in `start`.
@np.errstate(all="ignore")
def run(compiled: CompiledModel, p: np.ndarray, task: Task) -> Result:
    """Run a compiled model once with the parameter values p.

    Raises
    ------
    InitializationError
        If no consistent initial values exist or are found.
    SimulationError
        If the integration fails; its `result` has the rows before the failure.
    """
    made, (problem, plan, beginning) = memo_seconds(compiled), _begun(compiled, p, task)
    begun, at_first = clock.perf_counter(), memo_seconds(compiled)
    done = _integrated(problem, plan, beginning, task)
    building = done.integrator.trace.building + memo_seconds(compiled) - at_first
    # Counts of a run do not depend on earlier runs, even if one of them computed its initial point.
    seconds = beginning.seconds + clock.perf_counter() - begun - building
    done.integrator.trace.building = building + at_first - made
    met = None if isinstance(done.failure, KeyboardInterrupt) else first_violation(done.integrator, done.first)
    if met:
        done.integrator.trace.cut(met.time)
    result = _result(done, plan, _counted(done, plan, task, seconds), task.energy)
    if met:
        raise SimulationError(met.text, result.with_stats(stopped=met.text))
    if done.failure is not None:
        _raise(done, result)
    return result


@np.errstate(all="ignore")
def sizes_of_run(compiled: CompiledModel, p: np.ndarray, task: Task) -> np.ndarray:
    """Run a model as `run` does; return the final nominal values of states and algebraic unknowns, even if the run fails."""
    done = _integrated(*_begun(compiled, p, task), task)
    if isinstance(done.failure, KeyboardInterrupt):
        raise done.failure
    refuse_constraint_drift(done.integrator, done.first)
    return done.integrator.settings.nominal


@dataclass(frozen=True)
class _Plan:
    """Output times, break times by parameters alone, and all time events."""

    times: np.ndarray
    breaks: list[float]
    ends: list[float]

    @property
    def inside(self) -> float:
        return (self.times[0] + (self.ends[0] if self.ends else self.times[-1])) / 2


@dataclass(frozen=True)
class _Done:
    """A finished run: start, first point, integrator, events, and the exception that ended it early."""

    begun: Start
    at: Point
    integrator: Integrator
    course: Course
    failure: BaseException | None

    @property
    def first(self) -> Point:
        """The first row of the result."""
        return (self.course.first or self.at) if self.at is self.begun.point else self.begun.point


def _begun(compiled: CompiledModel, p: np.ndarray, task: Task) -> tuple[Problem, _Plan, InitialPoint]:
    problem = Problem(compiled, p, POLICY.loops.feedback / (task.stop_time - task.start_time), runs=True)
    plan = _plan(problem, task)
    return problem, plan, initial_point(problem, task.start_time, plan.inside, task.initial)


def _plan(problem: Problem, task: Task) -> _Plan:
    begin, end = task.start_time, task.stop_time
    numbers = (task.intervals + 1) * (problem.nx + problem.nz + PLAIN)
    if numbers > POLICY.defaults.numbers:
        raise DeclarationError(
            f"intervals is {task.intervals}: the result would need {8e-9 * numbers:.3g} GB. Use fewer; the motion "
            "between two outputs is computed in any case."
        )
    times = begin + (end - begin) * np.linspace(0.0, 1.0, task.intervals + 1)
    times[-1] = end
    found = clock_times(problem.compiled, problem.p, begin, end)
    breaks = _breaks(problem.compiled.guards.breaks(problem.p)[0].tolist(), begin, end)
    return _Plan(times, breaks, _breaks([*breaks, *found], begin, end))


def _integrated(problem: Problem, plan: _Plan, beginning: InitialPoint, task: Task) -> _Done:
    """Integrate, and repeat with other nominal values if states are much smaller than assumed."""
    at, span = beginning.at, task.stop_time - task.start_time
    settings = Settings(
        nominal=problem.nominal,
        tolerance=task.tolerance,
        outputs=task.intervals,
        spectrum=beginning.spectrum,
        span=span,
        given_order=task.max_order,
        energy=task.energy,
        progress=task.progress,
        constraints=task.constraints,
        methods=chosen(task.method, task.max_order),
    )
    counts, ends, started = Trace(), (task.start_time, task.stop_time), clock.perf_counter()
    skipped = plan.times[(plan.times > task.start_time) & (plan.times < at.time)].tolist()
    passed = [leave_singular_start(problem, beginning.start, time) for time in skipped]
    for _ in range(POLICY.sizes.passes):
        limits = Limits(problem, ends, task.tolerance, task.max_steps, task.max_seconds, started)
        integrator = Integrator(problem, settings, ends, counts, beginning.start.point.constants, limits)
        done = _Done(beginning.start, at, integrator, Course(integrator, plan.times, plan.ends, plan.breaks), None)
        try:
            done.course.go(at, passed)
        except KeyboardInterrupt as interrupt:
            Signals.heard()
            return replace(done, failure=interrupt)
        except (Failure, Chattering) as failure:
            done = replace(done, failure=failure)
            if isinstance(failure, Failure) and failure.kind is Kind.LIMIT:
                break
            if isinstance(failure, Failure) and failure.kind in (Kind.ERROR_TEST, Kind.DIVERGENCE):
                # The time of an escape to infinity is known to the tolerance; rows closer to it are meaningless.
                integrator.trace.cut(failure.time - task.tolerance * span)
        fitting = smaller_sizes(problem, integrator.trace.states(at), settings.nominal, task.tolerance, span)
        if fitting is None:
            break
        settings, counts = replace(settings, nominal=fitting), integrator.trace
    return done


def _raise(done: _Done, result: Result) -> NoReturn:
    """Raise the exception that ended a run, with the result so far."""
    failure: Any = done.failure
    if isinstance(failure, Failure | Chattering):
        text = str(failure)
        if isinstance(failure, Failure):
            text = failure_text(done.integrator, done.at, done.begun.redundancy, failure)
        error = SimulationError(text, result.with_stats(stopped=text))
        error.begun = isinstance(failure, Chattering) or failure.time > done.at.time
        raise error from failure.__cause__
    failure.result = result.with_stats(stopped="interrupted")
    raise failure


def _breaks(instants: list[float], start: float, stop: float) -> list[float]:
    """Return the break times inside a run, without those that differ by round-off."""
    found, apart = list[float](), part_of_time(POLICY.agenda.apart, start, stop)
    for b in sorted(b for b in instants if start < b < stop):
        if b - (found or [start])[-1] > apart * abs(b) and stop - b > apart * abs(stop):
            found.append(b)
    return found


def _counted(done: _Done, plan: _Plan, task: Task, seconds: float) -> Statistics:
    integrator, trace, begun = done.integrator, done.integrator.trace, done.begun
    compiled, settings, way, trials = integrator.compiled, integrator.settings, integrator.way, list(trace.orders)
    p = integrator.problem.p
    steps = Counter[str]()
    for key, n in trace.methods.items():
        steps[METHODS[key].name] += n
    return Statistics(
        equations_flat=compiled.reduced.flat.counts["equations_flat"],
        equations_reduced=compiled.nx + compiled.nz,
        states=compiled.nx,
        algebraic=compiled.nz,
        compile_seconds=sum(compiled.seconds.values()) + trace.building,
        solve_seconds=seconds,
        integration_seconds=trace.seconds,
        steps=trace.steps,
        factorisations=trace.factorisations,
        residual_evaluations=trace.residual_evaluations,
        calls=trace.calls,
        choices=trace.choices,
        max_order=lambda: settings.order(way),
        order_reason=lambda: "; ".join([settings.limit[1], *trials]),
        tolerance=settings.tolerance,
        sizes=absolute_sizes(compiled, settings.nominal),
        method=" and ".join(steps) or "none",
        method_reason="; ".join([why_first(task.method, task.max_order), *trace.changes]),
        method_steps=dict(steps),
        damped=any(METHODS[name].damps for name in trace.methods),
        fastest_rate=lambda: settings.spectrum.fastest,
        constraints="none" if not integrator.loops else "projection" if way.moves else "states",
        loosened_at=trace.loosened,
        break_times=plan.breaks,
        events=len(done.course.events),
        event_times=done.course.events,
        loops=lambda: loops_at(compiled.reduced, begun.found(compiled)),
        redundant_in_parts=lambda: parts_at(compiled.reduced, begun.found(compiled)),
        independent_states=lambda: list(begun.independent_states),
        held_inputs=lambda: held_inputs(compiled.reduced.flat, p),
    )


def _result(done: _Done, plan: _Plan, stats: Statistics, energy: bool) -> Result:
    integrator = done.integrator
    compiled, times = integrator.compiled, plan.times
    rows = integrator.trace.rows(done.first)
    whole = np.array_equal(rows.times, times)
    output = rows if whole else rows[np.searchsorted(rows.times, times[times <= rows.times[-1]])]
    evaluate = Evaluator(output, integrator.consistent)
    found = validity_warnings(evaluate) + smoothness_warnings(integrator, evaluate)
    found += mobility_warnings(integrator.problem, done.begun.point, done.begun.redundancy.redundant)
    found += growth_warnings(integrator.problem, done.begun.point, float(plan.times[-1] - plan.times[0]))
    found += loop_drift(integrator.consistent, rows) + done.course.idle()
    stats = stats.changed(doubts=[*found, *_loosened(integrator)])
    if energy:
        stored = Evaluator(rows[[0, -1]], integrator.consistent)
        change = float(np.diff(stored(compiled.reduced.flat.energies["stored_energy"])[:, 0])[0])
        supplied, dissipated = integrator.trace.energy.tolist()
        stats = stats.changed(
            energy_supplied=supplied,
            energy_stored_change=change,
            energy_dissipated=dissipated,
            energy_method=supplied - change - dissipated,
        )
    return Result(output.times, evaluate, compiled.tree, compiled.outputs, stats, title=type(compiled.tree).__name__)


def _loosened(integrator: Integrator) -> list[str]:
    """Return a warning with the times at which a larger tolerance was needed."""
    times = integrator.trace.loosened
    if not times:
        return []
    shown = ", ".join(f"{t:.6g}" for t in times[:SHOWN]) + (", ..." if len(times) > SHOWN else "")
    return [
        f"step size underflow at the tolerance {integrator.tolerance:g} after t = {shown} s, as happens near a singular "
        "configuration; each time one output interval was integrated with a larger tolerance, so errors may be larger afterwards."
    ]
