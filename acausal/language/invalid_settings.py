"""Messages for assignments without effect: a model is built from its class and its constructor arguments only."""

from __future__ import annotations

import inspect
from typing import Any

import numpy as np

from acausal.errors import DeclarationError
from acausal.language import fields as f
from acausal.language.call_arguments import checked_call
from acausal.language.condition import Condition
from acausal.language.expression import Expr
from acausal.language.misspelt_fields import in_own_method, intended_name
from acausal.language.source_code import ENGINE
from acausal.language.value_checks import holds_parts, nearest_field, shown


def refuse_value(component: Any, name: str, value: Any) -> str:
    """Return the message for an assignment to a field of an instance, with valid alternatives.

    Parameters
    ----------
    component : Component
        Template, or part of a built model.
    name : str
        Name of the field.
    value : object
        Assigned value.
    """
    cls = type(component)
    field = component.fields[name] if name in component.fields else cls.fields[name]
    if component._is_bound:
        path = f"{component._path}.{name}" if component._path else name
        return f"`{path}` cannot be set on a built model. {_by_path(path, field, value, compiled=True)}"
    given = f"{name}={_start(field, value)}"
    if in_own_method(component, constructor=True):
        given = f"{name}={name}" if name in inspect.signature(cls.__init__).parameters else given
        return f"{cls.__name__}.__init__ must not set self.{name}; pass it on: super().__init__({given})."
    by_path = f" {_by_path(name, field, value)}" if isinstance(field, f.Structural | f.Parameter) else ""
    return f"`{name}` of {cls.__name__} cannot be set on an instance: it belongs in `{cls.__name__}({given})`.{by_path}"


def refuse_path(path: str, cls: type | None, name: str, value: Any) -> str:
    """Return the message for an assignment to a member of a part of a model that is not built.

    Parameters
    ----------
    path : str
        Path of the member: "tip.m".
    cls : type, optional
        Class of the part, if known.
    name : str
        Name of the member in its part.
    value : object
        Assigned value.
    """
    known, kind = getattr(cls, "fields", {}), getattr(cls, "__name__", "")
    if known and name not in known:
        return f"{kind} has no field `{name}`; {nearest_field(cls, name)}"
    field, where = known.get(name), path.rpartition(".")[0]
    ways = [_by_path(path, field, value)] if not isinstance(field, f.Variable) or field.causality == "input" else []
    if field is not None:
        short = where if where.isidentifier() else "..."
        ways.append(f"Where the part is created: `{short} = {kind}({name}={_start(field, value)})`.")
    return f"`{path}` cannot be set on a model. {' '.join(ways)}"


@checked_call
def refuse_attribute(component: Any, name: str, value: Any) -> None:
    """Raise DeclarationError for an attribute that is meant as a part or a field, or that nothing reads.

    Methods and the constructor of the component itself may set plain attributes.
    """
    cls = type(component)
    if holds_parts(value) and not component._is_bound:
        raise DeclarationError(
            f"`{name}` cannot become a part of {cls.__name__} by assignment: write it in the class body, "
            f"`{name} = {shown(value)}`, or, if it depends on structural values, as a method marked @part: "
            f"`@part def {name}(self): return ...`."
        )
    if isinstance(value, f.Field):
        kind = type(value).__name__.lower()
        raise DeclarationError(
            f"`{name}` cannot be declared by assignment to an instance of {cls.__name__}: declare fields in the class "
            f"body, `{name}: Scalar = {kind}(...)`, and give their values to the constructor, "
            f"{cls.__name__}({name}=...)."
        )
    declared = any(name in inspect.get_annotations(base) for base in cls.__mro__)
    if hasattr(cls, name) or declared or name in cls._settings:
        return
    if not in_own_method(component):
        setting = intended_name(cls, name, cls._settings)
        meant = f"did you mean `{setting}`?" if setting else nearest_field(cls, name)
        raise DeclarationError(
            f"{cls.__name__} has no field `{name}`; {meant} Keep data of your own under a private name, `_{name}`, or "
            "declare it in the class body."
        )
    near = intended_name(cls, name, [*cls.fields, *cls._settings])
    if near:
        raise DeclarationError(
            f"{cls.__name__} has no field `{name}`, and no method of it reads that; did you mean `{near}`? "
            f"Pass fields to the constructor above, `super().__init__(...)`; keep data of your own as `_{name}`."
        )


def refuse_misspelt_fields(cls: Any, body: dict[str, Any], inherited: dict[str, f.Field]) -> None:
    """Raise DeclarationError for a name in a class body that resembles an inherited field, setting or method.

    Parameters
    ----------
    cls : Component class
        The class.
    body : dict of str to object
        Attributes in its body.
    inherited : dict of str to Field
        Fields of its bases.
    """
    annotations = inspect.get_annotations(cls)
    new = {n: v for n, v in body.items() if n[0] != "_" and "ClassVar" not in str(annotations.get(n, ""))}
    before = {n for base in cls.__bases__ if issubclass(base, f.Template) for n in dir(base)}
    for name, value in new.items():
        field = isinstance(value, f.Field) and not isinstance(value, f.Part)
        if field or name in before or name in cls._settings:
            continue
        near = intended_name(cls, name, _alike(cls, value, inherited))
        if near:
            own = "" if callable(value) else f", or annotate it, `{name}: ClassVar = ...`"
            raise DeclarationError(
                f"{cls.__name__}.{name} is new, and nothing in the class reads it; did you mean `{near}`? "
                f"If it is intended, give it a private name, `_{name}`{own}."
            )


def _alike(cls: Any, value: Any, inherited: dict[str, f.Field]) -> list[str]:
    """Return the known names that fit the kind of a value."""
    if inspect.isfunction(value):
        bases = [base for base in cls.__mro__[1:] if base.__module__ == ENGINE]
        return [n for base in bases for n, v in vars(base).items() if inspect.isfunction(v) and n[0] != "_"]
    if isinstance(value, f.Part) or holds_parts(value):
        return [name for name, field in inherited.items() if isinstance(field, f.Part)]
    plain = int | float | complex | str | list | tuple | dict | np.ndarray | np.generic | None
    if isinstance(value, plain | f.InitialValue | f.Deferrable | Condition | Expr):
        return [*inherited, *cls._settings]
    return []


def _by_path(path: str, field: f.Field | None, value: Any, compiled: bool = False) -> str:
    mapping = f"parameters={{{path!r}: {shown(value)}}}"
    if isinstance(field, f.Variable) and field.causality != "input":
        return "Set its start value where the part is created, by fixed(...) or guess(...)."
    if isinstance(field, f.Part | f.Outer | f.Observed):
        return "Set parts in the class body or in the constructor of their component; then compile again."
    if isinstance(field, f.Structural) or not compiled:
        return f"For one run: `ac.simulate(model, ..., {mapping})`; to keep it: `ac.compile(model, {mapping})`."
    return f"For one run: `ac.simulate(compiled, ..., {mapping})`."


def _start(field: f.Field, value: Any) -> str:
    needs = isinstance(field, f.Variable) and field.causality != "input" and not isinstance(value, f.InitialValue)
    return f"fixed({shown(value)})" if needs else shown(value)
