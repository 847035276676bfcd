"""Sizes, counts and seconds of a run."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Generic, TypeVar

from acausal.locks import exclusive

Value = TypeVar("Value")


class Later(Generic[Value]):
    """A field that may be given as a function without arguments, which is called when it is first read.

    Parameters
    ----------
    default : any, or callable
        Its value where none is given.
    """

    def __init__(self, default: Value | Callable[[], Value]) -> None:
        self._default: Any = default

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, instance: object, owner: type) -> Value:
        if instance is None:
            return self._default
        values: dict[str, Any] = vars(instance)
        if callable(later := values[self._name]):
            values[self._name] = exclusive(later)()
        return values[self._name]

    def __set__(self, instance: object, value: Value | Callable[[], Value]) -> None:
        vars(instance)[self._name] = value


@dataclass(frozen=True)
class Statistics(Mapping[str, Any]):
    """What a run took and found: `stats.steps`, or `stats["steps"]`.

    What does not apply to a run is None as an attribute, and no key.

    Parameters
    ----------
    equations_flat, equations_reduced, states, algebraic : int
        Scalar equations before and after the reduction, states and algebraic unknowns.
    steps, factorisations, residual_evaluations, calls, choices : int
        Of the integrators; `choices` counts how often states of loops were chosen.
    operations : int
        Instructions of a step, or of the equations, where the method of the run tells.
    compile_seconds, solve_seconds, integration_seconds : float
        Seconds; the first are those of the model and of the integrators that the run made, the last those inside them. Where
        the run before began in the same way, its beginning is taken, and its seconds count again.
    method, method_reason, method_steps, damped, max_order, order_reason, tolerance, fastest_rate, constraints
        What was chosen and why: the methods with their steps, whether vibrations that positions do not show were damped, the
        order limit, the tolerance, the size of the fastest eigenvalue at the start in 1/s, and how loops stayed closed. The
        order limit and that size are found when they are first read.
    sizes : dict of str to float
        Least size of the states of each unit: below it the tolerance is absolute.
    break_times, event_times, loosened_at : list of float
        Instants in s, the last where a larger tolerance was needed.
    events : int
        Number of events.
    loops, redundant_in_parts, independent_states
        What the ranks of loops, and of constraints that parts state, showed at the start; found when they are first read.
    doubts : list of str
        What was used outside its range.
    stopped : str
        Why the run ended before its stop time.
    energy_supplied, energy_stored_change, energy_dissipated, energy_method : float
        In J, if requested; the last is what the method itself lost.
    consistent_evaluations : int
        Evaluations of the equations for values that were read.
    accuracy, accuracy_reached, error_estimate, error_output, error_tolerance, error_elements, error_estimates
        What was requested and estimated, if an accuracy was.
    elements_kept, chosen, trials
        What was chosen and tried for it.
    """

    equations_flat: int = 0
    equations_reduced: int = 0
    states: int = 0
    algebraic: int = 0
    compile_seconds: float = 0.0
    solve_seconds: float = 0.0
    integration_seconds: float = 0.0
    steps: int = 0
    factorisations: int = 0
    residual_evaluations: int = 0
    calls: int = 0
    choices: int = 0
    consistent_evaluations: int = 0
    max_order: Later[int] = Later(0)
    order_reason: Later[str] = Later("")
    tolerance: float = 0.0
    sizes: dict[str, float] = field(default_factory=dict)
    method: str = ""
    method_reason: str = ""
    method_steps: dict[str, int] = field(default_factory=dict)
    damped: bool = False
    fastest_rate: Later[float] = Later(0.0)
    constraints: str = "none"
    loosened_at: list[float] = field(default_factory=list)
    break_times: list[float] = field(default_factory=list)
    events: int = 0
    event_times: list[float] = field(default_factory=list)
    loops: Later[list[dict[str, Any]]] = Later(list)
    redundant_in_parts: Later[list[dict[str, Any]]] = Later(list)
    independent_states: Later[list[str]] = Later(list)
    doubts: list[str] = field(default_factory=list)
    operations: int | None = None
    stopped: str | None = None
    energy_supplied: float | None = None
    energy_stored_change: float | None = None
    energy_dissipated: float | None = None
    energy_method: float | None = None
    accuracy: float | None = None
    accuracy_reached: bool | None = None
    error_estimate: float | None = None
    error_output: str | None = None
    error_tolerance: float | None = None
    error_elements: float | None = None
    error_estimates: dict[str, float] | None = None
    elements_kept: bool | None = None
    chosen: dict[str, Any] | None = None
    trials: list[dict[str, Any]] | None = None

    def __getitem__(self, name: str) -> Any:
        """Return what goes by a name."""
        value = getattr(self, name) if name in self.__dict__ else None
        if value is None:
            raise KeyError(name)
        return value

    def changed(self, **values: Any) -> Statistics:
        """Return the same with other values."""
        return Statistics(**{**vars(self), **values})

    def __getstate__(self) -> dict[str, Any]:
        return {f.name: getattr(self, f.name) for f in fields(self)}

    def __iter__(self) -> Iterator[str]:
        return (f.name for f in fields(self) if vars(self)[f.name] is not None)

    def __len__(self) -> int:
        return sum(1 for _ in self)
