"""Statistics of a run: sizes, counts, seconds, and findings."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Generic, TypeVar

from acausal.locks import exclusive

Value = TypeVar("Value")


class Later(Generic[Value]):
    """A lazy field: it may be set to a function without arguments, which is called on first access.

    Parameters
    ----------
    default : any, or callable
        Default value.
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
    """Statistics of a run, read as `stats.steps` or `stats["steps"]`.

    A statistic that does not apply to the run is None as an attribute, and not among the keys.

    Parameters
    ----------
    equations_flat, equations_reduced, states, algebraic : int
        Scalar equations before and after the reduction, states and algebraic unknowns.
    steps, factorisations, residual_evaluations, calls, choices : int
        Counts of the integrators; `choices` counts how often the states of loops were chosen.
    operations : int
        Instructions of a step, or of the equations, if the method reports them.
    compile_seconds, solve_seconds, integration_seconds : float
        Seconds to compile the model and build its integrators; to initialise and integrate; inside the integrators. An
        initial point reused from the previous run counts with the seconds it took then.
    method, method_reason, method_steps, damped, max_order, order_reason, tolerance, fastest_rate, constraints
        Choices and their reasons: the methods with their steps, whether fast vibrations were damped numerically, the order
        limit, the tolerance, the magnitude of the fastest eigenvalue at the start in 1/s, and how loops stayed closed. The
        order limit and the eigenvalue are computed on first access.
    sizes : dict of str to float
        Smallest nominal value of the states of each unit: below it the tolerance is absolute.
    break_times, event_times, loosened_at : list of float
        Instants in s; `loosened_at` lists those that needed a larger tolerance.
    events : int
        Number of events.
    loops, redundant_in_parts, independent_states
        Redundant constraints of loops and of parts, and independent states, by ranks at the start; computed on first access.
    doubts : list of str
        Components used outside their range of validity.
    held_inputs : dict of str to float
        Inputs of the whole model that were constant, with their values; computed on first access.
    stopped : str
        Why the run ended before its stop time.
    energy_supplied, energy_stored_change, energy_dissipated, energy_method : float
        Energies in J, if requested; `energy_method` is the numerical dissipation.
    consistent_evaluations : int
        Evaluations of the equations for values read from the result.
    accuracy, accuracy_reached, error_estimate, error_output, error_tolerance, error_elements, error_estimates
        Requested accuracy and estimated errors, if an accuracy was requested.
    elements_kept, chosen, trials
        Numerics chosen and tried for the accuracy.
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
    held_inputs: Later[dict[str, float]] = Later(dict)
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
        """Return a statistic by name."""
        value = getattr(self, name) if name in self.__dict__ else None
        if value is None:
            raise KeyError(name)
        return value

    def changed(self, **values: Any) -> Statistics:
        """Return a copy with other values."""
        return Statistics(**{**vars(self), **values})

    def __getstate__(self) -> dict[str, Any]:
        return {f.name: getattr(self, f.name) for f in fields(self)}

    def __iter__(self) -> Iterator[str]:
        return (f.name for f in fields(self) if vars(self)[f.name] is not None)

    def __len__(self) -> int:
        return sum(1 for _ in self)
