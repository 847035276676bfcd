"""Formulations: ways to discretise and integrate a model."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from acausal.errors import DeclarationError
from acausal.flatten.component_tree import join, members, walk
from acausal.flatten.instantiate import Instantiation
from acausal.flatten.structural import largest
from acausal.language import fields as f
from acausal.language.call_arguments import declaration_error
from acausal.language.component import Component
from acausal.language.data import same
from acausal.result import Result
from acausal.study.measuring.run_function import check_function, check_steps

# Default numbers of elements to try, as multiples of the model's own.
MULTIPLES = (1, 2, 4)


@dataclass(frozen=True)
class Formulation:
    """One way to compute a model: settings, numbers of elements to refine, and optionally an integrator of its own.

    Parameters
    ----------
    name : str
        Name in tables and pictures.
    settings : mapping of str to value
        Structural parameters, effects or parameters by path that select the formulation.
    refine : mapping of str to sequence of int
        Numbers of elements by path, from coarse to fine; several paths advance together.
    most : mapping of str to int
        Upper limits of these numbers, such as the number of modes of a body; a study determines them.
    exact : bool
        True if the formulation converges to the geometrically exact solution: a reference is made from it.
    run : callable, optional
        Integrator in place of `simulate`: run(model, stop_time, times, tolerance=...) returns a Result at these times, as
        from `result_of`. `model` is compiled with the settings; `times` are equidistant from 0 to `stop_time`, in s. The
        function is sent to the workers like the model. It may raise errors of acausal; their first line becomes the remark
        of the row. If it takes `progress=`, it gets a function to call with the fraction done and the number of steps, which
        ends runs that exceed the time limit.
    dt : sequence of float
        Steps in s to try instead of the tolerances: run(model, stop_time, times, dt=...).

    Examples
    --------
    >>> Formulation("volumes", {"formulation": "substructured"}, {"volumes": (5, 10, 20)}, exact=True)  # doctest: +SKIP

    A solver of one's own for der(charge) == -rate * charge, whose outputs lie at ends of steps; `result_of` computes all other
    variables from the states:

    >>> def euler(model, stop_time, times, dt):
    ...     steps = round(times[1] / dt)
    ...     charge = (1 - model.value("rate") * dt) ** (steps * np.arange(len(times)))
    ...     return ac.result_of(times, {"charge": charge}, model=model, steps=steps * (len(times) - 1))
    >>> Formulation("Euler", run=euler, dt=(1e-3, 1e-4))  # doctest: +SKIP
    """

    name: str
    settings: Mapping[str, Any] = field(default_factory=dict)
    refine: Mapping[str, Sequence[int]] = field(default_factory=dict)
    exact: bool = False
    most: Mapping[str, int] = field(default_factory=dict)
    run: Callable[..., Result] | None = None
    dt: Sequence[float] = ()

    def __post_init__(self) -> None:
        lengths = {len(sizes) for sizes in self.refine.values()}
        if len(lengths) > 1 or 0 in lengths:
            raise DeclarationError(
                f"formulation `{self.name}`: sizes advance together, so all paths of refine need equally many."
            )
        check_steps(f"formulation `{self.name}`: dt", self.dt)
        object.__setattr__(self, "dt", tuple(self.dt))
        if self.run is None and len(self.dt):
            raise DeclarationError(
                f"formulation `{self.name}`: dt needs an integrator of its own, run=...; `simulate` chooses its steps by the "
                "tolerance."
            )
        if self.run is not None:
            check_function(self.name, self.run, "dt" if len(self.dt) else "tolerance")

    @property
    def steps(self) -> int:
        """Number of sizes, without repetitions of the largest."""
        count = len(next(iter(self.refine.values()), (0,)))
        while count > 1 and self.most and self._sizes(count - 1) == self._sizes(count - 2):
            count -= 1
        return count

    def at(self, step: int) -> tuple[dict[str, Any], str]:
        """Return settings and label of a size; beyond the last one, sizes double up to their limits.

        Parameters
        ----------
        step : int
            0 is the coarsest.
        """
        sizes = self._sizes(step)
        return {**self.settings, **sizes}, " + ".join(map(str, dict.fromkeys(sizes.values())))

    def _sizes(self, step: int) -> dict[str, int]:
        return {
            path: min(n[min(step, len(n) - 1)] * 2 ** max(0, step + 1 - len(n)), self.most.get(path, sys.maxsize))
            for path, n in self.refine.items()
        }


def with_and_without(*formulations: Formulation, **switches: str) -> tuple[Formulation, ...]:
    """Return each formulation with each switch off and on; with it on, the formulation is named "name, word".

    Parameters
    ----------
    *formulations : Formulation
        Formulations that have the switches.
    **switches : str
        Path of each switch, by the word for the name: stiffened="beam.geometric_stiffness".
    """
    for form in formulations or (None,):
        if not isinstance(form, Formulation):
            given = "none is given" if form is None else f"{form!r} is not one"
            example = 'Formulation("fine", {"beam.elements": 8})'
            raise declaration_error(f"with_and_without() takes formulations, such as {example}; {given}.")
    found = formulations
    for word, path in switches.items():
        pairs = [(form, on) for form in found for on in (False, True)]
        found = tuple(
            replace(form, name=f"{form.name}, {word}" if on else form.name, settings={**form.settings, path: on})
            for form, on in pairs
        )
    return found


def formulations_of(model: Component, given: Mapping[str, Any]) -> tuple[Formulation, ...]:
    """Return the formulations that a model declares, or those that follow from its fields.

    A model declares them as a class attribute `formulations`. If none of these agrees with the given values, each choice
    of its structural parameter `formulation` is one, refined by the numbers of elements of its components.

    Parameters
    ----------
    model : Component
        The model, not instantiated.
    given : mapping of str to value
        Values fixed by the user: formulations that contradict them are left out.
    """
    declared: Sequence[Formulation] = getattr(type(model), "formulations", ())
    found = [form for form in declared if _agrees(form, given)]
    return tuple(within(model, given, _with(form, given)) for form in found or _derived(model, given))


def within(model: Component, given: Mapping[str, Any], form: Formulation) -> Formulation:
    """Return a formulation with the upper limits of its numbers of elements.

    Parameters
    ----------
    model : Component
        The model, not instantiated.
    given : mapping of str to value
        Values fixed by the user.
    form : Formulation
        A formulation of this model.
    """
    if not form.refine:
        return form
    most: dict[str, int] = {}
    for component in walk(Instantiation(model, {**given, **form.at(0)[0]}).root):
        for name, declared in component.fields.items():
            path = join(component._path, name)
            if path in form.refine and isinstance(declared, f.Structural):
                greatest = largest(component, declared)
                most |= {} if greatest is None else {path: int(greatest)}
    return replace(form, most={**most, **form.most})


def _agrees(form: Formulation, given: Mapping[str, Any]) -> bool:
    return all(path not in given or same(given[path], value) for path, value in form.settings.items())


def _with(form: Formulation, given: Mapping[str, Any]) -> Formulation:
    """Return a formulation without refinement of numbers of elements that the user fixed."""
    return replace(form, refine={path: sizes for path, sizes in form.refine.items() if path not in given})


def _derived(model: Component, given: Mapping[str, Any]) -> Iterator[Formulation]:
    field_ = type(model).fields.get("formulation")
    kinds = field_.choices if isinstance(field_, f.Structural) else None
    for kind in kinds or (None,):
        own = {} if kind is None else {"formulation": kind}
        if not _agrees(Formulation("", own), given):
            continue
        tree = Instantiation(model, {**given, **own}).root
        yield Formulation("as given" if kind is None else str(kind), own, _refinement(tree))


def _refinement(tree: Component) -> dict[str, tuple[int, ...]]:
    """Return the sizes by path, without repetitions at the coarse end."""
    found = {path: _multiples(n, least, most) for path, n, least, most in _elements(tree)}
    steps = list(zip(*found.values(), strict=True))
    while len(steps) > 1 and steps[0] == steps[1]:
        del steps[0]
    return {path: sizes[len(sizes) - len(steps) :] for path, sizes in found.items()}


def _multiples(n: int, least: int, most: float | None) -> tuple[int, ...]:
    """Return multiples of a number within its limit, filled up with halves of it."""
    found = sorted({n * k if most is None else min(n * k, int(most)) for k in MULTIPLES})
    while len(found) < len(MULTIPLES):
        found.insert(0, min(max(found[0] // 2, least), found[0]))
    return tuple(found)


def _elements(component: Component) -> Iterator[tuple[str, int, int, float | None]]:
    """Yield paths, values and bounds of the topmost numbers of elements below a component."""
    own = [n for n, d in component.fields.items() if isinstance(d, f.Structural) and d.refine is not None]
    for name in own:
        declared: Any = component.fields[name]
        most = largest(component, declared)
        value = getattr(component, name)
        if value is None:  # None means the maximum
            value = most
        if value is not None:
            yield join(component._path, name), int(value), int(declared.minimum or 1), most
    if own:
        return
    for member in members(component):
        yield from _elements(member)
