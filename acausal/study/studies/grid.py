"""The grid of a study: all combinations of the varied quantities."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from acausal.errors import DeclarationError
from acausal.language.value_checks import shown
from acausal.simulation.settings_checks import CHOICES, CONSTRAINTS
from acausal.study.measuring.case import Case
from acausal.study.measuring.run_function import check_steps
from acausal.study.measuring.study_arguments import items
from acausal.study.studies.formulation import Formulation

EXAMPLES = {
    "formulations": "formulations_of(model)",
    "tolerances": "[1e-4, 1e-6]",
    "max_orders": "[2, 5]",
    "methods": '["idas", "rosenbrock"]',
    "constraints": '["states", "projection"]',
}
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)


@dataclass(frozen=True)
class Grid:
    """The varied quantities of a study.

    Parameters
    ----------
    formulations : sequence of Formulation
        Formulations, each with its sizes.
    tolerances : sequence of float
        Relative tolerances of a step.
    max_orders : sequence of int or None
        Limits of the order; None lets `simulate` choose.
    methods : sequence of str or None
        As in `simulate`; None is the model's own.
    constraints : sequence of str
        As in `simulate`.
    switches : mapping of str to sequence
        Other structural parameters and effects by path, with their values.
    dt : sequence of float, optional
        Steps in s that replace those of formulations with steps of their own.
    """

    formulations: Sequence[Formulation]
    tolerances: Sequence[float] = TOLERANCES
    max_orders: Sequence[int | None] = (None,)
    methods: Sequence[str | None] = (None,)
    constraints: Sequence[str] = ("auto",)
    switches: Mapping[str, Sequence[Any]] = field(default_factory=dict)
    dt: Sequence[float] | None = None

    def __post_init__(self) -> None:
        for name, example in EXAMPLES.items():
            if not items(name, getattr(self, name), example):
                raise DeclarationError(f"{name} is empty; give at least one.")
        for value in self.tolerances:
            if isinstance(value, bool) or not isinstance(value, int | float) or not 1e-12 <= value < 1:
                raise DeclarationError(f"tolerances has {value!r}; it must lie between 1e-12 and 1, for instance 1e-6.")
        if self.dt is not None:
            check_steps("dt", items("dt", self.dt, "[1e-3, 1e-4]"))
            if not len(self.dt) or not any(form.dt for form in self.formulations if isinstance(form, Formulation)):
                why = "no formulation has steps of its own" if len(self.dt) else "it is empty"
                raise DeclarationError(f"dt has no effect: {why}. Leave it out.")
        for value in self.max_orders:
            if value is not None and (isinstance(value, bool) or value not in range(1, 6)):
                raise DeclarationError(f"a limit of the order is {value!r}; it must be a whole number from 1 to 5.")
        for name, known in (("methods", CHOICES), ("constraints", CONSTRAINTS)):
            for value in getattr(self, name):
                if value not in (*known, None):
                    raise DeclarationError(f"{name} has {value!r}; it must be one of {', '.join(known)}.")
        for form in self.formulations:
            if not isinstance(form, Formulation):
                raise DeclarationError(
                    f"a formulation is {shown(form)}; choose from formulations_of(model), or give none."
                )
        names = [form.name for form in self.formulations]
        if len(set(names)) < len(names):
            raise DeclarationError(f"formulations need names of their own, not {', '.join(names)}.")
        for path, values in self.switches.items():
            example = "[True, False]" if isinstance(values, bool) else "[1, 2]"
            if not items(f'switches["{path}"]', values, example):
                raise DeclarationError(f"the switch `{path}` has no values; give the values to try.")

    def cases(self, given: Mapping[str, Any]) -> list[Case]:
        """Return all cases, those of one compiled model together.

        Parameters
        ----------
        given : mapping of str to value
            Common settings of all cases.
        """
        return [found for form, case in self._structures(given) for found in self._runs(form, case)]

    def structures(self, given: Mapping[str, Any]) -> list[Case]:
        """Return one case for each compiled model.

        Parameters
        ----------
        given : mapping of str to value
            Common settings of all cases.
        """
        return [case for _, case in self._structures(given)]

    def _structures(self, given: Mapping[str, Any]) -> Iterator[tuple[Formulation, Case]]:
        for form in self.formulations:
            for step, values in itertools.product(range(form.steps), itertools.product(*self.switches.values())):
                settings, size = form.at(step)
                switched = dict(zip(self.switches, values, strict=True))
                yield form, Case(form.name, {**given, **settings, **switched}, size, run=form.run)

    def _runs(self, form: Formulation, case: Case) -> Iterator[Case]:
        """Yield a case with all steps, or with all tolerances, methods, constraints and order limits."""
        tolerances = sorted(self.tolerances, reverse=True)
        if form.dt:
            yield from (replace(case, dt=float(dt)) for dt in sorted(self.dt or form.dt, reverse=True))
        elif form.run:
            yield from (replace(case, tolerance=tolerance) for tolerance in tolerances)
        else:
            for method, constraints, order in itertools.product(self.methods, self.constraints, self.max_orders):
                chosen = replace(case, method=method, constraints=constraints, max_order=order)
                yield from (replace(chosen, tolerance=tolerance) for tolerance in tolerances)
