"""Reading of class bodies: new fields, parts, and new values of inherited fields."""

from __future__ import annotations

import inspect
from copy import copy
from types import FunctionType, GeneratorType
from typing import Any

from acausal.errors import AcausalError, DeclarationError, user_line
from acausal.language import fields as f
from acausal.language.field_checks import check_field
from acausal.language.invalid_settings import refuse_misspelt_fields
from acausal.language.misspelt_fields import SETTABLE
from acausal.language.names import refuse_annotations, refuse_names, refuse_plain
from acausal.language.source_code import body_line
from acausal.language.types import shape_of_annotation
from acausal.language.value_checks import check_value, holds_parts, instance, instances, is_part_class, shown

_ABSENT: Any = object()


def read_body(cls: Any) -> None:
    """Set the `fields` of a class, inherited and own ones, and its new values of inherited fields.

    Parameters
    ----------
    cls : Component class
        Class whose body was executed.
    """
    fields: dict[str, f.Field] = {}
    settings: dict[str, Any] = {}
    plain: dict[str, Any] = {}
    for base in reversed(cls.__mro__[1:]):
        if "_own_fields" in vars(base):
            fields.update(vars(base)["_own_fields"])
            settings = {name: v for name, v in settings.items() if name not in vars(base)["_own_fields"]}
            settings.update(vars(base)["_own_values"])
            plain = {name: v for name, v in plain.items() if name not in vars(base)["_own_fields"]}
        else:
            plain.update(vars(base))
    # Values of a base class that is not a component count as values of this class body.
    body = {name: value for name, value in plain.items() if name in fields} | dict(vars(cls))
    refuse_names(cls, vars(cls))
    own: dict[str, f.Field] = {}
    new: dict[str, Any] = {}
    cls._own_fields, cls._own_values, cls.fields = own, new, fields
    for name, value in body.items():
        if not name.startswith("__"):
            try:
                _read(cls, name, value, fields.get(name), own, new)
            except AcausalError as error:
                error.line = body_line(cls, name)
                raise
    refuse_misspelt_fields(cls, {**plain, **vars(cls), **own}, fields)
    for name in body.keys() & inspect.get_annotations(cls).keys() - fields.keys():
        refuse_plain(cls, name, body[name])
    for name, field in own.items():
        if field.shape is None and not isinstance(field, f.Part | f.Outer):
            field.shape = shape_of_annotation(cls, name)
        check_field(cls, name, field)
    cls.fields = {**fields, **own}
    cls._class_values = {**{n: v for n, v in settings.items() if n not in own}, **new}
    cls._line = user_line()
    cls._as_read = {name: value for name, value in vars(cls).items() if not name.startswith("_")}


def refuse_late_fields(cls: Any) -> None:
    """Raise DeclarationError for attributes set on a class, or a base, after its creation: they have no effect."""
    for base in (base for base in cls.__mro__ if "_as_read" in vars(base)):
        late = {n: v for n, v in vars(base).items() if n[0] != "_" and base._as_read.get(n, _ABSENT) is not v}
        for name, value in late.items():
            if name in base.fields or isinstance(value, f.Field) or holds_parts(value):
                remedy = (
                    f"{base.__name__}({name}={shown(value)})" if name in cls.fields else "write it in the class body"
                )
                raise DeclarationError(
                    f"{base.__name__}.{name} = {shown(value)} was set after the class was created, and has no effect. "
                    f"Derive a class: `class My{base.__name__}({base.__name__}): {name} = {shown(value)}`, or {remedy}."
                )
        refuse_misspelt_fields(base, late, base.fields)
    refuse_annotations(cls)


def _read(
    cls: Any, name: str, value: Any, old: f.Field | None, own: dict[str, f.Field], settings: dict[str, Any]
) -> None:
    """Read one attribute of a class body; `old` is the inherited field of that name."""
    where = f"{cls.__name__}.{name}"
    if any(isinstance(getattr(value, inner, None), f.Field) for inner in ("__func__", "fget", "func")):
        raise DeclarationError(f"{where}: remove @{type(value).__name__}: a field needs no other decorator.")
    second = isinstance(value, f.Field) and _is_second_name(cls, value, name, own)
    if second and old is None and name in cls._settings and name not in SETTABLE:
        return  # a setting of the model that equals a field
    if isinstance(value, f.Field) and (value.name == name or not _has_value(old)):
        own[name] = value if value.name == name and value is not old else _named(copy(value), name)
        setattr(cls, name, own[name])
        if second and _has_value(value):
            settings[name] = value  # the value of the first field, unless it gets its own
    elif isinstance(value, f.Template):
        own[name] = f.Part("", make=value, is_port=value._is_port, name=name)
        # A template gets its name from the class: a second name needs a copy.
        twice = any(v is value for base in cls.__mro__ for n, v in vars(base).items() if n != name)
        setattr(cls, name, copy(value) if twice else value)
    elif is_part_class(value) and (isinstance(old, f.Part) or _stands_for_a_part(cls, name, value)):
        part = instance(value)
        own[name] = f.Part("", make=part, is_port=part._is_port, name=name)
        setattr(cls, name, part)
    elif isinstance(value, list | tuple) and (isinstance(old, f.Part) or (holds_parts(value) and name[0] != "_")):
        own[name] = f.Part("", make=instances(value, where), many=True, name=name)
        setattr(cls, name, own[name])
    elif name[0] != "_" and (holds_parts(value) or isinstance(value, GeneratorType)):
        raise DeclarationError(
            f"{where} is a {type(value).__name__}; declare parts one by one, or in a list: "
            f"`{name} = [Body(m=1), Body(m=2)]`, with the paths `{name}[0]`, `{name}[1]`."
        )
    elif isinstance(old, f.Part):
        own[name] = _part_instead(where, name, value, old)
        setattr(cls, name, own[name])
    elif old is not None:
        if isinstance(value, FunctionType | property | staticmethod | classmethod) and not _is_default(value, old):
            remedy = "decorate this method with @observed" if isinstance(old, f.Observed) else "rename this method"
            raise DeclarationError(f"{where} is a field of {cls.__name__}; {remedy}.")
        settings[name] = check_value(cls, name, value)
        setattr(cls, name, copy(old))  # it returns paths, as the inherited field does


def _is_second_name(cls: Any, field: f.Field, name: str, own: dict[str, f.Field]) -> bool:
    """Return whether a field already has another name in the class."""
    return field.name != name and any(known.get(field.name) is field for known in (own, cls.fields))


def _has_value(field: f.Field | None) -> bool:
    return isinstance(field, f.Parameter | f.Structural | f.Variable)


def _is_default(value: Any, old: f.Field) -> bool:
    """Return whether a value is a function for the default of a field, as in `default=`."""
    return isinstance(value, FunctionType) and isinstance(old, f.Parameter | f.Structural)


def _named(field: f.Field, name: str) -> f.Field:
    field.name = name
    return field


def _stands_for_a_part(cls: Any, name: str, value: Any) -> bool:
    """Return whether a class in a class body, such as `joint = Prismatic`, declares a part.

    It does not if the class is defined in this body, if the name is capitalised, or if the attribute is plain in a base
    or annotated as a type.
    """
    here = value.__qualname__ == f"{cls.__qualname__}.{value.__name__}"
    plain = any(name in vars(base) for base in cls.__mro__[1:])
    is_type = str(inspect.get_annotations(cls).get(name, "")).lower().startswith(("type", "<class 'type'", "classvar"))
    return name[0].islower() and not here and not plain and not is_type


def _part_instead(where: str, name: str, value: Any, old: f.Part) -> f.Part:
    """Return the part that replaces an inherited one."""
    if value is None:
        return f.Part(old.description, make=None, is_port=old.is_port, name=name)
    if isinstance(value, FunctionType):
        description = value.__doc__ or old.description
        return type(old)(description, make=value, many=old.many, is_port=old.is_port, name=name)
    raise DeclarationError(
        f"{where} is a part; replace it by a component, `{name} = Body(m=1)`, or by None to remove it, "
        f"not {f'the class {value.__name__}' if isinstance(value, type) else shown(value)}."
    )
