"""Cache of runs of one model with several tolerances, methods and numbers of elements."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel, ready
from acausal.errors import DeclarationError, SimulationError
from acausal.flatten.component_tree import join, walk
from acausal.flatten.instantiate import Instantiation
from acausal.flatten.structural import largest
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.result import Result
from acausal.solve.run import Task, run

COUNTS = ("states", "steps", "factorisations", "residual_evaluations", "solve_seconds")


@dataclass(frozen=True)
class Numerics:
    """Numerics of a run: elements or volumes of each adaptive beam (0 if none is adaptive), tolerance, method, order limit."""

    number: int
    tolerance: float
    method: str
    max_order: int | None


class RunCache:
    """Runs of a model by their numerics, each computed once.

    Parameters
    ----------
    model : Component or CompiledModel
        The model; a compiled one must not contain adaptive parts.
    parameters : mapping of str to value or None
        As in `simulate`.
    task : Task
        The task; tolerance, method and order limit are replaced by the numerics.
    """

    def __init__(self, model: Component | CompiledModel, parameters: Mapping[str, Any] | None, task: Task) -> None:
        self.model, self.parameters, self.task = model, dict(parameters or {}), task
        fixed = isinstance(model, CompiledModel)
        tree = model.tree if fixed else Instantiation(model, self.parameters).root
        self.adaptive = adaptive(tree)
        self.keeps_elements = not self.adaptive and bool(adaptive(tree, whatever=True))
        if not any(isinstance(d, f.Variable) and d.causality == "output" for d in tree.fields.values()):
            raise DeclarationError(
                "the model has no output whose error could be estimated. Declare the quantity of interest: "
                'y: Scalar = output("..."), or give a tolerance instead of an accuracy.'
            )
        if fixed and self.adaptive:
            path = next(iter(self.adaptive))
            raise DeclarationError(
                f"accuracy chooses `{path}`, which is fixed in a compiled model. Give the model itself, "
                f'simulate(model, accuracy=...), or compile with parameters={{"{_beam(path)}.adaptive": False}}.'
            )
        self.greatest = max((most for _, most in self.adaptive.values()), default=float("inf"))
        self.compiled: dict[int, tuple[CompiledModel, np.ndarray]] = {}
        self.results: dict[Numerics, Result | SimulationError] = {}
        self.done: list[dict[str, Any]] = []
        self.building = 0.0  # seconds spent on building integrators

    def __call__(self, numerics: Numerics) -> Result | SimulationError:
        """Return the result of a run with these numerics, or the error by which it failed."""
        numerics = replace(numerics, number=int(min(numerics.number, self.greatest)))
        if numerics not in self.results:
            compiled, p = self._compile(numerics.number)
            how = {"tolerance": numerics.tolerance, "method": numerics.method, "max_order": numerics.max_order}
            try:
                found: Any = run(compiled, p, replace(self.task, **how))
            except SimulationError as failure:
                found = failure
            self.results[numerics] = found
            self._note(numerics, *((found, "") if isinstance(found, Result) else (found.result, found.text())))
        return self.results[numerics]

    def sizes(self, number: int) -> dict[str, int]:
        """Return numbers of elements or volumes by path."""
        return {path: int(min(max(number, least), most)) for path, (least, most) in self.adaptive.items()}

    def seconds(self) -> dict[str, float]:
        """Return the seconds spent on compiling and solving in all runs."""
        return {
            "compile_seconds": sum(sum(c.seconds.values()) for c, _ in self.compiled.values()) + self.building,
            "solve_seconds": sum(run["solve_seconds"] for run in self.done),
        }

    def _compile(self, number: int) -> tuple[CompiledModel, np.ndarray]:
        if number not in self.compiled:
            self.compiled[number] = ready(self.model, {**self.parameters, **self.sizes(number)})
        return self.compiled[number]

    def _note(self, numerics: Numerics, result: Any, failed: str) -> None:
        stats = result.stats
        self.building += stats.compile_seconds - sum(self.compiled[numerics.number][0].seconds.values())
        self.done.append(
            {
                "tolerance": numerics.tolerance,
                "max_order": stats.max_order,
                "method": stats.method,
                "sizes": self.sizes(numerics.number),
                **{name: stats[name] for name in COUNTS},
                "failed": failed,
            }
        )


def adaptive(tree: Component, whatever: bool = False) -> dict[str, tuple[int, float]]:
    """Return path and bounds of every number of elements that accuracy control may choose, or of all if `whatever`."""
    return {
        join(component._path, name): (int(declared.minimum or 1), _most(component, declared))
        for component in walk(tree)
        for name, declared in component.fields.items()
        if isinstance(declared, f.Structural)
        and declared.refine is not None
        and (whatever or declared.refine(component))
    }


def _most(component: Component, declared: f.Structural) -> float:
    found = largest(component, declared)
    return float("inf") if found is None else found


def _beam(path: str) -> str:
    return path.rpartition(".")[0]
