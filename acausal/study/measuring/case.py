"""A case of a study, its job for a worker, and its measurement."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import Any

import numpy as np

from acausal.language.data import plain
from acausal.policy import POLICY
from acausal.study.measuring.model_pickling import pack, unpack
from acausal.study.measuring.run_function import identity_of


@dataclass(frozen=True, eq=False)
class Case:
    """One way to compute a model.

    Parameters
    ----------
    formulation : str
        Name of the formulation, for tables.
    settings : mapping of str to value
        Structural parameters, effects and parameters by path, as in `compile`.
    size : str
        Numbers of elements, for tables: "3 + 8".
    tolerance : float
        Relative tolerance of a step.
    max_order : int or None
        Limit of the order; None lets `simulate` choose.
    method : str or None
        As in `simulate`; None is the model's own.
    constraints : str
        As in `simulate`.
    dt : float or None
        Step in s of the formulation's own integrator, if it is refined by its step instead of the tolerance.
    run : callable or None
        The formulation's own integrator.
    """

    formulation: str = "as given"
    settings: Mapping[str, Any] = field(default_factory=dict)
    size: str = ""
    tolerance: float = POLICY.defaults.tolerance
    max_order: int | None = None
    method: str | None = None
    constraints: str = "auto"
    dt: float | None = None
    run: Callable[..., Any] | None = None

    @cached_property
    def structure(self) -> str:
        """Text that identifies the compiled model of the case, the same in every session."""
        return json.dumps(plain(self.settings), sort_keys=True)

    @cached_property
    def key(self) -> str:
        """Hash of the whole case, the same in every session."""
        known = {f.name: getattr(self, f.name) for f in fields(self)} | {"run": identity_of(self.run)}
        return hashlib.sha256(json.dumps(plain(known), sort_keys=True).encode()).hexdigest()

    @property
    def control(self) -> float:
        """The refined quantity: the step in s, or the tolerance."""
        return self.tolerance if self.dt is None else self.dt

    @property
    def fineness(self) -> str:
        """The refined quantity as text, "dt 1e-04 s" or "1e-04"."""
        return f"{self.tolerance:.0e}" if self.dt is None else f"dt {self.dt:.3g} s"

    def refined(self, control: float) -> Case:
        """Return the case with another step, or another tolerance."""
        return replace(self, tolerance=control) if self.dt is None else replace(self, dt=control)

    def without_data(self) -> Case:
        """Return an equal case without settings and run, which are sent separately."""
        found = replace(self, settings={}, run=None)
        vars(found).update(key=self.key, structure=self.structure)
        return found

    def __str__(self) -> str:
        words = [self.formulation, self.size, "tolerance " * (self.dt is None) + self.fineness]
        words += [f"order {self.max_order}" if self.max_order else "", self.method or ""]
        words += [self.constraints if self.constraints != "auto" else ""]
        return ", ".join(filter(None, words))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Case) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)


@dataclass(frozen=True)
class Job:
    """The input of a worker: a model, a case and how to run it.

    Parameters
    ----------
    model : bytes
        From `pack`.
    case : Case
        The case.
    stop_time : float
        In s.
    intervals : int
        The run has intervals + 1 points.
    outputs : tuple of str
        Paths of the quantities to compare; the model's outputs if empty.
    repeats : int
        Number of runs whose median counts; short runs are repeated more often, unless it is 1.
    limit : float
        Seconds after which a run is stopped.
    initial : str, optional
        As in `simulate`.
    home : str
        Module of the class of the model.
    settings : bytes
        Settings of the case, from `pack`, so that they share classes of the user's file with the model; empty if the case
        itself holds them.
    run : bytes
        The formulation's own integrator, from `pack`; empty if there is none.
    """

    model: bytes
    case: Case
    stop_time: float
    intervals: int = POLICY.defaults.intervals
    outputs: tuple[str, ...] = ()
    repeats: int = 1
    limit: float = 60.0
    initial: str | None = None
    home: str = ""
    settings: bytes = b""
    run: bytes = b""

    def of(self, case: Case) -> Job:
        """Return the job of another case, ready to be sent."""
        run = pack(case.run, self.home) if case.run else b""
        return replace(self, case=case.without_data(), settings=pack(dict(case.settings), self.home), run=run)

    @property
    def values(self) -> Mapping[str, Any]:
        """Values by path, as in `compile`."""
        return unpack(self.settings) if self.settings else self.case.settings


@dataclass(frozen=True)
class Measurement:
    """The result of a case.

    Parameters
    ----------
    case : Case
        The case.
    times : array, shape (times,)
        In s; empty if the case failed.
    values : mapping of str to array, shape (times,)
        Scalars by name; arrays entry by entry.
    compile_seconds : float
        Seconds from the model to the first ready integrator.
    solve_seconds : float
        Median of the repeats: initialisation, choice of the order and integration, without the processor time of other
        processes.
    steps, factorisations, residual_evaluations : int
        Counts of one run.
    equations : int
        States and algebraic unknowns of the integrated system.
    operations : int
        Instructions of the equations and their Jacobian.
    max_order : int
        The limit of the order.
    method, constraints : str
        The method, and how loops stayed closed.
    error : str
        Why the case failed; "" if it succeeded.
    """

    case: Case
    times: np.ndarray = field(default_factory=lambda: np.empty(0))
    values: Mapping[str, np.ndarray] = field(default_factory=dict)
    compile_seconds: float = 0.0
    solve_seconds: float = 0.0
    steps: int = 0
    factorisations: int = 0
    residual_evaluations: int = 0
    equations: int = 0
    operations: int = 0
    max_order: int = 0
    method: str = ""
    constraints: str = ""
    error: str = ""
