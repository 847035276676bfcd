"""Formulations: the ways in which a model can be discretised."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from acausal.errors import DeclarationError
from acausal.flatten.instantiate import Instantiation
from acausal.flatten.tree import join, members
from acausal.language import fields as f
from acausal.language.arguments import refused
from acausal.language.component import Component
from acausal.language.data import same

# Where a model does not say which numbers of elements to try: its own, twice and four times as many.
MULTIPLES = (1, 2, 4)


@dataclass(frozen=True)
class Formulation:
    """One way of discretising a model: the settings that select it, and what is refined in it.

    Parameters
    ----------
    name : str
        For tables and pictures.
    settings : mapping of str to value
        Structural parameters, effects or parameters by path that select it.
    refine : mapping of str to sequence of int
        Numbers of elements by path, from coarse to fine; those of several paths advance together.
    exact : bool
        True if it comes to the geometrically exact solution in the limit: a reference is made from it.

    Examples
    --------
    >>> Formulation("volumes", {"formulation": "substructured"}, {"volumes": (5, 10, 20)}, exact=True)  # doctest: +SKIP
    """

    name: str
    settings: Mapping[str, Any] = field(default_factory=dict)
    refine: Mapping[str, Sequence[int]] = field(default_factory=dict)
    exact: bool = False

    def __post_init__(self) -> None:
        lengths = {len(sizes) for sizes in self.refine.values()}
        if len(lengths) > 1 or 0 in lengths:
            raise DeclarationError(
                f"formulation `{self.name}`: sizes advance together, so each path of refine needs as many of them."
            )

    @property
    def steps(self) -> int:
        """Number of sizes."""
        return len(next(iter(self.refine.values()), (0,)))

    def at(self, step: int) -> tuple[dict[str, Any], str]:
        """Return settings and label of a size; beyond the last one, sizes double.

        Parameters
        ----------
        step : int
            0 is the coarsest.
        """
        last = self.steps - 1
        sizes = {path: n[min(step, last)] * 2 ** max(0, step - last) for path, n in self.refine.items()}
        return {**self.settings, **sizes}, " + ".join(map(str, dict.fromkeys(sizes.values())))


def with_and_without(*formulations: Formulation, **switches: str) -> tuple[Formulation, ...]:
    """Return each formulation twice for each switch: with it off, and with it on, then named "name, word".

    Parameters
    ----------
    *formulations : Formulation
        Those that have the switch.
    **switches : str
        Word for the name and path of the switch: stiffened="beam.geometric_stiffness".
    """
    for form in formulations or (None,):
        if not isinstance(form, Formulation):
            given = "none is given" if form is None else f"{form!r} is none"
            example = 'Formulation("fine", {"beam.elements": 8})'
            raise refused(f"with_and_without() takes formulations, such as {example}; {given}.")
    found = formulations
    for word, path in switches.items():
        pairs = [(form, on) for form in found for on in (False, True)]
        found = tuple(
            replace(form, name=f"{form.name}, {word}" if on else form.name, settings={**form.settings, path: on})
            for form, on in pairs
        )
    return found


def formulations_of(model: Component, given: Mapping[str, Any]) -> tuple[Formulation, ...]:
    """Return the formulations that a model declares, or those that its fields tell.

    A model declares them as a class attribute `formulations`. Where none of these fits what is given, each choice of its
    structural parameter `formulation` is one, and in each the numbers of elements of its components are refined.

    Parameters
    ----------
    model : Component
        Not built.
    given : mapping of str to value
        What the user fixed: formulations that contradict it are left out.
    """
    declared: Sequence[Formulation] = getattr(type(model), "formulations", ())
    found = [form for form in declared if _agrees(form, given)]
    return tuple(_with(form, given) for form in found or _derived(model, given))


def _agrees(form: Formulation, given: Mapping[str, Any]) -> bool:
    return all(path not in given or same(given[path], value) for path, value in form.settings.items())


def _with(form: Formulation, given: Mapping[str, Any]) -> Formulation:
    """Leave numbers of elements alone that the user fixed."""
    return replace(form, refine={path: sizes for path, sizes in form.refine.items() if path not in given})


def _derived(model: Component, given: Mapping[str, Any]) -> Iterator[Formulation]:
    field_ = type(model).fields.get("formulation")
    kinds = field_.choices if isinstance(field_, f.Structural) else None
    for kind in kinds or (None,):
        own = {} if kind is None else {"formulation": kind}
        if not _agrees(Formulation("", own), given):
            continue
        tree = Instantiation(model, {**given, **own}).root
        refine = {path: tuple(n * k for k in MULTIPLES) for path, n in _elements(tree)}
        yield Formulation("as given" if kind is None else str(kind), own, refine)


def _elements(component: Component) -> Iterator[tuple[str, int]]:
    """Paths and values of the topmost numbers of elements below a component."""
    own = [n for n, d in component.fields.items() if isinstance(d, f.Structural) and d.refine is not None]
    for name in own:
        yield join(component._path, name), getattr(component, name)
    if own:
        return
    for member in members(component):
        yield from _elements(member)
