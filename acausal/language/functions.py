"""Functions of expressions; on fields of a class body they are deferred until the model is built."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import partial, wraps
from typing import Any

import casadi as ca

from acausal.errors import DeclarationError, UnitsError
from acausal.language import unit_rules
from acausal.language.call_arguments import checked_call
from acausal.language.condition import Condition, refuse_cases
from acausal.language.expression import Expr, as_expr, entrywise, is_deferred
from acausal.language.fields import Deferred
from acausal.language.formatting import kind_of
from acausal.language.pending import PENDING, Pending, pending_for, truth
from acausal.symbols import scalars
from acausal.units import DIMENSIONLESS, Dimension, parse

_SECOND = parse("s")
# Without a unit, so that sin(time) is valid, meant as 1 rad/s times time.
time = Expr(ca.SX.sym("time"), None, "time")
initial = Expr(ca.SX.sym("initial"), DIMENSIONLESS, "initial")
# Rate at which states return to an invariant (Baumgarte 1972): ten time constants in a run.
feedback = Expr(ca.SX.sym("feedback"), DIMENSIONLESS / _SECOND, "feedback")


def _deferrable(function: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(function)
    def call(*arguments: Any) -> Any:
        if is_deferred(*arguments):
            return Deferred(call, arguments)
        return function(*arguments)

    return checked_call(call)


def _elementary(name: str, operate: Callable[[ca.SX], ca.SX]) -> Callable[[Any], Any]:
    def function(x: Any) -> Expr:
        x = as_expr(x)
        if isinstance(x.unit, Dimension) and x.unit != DIMENSIONLESS:
            raise UnitsError(f"{name} needs a number or an angle, but {x!r} is in [{x.unit}].")
        return Expr(operate(x.sx), DIMENSIONLESS if x.unit is not None else None, shape=x.shape)

    function.__name__ = function.__qualname__ = name
    function.__doc__ = f"{name.capitalize()} of an expression, entry by entry; the argument is dimensionless or in rad."
    return _deferrable(function)


sin = _elementary("sin", ca.sin)
cos = _elementary("cos", ca.cos)
tan = _elementary("tan", ca.tan)
asin = _elementary("asin", ca.asin)
acos = _elementary("acos", ca.acos)
exp = _elementary("exp", ca.exp)
log = _elementary("log", ca.log)
tanh = _elementary("tanh", ca.tanh)


@_deferrable
def sqrt(x: Any) -> Any:
    """Square root of an expression, entry by entry."""
    x = as_expr(x)
    return Expr(ca.sqrt(x.sx), unit_rules.of_power(x, Fraction(1, 2)), shape=x.shape)


@_deferrable
def sign(x: Any) -> Any:
    """Sign of an expression, entry by entry: -1, 0 or 1; the integration stops where it changes."""
    x, pending = as_expr(x), PENDING.get(None)
    if x.sx.is_constant():
        return Expr(ca.sign(x.sx), DIMENSIONLESS, shape=x.shape)
    if pending is None:
        return Deferred(sign, (x,))
    entries = [_watched_sign(Expr(entry), pending) for entry in scalars(x.sx)]
    return Expr(ca.reshape(ca.vertcat(*entries), *x.sx.shape), DIMENSIONLESS, shape=x.shape)


def _watched_sign(x: Expr, pending: Pending) -> ca.SX:
    return pending.switch(Condition(-x, "<")) - pending.switch(Condition(x, "<"))


@_deferrable
def absolute(x: Any) -> Any:
    """Absolute value of an expression, entry by entry, as abs(x).

    The value is continuous: the integration stops only at kinks of functions of time alone.
    """
    x, pending = as_expr(x), PENDING.get(None)
    symbols = {s.element_hash() for s in ca.symvar(x.sx)}
    if time.sx.element_hash() not in symbols or (pending is not None and symbols & pending.varying):
        return Expr(ca.fabs(x.sx), x.unit, shape=x.shape)
    if pending is None:
        return Deferred(absolute, (x,))
    entries = [piecewise((-entry, entry < 0), entry).sx for entry in map(Expr, scalars(x.sx))]
    return Expr(ca.reshape(ca.vertcat(*entries), *x.sx.shape), x.unit, shape=x.shape)


@_deferrable
def atan2(y: Any, x: Any) -> Any:
    """Angle of the point (x, y) in rad, in (-pi, pi]."""
    y, x = as_expr(y), as_expr(x)
    shape = entrywise(y, "and", x)
    unit_rules.common(y, x, "the arguments of atan2")
    return Expr(ca.atan2(y.sx, x.sx), DIMENSIONLESS, shape=shape)


@_deferrable
def dot(a: Any, b: Any) -> Any:
    """Scalar product of two vectors, both resolved in the same frame."""
    return as_expr(a) @ as_expr(b)


@_deferrable
def cross(a: Any, b: Any) -> Any:
    """Vector product of two vectors of length 3, both resolved in the same frame."""
    a, b = as_expr(a), as_expr(b)
    if a.shape != (3,) or b.shape != (3,):
        raise DeclarationError(f"cross needs two vectors of length 3, not {kind_of(a.shape)} and {kind_of(b.shape)}.")
    one = isinstance(a.unit, Dimension | None) and isinstance(b.unit, Dimension | None)
    return Expr(ca.cross(a.sx, b.sx), unit_rules.of_product(a, b) if one else None)


@checked_call
def quantity(value: Any, unit: str) -> Expr:
    """Return a constant with a unit; a number without one takes the unit of the equation.

    Parameters
    ----------
    value : float or array
        The value in SI.
    unit : str
        SI unit of every entry.

    Examples
    --------
    >>> yield self.f == quantity(100, "N/m") * self.s  # doctest: +SKIP
    """
    if isinstance(value, str) or not isinstance(unit, str):
        raise DeclarationError(
            f'a quantity is a number and its unit, quantity(100, "N/m"), not quantity({value!r}, {unit!r}).'
        )
    number = as_expr(value)
    return Expr(number.sx, parse(unit), shape=number.shape)


@checked_call
def der(x: Any) -> Any:
    """Time derivative of an expression.

    Parameters
    ----------
    x : Expr
        Any expression of variables, parameters and time.

    Returns
    -------
    Expr
        Derivative, of the shape of `x`, its unit divided by s.
    """
    pending = pending_for("der()")
    x = as_expr(x)
    placeholder = pending.differentiate(x.sx)
    if isinstance(x.unit, tuple):
        unit: Any = tuple(None if u is None else u / _SECOND for u in x.unit)
    else:
        unit = x.unit / _SECOND if x.unit is not None else None
    return Expr(placeholder, unit, f"der({x.name})" if x.name else "", x.shape)


@checked_call
def piecewise(*cases: Any, smooth: bool = False) -> Any:
    """Value of the first case whose condition holds.

    Parameters
    ----------
    *cases : (value, Condition) pairs, then a value
        The last argument, without a condition, is the value otherwise. Where a condition compares `time` with an
        expression of parameters, alone or joined with others, its change is a time event: the integration stops there
        exactly. Changes of other conditions are state events, located to about the tolerance. A value that is
        differentiated must not jump.
    smooth : bool
        True declares that the value and its first two derivatives are continuous, so that no event is needed. A run in
        which the value jumps nevertheless ends with a warning.

    Returns
    -------
    Expr
        The value; all cases have one shape.

    Examples
    --------
    >>> torque = piecewise((0.01 * (1 - exp(-time / 0.167)), time <= 0.7), 0)  # doctest: +SKIP
    """
    refuse_cases(cases)
    flat = [item for case in cases[:-1] for item in (case[0], case[1].excess)] + [cases[-1]]
    if is_deferred(*flat) or (not smooth and PENDING.get(None) is None):
        return Deferred(partial(piecewise, smooth=smooth), cases)
    otherwise = as_expr(cases[-1])
    unit, laws = (
        otherwise.unit,
        [(ca.SX(1), otherwise.sx)],
    )  # (condition, value) of the cases, from last to first
    for choice, condition in reversed(cases[:-1]):
        choice = as_expr(choice)
        if choice.shape != otherwise.shape:
            raise DeclarationError(
                f"the cases of piecewise differ in shape: {kind_of(choice.shape)} and {kind_of(otherwise.shape)}."
            )
        last = Expr(otherwise.sx, unit, otherwise.name, otherwise.shape)
        unit = unit_rules.common(choice, last, "cases of a piecewise")
        laws.append((truth(condition) if smooth else pending_for("piecewise").switch(condition), choice.sx))
    _, value = _first_that_holds(laws[::-1])
    if smooth and (pending := PENDING.get(None)):
        pending.add_smooth_law([condition for _, condition in cases[:-1]], [law for _, law in reversed(laws)], value)
    return Expr(value, unit, shape=otherwise.shape)


def _first_that_holds(cases: list[tuple[ca.SX, ca.SX]]) -> tuple[ca.SX, ca.SX]:
    """Return whether any of the cases holds, and the value of the first case that holds, or else of the last one.

    The selections form a balanced tree: reverse differentiation of a chain of n selections takes n^2 operations.
    """
    if len(cases) == 1:
        return cases[0]
    half = len(cases) // 2
    (early, first), (late, second) = _first_that_holds(cases[:half]), _first_that_holds(cases[half:])
    return ca.logic_or(early, late), ca.if_else(early, first, second)
