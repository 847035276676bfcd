"""Messages for values that are invalid in expressions."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from inspect import isgenerator
from types import ModuleType
from typing import Any

import numpy as np

from acausal.errors import DeclarationError
from acausal.language.formatting import kind_of, short

# Class name: description and remedy. Names in place of classes avoid circular imports.
WORDS = {
    "Equation": ("an equation", "State it alone: yield a == b."),
    "Condition": ("an inequality", "A condition chooses a value: piecewise((value, a < b), otherwise)."),
    "Joined": ("a condition", "A condition chooses a value: piecewise((value, (a < b) & (c < d)), otherwise)."),
    "InitialValue": ("fixed(...) or guess(...)", "It is given alone: to a variable of a part, phi=fixed(0.1)."),
    "Reinit": ("reinit(...)", "Yield it in when(condition, reinit(variable, value))."),
    "When": ("when(...)", "Yield it alone in equations()."),
    "Path": ("a name in a model that is not built", "Write the part in the class body, and use self.part."),
}


def invalid_operand(value: Any) -> str:
    """Return the message for a value that is invalid in an expression."""
    what, remedy = _described(value)
    return f"{what} cannot stand in an expression. {remedy}"


def number_of(value: Any) -> float:
    """Return a value as a number of double precision."""
    try:
        return float(value)
    except OverflowError:
        digits = len(str(abs(value)))
        raise DeclarationError(f"a number of {digits} digits is too large; numbers reach to 1.8e308.") from None


def ragged(shapes: Sequence[tuple[int, ...]], value: object) -> str:
    """Return the message for entries of different shapes."""
    seen = " and ".join(dict.fromkeys(map(kind_of, shapes)))
    return f"the entries of a vector are scalars, the rows of a matrix have equal lengths; these are {seen}: {short(value)}."


def decimal_point(value: Any) -> str:
    """Return the remedy for a decimal comma, as in 1,5 and "1,5"; "" for other values."""
    parts = value.split(",") if isinstance(value, str) else value if isinstance(value, tuple) else ()
    texts = [str(part).strip() for part in parts]
    meant = len(texts) == 2 and re.fullmatch(r"[-+]?\d*", texts[0]) and re.match(r"\d+", texts[1])
    return f"; with a decimal point: {texts[0]}.{texts[1]}" if meant else ""


def _without_quotes(text: str) -> str:
    """Return the remedy for a text: its number, or a variable of its name."""
    try:
        float(text)
    except ValueError:
        if decimal_point(text):
            return f"Write a number{decimal_point(text)}."
        name = text if text.isidentifier() else "x"
        return f"Write a number, or a variable without quotes: self.{name}, in the class body {name}."
    return f"Write the number without quotes: {text.strip()}."


def _described(value: Any) -> tuple[str, str]:
    kind = type(value).__name__
    if kind in WORDS:
        return WORDS[kind]
    if value is None:
        return (
            "None",
            "Write a number. If you did not write None, a method lacks its `return`, or an optional part does not "
            "exist.",
        )
    if isinstance(value, str):
        return f"the text {value!r}", _without_quotes(value)
    if hasattr(value, "fields") and hasattr(value, "_ports"):
        names = [n for n, field in value.fields.items() if type(field).__name__ in ("Variable", "Parameter")]
        return f"the part {value!r}", f"Name one of its values{f', such as .{names[0]}' if names else ''}."
    if getattr(value, "is_deferred", False) is True:
        return "a field that belongs to no part", "Declare it in the class body, and use self.<name>."
    if isinstance(value, ModuleType):
        return (
            f"the module {value.__name__}",
            f"Import the function from acausal: from acausal import {value.__name__}.",
        )
    if isgenerator(value) or isinstance(value, Iterator):
        return "a generator", "Make a list of it: [... for ... in ...]."
    if isinstance(value, Callable):  # type: ignore[arg-type]
        return f"the function {getattr(value, '__name__', kind)}", f"Call it: {getattr(value, '__name__', 'f')}(...)."
    if isinstance(value, complex | np.complexfloating):
        return f"the complex number {value}", "Write real and imaginary part as two equations."
    if isinstance(value, set | dict):
        return f"a {kind}", "A vector has an order: (a, b, c)."
    return f"a {kind}, {value!r:.60},", "Give a number, or a variable or parameter of a part."
