"""effects(): changes and costs of each effect of a scene, and the cheapest set of effects within an accuracy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from acausal.compiler import checked_model, checked_values, compile
from acausal.errors import DeclarationError, SimulationError
from acausal.flatten.instantiate import Instantiation
from acausal.language.call_arguments import checked_arguments
from acausal.language.component import Component
from acausal.language.data import same
from acausal.policy import POLICY
from acausal.simulation.inputs import with_inputs
from acausal.simulation.settings_checks import check_choice
from acausal.study.effects.cheapest import cheapest, search
from acausal.study.effects.effect_rows import ALL, EffectRow, Interaction, interaction, row
from acausal.study.effects.effects_result import Effects
from acausal.study.effects.listing import Effect, fitting, fullest
from acausal.study.effects.variants import Choices, Variants
from acausal.study.measuring.case import Case, Job, Measurement
from acausal.study.measuring.journal import Journal, identity
from acausal.study.measuring.model_pickling import pack
from acausal.study.measuring.pool import executor_of
from acausal.study.measuring.session import Progress
from acausal.study.measuring.study_arguments import (
    check_counts,
    check_run,
    check_shares,
    outputs_of,
    stop_time_of,
)


@checked_arguments
def effects(
    model: Component,
    *,
    stop_time: float | None = None,
    accuracy: float = 1e-2,
    tolerance: float = POLICY.defaults.tolerance,
    intervals: int = POLICY.defaults.intervals,
    outputs: Sequence[str] | None = None,
    parameters: Mapping[str, Any] | None = None,
    inputs: Mapping[str, Any] | None = None,
    initial: str | None = None,
    method: str | None = None,
    repeats: int = 3,
    limit: float = 60.0,
    pairs: int = 15,
    workers: int | None = None,
    executor: Executor | str | None = None,
    journal: str | Path | None = None,
    progress: Progress | None = None,
) -> Effects:
    """Measure what each effect of a scene changes and costs, and find the cheapest set of effects within an accuracy.

    The reference is the fullest scene: every effect at its most complete choice. Each effect is switched alone, then in
    pairs with others that matter or save time. The cheapest set is built greedily from single effects, and each step is
    verified by a simulation.

    Parameters
    ----------
    model : Component
        A model, not compiled.
    stop_time : float, optional
        In s; that of the model if not given.
    accuracy : float
        Largest change of the outputs that the cheapest set may make, as a fraction of their ranges.
    tolerance, initial, method
        As in `simulate`.
    intervals : int
        Outputs are compared at intervals + 1 equidistant times.
    outputs : sequence of str, optional
        Paths, or patterns with * and ?, of the quantities to compare; the outputs of the model if not given.
    parameters : mapping of str to value, optional
        Values by path for all runs.
    inputs : mapping of str to data, optional
        As in `simulate`.
    repeats : int
        Runs whose median solve time counts.
    limit : float
        Seconds after which a run is stopped.
    pairs : int
        Largest number of pairs to try, those with the largest changes first.
    workers : int, optional
        Parallel processes; one per core if not given.
    executor : Executor or str, optional
        Where to run instead: an executor as in concurrent.futures, or the address of a Dask scheduler.
    journal : str or Path, optional
        File that records finished runs; an interrupted call continues from it, a complete one removes it.
    progress : callable, optional
        Called with the number of runs done, the number of runs known so far, and the current stage.

    Returns
    -------
    Effects
        Rows, interactions and cheapest sets, with tables.

    Raises
    ------
    DeclarationError
        If the model is wrong, has no effects, or no outputs to compare.
    SimulationError
        If neither the fullest scene nor the scene itself can be integrated.
    """
    model = checked_model(model)
    stop = stop_time_of(model, stop_time, checked_values(parameters))
    given = with_inputs(model, parameters, inputs, ends=(0.0, stop))
    check_run(intervals, repeats, limit)
    check_counts(0, pairs=pairs)
    check_shares(1e-2, accuracy=accuracy)
    check_shares(1e-6, tolerance=tolerance)
    check_choice("initial", initial)
    check_choice("method", method)
    if workers is not None:
        check_counts(workers=workers)
    names = outputs_of(compile(model, given), outputs or ())
    found, full = fullest(model, given)
    if not found:
        raise DeclarationError(
            f"{type(model).__name__} has no effects: none of its fields, and none of its parts', is an effect(...)."
        )
    case = Case(tolerance=tolerance, method=method)
    job = Job(pack(model), case, stop, intervals, names, repeats, limit, initial, type(model).__module__)
    trees = [Instantiation(model, fitting(model, {**given, **choices})).root for choices in ({}, full)]
    common = {"given": given, "stop_time": stop, "intervals": intervals, "outputs": names, "initial": initial}
    kept = Journal(journal, identity(model, trees, **common))
    with executor_of(executor, workers) as where:
        variants = Variants(model, given, job, where, kept, progress)
        result = _Study(variants, found, full, accuracy).result(pairs)
    kept.remove()
    return result


class _Study:
    """One study of effects, from the reference to the cheapest sets."""

    def __init__(self, variants: Variants, found: tuple[Effect, ...], full: Choices, accuracy: float) -> None:
        self.variants, self.effects, self.accuracy = variants, found, accuracy
        self.tolerance = variants.job.case.tolerance
        full_run, stands_run = variants.measure([full, {}], "reference")
        self.refused = full_run.error
        if full_run.error and stands_run.error:
            raise SimulationError(
                f"neither the fullest scene nor the scene as it stands can be simulated: {stands_run.error}"
            )
        self.base = full if not full_run.error else self._in_force(full)
        self.reference = stands_run if full_run.error else full_run
        self.origin = row({}, self.reference, self.reference)
        self.standing = row(self._difference({}), stands_run, self.reference)

    def result(self, pairs: int) -> Effects:
        """Measure single effects and pairs, and find the cheapest sets."""
        singles, idle = self._singles()
        rows = self._rows(singles, "effects")
        fine = self.variants.measure([self.base], "integration error", self.tolerance / POLICY.study.tighter)
        floor = row({}, fine[0], self.reference)
        together, left = self._pairs(rows, pairs)
        sets = self._cheapest(rows)
        return Effects(
            scene=type(self.variants.model).__name__,
            accuracy=self.accuracy,
            tolerance=self.tolerance,
            effects=self.effects,
            reference=self.origin,
            standing=self.standing,
            refused=self.refused,
            floor=floor,
            rows=tuple(sorted(rows, key=lambda r: (bool(r.error), -r.change(), r.seconds))),
            interactions=tuple(sorted(together, key=lambda i: -i.largest)),
            untried=left,
            idle=tuple(idle),
            cheapest=sets,
            choices={name: self._choices(best.choices, idle) for name, best in sets.items()},
        )

    def _in_force(self, paths: Choices) -> dict[str, Any]:
        """Return the scene's own choices of these effects."""
        return {effect.path: effect.value for effect in self.effects if effect.path in paths}

    def _difference(self, choices: Choices) -> dict[str, Any]:
        """Return the choices of a variant that differ from the reference, of effects that both have."""
        return {
            effect.path: value
            for effect in self.effects
            for value in [choices.get(effect.path, effect.value)]
            if effect.path in self.base and not same(value, self.base[effect.path])
        }

    def _singles(self) -> tuple[list[Choices], list[Choices]]:
        """Return single switches: those that change the equations, and those that leave them as they are."""
        wanted: list[Choices] = [
            {effect.path: choice}
            for effect in self.effects
            for choice in effect.tries
            if effect.path in self.base and not same(choice, self.base[effect.path])
        ]
        reference, *prints = self.variants.fingerprints([self.base, *[self._with(choices) for choices in wanted]])
        idle = [choices for choices, print_ in zip(wanted, prints, strict=True) if print_ == reference]
        return [choices for choices in wanted if choices not in idle], idle

    def _with(self, choices: Choices) -> dict[str, Any]:
        return {**self.base, **choices}

    def _measured(self, wanted: Sequence[Choices], what: str) -> list[Measurement]:
        return self.variants.measure([self._with(choices) for choices in wanted], what)

    def _rows(self, wanted: Sequence[Choices], what: str) -> list[EffectRow]:
        found = self._measured(wanted, what)
        return [row(choices, run, self.reference) for choices, run in zip(wanted, found, strict=True)]

    def _existing(self, choices: Choices) -> dict[str, Any]:
        there = self.variants.fitting(self._with(choices))
        return {path: value for path, value in choices.items() if path in there}

    def _pairs(self, rows: Sequence[EffectRow], most: int) -> tuple[list[Interaction], int]:
        """Measure pairs of effects that matter or save time; return interactions and the number of untried pairs."""
        counts = [
            r
            for r in rows
            if not r.error
            and r.change() < POLICY.study.other
            and (r.change() > POLICY.study.matters * self.accuracy or r.cheaper(self.origin))
        ]
        ways = [
            (a, b)
            for a, b in combinations(sorted(counts, key=lambda r: -r.change()), 2)
            if a.choices.keys() != b.choices.keys() and len(self._existing({**a.choices, **b.choices})) == 2
        ]
        ways.sort(key=lambda pair: -min(r.change() for r in pair))
        tried, left = ways[:most], max(0, len(ways) - most)
        both = self._measured([{**a.choices, **b.choices} for a, b in tried], "pairs")
        alone = [self._measured([a.choices, b.choices], "pairs") for a, b in tried]
        found = [
            interaction((a.choices, first), (b.choices, second), together, self.reference)
            for (a, b), (first, second), together in zip(tried, alone, both, strict=True)
            if not (_same(together, first) or _same(together, second))
        ]
        return found, left

    def _cheapest(self, rows: Sequence[EffectRow]) -> dict[str, EffectRow]:
        """Return the cheapest set for all outputs together, and for each alone."""
        names = list(self.reference.values)
        targets = {ALL: names} | ({name: [name] for name in names} if len(names) > 1 else {})
        return cheapest(
            {
                name: search(rows, self.origin, self.standing, outputs, self.accuracy, self._existing)
                for name, outputs in targets.items()
            },
            lambda wanted: self._rows(wanted, "cheapest sets"),
        )

    def _choices(self, choices: Choices, idle: Sequence[Choices]) -> dict[str, Any]:
        """Return all choices of a set by path, without idle effects at the scene's own choice."""
        there = self._existing(self._with(choices))
        silent = {path for one in idle for path in one if same(there.get(path), self._in_force(self.base)[path])}
        return {path: value for path, value in there.items() if path not in silent}


def _same(one: Measurement, other: Measurement) -> bool:
    """Return whether two variants give the same results: then one effect disables the other."""
    return one.operations == other.operations and all(
        np.array_equal(one.values[name], other.values[name]) for name in other.values if name in one.values
    )
