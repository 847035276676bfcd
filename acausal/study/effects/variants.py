"""Variants of a scene: some effects changed; compiled, compared and measured."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from concurrent.futures import Executor
from dataclasses import replace
from typing import Any

import casadi as ca

from acausal.compiler import compile
from acausal.errors import AcausalError
from acausal.language.component import Component
from acausal.result.lookup import find
from acausal.study.effects.listing import fitting
from acausal.study.measuring.case import Case, Job, Measurement
from acausal.study.measuring.journal import Journal
from acausal.study.measuring.model_pickling import unpack
from acausal.study.measuring.session import Progress, Session

Choices = Mapping[str, Any]


def fingerprint(job: Job) -> str:
    """Return a hash of the equations and outputs of a scene; "" if it cannot be compiled.

    Parameters
    ----------
    job : Job
        The job of the variant.
    """
    try:
        compiled = compile(unpack(job.model), parameters=job.values)
        shown = ca.vertcat(*[find(compiled.tree, name).column for name in job.outputs])
        outputs = ca.Function("outputs", compiled.arguments, [compiled.reduced.resolve(ca.densify(shown))])
    except AcausalError:
        return ""
    functions = (compiled.local.function, outputs, compiled.start.function, compiled.guards.breaks.function)
    return hashlib.sha256("".join(f.serialize() for f in functions).encode()).hexdigest()


class Variants:
    """Measures variants of a scene, each once.

    Parameters
    ----------
    model : Component
        The scene.
    settings : mapping of str to value
        Values that hold in all variants, unless a choice replaces them.
    job : Job
        Template of the jobs; its case gives everything except the settings.
    executor : Executor
        Executor of the runs.
    journal : Journal
        Holds the finished runs.
    progress : callable, optional
        Called with the number of runs done, the number of runs known so far, and the current stage.
    """

    def __init__(
        self,
        model: Component,
        settings: Choices,
        job: Job,
        executor: Executor,
        journal: Journal,
        progress: Progress | None = None,
    ) -> None:
        self.model, self.settings, self.job, self.executor = model, settings, job, executor
        self.session = Session(job, executor, journal, progress)

    def fitting(self, choices: Choices) -> dict[str, Any]:
        """Return the compatible settings of a variant."""
        return fitting(self.model, {**self.settings, **choices})

    def fingerprints(self, wanted: Iterable[Choices]) -> list[str]:
        """Return the fingerprint of each variant."""
        return list(self.executor.map(fingerprint, [self.job.of(self._case(choices)) for choices in wanted]))

    def measure(self, wanted: Iterable[Choices], what: str, tolerance: float | None = None) -> list[Measurement]:
        """Measure variants.

        Parameters
        ----------
        wanted : iterable of mapping
            Choices by path.
        what : str
            The current stage, for the progress.
        tolerance : float, optional
            A tolerance that replaces that of the job.
        """
        cases = [self._case(choices) for choices in wanted]
        if tolerance is not None:
            cases = [replace(case, tolerance=tolerance) for case in cases]
        return self.session.measure(cases, what)

    def _case(self, choices: Choices) -> Case:
        return replace(self.job.case, settings=self.fitting(choices))
