"""Settings that would be ignored, because a model is built from its class and the arguments of its constructor alone."""

from __future__ import annotations

import difflib
import sys
from typing import Any

from acausal.errors import DeclarationError
from acausal.language import fields as f
from acausal.language.values import holds_parts, nearest_field


def refuse_value(component: Any, name: str, value: Any) -> str:
    """Return the message for a field that is set on an instance, and the ways that work.

    Parameters
    ----------
    component : Component
        A template, or a part of a built model.
    name : str
        The field.
    value : object
        What it should become.
    """
    cls, field = type(component), component.fields[name]
    if component._is_bound:
        path = f"{component._path}.{name}" if component._path else name
        return f"`{path}` is not set on a built model. {_by_path(path, field, value, compiled=True)}"
    given = f"{name}={_start(field, value)}"
    if _in_constructor(component):
        return f"`{name}` of {cls.__name__} goes to the constructor above: `super().__init__({given})`."
    by_path = f" {_by_path(name, field, value)}" if isinstance(field, f.Structural | f.Parameter) else ""
    return f"`{name}` of {cls.__name__} is not set on an instance: give it when it is made, `{cls.__name__}({given})`.{by_path}"


def refuse_path(path: str, cls: type | None, name: str, value: Any) -> str:
    """Return the message for a member of a part that is set on a model that is not built.

    Parameters
    ----------
    path : str
        The member: "tip.m".
    cls : type, optional
        The class that has it, if that is known.
    name : str
        Its name there.
    value : object
        What it should become.
    """
    known, kind = getattr(cls, "fields", {}), getattr(cls, "__name__", "")
    if known and name not in known:
        return f"{kind} has no field `{name}`; {nearest_field(cls, name)}"
    field, where = known.get(name), path.rpartition(".")[0]
    ways = [_by_path(path, field, value)] if not isinstance(field, f.Variable) or field.causality == "input" else []
    if field is not None:
        short = where if where.isidentifier() else "..."
        ways.append(f"Where the part is made: `{short} = {kind}({name}={_start(field, value)})`.")
    return f"`{path}` is not set on a model. {' '.join(ways)}"


def refuse_attribute(template: Any, name: str, value: Any) -> None:
    """Raise DeclarationError for an attribute of a template that is meant as a part, or as a field of similar name."""
    cls = type(template)
    if holds_parts(value):
        raise DeclarationError(
            f"`{name}` cannot become a part of {cls.__name__} by setting it: write it in the class body, "
            f"`{name} = {shown(value)}`, or, if it depends on structural values, as a method marked @part: "
            f"`@part def {name}(self): return ...`."
        )
    if not hasattr(cls, name) and not _in_constructor(template):
        near = difflib.get_close_matches(name, cls.fields, 1, 0.75)
        if near:
            raise DeclarationError(f"{cls.__name__} has no field `{name}`; did you mean `{near[0]}`?")


def _by_path(path: str, field: f.Field | None, value: Any, compiled: bool = False) -> str:
    mapping = f"parameters={{{path!r}: {shown(value)}}}"
    if isinstance(field, f.Variable) and field.causality != "input":
        return "Its start value is given in the model, where the part is made, by fixed(...) or guess(...)."
    if isinstance(field, f.Part | f.Outer | f.Observed):
        return "Parts are given in the class body or to the constructor of what has them; then compile again."
    if isinstance(field, f.Structural) or not compiled:
        return f"For one run: `ac.simulate(model, ..., {mapping})`; to keep it: `ac.compile(model, {mapping})`."
    return f"For one run: `ac.simulate(compiled, ..., {mapping})`."


def _in_constructor(component: Any) -> bool:
    """Whether the user's own __init__ of this component is being executed, in which the line stands."""
    frame = sys._getframe(3)
    return frame.f_code.co_name == "__init__" and any(v is component for v in frame.f_locals.values())


def _start(field: f.Field, value: Any) -> str:
    needs = isinstance(field, f.Variable) and field.causality != "input" and not isinstance(value, f.Start)
    return f"fixed({shown(value)})" if needs else shown(value)


def shown(value: Any) -> str:
    """Return a value as it is written in code, `...` where that is long."""
    if isinstance(value, f.Start):
        return f"{'fixed' if value.fixed else 'guess'}({shown(value.value)})"
    if isinstance(value, f.Template):
        given = vars(value).get("_values", {}).items()
        text = f"{type(value).__name__}({', '.join(f'{name}={shown(v)}' for name, v in given)})"
    else:
        text = repr(value)
    return text if len(text) <= 60 and "<" not in text else "..."
