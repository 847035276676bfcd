"""simulate(): from a model to a Result."""

from __future__ import annotations

import time as clock
from collections.abc import Mapping
from typing import Any, NoReturn

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel, compile
from acausal.compiler.call import Call
from acausal.errors import DeclarationError, SimulationError
from acausal.language.component import Component
from acausal.language.functions import initial as initial_flag
from acausal.language.functions import time as time_symbol
from acausal.result import Result
from acausal.solve.events import Chattering, Run
from acausal.solve.instant import Point, go_on, start
from acausal.solve.integrate import Failure, Integrator, Progress, Settings, Trace
from acausal.solve.order import eigenvalues_of, order_limit

METHODS = ("auto", "idas", "rosenbrock", "resolve")
CONSTRAINTS = ("auto", "states", "projection")


def simulate(
    model: Component | CompiledModel,
    *,
    stop_time: float,
    start_time: float = 0.0,
    tolerance: float = 1e-6,
    intervals: int = 400,
    parameters: Mapping[str, Any] | None = None,
    initial: str = "fixed",
    method: str | None = None,
    constraints: str = "auto",
    max_order: int | None = None,
    energy: bool = False,
    progress: Progress | None = None,
) -> Result:
    """Simulate a model.

    Parameters
    ----------
    model : Component or CompiledModel
        A model is compiled first, with the given parameters; a compiled one only takes new values.
    stop_time, start_time : float
        In s.
    tolerance : float
        Relative tolerance of a step; absolute tolerance = tolerance * nominal value. The error of a result is typically
        100 to 1000 times larger where bodies oscillate.
    intervals : int
        The result has intervals + 1 equidistant points.
    parameters : mapping of str to value, optional
        Values by path, such as {"beam.E": 7e10}.
    initial : "fixed", "guesses" or "steady"
        Whether states without a condition at the start are refused, take their guesses, or take values at which all
        derivatives vanish.
    method : "auto", "idas", "rosenbrock" or "resolve"
        "idas" is a multistep method whose error test sees every velocity; "resolve" is another name for it, and follows
        every vibration. "rosenbrock" is a one-step method that damps vibrations too small to be seen in positions. "auto"
        begins with the first, and takes the other where vibrations faster than the outputs take more steps than the
        motion. Default: that of the model, or "auto".
    constraints : "auto", "states" or "projection"
        How closed loops stay closed: "states" lets some coordinates follow from the others, chosen by pivots at the start
        and again where the pivots fall; "projection" integrates all of them and projects. "auto" begins with states, and
        projects if they do not last.
    max_order : int, optional
        Limit of the order of the multistep method, 1 to 5; chosen from the problem where it is not given.
    energy : bool
        Integrate the supplied and the dissipated power as well.
    progress : callable, optional
        Called now and then in long runs with the fraction that is done and the number of steps.

    Returns
    -------
    Result
        Read any variable by its path.

    Raises
    ------
    InitializationError
        If no consistent initial values exist or are found.
    SimulationError
        If the integration fails; its `result` holds what was computed.
    """
    tree = model.tree if isinstance(model, CompiledModel) else model
    method = str(method or getattr(tree, "method", "auto"))
    _check(start_time, stop_time, tolerance, intervals, max_order)
    _choose("method", method, METHODS)
    _choose("constraints", constraints, CONSTRAINTS)
    if isinstance(model, CompiledModel):
        compiled, p = model, model.parameter_values(parameters)
    else:
        compiled = compile(model, parameters)
        p = compiled.parameter_values(None)
    built = compiled.seconds.get("integrators", 0.0)
    started = clock.perf_counter()
    times = start_time + (stop_time - start_time) * np.linspace(0.0, 1.0, intervals + 1)
    times[-1] = stop_time
    breaks = _breaks(compiled, p, start_time, stop_time)
    at = start(compiled, p, start_time, _middle(start_time, breaks, stop_time), initial)
    first, at = at, go_on(compiled, p, at)
    rates = eigenvalues_of(compiled, at.x, at.z, p, start_time, at.modes)
    max_order = max_order or order_limit(rates, stop_time - start_time)
    fastest = float(np.max(np.abs(rates), initial=0.0))
    settings = Settings(tolerance, max_order, energy, progress, constraints, method, fastest)
    integrator = Integrator(compiled, p, settings, (start_time, stop_time))
    run = Run(integrator, times, breaks)
    failure: BaseException | None = None
    try:
        run.go(at)
    except (Failure, Chattering, KeyboardInterrupt) as caught:
        failure = caught
    waited = compiled.seconds.get("integrators", 0.0) - built
    stats = _stats(compiled, integrator, tolerance, max_order, breaks)
    stats |= {"events": len(run.events), "event_times": run.events}
    stats["solve_seconds"] = clock.perf_counter() - started - waited
    result = _result(compiled, integrator.trace, p, (run.first or at) if at is first else first, times, stats, energy)
    if failure is not None:
        _raise(failure, result, integrator, p)
    return result


def _raise(failure: BaseException, result: Result, integrator: Integrator, p: np.ndarray) -> NoReturn:
    """Raise what ended a run, with what was computed."""
    if isinstance(failure, Failure):
        raise SimulationError(_failure_text(integrator.compiled, integrator, p, failure), result)
    if isinstance(failure, Chattering):
        raise SimulationError(str(failure), result)
    failure.result = result  # type: ignore[attr-defined]
    raise failure


def _choose(name: str, value: str, choices: tuple[str, ...]) -> None:
    if value not in choices:
        raise DeclarationError(f"{name} is {value!r}; it must be one of {', '.join(choices)}.")


def _check(start: float, stop: float, tolerance: float, intervals: int, order: int | None) -> None:
    for name, value in (("start_time", start), ("stop_time", stop), ("tolerance", tolerance)):
        if isinstance(value, bool) or not isinstance(value, int | float | np.number):
            raise DeclarationError(f"{name} is {value!r}; it must be a number.")
    if not np.isfinite(start) or not np.isfinite(stop) or stop <= start:
        raise DeclarationError(f"stop_time is {stop:g} s; it must come after start_time = {start:g} s.")
    if not 0 < tolerance < 1:
        raise DeclarationError(f"tolerance is {tolerance:g}; it must lie between 0 and 1, for instance 1e-6.")
    if isinstance(intervals, bool) or not isinstance(intervals, int | np.integer) or intervals < 1:
        raise DeclarationError(f"intervals is {intervals!r}; it must be a whole number of at least 1.")
    if order is not None and order not in range(1, 6):
        raise DeclarationError(f"max_order is {order!r}; it must be a whole number from 1 to 5.")


def _breaks(compiled: CompiledModel, p: np.ndarray, start: float, stop: float) -> list[float]:
    inside = compiled.breaks(p)[0]
    return sorted({float(b) for b in inside if start < b < stop})


def _middle(start: float, breaks: list[float], stop: float) -> float:
    return (start + (breaks[0] if breaks else stop)) / 2


def _stats(
    compiled: CompiledModel, run: Integrator, tolerance: float, max_order: int, breaks: list[float]
) -> dict[str, Any]:
    report, trace = compiled.report, run.trace
    return {
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
        "max_order": max_order,
        "tolerance": tolerance,
        "method": " and ".join(trace.methods) or "none",
        "constraints": "none" if not compiled.closing.size else "projection" if run.moves else "states",
        "choices": trace.choices,
        "loosened_at": trace.loosened,
        "break_times": breaks,
    }


def _result(
    compiled: CompiledModel,
    trace: Trace,
    p: np.ndarray,
    first: Point,
    times: np.ndarray,
    stats: dict[str, Any],
    energy: bool,
) -> Result:
    t = np.concatenate([[first.time], *trace.times])
    x = np.vstack([first.x[None], *trace.x])
    z = np.vstack([first.z[None], *trace.z])
    modes = np.vstack([first.modes[None], *trace.modes])
    rows = np.searchsorted(t, times[times <= t[-1]])
    evaluate = Evaluator(compiled, t[rows], x[rows], z[rows], modes[rows], p)
    if energy:
        stored = Evaluator(compiled, t[[0, -1]], x[[0, -1]], z[[0, -1]], modes[[0, -1]], p)
        held = stored(compiled.reduced.flat.energies["stored_energy"])[:, 0]
        supplied, dissipated = trace.energy[-1][-1] if trace.energy else (0.0, 0.0)
        change = held[1] - held[0]
        stats |= {
            "energy_supplied": float(supplied),
            "energy_stored_change": float(change),
            "energy_dissipated": float(dissipated),
            "energy_method": float(supplied - change - dissipated),
        }
    return Result(t[rows], evaluate, compiled.tree, compiled.outputs, stats, title=type(compiled.tree).__name__)


class Evaluator:
    """Values of expressions of the model along a run."""

    def __init__(
        self, compiled: CompiledModel, t: np.ndarray, x: np.ndarray, z: np.ndarray, modes: np.ndarray, p: np.ndarray
    ) -> None:
        self.compiled = compiled
        self.columns = [x.T, z.T, p, t[None], modes.T]

    def __call__(self, expression: ca.SX) -> np.ndarray:
        """Return one row for each time, one column for each entry of a column of expressions."""
        c = self.compiled
        resolved = ca.substitute(c.reduced.resolve(ca.densify(expression)), initial_flag.sx, 0)
        arguments = [c.reduced.x, c.reduced.z, c.reduced.flat.parameters, time_symbol.sx, c.reduced.modes]
        n = self.columns[3].shape[1]
        function = ca.Function("observe", arguments, [resolved]).map(n)
        x, z, p, t, modes = self.columns
        call = Call(function)
        values = [x.flatten("F"), z.flatten("F"), np.tile(p, n), t[0], modes.flatten("F")]
        return call(*values)[0].reshape(n, -1).copy()


def _failure_text(compiled: CompiledModel, run: Integrator, p: np.ndarray, failure: Failure) -> str:
    trace = run.trace
    lines = [f"the integration stopped at t = {failure.time:.6g} s after {trace.steps} steps: {failure.reason}."]
    if trace.x:
        x, z, modes = trace.x[-1][-1], trace.z[-1][-1], trace.modes[-1][-1]
        at = float(trace.times[-1][-1])
        rates = compiled.values(x, z, p, at, modes, 0.0)[0][: compiled.nx] / compiled.nominal[: compiled.nx]
        fastest = np.argsort(-np.abs(np.nan_to_num(rates, nan=np.inf)))[:3]
        names = ", ".join(f"`{compiled.states[k]}`" for k in fastest)
        lines.append(f"Until t = {at:.6g} s all is well; what changes fastest there: {names}.")
    lines.append(
        "A motion that grows without bound, a force that becomes infinite, or a jump that no break time declares "
        "stops an integrator. What was computed is kept."
    )
    return "\n".join(lines)
