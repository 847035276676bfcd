"""Interval arithmetic (Moore 1966): bounds of a function of time over intervals of time.

The instructions of a CasADi function are evaluated with a lower and an upper bound for every value, for many intervals at
once. The bounds always enclose the range.
"""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
import numpy as np

Bounds = tuple[np.ndarray, np.ndarray]
# Relative widening after each operation, twice the unit round-off, so that the bounds enclose round-off as well.
ROUNDING = 4e-16
_RISING: dict[int, Callable[[np.ndarray], np.ndarray]] = {
    ca.OP_ASSIGN: np.positive,
    ca.OP_TWICE: lambda x: 2 * x,
    ca.OP_EXP: np.exp,
    ca.OP_LOG: lambda x: np.log(np.maximum(x, 0.0)),
    ca.OP_SQRT: lambda x: np.sqrt(np.maximum(x, 0.0)),
    ca.OP_ASIN: lambda x: np.arcsin(np.clip(x, -1, 1)),
    ca.OP_ATAN: np.arctan,
    ca.OP_SINH: np.sinh,
    ca.OP_TANH: np.tanh,
    ca.OP_FLOOR: np.floor,
    ca.OP_CEIL: np.ceil,
    ca.OP_SIGN: np.sign,
}
_STEPS = {ca.OP_FLOOR, ca.OP_CEIL, ca.OP_SIGN}
_EVEN: dict[int, Callable[[np.ndarray], np.ndarray]] = {ca.OP_SQ: np.square, ca.OP_FABS: np.abs, ca.OP_COSH: np.cosh}
_COMPARED: dict[int, Callable[[Bounds, Bounds], Bounds]] = {
    ca.OP_LT: lambda a, b: (a[1] < b[0], a[0] < b[1]),
    ca.OP_LE: lambda a, b: (a[1] <= b[0], a[0] <= b[1]),
    ca.OP_EQ: lambda a, b: ((a[0] == a[1]) & (b[0] == b[1]) & (a[0] == b[0]), (a[0] <= b[1]) & (b[0] <= a[1])),
    ca.OP_NE: lambda a, b: ((a[0] > b[1]) | (b[0] > a[1]), (a[0] != a[1]) | (b[0] != b[1]) | (a[0] != b[0])),
    ca.OP_AND: lambda a, b: (_surely(a) & _surely(b), _perhaps(a) & _perhaps(b)),
    ca.OP_OR: lambda a, b: (_surely(a) | _surely(b), _perhaps(a) | _perhaps(b)),
    ca.OP_NOT: lambda a, b: (~_perhaps(a), ~_surely(a)),
}


def bounds(function: ca.Function, p: np.ndarray, low: np.ndarray, high: np.ndarray) -> tuple[Bounds, np.ndarray]:
    """Bound the first entry of a function of parameters and time.

    Parameters
    ----------
    function : casadi.Function
        A function of scalar symbols (SX) that is `bounded`.
    p : array
        Parameter values.
    low, high : arrays, shape (n,)
        Intervals of time; a degenerate interval gives the value itself.

    Returns
    -------
    bounds : two arrays, shape (n,)
    jumps : array of bool, shape (n,)
        Whether the function may jump inside the interval, so that its derivative does not bound its change.
    """
    whole = np.full(len(low), np.inf)
    result, jumps = (-whole, whole), np.zeros(len(low), dtype=bool)
    exact = low == high
    work: dict[int, Bounds] = {}
    with np.errstate(all="ignore"):
        for k in range(function.n_instructions()):
            op, inputs, outputs = (
                function.instruction_id(k),
                function.instruction_input(k),
                function.instruction_output(k),
            )
            if op == ca.OP_OUTPUT:
                result = work[inputs[0]]
                continue
            if op == ca.OP_CONST:
                work[outputs[0]] = (one := np.full(len(low), function.instruction_constant(k)), one)
                continue
            if op == ca.OP_INPUT:
                given = np.full(len(low), p[inputs[1]]) if inputs[0] == 0 else None
                work[outputs[0]] = (low, high) if given is None else (given, given)
                continue
            a, b = work[inputs[0]], work[inputs[-1]]
            one, torn = _apply(op, a, b)
            lower, upper = (np.where(np.isnan(side), end, side) for side, end in zip(one, (-whole, whole), strict=True))
            slack = np.where(exact, 0.0, ROUNDING)
            work[outputs[0]] = lower - slack * np.abs(lower), upper + slack * np.abs(upper)
            jumps |= torn
    return result, jumps


def bounded(function: ca.Function) -> bool:
    """Return whether interval arithmetic knows all operations of a function."""
    return all(function.instruction_id(k) in _KNOWN for k in range(function.n_instructions()))


def _apply(op: int, a: Bounds, b: Bounds) -> tuple[Bounds, np.ndarray]:
    """Return the bounds of one operation, and where it may jump."""
    never = np.zeros(len(a[0]), dtype=bool)
    if op in _RISING:
        one = _RISING[op](a[0]), _RISING[op](a[1])
        return one, (one[0] != one[1]) if op in _STEPS else never
    if op in _EVEN:
        ends = _EVEN[op](a[0]), _EVEN[op](a[1])
        least = np.where((a[0] < 0) & (a[1] > 0), _EVEN[op](np.zeros(1)), np.minimum(*ends))
        return (least, np.maximum(*ends)), never
    if op in _COMPARED:
        low, high = _COMPARED[op](a, b)
        return (low.astype(float), high.astype(float)), low != high
    return _OTHERS[op](a, b), never


def _surely(a: Bounds) -> np.ndarray:
    return (a[0] > 0) | (a[1] < 0)


def _perhaps(a: Bounds) -> np.ndarray:
    return (a[0] != 0) | (a[1] != 0)


def _corners(operate: Callable[[np.ndarray, np.ndarray], np.ndarray], a: Bounds, b: Bounds) -> Bounds:
    values = np.nan_to_num([operate(x, y) for x in a for y in b], posinf=np.inf, neginf=-np.inf)
    return np.min(values, axis=0), np.max(values, axis=0)


def _inverse(a: Bounds) -> Bounds:
    around = (a[0] <= 0) & (a[1] >= 0)
    return np.where(around, -np.inf, 1 / a[1]), np.where(around, np.inf, 1 / a[0])


def _sine(a: Bounds, shift: float = 0.0) -> Bounds:
    """Bounds of sin(x + shift): -1 or 1 if an extremum lies inside the interval, otherwise the values at its ends."""
    ends = np.sin(a[0] + shift), np.sin(a[1] + shift)

    def holds(angle: float) -> np.ndarray:
        turns = np.ceil((a[0] + shift - angle) / (2 * np.pi) - 1e-9)
        return angle + 2 * np.pi * turns <= a[1] + shift + 1e-9 * (a[1] > a[0])

    point = a[0] == a[1]
    low = np.where(holds(-np.pi / 2) & ~point, -1.0, np.minimum(*ends))
    return low, np.where(holds(np.pi / 2) & ~point, 1.0, np.maximum(*ends))


def _tangent(a: Bounds, b: Bounds) -> Bounds:
    pole = np.floor(a[0] / np.pi + 0.5) != np.floor(a[1] / np.pi + 0.5)
    return np.where(pole, -np.inf, np.tan(a[0])), np.where(pole, np.inf, np.tan(a[1]))


def _power(a: Bounds, b: Bounds) -> Bounds:
    """Bounds of powers: any base with an integer exponent, otherwise nonnegative bases only."""
    low, high = _corners(np.power, (np.maximum(a[0], 0.0), np.maximum(a[1], 0.0)), b)
    n = b[0][0] if b[0].size else 1.0
    if np.all(b[0] == n) and np.all(b[1] == n) and n == round(n):
        ends = np.power(a[0], n), np.power(a[1], n)
        inside = (a[0] <= 0) & (a[1] >= 0)
        least = np.where(inside & (n > 0) & (n % 2 == 0), 0.0, np.minimum(*ends))
        wild = inside & (n < 0)
        return np.where(wild, -np.inf, least), np.where(wild, np.inf, np.maximum(*ends))
    known = a[0] >= 0
    return np.where(known, low, -np.inf), np.where(known, high, np.inf)


def _angle(y: Bounds, x: Bounds) -> Bounds:
    low, high = _corners(np.arctan2, y, x)
    cut = (x[0] < 0) & (y[0] <= 0) & (y[1] >= 0)
    return np.where(cut, -np.pi, low), np.where(cut, np.pi, high)


_OTHERS: dict[int, Callable[[Bounds, Bounds], Bounds]] = {
    ca.OP_ADD: lambda a, b: (a[0] + b[0], a[1] + b[1]),
    ca.OP_SUB: lambda a, b: (a[0] - b[1], a[1] - b[0]),
    ca.OP_NEG: lambda a, b: (-a[1], -a[0]),
    ca.OP_ACOS: lambda a, b: (np.arccos(np.clip(a[1], -1, 1)), np.arccos(np.clip(a[0], -1, 1))),
    ca.OP_MUL: lambda a, b: _corners(np.multiply, a, b),
    ca.OP_IF_ELSE_ZERO: lambda a, b: _corners(np.multiply, a, b),
    ca.OP_DIV: lambda a, b: _corners(np.multiply, a, _inverse(b)),
    ca.OP_INV: lambda a, b: _inverse(a),
    ca.OP_FMIN: lambda a, b: (np.minimum(a[0], b[0]), np.minimum(a[1], b[1])),
    ca.OP_FMAX: lambda a, b: (np.maximum(a[0], b[0]), np.maximum(a[1], b[1])),
    ca.OP_SIN: lambda a, b: _sine(a),
    ca.OP_COS: lambda a, b: _sine(a, np.pi / 2),
    ca.OP_TAN: _tangent,
    ca.OP_POW: _power,
    ca.OP_CONSTPOW: _power,
    ca.OP_ATAN2: _angle,
}
_KNOWN = {ca.OP_CONST, ca.OP_INPUT, ca.OP_OUTPUT, *_RISING, *_EVEN, *_COMPARED, *_OTHERS}
