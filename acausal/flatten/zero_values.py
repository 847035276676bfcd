"""Values of expressions where some unknowns are 0, and the unknowns that change them to first order there."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

import casadi as ca

from acausal.flatten.linear_values import LinearValues

# Functions with a derivative wherever they have a value, and where this derivative vanishes.
_SMOOTH: dict[int, Callable[[float], float]] = {
    ca.OP_NEG: lambda x: -x,
    ca.OP_TWICE: lambda x: 2 * x,
    ca.OP_ASSIGN: lambda x: x,
    ca.OP_SQ: lambda x: x * x,
    ca.OP_INV: lambda x: 1 / x,
    ca.OP_SIN: math.sin,
    ca.OP_COS: math.cos,
    ca.OP_TAN: math.tan,
    ca.OP_ATAN: math.atan,
    ca.OP_SINH: math.sinh,
    ca.OP_COSH: math.cosh,
    ca.OP_TANH: math.tanh,
    ca.OP_EXP: math.exp,
    ca.OP_LOG: math.log,
}
_PRODUCTS = {ca.OP_MUL, ca.OP_DIV}
_EVEN = {ca.OP_SQ, ca.OP_COS, ca.OP_COSH}
# Functions with an infinite derivative at an end of their range.
_OPEN: dict[int, Callable[[float], float]] = {ca.OP_SQRT: math.sqrt, ca.OP_ASIN: math.asin, ca.OP_ACOS: math.acos}
_INFINITE_AT = {ca.OP_SQRT: (0.0,), ca.OP_ASIN: (-1.0, 1.0), ca.OP_ACOS: (-1.0, 1.0)}


@dataclass
class ZeroValues:
    """Operations that are constant where some unknowns are 0, whatever the other unknowns and the parameters are.

    Attributes
    ----------
    constant : dict of int to float
        Value of each such operation; NaN where it has no derivative, as |x| at 0.
    changed_by : dict of int to int
        Bits of the unknowns that change it to first order there; missing for none.
    undefined : list of int
        Operations without a value there, as 1 / x.
    """

    constant: dict[int, float] = field(default_factory=dict)
    changed_by: dict[int, int] = field(default_factory=dict)
    undefined: list[int] = field(default_factory=list)


def zero_values(linear: LinearValues, bits: Mapping[int, int], nodes: Iterable[int]) -> ZeroValues:
    """Evaluate operations where the unknowns in `bits` are 0.

    Parameters
    ----------
    linear : LinearValues
        The operations.
    bits : mapping of int to int
        Bits that represent each of these unknowns.
    nodes : iterable of int
        Operations to evaluate, ascending, such as those that are constant where more unknowns are 0.
    """
    found = ZeroValues()
    constant, changed_by, get = found.constant, found.changed_by, found.constant.get
    values, operations, arguments = linear.value, linear.op, linear.args
    for node in nodes:
        value, own_bits = values[node], 0
        if value is not None:
            for unknown, _ in value[1]:
                if unknown not in bits:
                    break
                own_bits |= bits[unknown]
            else:
                constant[node] = value[0]
                if own_bits:
                    changed_by[node] = own_bits
            continue
        op, args = operations[node], arguments[node]
        if not args:
            continue
        a, b = get(args[0]), get(args[-1])
        # Most operations are not constant.
        if (a is None and (b != 0 or op not in _PRODUCTS)) or (b is None and (a != 0 or op not in _PRODUCTS)):
            continue
        own, own_bits = _operation(op, a, b, changed_by.get(args[0], 0), changed_by.get(args[-1], 0))
        if math.isinf(own):
            own = math.nan
            found.undefined.append(node)
        constant[node] = own
        if own_bits:
            changed_by[node] = own_bits
    return found


def _operation(op: int, a: float | None, b: float | None, a_bits: int, b_bits: int) -> tuple[float, int]:
    """Return the value of an operation, infinite if it has none, and its bits."""
    if op == ca.OP_MUL:
        if a is None or b is None:
            return 0.0, b_bits if a is None else a_bits
        return a * b, (a_bits if b else 0) | (b_bits if a else 0)
    if op == ca.OP_DIV:
        if not b:
            return (math.inf, 0) if b == 0 else (0.0, a_bits)
        assert a is not None
        return a / b, a_bits | (b_bits if a else 0)
    assert a is not None
    assert b is not None
    if op in (ca.OP_ADD, ca.OP_SUB):
        return a + b if op == ca.OP_ADD else a - b, a_bits | b_bits
    try:
        if op in _SMOOTH:
            return _SMOOTH[op](a), 0 if op in _EVEN and a == 0 else a_bits
        if op in _OPEN and a not in _INFINITE_AT[op]:
            return _OPEN[op](a), a_bits
        if op in (ca.OP_POW, ca.OP_CONSTPOW):
            return _power(a, b, a_bits | b_bits)
    except (ArithmeticError, ValueError):
        return math.inf, 0
    if op == ca.OP_ATAN2 and a == b == 0:
        return math.inf, 0
    return math.nan, 0


def _power(a: float, b: float, bits: int) -> tuple[float, int]:
    if a != 0:
        return a**b, bits
    if b == int(b) and b >= 0:
        return a**b, bits if b == 1 else 0
    return (math.nan if b > 0 else math.inf), 0
