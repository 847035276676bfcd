"""How expressions, values and shapes are written in messages."""

from __future__ import annotations

import re
from typing import Any

import casadi as ca

LONG = 60  # letters of an expression that are shown
DEEP = 40  # operations inside each other that are followed


def formatted(sx: ca.SX, shape: tuple[int, ...]) -> str:
    """Return an expression of a shape as a formula, each shared part where it is used."""
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
    """Return an expression, the end of a long one left out."""
    text = repr(value)
    return text if len(text) <= LONG else text[: LONG - 3] + "..."


def in_code(text: str, otherwise: str) -> str:
    """Return what Python writes for a value, something else where it is long or cannot stand in code."""
    return text if len(text) <= LONG and "\n" not in text and not re.search(r"<\w", text) else otherwise


def kind_of(shape: tuple[int, ...]) -> str:
    """Return a shape in words: a scalar, a vector of 3, a 3 x 2 matrix."""
    if not shape:
        return "a scalar"
    return f"a vector of {shape[0]}" if len(shape) == 1 else f"a {shape[0]} x {shape[1]} matrix"


def _scalar(sx: ca.SX, known: dict[int, str], depth: int) -> str:
    if sx.n_dep() == 0:
        return str(sx)
    key = sx.element_hash()
    if key not in known:
        if depth == 0:
            return "..."
        text = ca.print_operator(sx, [_scalar(sx.dep(k), known, depth - 1) for k in range(sx.n_dep())])
        known[key] = text if len(text) <= 4 * LONG else text[: 4 * LONG] + "..."
    return known[key]
