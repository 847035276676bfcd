"""Hints for unbalanced models: discrete variables in equations, and overridden fields of another kind."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import casadi as ca

from acausal.flatten.component_tree import join, walk
from acausal.flatten.origin import value_origin
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.symbols import scalars


def wrong_kinds(tree: Component, residuals: Iterable[ca.SX]) -> list[str]:
    """Return hints on discrete variables in some equations, and on fields whose kind a class has changed.

    Parameters
    ----------
    tree : Component
        Bound model.
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
                f"`{path}` is a discrete variable, which is changed by when(condition, reinit(self.{path}, ...)) and "
                "not determined by an equation. Declare it variable(...) if an equation should determine it."
            )


def _changed(component: Component) -> Iterator[str]:
    """Yield hints on variables that a class overrides by parameters, and vice versa."""
    cls = type(component)
    for name, field in component.fields.items():
        for base in cls.__mro__[1:]:
            was = getattr(base, "fields", {}).get(name)
            if was is not None and _kind(was) != _kind(field) and _kind(was) and _kind(field):
                yield (
                    f"{value_origin(component, name)} is a {_kind(field)} here, but a {_kind(was)} in the equations of "
                    f"{base.__name__}: rename it."
                )
                break


def _kind(field: f.Field) -> str:
    """Return the kind of a field in equations; "" for other fields, and for inputs, which may become parameters."""
    if isinstance(field, f.Variable):
        return "variable" if field.causality != "input" else ""
    if isinstance(field, f.Structural):
        return "structural parameter"
    return "parameter" if isinstance(field, f.Parameter) else ""
