"""Rows of a study of effects: changes and costs of switched effects."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from acausal.policy import POLICY
from acausal.simulation.estimate import scale
from acausal.study.measuring.case import Measurement
from acausal.study.measuring.deviation import deviations

# Name of the target of a cheapest set that covers all outputs.
ALL = "all outputs"


@dataclass(frozen=True)
class EffectRow:
    """Changes and costs of a variant relative to the reference.

    Parameters
    ----------
    choices : mapping of str to value
        Switched effects; empty for the reference.
    largest, rms : mapping of str to float
        Largest and root mean square change of each output, as a fraction of its range.
    seconds : float
        Median solve time.
    time, work : float
        Ratios of solve times and of operations.
    operations, equations, equations_less, steps : int
        Instructions of equations and Jacobian; size of the integrated system, and its reduction; number of steps.
    error : str
        Why the variant failed, "" if it succeeded.
    """

    choices: Mapping[str, Any]
    largest: Mapping[str, float] = field(default_factory=dict)
    rms: Mapping[str, float] = field(default_factory=dict)
    seconds: float = 0.0
    time: float = 1.0
    work: float = 1.0
    operations: int = 0
    equations: int = 0
    equations_less: int = 0
    steps: int = 0
    error: str = ""

    @property
    def name(self) -> str:
        """The switched effects, such as "crank=rigid, rod_bar.weight=False"."""
        return ", ".join(f"{path}={value}" for path, value in self.choices.items())

    def change(self, outputs: Iterable[str] | None = None) -> float:
        """Return the largest change of the given outputs, or of all."""
        return max((self.largest[name] for name in (self.largest if outputs is None else outputs)), default=0.0)

    @property
    def worst(self) -> str:
        """The output with the largest change."""
        return max(self.largest, key=lambda name: self.largest[name])

    def cheaper(self, other: EffectRow) -> bool:
        """Return whether the variant takes less time; within the noise, fewer operations, then fewer steps decide."""
        if not as_fast(self, other):
            return self.seconds < other.seconds
        return (self.operations, self.steps) < (other.operations, other.steps)


def as_fast(one: EffectRow, other: EffectRow) -> bool:
    """Return whether the times of two variants agree within the noise."""
    return abs(one.seconds - other.seconds) <= POLICY.study.noise * other.seconds


@dataclass(frozen=True)
class Interaction:
    """Interaction of two effects: the change by both minus the sum of the single changes, as a fraction of the range."""

    first: Mapping[str, Any]
    second: Mapping[str, Any]
    size: Mapping[str, float]
    error: str = ""

    @property
    def largest(self) -> float:
        """The largest interaction of all outputs."""
        return max(self.size.values(), default=0.0)


def row(choices: Mapping[str, Any], found: Measurement, reference: Measurement) -> EffectRow:
    """Compare a variant with the reference.

    Parameters
    ----------
    choices : mapping of str to value
        Switched effects.
    found, reference : Measurement
        Measurements of the variant and of the reference.
    """
    if found.error:
        return EffectRow(dict(choices), error=found.error)
    changes = deviations(found.values, reference.values)
    return EffectRow(
        dict(choices),
        {name: largest for name, (largest, _) in changes.items()},
        {name: rms for name, (_, rms) in changes.items()},
        found.solve_seconds,
        found.solve_seconds / reference.solve_seconds,
        found.operations / reference.operations,
        found.operations,
        found.equations,
        reference.equations - found.equations,
        found.steps,
    )


def interaction(
    first: tuple[Mapping[str, Any], Measurement],
    second: tuple[Mapping[str, Any], Measurement],
    both: Measurement,
    reference: Measurement,
) -> Interaction:
    """Compare the change of both effects with the sum of the changes of each.

    Parameters
    ----------
    first, second : (mapping of str to value, Measurement)
        Switched effects, and their measurement alone.
    both, reference : Measurement
        Measurements of both together, and of the reference.
    """
    if both.error:
        return Interaction(first[0], second[0], {}, both.error)
    size = {}
    for name, exact in reference.values.items():
        alone = first[1].values[name] + second[1].values[name] - exact
        size[name] = float(np.max(np.abs(both.values[name] - alone)) / scale(exact))
    return Interaction(first[0], second[0], size)
