"""Formatting of expressions, values and shapes in messages."""

from __future__ import annotations

import re
from typing import Any

import casadi as ca

LONG = 60  # characters of an expression in a message
DEEP = 40  # nesting depth of operations in a formula; deeper ones are "...", as the text grows exponentially


def formatted(sx: ca.SX, shape: tuple[int, ...]) -> str:
    """Return an expression as a formula, with shared subexpressions written out."""
    sx = ca.densify(sx)
    known: dict[int, str] = {}
    if not shape:
        return _scalar(sx, known, DEEP)
    rows = [[_scalar(sx[i, j], known, DEEP) for j in range(sx.shape[1])] for i in range(sx.shape[0])]
    if len(shape) == 1:
        return f"[{', '.join(row[0] for row in rows)}]"
    inner = [f"[{', '.join(row)}]" for row in rows]
    return f"[{', '.join(inner)}]"


def short(value: Any) -> str:
    """Return the text of a value, truncated if it is long."""
    text = repr(value)
    return text if len(text) <= LONG else text[: LONG - 3] + "..."


def in_code(text: str, otherwise: str) -> str:
    """Return the `repr` of a value if it is short and valid Python code, `otherwise` if not."""
    return text if len(text) <= LONG and "\n" not in text and not re.search(r"<\w", text) else otherwise


def kind_of(shape: tuple[int, ...]) -> str:
    """Return a shape in words: a scalar, a vector of 3, a 3 x 2 matrix."""
    if not shape:
        return "a scalar"
    return f"a vector of {shape[0]}" if len(shape) == 1 else f"a {shape[0]} x {shape[1]} matrix"


def _scalar(sx: ca.SX, known: dict[int, str], depth: int) -> str:
    if sx.n_dep() == 0 or sx.is_output():
        return "table(...)" if sx.is_output() else str(sx)
    key = sx.element_hash()
    if key not in known:
        if depth == 0:
            return "..."
        text = ca.print_operator(sx, [_scalar(sx.dep(k), known, depth - 1) for k in range(sx.n_dep())])
        known[key] = text if len(text) <= 4 * LONG else text[: 4 * LONG] + "..."
    return known[key]
