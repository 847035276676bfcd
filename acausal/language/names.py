"""Reserved names in class bodies, and annotations that declare nothing."""

from __future__ import annotations

import inspect
import re
from collections.abc import Mapping
from functools import cache
from types import FunctionType
from typing import Any

from acausal.language import fields as f
from acausal.language.call_arguments import declaration_error
from acausal.language.source_code import ENGINE, body_line
from acausal.language.types import shape_of_annotation
from acausal.language.value_checks import shown

PLAIN = ("ends", "start_words", "without_soft")  # reserved attributes that are not methods
EXAMPLES = {
    "connections": "yield connect(self.a, self.b)",
    "equations": "yield self.x == ...",
    "initial_equations": "yield self.x == ...",
    "check": "...",
    "requirements": "yield require(...)",
    "validity": "yield expect(...)",
    "shapes": "yield geometry.Sphere(...)",
}


def refuse_names(cls: Any, body: Mapping[str, Any]) -> None:
    """Raise DeclarationError for a reserved name with a value of another kind.

    Parameters
    ----------
    cls : Component class
        Class whose body was executed.
    body : mapping of str to object
        Attributes in the body.
    """
    if cls.__module__ == ENGINE:
        return
    engine: dict[str, Any] = {}
    for base in cls.__mro__[:0:-1]:
        if base.__module__ in (ENGINE, f.__name__):
            engine |= vars(base)
    for name, value in body.items():
        wrong = _reserved(cls, name, value, engine)
        if wrong:
            raise declaration_error(f"{cls.__name__}.{name}: {wrong}", body_line(cls, name))


def refuse_annotations(cls: Any) -> None:
    """Raise DeclarationError for an annotation without a value that looks like a field."""
    for base in cls.__mro__:
        for name in inspect.get_annotations(base) if "_own_fields" in vars(base) else ():
            if name in cls.fields or hasattr(cls, name):
                continue
            if _is_call(inspect.get_annotations(base)[name]):
                raise declaration_error(
                    f"{base.__name__}.{name} has no value: use `=` instead of `:`. Write `{name} = ...`, or "
                    f"`{name}: Scalar = ...` for a field.",
                    base._line,
                )
            if shape_of_annotation(base, name) is None:
                continue
            kind = inspect.get_annotations(base)[name]
            kind = kind if isinstance(kind, str) else kind.__name__
            raise declaration_error(
                f'{base.__name__}.{name} has a type, but is not declared: write `{name}: {kind} = variable("...")`, or '
                "parameter, input, output.",
                base._line,
            )


def _is_call(annotation: Any) -> bool:
    """Return whether an annotation is a part or a field, or the text of a call."""
    made = isinstance(annotation, f.Template | f.Field)
    return made or (isinstance(annotation, str) and re.match(r"[\w.]+\(", annotation) is not None)


def refuse_plain(cls: Any, name: str, value: Any) -> None:
    """Raise DeclarationError for a plain value that is annotated as a field."""
    annotation = inspect.get_annotations(cls).get(name)
    if isinstance(value, f.Field) or shape_of_annotation(cls, name) is None or isinstance(value, property):
        return
    kind = annotation if isinstance(annotation, str) else annotation.__name__  # type: ignore[union-attr]
    if inspect.isfunction(value):
        word = value.__name__
        remedy = f'`{word}` is not called: write `{name}: {kind} = {word}("...")`'
    else:
        remedy = (
            f'it is {shown(value)}, not a field: write `{name}: {kind} = parameter("...", default={shown(value)})`; a '
            f"constant has no type, `{name} = {shown(value)}`"
        )
    raise declaration_error(f"{cls.__name__}.{name}: {remedy}.", body_line(cls, name))


def _reserved(cls: Any, name: str, value: Any, engine: Mapping[str, Any]) -> str:
    """Return the message for a value of a reserved name, "" if it is valid."""
    field = isinstance(value, f.Field | f.Template)
    if name == "__post_init__":
        return (
            "a component class has none. Move its code to check(), or to an __init__ that calls super().__init__(...)."
        )
    if name not in engine or name.startswith("__"):
        return ""
    old = engine[name]
    if not inspect.isfunction(old) or name[0] == "_":
        plain = name in PLAIN and not field and not callable(value)
        return "" if plain else "this name is reserved; choose another one."
    if isinstance(value, FunctionType) and _takes(value, old):
        return ""
    written = ", ".join(_arguments(old))
    form = f"`def {name}({written}): {EXAMPLES.get(name, 'return ...')}`"
    if not isinstance(value, FunctionType):
        marked = isinstance(value, property | staticmethod | classmethod)
        what = f"remove @{type(value).__name__}." if marked else f"write that instead of `{name} = {shown(value)}`."
        other = f"rename this {'part' if isinstance(value, f.Template | f.Part) else 'field'}." if field else what
        return f"every component has a method of this name, {form}; {other}"
    return f"this method takes {'only self' if written == 'self' else written}: {form}."


@cache
def _arguments(method: FunctionType) -> tuple[str, ...]:
    return tuple(inspect.signature(method).parameters)


def _takes(method: FunctionType, old: FunctionType) -> bool:
    """Return whether a method takes the arguments of the method that it overrides."""
    try:
        inspect.signature(method).bind(*_arguments(old))
    except TypeError:
        return False
    return True
