"""Fields of another kind than equations take them for: discrete variables, and fields in place of inherited ones."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import casadi as ca

from acausal.flatten.component_tree import join, walk
from acausal.flatten.origin import value_origin
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.symbols import scalars


def wrong_kinds(tree: Component, residuals: Iterable[ca.SX]) -> list[str]:
    """Name discrete variables in some equations, and fields whose kind a class has changed, where a model is unbalanced.

    Parameters
    ----------
    tree : Component
        The model.
    residuals : iterable of casadi.SX
        Equations that determine too few unknowns.
    """
    inside = {s.element_hash() for residual in residuals for s in ca.symvar(residual)}
    return [line for c in walk(tree) for line in (*_discrete(c, inside), *_changed(c))]


def _discrete(component: Component, inside: set[int]) -> Iterator[str]:
    for name, field in component.fields.items():
        is_discrete = isinstance(field, f.Variable) and field.causality == "discrete"
        if is_discrete and any(s.element_hash() in inside for s in scalars(getattr(component, name).sx)):
            path = join(component._path, name)
            yield (
                f"`{path}` is a discrete variable: no equation determines it; it changes by when(condition, reinit(self.{path}, "
                "...)). Declare it variable(...) if an equation is to determine it."
            )


def _changed(component: Component) -> Iterator[str]:
    """Variables that a class replaces by parameters, and the other way round."""
    cls = type(component)
    for name, field in component.fields.items():
        for base in cls.__mro__[1:]:
            was = getattr(base, "fields", {}).get(name)
            if was is not None and _kind(was) != _kind(field) and _kind(was) and _kind(field):
                yield (
                    f"{value_origin(component, name)} is a {_kind(field)}, in place of the {_kind(was)} of {base.__name__} "
                    "whose equations hold it: give it another name."
                )
                break


def _kind(field: f.Field) -> str:
    """Word for a field that equations hold, "" for others and for inputs, which may become parameters."""
    if isinstance(field, f.Variable):
        return "variable" if field.causality != "input" else ""
    if isinstance(field, f.Structural):
        return "structural parameter"
    return "parameter" if isinstance(field, f.Parameter) else ""
