"""Expressions as Modelica text; common subexpressions are written once."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import casadi as ca
import numpy as np

from acausal.core.tape import KIND
from acausal.errors import ExportError
from acausal.export.dae.expressions import NAMES
from acausal.instructions import READABLE, read_instructions
from acausal.symbols import scalars, stacked

# Depth of nesting and length in characters beyond which a subexpression gets a name: parsers recurse for each bracket.
DEEP, LONG = 12, 400
_SAME = ("sin", "cos", "tan", "exp", "log", "sinh", "cosh", "tanh", "sqrt")
_ARCS = ("sin", "cos", "tan")
FORMS = {
    **{
        "add": "({} + {})",
        "subtract": "({} - {})",
        "multiply": "({} * {})",
        "divide": "({} / {})",
        "negative": "(-{})",
    },
    **{"square": "({} ^ 2)", "twice": "(2.0 * {})", "reciprocal": "(1.0 / {})", "power": "({} ^ {})", "assign": "{}"},
    **{name: name + "({})" for name in _SAME},
    **{f"arc{name}": f"a{name}" + "({})" for name in _ARCS},
    **{
        "arctan2": "atan2({}, {})",
        "hypot": "sqrt({} ^ 2 + {} ^ 2)",
        "log1p": "log(1.0 + {})",
        "expm1": "(exp({}) - 1.0)",
    },
    **{
        "abs": "noEvent(abs({}))",
        "sign": "noEvent(sign({}))",
        "floor": "noEvent(floor({}))",
        "ceil": "noEvent(ceil({}))",
    },
    **{"fmin": "noEvent(min({}, {}))", "fmax": "noEvent(max({}, {}))", "fmod": "noEvent(rem({}, {}))"},
    "less": "noEvent(if {} < {} then 1.0 else 0.0)",
    "less_equal": "noEvent(if {} <= {} then 1.0 else 0.0)",
    "equal": "noEvent(if abs({} - {}) > 0.0 then 0.0 else 1.0)",
    "not_equal": "noEvent(if abs({} - {}) > 0.0 then 1.0 else 0.0)",
    "logical_not": "noEvent(if abs({}) > 0.0 then 0.0 else 1.0)",
    "logical_and": "noEvent(if abs({} * {}) > 0.0 then 1.0 else 0.0)",
    "logical_or": "noEvent(if abs({}) + abs({}) > 0.0 then 1.0 else 0.0)",
    "if_else_zero": "noEvent(if abs({}) > 0.0 then {} else 0.0)",
}
_PLAIN = re.compile(r"[^0-9A-Za-z_!#$%&()*+,\-./:;<>=?@\[\]^{}|~ ]")


class Names:
    """Unique quoted names of Modelica."""

    def __init__(self) -> None:
        self._taken: set[str] = set()

    def __call__(self, name: str) -> str:
        """Return a unique name derived from the given one."""
        plain = _PLAIN.sub("_", name) or "_"
        found, k = plain, 1
        while found in self._taken:
            k += 1
            found = f"{plain}#{k}"
        self._taken.add(found)
        return f"'{found}'"


def number(value: float) -> str:
    """Return a number in Modelica, with all digits."""
    if np.isnan(value):
        return "(0.0 / 0.0)"
    if np.isinf(value):
        return f"({'-' if value < 0 else ''}1.0 / 0.0)"
    return repr(float(value)) if value >= 0 else f"({float(value)!r})"


def modelica(expressions: ca.SX, known: Mapping[int, str], names: Names) -> tuple[list[str], list[tuple[str, str]]]:
    """Return the text of each expression, and names with texts of their common subexpressions.

    Parameters
    ----------
    expressions : casadi.SX
        A dense column.
    known : mapping of int to str
        Texts of symbols by their hashes.
    names : Names
        The names in use.

    Raises
    ------
    ExportError
        If an operation has no counterpart in Modelica.
    """
    symbols = ca.symvar(expressions)
    read = read_instructions(ca.Function("text", [stacked(symbols)], [expressions], READABLE))
    uses = np.bincount([k for arguments in read.arguments for k in arguments], minlength=len(read.op))
    shared: list[tuple[str, str]] = []
    text: list[str] = []
    depth: list[int] = []
    for node, (op, arguments) in enumerate(zip(read.op, read.arguments, strict=True)):
        if not arguments:
            place = read.place.get(node)
            text.append(number(read.constant[node]) if place is None else known[symbols[place[1]].element_hash()])
            depth.append(0)
            continue
        found, deep = _form(op, [text[k] for k in arguments]), 1 + max(depth[k] for k in arguments)
        if uses[node] > 1 or (uses[node] and (deep > DEEP or len(found) > LONG)):
            name = names(f"${len(shared) + 1}")
            shared.append((name, found))
            found, deep = name, 0
        text.append(found)
        depth.append(deep)
    return [text[node] for node in read.results[0]], shared


def _form(op: int, arguments: Sequence[str]) -> str:
    name = NAMES[KIND[op]] if op in KIND else ""
    if name not in FORMS:
        raise ExportError(f"the model contains an operation that Modelica does not have: {name or op}.")
    return FORMS[name].format(*arguments)


def texts(column: Sequence[str], sizes: Sequence[int]) -> list[list[str]]:
    """Split a list into parts of the given sizes."""
    ends = np.cumsum(sizes).tolist()
    return [list(column[end - n : end]) for end, n in zip(ends, sizes, strict=True)]


def hashed(symbols: ca.SX, texts: Sequence[str]) -> dict[int, str]:
    """Return the texts of symbols by their hashes."""
    return {s.element_hash(): text for s, text in zip(scalars(symbols), texts, strict=True)}
