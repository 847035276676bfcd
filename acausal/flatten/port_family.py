"""Port families: ports with structural names, which replace their family among the fields of an instance."""

from __future__ import annotations

import keyword
from collections.abc import Mapping
from typing import Any

from acausal.errors import DeclarationError
from acausal.flatten.origin import Origin
from acausal.language import fields as f
from acausal.language.component import Component, Connector
from acausal.language.value_checks import shown


def enter_family(bound: Component, name: str, declared: f.Family, made: Any) -> dict[str, Connector]:
    """Add the ports of a family to the fields of a component; return their templates.

    Parameters
    ----------
    bound : Component
        Component under construction.
    name : str
        Name of the family.
    declared : Family
        Declaration of the family.
    made : dict of str to Connector
        Result of its method.

    Raises
    ------
    DeclarationError
        If the result is not a dict of connectors, or a name is invalid for a port.
    """
    place = Origin(bound._path, type(bound).__name__, declared.where, name)
    if not isinstance(made, Mapping):
        raise DeclarationError(
            f"{place}: @ports decorates a method that returns a dict of ports by name, "
            f'{{"tip": Frame()}}, not {shown(made)}.'
        )
    for port, template in made.items():
        if wrong := _wrong_name(bound, port):
            # Names depend on constructor arguments, so the line of the construction is shown.
            raise DeclarationError(f"{Origin.of(bound)}: {wrong}")
        if not isinstance(template, Connector) or template._is_bound:
            raise DeclarationError(f"{place}: `{port}` must be a port, such as Frame(), not {invalid_part(template)}.")
    ports = {
        port: f.Part(declared.description, make=template, is_port=True, name=port, family=name)
        for port, template in made.items()
    }
    fields: dict[str, f.Field] = {}
    for known, field in bound.fields.items():
        fields |= ports if known == name else {known: field}
    vars(bound)["fields"] = fields
    return dict(made)


def _wrong_name(bound: Component, port: Any) -> str:
    """Return the message for an invalid name of a port, "" for a valid one."""
    if not isinstance(port, str):
        return f"the name of a port is a string, not {shown(port)}."
    if not port.isidentifier() or keyword.iskeyword(port) or port.startswith("_"):
        return (
            f"{port!r} cannot be the name of a port, `body.tip`: use letters, digits and `_`, begin with a letter, and "
            "use no keyword of Python."
        )
    cls = type(bound)
    if port in bound.fields or port in vars(bound) or any(port in vars(base) for base in cls.__mro__):
        what = "a field" if port in bound.fields else "a name"
        return f"`{port}` is {what} of {cls.__name__} already; give the port another name."
    return ""


def invalid_part(value: Any) -> str:
    """Describe a value that is not a part, for messages."""
    if isinstance(value, type):
        return f"the class {value.__name__}: write {value.__name__}(...)"
    if isinstance(value, Component) and value._is_bound:
        return f"{value._path or 'a model'}, a part of another model"
    return "a list in a list" if isinstance(value, list) else shown(value)
