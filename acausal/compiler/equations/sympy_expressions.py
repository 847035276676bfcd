"""Expressions of CasADi as expressions of sympy, to be read."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cache
from math import isfinite
from typing import Any

import casadi as ca

from acausal.instructions import CONSTANT, FIND, INPUT, LOAD, PUT, READABLE, VALUE, read_instructions

# Operations above which a subexpression that occurs more than once gets a name: written out, expressions grow exponentially.
LONG = 30
# Denominator of numbers that are written as fractions: 1/3 of a rule of Simpson, 5/6 of a shear factor.
SIMPLE = 12


def to_sympy(
    expressions: Sequence[ca.SX], names: Mapping[int, str] | None = None, shared: dict[Any, Any] | None = None
) -> list[Any]:
    """Return matrices or scalars of CasADi in sympy.

    Parameters
    ----------
    expressions : sequence of casadi.SX
        Expressions of any shape.
    names : mapping of int to str, optional
        Names of symbols by their hashes; others keep their own.
    shared : dict, optional
        Receives long subexpressions that occur more than once, by the symbols z1, z2, ... that stand for them. Without it all
        are written out.

    Returns
    -------
    list of sympy.Expr or sympy.Matrix
        A scalar for one of shape (1, 1), a dense matrix for others.
    """
    import sympy

    symbols = ca.symvar(ca.vertcat(ca.SX(0, 1), *(ca.vec(ca.densify(e)) for e in expressions)))
    function = ca.Function("f", [ca.vertcat(*symbols)], [ca.densify(e) for e in expressions], READABLE)
    own, operations = read_instructions(function), _operations()
    values: list[Any] = []
    long = [False] * len(own.op) if shared is None else _long_and_shared(own)
    for k, (op, arguments) in enumerate(zip(own.op, own.arguments, strict=True)):
        if op == INPUT:
            symbol = symbols[own.place[k][1]]
            values.append(sympy.Symbol((names or {}).get(symbol.element_hash(), symbol.name()), real=True))
        elif op == CONSTANT:
            values.append(_number(own.constant[k]))
        else:
            values.append(operations[op](*(values[i] for i in arguments)))
            if shared is not None and long[k] and not _is_condition(values[k]):
                symbol = sympy.Symbol(f"z{len(shared) + 1}", real=True)
                shared[symbol], values[k] = values[k], symbol
    found = []
    for expression, entries in zip(expressions, own.results, strict=True):
        rows, columns = expression.shape
        matrix = [[_as_number(values[entries[i + j * rows]]) for j in range(columns)] for i in range(rows)]
        found.append(matrix[0][0] if (rows, columns) == (1, 1) else sympy.Matrix(matrix))
    return found


def _long_and_shared(function: Any) -> list[bool]:
    """Return whether each value is used more than once and is long, written out in named values."""
    uses = Counter(i for arguments in function.arguments for i in arguments)
    size, found = list[int](), list[bool]()
    for k, arguments in enumerate(function.arguments):
        length = 1 + sum(size[i] for i in arguments)
        found.append(length > LONG and uses[k] > 1)
        size.append(1 if found[k] else length)
    return found


def _number(value: float) -> Any:
    import sympy

    if not isfinite(value):
        return sympy.Float(value)
    simple = Fraction(value).limit_denominator(SIMPLE)
    return sympy.Rational(simple.numerator, simple.denominator) if float(simple) == value else sympy.Float(value)


def _is_condition(x: Any) -> bool:
    """Return whether an expression is true or false; a symbol, which sympy counts among these, is a number here."""
    from sympy.core.relational import Relational
    from sympy.logic.boolalg import BooleanAtom, BooleanFunction

    return isinstance(x, Relational | BooleanAtom | BooleanFunction)


def _as_number(x: Any) -> Any:
    """Return 1 for what is true and 0 for what is false, as CasADi has them."""
    import sympy

    return sympy.Piecewise((1, x), (0, True), evaluate=False) if _is_condition(x) else x


def _as_condition(x: Any) -> Any:
    import sympy

    return x if _is_condition(x) else sympy.Ne(x, 0)


@cache
def _operations() -> dict[int, Callable[..., Any]]:
    """Return the functions of sympy by the operation codes of CasADi."""
    import sympy as sp

    def of_numbers(function: Callable[..., Any]) -> Callable[..., Any]:
        return lambda *arguments: function(*map(_as_number, arguments))

    arithmetic = {
        ca.OP_ASSIGN: lambda x: x,
        ca.OP_ADD: lambda x, y: x + y,
        ca.OP_SUB: lambda x, y: x - y,
        ca.OP_MUL: lambda x, y: x * y,
        ca.OP_DIV: lambda x, y: x / y,
        ca.OP_NEG: lambda x: -x,
        ca.OP_POW: lambda x, y: x**y,
        ca.OP_CONSTPOW: lambda x, y: x**y,
        ca.OP_SQ: lambda x: x**2,
        ca.OP_TWICE: lambda x: 2 * x,
        ca.OP_INV: lambda x: 1 / x,
        ca.OP_LOG1P: lambda x: sp.log(1 + x),
        ca.OP_EXPM1: lambda x: sp.exp(x) - 1,
        ca.OP_HYPOT: lambda x, y: sp.sqrt(x**2 + y**2),
        ca.OP_FMOD: lambda x, y: sp.sign(x) * sp.Mod(sp.Abs(x), sp.Abs(y)),
        ca.OP_COPYSIGN: lambda x, y: sp.Abs(x) * sp.sign(y),
        ca.OP_LT: lambda x, y: sp.Lt(x, y),
        ca.OP_LE: lambda x, y: sp.Le(x, y),
        ca.OP_EQ: lambda x, y: sp.Eq(x, y),
        ca.OP_NE: lambda x, y: sp.Ne(x, y),
        FIND: sp.Function("find"),
        LOAD: sp.Function("load"),
        PUT: sp.Function("put"),
        VALUE: sp.Function("value"),
    }
    names = "exp log sqrt sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh atan2 floor erf sign"
    arithmetic |= {getattr(ca, f"OP_{name.upper()}"): getattr(sp, name) for name in names.split()}
    arithmetic |= {ca.OP_CEIL: sp.ceiling, ca.OP_FABS: sp.Abs, ca.OP_FMIN: sp.Min, ca.OP_FMAX: sp.Max}
    logic = {
        ca.OP_NOT: lambda x: sp.Not(_as_condition(x)),
        ca.OP_AND: lambda x, y: sp.And(_as_condition(x), _as_condition(y)),
        ca.OP_OR: lambda x, y: sp.Or(_as_condition(x), _as_condition(y)),
        ca.OP_IF_ELSE_ZERO: lambda case, x: sp.Piecewise(
            (_as_number(x), _as_condition(case)), (0, True), evaluate=False
        ),
    }
    return {op: of_numbers(function) for op, function in arithmetic.items()} | logic
